#include "mdat/common/limits.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// Sum of the binomial probabilities of `from` to `to` cases within, of `cases`, at this share.
double probability(int from, int to, int cases, double share) {
  double sum = 0;
  for (int k = from; k <= to; ++k)
    sum += std::exp(std::lgamma(cases + 1.0) - std::lgamma(k + 1.0) - std::lgamma(cases - k + 1.0) + k * std::log(share) +
                    (cases - k) * std::log1p(-share));
  return sum;
}

TEST(ShareLimits, AreTheClosedFormsWhereAllOrNoneAreWithin) {
  VERIFIES("LASSO-GND-052~1");
  EXPECT_NEAR(share_limits(0, 10, 0.95).upper, 1 - std::pow(0.025, 0.1), 1e-14);  // 0.3085, as published
  EXPECT_NEAR(share_limits(10, 10, 0.95).lower, std::pow(0.025, 0.1), 1e-14);
  EXPECT_EQ(share_limits(0, 10, 0.95).lower, 0);
  EXPECT_EQ(share_limits(10, 10, 0.95).upper, 1);
  EXPECT_NEAR(lower_share_limit(500, 500, 0.95), std::pow(0.05, 1 / 500.0), 1e-14);  // 3 / n
  EXPECT_NEAR(upper_share_limit(0, 500, 0.95), 1 - std::pow(0.05, 1 / 500.0), 1e-14);
}

// Their definition: at the limit, as many within or more (less) have the probability that is left.
TEST(ShareLimits, LeaveHalfOfTheDoubtOnEitherSide) {
  VERIFIES("LASSO-GND-052~1");
  for (const int within : {1, 7, 250, 497, 499}) {
    const Limits limits = share_limits(within, 500, 0.9);
    EXPECT_NEAR(probability(within, 500, 500, limits.lower), 0.05, 1e-9) << within;
    EXPECT_NEAR(probability(0, within, 500, limits.upper), 0.05, 1e-9) << within;
    EXPECT_NEAR(probability(within, 500, 500, lower_share_limit(within, 500, 0.99)), 0.01, 1e-9) << within;
    EXPECT_NEAR(probability(0, within, 500, upper_share_limit(within, 500, 0.99)), 0.01, 1e-9) << within;
  }
}

TEST(ShareLimits, KnowNothingWithoutCases) {
  VERIFIES("LASSO-GND-052~1");
  EXPECT_EQ(share_limits(0, 0, 0.95).lower, 0);
  EXPECT_EQ(share_limits(0, 0, 0.95).upper, 1);
}

TEST(ShareLimits, CloseInOnTheShareOfABillionCases) {
  VERIFIES("LASSO-GND-052~1");
  for (const double share : {0.5, 0.999}) {  // where the normal approximation is good
    const Limits limits = share_limits(share * 1e9, 1e9, 0.95);
    const double sigma = std::sqrt(share * (1 - share) / 1e9);
    EXPECT_NEAR((share - limits.lower) / sigma, 1.96, 0.03);
    EXPECT_NEAR((limits.upper - share) / sigma, 1.96, 0.03);
  }
}

}  // namespace
}  // namespace lasso::mdat
