// Shot noise of light: how many electrons a pixel collects.
#pragma once

#include "hal_sim/random.hpp"

namespace lasso::mdat {

constexpr double kManyElectrons = 64;

// A Poisson number of this mean (>= 0). Below kManyElectrons exactly, as a product of uniform numbers (Knuth 1969, 3.4.1); above, a
// rounded normal number of the same mean and variance, whose skewness of at most 1/8 is left out.
double shot_noise(double mean_e, sim::Random& random);

}  // namespace lasso::mdat
