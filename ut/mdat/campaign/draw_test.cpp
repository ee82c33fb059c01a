#include "mdat/campaign/draw.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/run/simulated_scenario.hpp"
#include "ut/mdat/campaign/distributions.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

constexpr std::uint32_t kDraws = 4000;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

CampaignSource campaign_of(std::vector<Dispersion> dispersions, std::uint32_t cases = kDraws) {
  CampaignSource campaign;
  campaign.cases = cases;
  campaign.seed = 8;
  campaign.dispersions = std::move(dispersions);
  return campaign;
}

// Of a law of `count` numbers, by columns.
std::vector<std::vector<double>> drawn(const Law& law, std::size_t count, std::uint32_t cases = kDraws) {
  const CaseDraws draws(campaign_of({{std::vector<std::string>(count, "truth.x"), law}}, cases));
  std::vector<std::vector<double>> columns(count);
  for (std::uint32_t k = 0; k < cases; ++k) {
    const CaseValues values = draws.values(k);
    EXPECT_EQ(values.numbers.size(), count);
    for (std::size_t i = 0; i < count; ++i) columns[i].push_back(values.numbers.at(i));
  }
  return columns;
}
std::vector<double> drawn(const NumberLaw& law) { return drawn(Law(law), 1)[0]; }

double phi(double z) { return std::exp(-0.5 * z * z) / std::sqrt(2 * kPi); }
double cumulative(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

// Distance, and the mean within 4 of its standard errors.
template <class Function>
void expect_law(const std::vector<double>& sample, const Function& distribution, double mean, double sigma) {
  EXPECT_LT(ks_distance(sample, distribution), ks_limit(kDraws));
  EXPECT_NEAR(mean_of(sample), mean, 4 * sigma / std::sqrt(kDraws));
}

TEST(CaseDraws, NumbersFollowTheirLaws) {
  VERIFIES("LASSO-GND-047~1");
  expect_law(
      drawn(Uniform{2, 7}), [](double x) { return (x - 2) / 5; }, 4.5, 5 / std::sqrt(12.0));
  expect_law(
      drawn(LogUniform{1e-5, 1e-3}), [](double x) { return std::log(x / 1e-5) / std::log(100.0); }, 99e-5 / std::log(100.0), 2.5e-4);
  expect_law(
      drawn(Normal{1, 2, -kInfinity, kInfinity}), [](double x) { return cumulative((x - 1) / 2); }, 1, 2);
  EXPECT_EQ(drawn(Fixed{0.25}), std::vector<double>(kDraws, 0.25));
}

// The mean of a truncated normal is mu + sigma (phi(a) - phi(b)) / (Phi(b) - Phi(a)).
TEST(CaseDraws, TruncatedNormalsAreCutOffAndNotPiledUp) {
  VERIFIES("LASSO-GND-047~1");
  struct Cut {
    double low, high;
  };
  for (const Cut& cut : {Cut{-1, 0.5}, Cut{0.5, kInfinity}, Cut{-kInfinity, -2}, Cut{3, 4}}) {
    const double inside = cumulative(-cut.low) - cumulative(-cut.high);
    const std::vector<double> sample = drawn(Normal{10, 2, 10 + 2 * cut.low, 10 + 2 * cut.high});
    const auto distribution = [&](double x) { return (cumulative(-cut.low) - cumulative(-(x - 10) / 2)) / inside; };
    expect_law(sample, distribution, 10 + 2 * (phi(cut.low) - phi(cut.high)) / inside, 2);
    EXPECT_EQ(std::count(sample.begin(), sample.end(), 10 + 2 * cut.low) + std::count(sample.begin(), sample.end(), 10 + 2 * cut.high), 0);
  }
}

TEST(CaseDraws, NoShareLeavesTheRange) {
  VERIFIES("LASSO-GND-047~1");
  constexpr double kLeast = 0x1p-53;
  for (const double share : {kLeast, 0.5, 1 - kLeast}) {
    EXPECT_EQ(std::clamp(quantile_of(Uniform{-0.1, 0.3}, share), -0.1, 0.3), quantile_of(Uniform{-0.1, 0.3}, share));
    EXPECT_EQ(std::clamp(quantile_of(LogUniform{1e-5, 1e-3}, share), 1e-5, 1e-3), quantile_of(LogUniform{1e-5, 1e-3}, share));
    EXPECT_EQ(std::clamp(quantile_of(Normal{0, 1, 6, 7}, share), 6.0, 7.0), quantile_of(Normal{0, 1, 6, 7}, share));
    EXPECT_LT(std::fabs(quantile_of(Normal{0, 1, -kInfinity, kInfinity}, share)), 8.3);
  }
  for (double low = -3; low <= 0; low += 0.01) EXPECT_LT(quantile_of(Normal{0, 1, low, kInfinity}, 1 - kLeast), 8.3) << low;
}

TEST(CaseDraws, ValuesOfAListComeAsOftenAsTheirWeights) {
  VERIFIES("LASSO-GND-047~1");
  const std::vector<double> sample = drawn(OneOf{{0, 0.005, 3}, {3, 1, 4}});
  const auto expect_share = [&](double value, double share) {
    EXPECT_NEAR(static_cast<double>(std::count(sample.begin(), sample.end(), value)) / kDraws, share,
                4 * std::sqrt(share * (1 - share) / kDraws))
        << value;
  };
  expect_share(0, 0.375);
  expect_share(0.005, 0.125);
  expect_share(3, 0.5);
}

TEST(CaseDraws, DirectionsAreUniformOnTheSphere) {
  VERIFIES("LASSO-GND-047~1");
  const auto columns = drawn(AnyDirection{Uniform{1, 5}}, 3);
  std::vector<double> lengths;
  std::vector<std::vector<double>> unit(3);
  for (std::uint32_t k = 0; k < kDraws; ++k) {
    lengths.push_back(std::hypot(columns[0][k], columns[1][k], columns[2][k]));
    for (std::size_t i = 0; i < 3; ++i) unit[i].push_back(columns[i][k] / lengths.back());
  }
  expect_law(
      lengths, [](double x) { return (x - 1) / 4; }, 3, 4 / std::sqrt(12.0));
  for (const auto& axis : unit)
    expect_law(
        axis, [](double x) { return (x + 1) / 2; }, 0, 1 / std::sqrt(3.0));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(std::fabs(correlation(unit[i], unit[(i + 1) % 3])), 4 / std::sqrt(kDraws));
  EXPECT_EQ(drawn(AnyDirection{Fixed{0}}, 3)[0], std::vector<double>(kDraws, 0)) << "of no length";
}

// As scenarios draw it themselves: two samples of one law (the limit of two of n is that of one of n / 2).
TEST(CaseDraws, AttitudesAreThoseOfDrawnScenarios) {
  VERIFIES("LASSO-GND-047~1");
  const auto columns = drawn(AnyAttitude{}, 3);
  Scenario scenario;
  scenario.drawn = 1;
  scenario.spin_radps = scenario.drift_mps = {1, 0, 0};
  std::vector<std::vector<double>> others(3);
  for (std::uint64_t seed = 1; seed <= kDraws; ++seed) {
    const Scenario other = drawn_scenario(scenario, seed);
    others[0].push_back(other.roll_rad / kRadPerDeg);
    others[1].push_back(other.tilt_rad / kRadPerDeg);
    others[2].push_back(other.boresight_rad / kRadPerDeg);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    std::sort(others[i].begin(), others[i].end());
    const auto share = [&](double x) {
      return static_cast<double>(std::lower_bound(others[i].begin(), others[i].end(), x) - others[i].begin()) / kDraws;
    };
    EXPECT_LT(ks_distance(columns[i], share), ks_limit(kDraws / 2.0)) << i;
  }
  EXPECT_LT(ks_distance(columns[1], [](double tilt) { return 0.5 + 0.5 * std::sin(tilt * kRadPerDeg); }), ks_limit(kDraws));
}

TEST(CaseDraws, CorrelatedNumbersHaveTheCovariance) {
  VERIFIES("LASSO-GND-047~1");
  const std::vector<double> covariance{0.01, 0.012, -0.004, 0.012, 0.04, 0.01, -0.004, 0.01, 0.09}, mean{1, -2, 3};
  const std::vector<double> everything(3, kInfinity), nothing(3, -kInfinity);
  const auto columns = drawn(Correlated{mean, covariance, nothing, everything}, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    expect_law(
        columns[i], [&](double x) { return cumulative((x - mean[i]) / std::sqrt(covariance[4 * i])); }, mean[i],
        std::sqrt(covariance[4 * i]));
    for (std::size_t j = 0; j <= i; ++j) {
      const double expected = covariance[3 * i + j], scale = std::sqrt(covariance[4 * i] * covariance[4 * j]);
      EXPECT_NEAR(covariance_of(columns[i], columns[j]), expected, 4 * std::sqrt(2.0 / kDraws) * scale) << i << j;
    }
  }
}

TEST(CaseDraws, CorrelatedNumbersStayInTheirRanges) {
  VERIFIES("LASSO-GND-047~1");
  const auto columns = drawn(Correlated{{0, 0}, {1, 0.9, 0.9, 1}, {-1, -0.5}, {1, 2}}, 2);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_GE(*std::min_element(columns[i].begin(), columns[i].end()), i == 0 ? -1 : -0.5);
    EXPECT_LE(*std::max_element(columns[i].begin(), columns[i].end()), i == 0 ? 1 : 2);
  }
}

TEST(CaseDraws, RowsOfATableStayTogether) {
  VERIFIES("LASSO-GND-047~1");
  const std::vector<double> values{1, -1, 2, -2, 3, -3};
  const auto in_order = drawn(Rows{"t.csv", true, values}, 2, 7);
  EXPECT_EQ(in_order[0], (std::vector<double>{1, 2, 3, 1, 2, 3, 1}));
  const auto any = drawn(Rows{"t.csv", false, values}, 2);
  for (std::uint32_t k = 0; k < kDraws; ++k) ASSERT_EQ(any[1][k], -any[0][k]);
  for (const double row : {1, 2, 3})
    EXPECT_NEAR(static_cast<double>(std::count(any[0].begin(), any[0].end(), row)), kDraws / 3.0, 4 * std::sqrt(kDraws * 2.0 / 9));
}

std::vector<Dispersion> several() {
  return {{{"truth.range_m"}, Uniform{2, 7}},
          {{"truth.x", "truth.y"}, Correlated{{0, 0}, {1, 0.5, 0.5, 1}, {-9, -9}, {9, 9}}},
          {{"truth.a", "truth.b", "truth.c"}, AnyDirection{LogUniform{1, 2}}}};
}

TEST(CaseDraws, ACaseIsTheSameAloneAndAmongAll) {
  VERIFIES("LASSO-GND-046~1");
  for (const Sampling sampling : {Sampling::kRandom, Sampling::kLatinHypercube, Sampling::kSobol}) {
    CampaignSource campaign = campaign_of(several(), 50);
    campaign.sampling = sampling;
    const CaseDraws all(campaign);
    std::vector<CaseValues> cases;
    for (std::uint32_t k = 0; k < 50; ++k) cases.push_back(all.values(k));
    const CaseValues alone = CaseDraws(campaign).values(17);
    EXPECT_EQ(alone.numbers, cases[17].numbers);
    EXPECT_EQ(alone.seed, cases[17].seed);
    EXPECT_NE(alone.numbers, cases[18].numbers);
    campaign.seed = 9;
    EXPECT_NE(CaseDraws(campaign).values(17).numbers, alone.numbers);
    EXPECT_NE(CaseDraws(campaign).values(17).seed, alone.seed);
  }
}

TEST(CaseDraws, ColumnsAreThoseOfTheDispersions) {
  VERIFIES("LASSO-GND-049~1");
  EXPECT_EQ(CaseDraws(campaign_of(several())).columns(),
            (std::vector<std::string>{"truth.range_m", "truth.x", "truth.y", "truth.a", "truth.b", "truth.c"}));
}

TEST(CaseDraws, NoTwoCasesHaveOneSeed) {
  VERIFIES("LASSO-GND-050~1");
  constexpr std::uint32_t kMany = 200000;  // of drawn seeds, about 5 pairs would be alike
  const CaseDraws draws(campaign_of({}, kMany));
  std::set<std::uint64_t> seeds;
  for (std::uint32_t k = 0; k < kMany; ++k) {
    const std::uint64_t seed = draws.values(k).seed;
    ASSERT_LT(seed, std::uint64_t{1} << 32);
    seeds.insert(seed);
  }
  EXPECT_EQ(seeds.size(), kMany);
}

}  // namespace
}  // namespace lasso::mdat
