#include "mdat/stereo/shot_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(ShotNoise, HasThePoissonProbabilities) {
  VERIFIES("LASSO-STE-001~1");
  sim::Random random(11);
  constexpr int kDraws = 100000;
  for (const double mean : {0.0, 0.3, 2.5, 20.0}) {
    std::vector<int> counts(60, 0);
    for (int i = 0; i < kDraws; ++i) ++counts.at(static_cast<std::size_t>(shot_noise(mean, random)));
    for (int k = 0; k < 30; ++k) {
      const double share = std::exp(-mean + (mean > 0 ? k * std::log(mean) : k > 0 ? -1e9 : 0) - std::lgamma(k + 1.0));
      const double sigma = std::sqrt(share * (1 - share) / kDraws);
      EXPECT_NEAR(counts[static_cast<std::size_t>(k)] / double{kDraws}, share, 5 * sigma + 1e-5) << mean << " " << k;
    }
  }
}

TEST(ShotNoise, OfManyElectronsHasMeanAndVarianceAlike) {
  VERIFIES("LASSO-STE-001~1");
  sim::Random random(12);
  for (const double mean : {kManyElectrons, 5000.0}) {
    double sum = 0, squares = 0;
    constexpr int kDraws = 40000;
    for (int i = 0; i < kDraws; ++i) {
      const double off = shot_noise(mean, random) - mean;
      EXPECT_EQ(off + mean, std::floor(off + mean));
      sum += off;
      squares += off * off;
    }
    EXPECT_NEAR(sum / kDraws, 0, 5 * std::sqrt(mean / kDraws));
    EXPECT_NEAR(squares / kDraws / mean, 1, 0.05);
  }
}

}  // namespace
}  // namespace lasso::mdat
