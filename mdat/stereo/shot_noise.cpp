#include "mdat/stereo/shot_noise.hpp"

#include <algorithm>
#include <cmath>

#include "fsw/geometry/portable_math.hpp"

namespace lasso::mdat {

double shot_noise(double mean_e, sim::Random& random) {
  if (mean_e >= kManyElectrons) return std::max(0.0, std::floor(mean_e + std::sqrt(mean_e) * random.gaussian() + 0.5));
  const double none = exponential(-mean_e);  // probability of no electron
  double count = 0;
  double product = random.uniform();
  while (product > none) {
    product *= random.uniform();
    ++count;
  }
  return count;
}

}  // namespace lasso::mdat
