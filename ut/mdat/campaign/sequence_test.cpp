#include "mdat/campaign/sequence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "hal_sim/random.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using LimitsOf = Limits (*)(double within, double cases, double confidence);

constexpr double kRates[] = {0.001, 0.01, 0.1};
constexpr int kCampaigns = 1000, kCasesEach = 2000, kLookEvery = 50;
constexpr double kConfidence = 0.95;

bool covers(const Limits& limits, double share) { return limits.lower <= share && share <= limits.upper; }

// Limits by number of cases and failures, which campaigns have in common.
class Known {
 public:
  explicit Known(LimitsOf of) : of_(of) {}
  const Limits& at(int failures, int cases) {
    const auto [place, is_new] = limits_.try_emplace({failures, cases});
    if (is_new) place->second = of_(failures, cases, kConfidence);
    return place->second;
  }

 private:
  LimitsOf of_;
  std::map<std::pair<int, int>, Limits> limits_;
};

// Campaigns whose limits cover the true rate, of 1,000: after all cases, and at every look, as if each campaign stopped where its limits
// are wrong. No stopping rule covers less than that.
struct Coverage {
  int at_end = 0, at_every_look = 0;
};

Coverage simulate(LimitsOf of, double rate) {
  Known limits(of);
  Coverage coverage;
  for (int campaign = 0; campaign < kCampaigns; ++campaign) {
    sim::Random random = sim::ray_stream(33, static_cast<std::uint32_t>(campaign), static_cast<std::uint32_t>(1e6 * rate));
    bool always = true;
    int failures = 0;
    for (int cases = 1; cases <= kCasesEach; ++cases) {
      failures += random.uniform() < rate ? 1 : 0;
      if (cases % kLookEvery == 0) always = always && covers(limits.at(failures, cases), rate);
    }
    coverage.at_every_look += always ? 1 : 0;
    coverage.at_end += covers(limits.at(failures, kCasesEach), rate) ? 1 : 0;
  }
  return coverage;
}

// Of Clopper and Pearson's limits: the sum of the probabilities of the numbers of failures whose limits cover the rate.
double exact_coverage(double rate) {
  double sum = 0;
  for (int k = 0; k <= kCasesEach; ++k) {
    if (!covers(share_limits(k, kCasesEach, kConfidence), rate)) continue;
    sum += std::exp(std::lgamma(kCasesEach + 1.0) - std::lgamma(k + 1.0) - std::lgamma(kCasesEach - k + 1.0) + k * std::log(rate) +
                    (kCasesEach - k) * std::log1p(-rate));
  }
  return sum;
}

TEST(ShareSequence, CoversTheTruthWheneverACampaignStops) {
  VERIFIES("LASSO-GND-053~1");
  std::printf("coverage of %d simulated campaigns of %d cases, with looks after each %d\n", kCampaigns, kCasesEach, kLookEvery);
  std::printf("failure rate   fixed   exact   fixed, looked at   sequence, looked at\n");
  for (const double rate : kRates) {
    const Coverage fixed = simulate(share_limits, rate), sequence = simulate(share_sequence, rate);
    const double exact = exact_coverage(rate), error = std::sqrt(exact * (1 - exact) / kCampaigns);
    std::printf("%10.1f %%  %5.1f %%  %5.1f %%           %5.1f %%               %5.1f %%\n", 100 * rate, 0.1 * fixed.at_end, 100 * exact,
                0.1 * fixed.at_every_look, 0.1 * sequence.at_every_look);
    EXPECT_GE(exact, 0.95);
    EXPECT_NEAR(fixed.at_end / 1000.0, exact, 3 * error) << rate;
    EXPECT_GE(sequence.at_every_look, 950) << rate;
    EXPECT_LT(fixed.at_every_look, 936) << rate;  // limits of a fixed number, looked at again and again, are the mistake to avoid
  }
}

// The mixture integrated numerically, as its source writes it.
double log_ratio(int within, int cases, double share) {
  double sum = 0;
  const int steps = 20000;
  for (int i = 0; i < steps; ++i) {  // p = sin^2(angle): Beta(1/2, 1/2) is uniform in the angle
    const double angle = (i + 0.5) / steps * std::acos(-1.0) / 2, p = std::pow(std::sin(angle), 2);
    sum += std::exp(within * std::log(p / share) + (cases - within) * std::log((1 - p) / (1 - share)));
  }
  return std::log(sum / steps);
}

TEST(ShareSequence, EndsWhereTheMixtureRatioReachesOneOverAlpha) {
  VERIFIES("LASSO-GND-053~1");
  for (const int within : {3, 20, 39}) {
    const Limits limits = share_sequence(within, 40, 0.9);
    EXPECT_NEAR(log_ratio(within, 40, limits.lower), std::log(10), 1e-6) << within;
    EXPECT_NEAR(log_ratio(within, 40, limits.upper), std::log(10), 1e-6) << within;
    EXPECT_LT(limits.lower, within / 40.0);
    EXPECT_GT(limits.upper, within / 40.0);
  }
}

TEST(ShareSequence, IsOneSidedWhereAllOrNoneAreWithin) {
  VERIFIES("LASSO-GND-053~1");
  // one case, within: B(3/2, 1/2) / B(1/2, 1/2) = 1/2, so that 1/2 / p = 20 at p = 1/40
  EXPECT_NEAR(share_sequence(1, 1, 0.95).lower, 1.0 / 40, 1e-15);
  EXPECT_EQ(share_sequence(1, 1, 0.95).upper, 1);
  EXPECT_NEAR(share_sequence(0, 1, 0.95).upper, 39.0 / 40, 1e-15);
  EXPECT_EQ(share_sequence(0, 1, 0.95).lower, 0);
  EXPECT_EQ(share_sequence(0, 0, 0.95).upper, 1);
}

}  // namespace
}  // namespace lasso::mdat
