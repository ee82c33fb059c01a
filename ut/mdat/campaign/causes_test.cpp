#include "mdat/campaign/causes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hal_sim/random.hpp"
#include "ut/mdat/campaign/tables.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using test::at_most;
using test::kInfinite;
using test::kNoNumber;
using test::table_of;

TEST(RankCorrelation, TiesShareTheMeanOfTheirRanks) {
  VERIFIES("LASSO-GND-056~1");
  EXPECT_EQ(average_ranks({7, 3, 7, 1, 7}), (std::vector<double>{4, 2, 4, 1, 4}));
  EXPECT_EQ(average_ranks({kInfinite, 3, kInfinite}), (std::vector<double>{2.5, 1, 2.5}));
}

// x: 1 to 5; y: ranks 1, 2, 3, 5, 4 but for a tie of the third and the fifth, 3.5 each... by hand: ranks of 5, 6, 7, 8, 7 are 1, 2, 3.5,
// 5, 3.5; products of the distances from 3: 2*2 + 1*1 + 0 + 1*2 + 2*0.5 = 8; squares 10 and 4 + 1 + 0.25 + 4 + 0.25 = 9.5.
TEST(RankCorrelation, IsPearsonsOfTheRanks) {
  VERIFIES("LASSO-GND-056~1");
  const double rho = rank_correlation({1, 2, 3, 4, 5}, {5, 6, 7, 8, 7});
  EXPECT_NEAR(rho, 8 / std::sqrt(95), 1e-14);
  EXPECT_NEAR(two_sided_probability(rho, 5), 0.0885870, 1e-7);  // as SciPy's spearmanr says of this example
  EXPECT_NEAR(rank_correlation({1, 2, 3, 4}, {1000, 10, 1, -5}), -1, 1e-14);
  EXPECT_TRUE(std::isnan(rank_correlation({1, 2, 3}, {4, 4, 4})));
}

// Of all orders of three or four values the two extreme ones.
TEST(RankCorrelation, IsNotSureOfFewCases) {
  VERIFIES("LASSO-GND-056~1");
  EXPECT_EQ(two_sided_probability(1, 2), 1);
  EXPECT_NEAR(two_sided_probability(1, 3), 2 / 6.0, 1e-15);
  EXPECT_NEAR(two_sided_probability(-1, 4), 2 / 24.0, 1e-15);
}

TEST(RankCorrelation, HolmMultipliesByThoseThatAreLeft) {
  VERIFIES("LASSO-GND-056~1");
  const std::vector<double> adjusted = holm({0.04, 0.01, 0.03, 0.9});
  const std::vector<double> expected = {0.09, 0.04, 0.09, 0.9};  // 4 * 0.01, 3 * 0.03, max(0.09, 2 * 0.04), 0.9
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(adjusted[i], expected[i], 1e-15);
  EXPECT_EQ(holm({0.6, 0.7}), (std::vector<double>{1, 1}));
}

// 300 cases with four values that nothing depends on, 200 times: a false finding in at most 5 % of them, within three standard errors.
TEST(RankCorrelation, FindsNothingInNothing) {
  VERIFIES("LASSO-GND-056~1");
  int found = 0;
  for (std::uint32_t campaign = 0; campaign < 200; ++campaign) {
    sim::Random random = sim::ray_stream(5, campaign, 0);
    ResultTable table{{"rms_mm"}, {"a", "b", "c", "d"}, {}};
    for (std::uint32_t number = 0; number < 300; ++number)
      table.rows.push_back({number, "ok", {random.uniform()}, {random.uniform(), random.uniform(), random.uniform(), random.uniform()}});
    const auto all = correlations(at_most("", "rms_mm", 1, 0.5), table, 0);
    found += std::any_of(all.begin(), all.end(), [](const Correlation& one) { return one.probability < kSignificance; }) ? 1 : 0;
  }
  EXPECT_LE(found, 10 + 9);
  EXPECT_GE(found, 1);
}

TEST(RankCorrelation, SortsWhatMattersByStrengthAndLeavesOutWhatDoesNotVary) {
  VERIFIES("LASSO-GND-056~1");
  ResultTable table{{"rms_mm"}, {"noise", "fixed", "range", "spin"}, {}};
  sim::Random random = sim::ray_stream(6, 0, 0);
  for (std::uint32_t number = 0; number < 200; ++number) {
    const double range = random.uniform(), spin = random.uniform();
    const double figure = number == 7 ? kNoNumber : 10 * spin * spin - 2 * range;
    table.rows.push_back({number, "ok", {figure}, {random.uniform(), 3, range, spin}});
  }
  const auto found = correlations(at_most("", "rms_mm", 4, 0.5), table, 0);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].column, 3U);
  EXPECT_GT(found[0].rho, 0.8);
  EXPECT_EQ(found[1].column, 2U);
  EXPECT_LT(found[1].rho, 0);
  EXPECT_LT(found[1].probability, 0.05);
  EXPECT_GT(found[2].probability, 0.05);
  EXPECT_TRUE(correlations(at_most("", "rms_mm", 4, 0.5), table_of({1, 1, 1}), 0).empty());
  EXPECT_TRUE(correlations(at_most("", "rms_mm", 4, 0.5), table_of({}), 0).empty());
}

TEST(WorstCases, AreFarthestBeyondTheNearerBound) {
  VERIFIES("LASSO-GND-056~1");
  ResultTable table = table_of({5, 1, kNoNumber, 9, 5, 0});
  table.rows[1].status = "failed:refused";
  const Criterion between{"", "rms_mm", 4, 6, 0.5, 0.95};
  EXPECT_EQ(worst_cases(between, table, 0, 10), (std::vector<std::size_t>{2, 5, 3}));  // 0 is 4 below, 9 is 3 above
  EXPECT_EQ(worst_cases(between, table, 0, 2), (std::vector<std::size_t>{2, 5}));
  const Criterion below = at_most("", "rms_mm", 20, 0.5);
  EXPECT_EQ(worst_cases(below, table_of({5, 1, 9, 1}), 0, 10), (std::vector<std::size_t>{2, 0}));  // within, but worse than others
  EXPECT_TRUE(worst_cases(below, table_of({1, 1}), 0, 10).empty());
  EXPECT_EQ(worst_cases(below, table_of({30, 30}), 0, 10).size(), 2U);
  EXPECT_TRUE(worst_cases(below, table_of({}), 0, 10).empty());
}

}  // namespace
}  // namespace lasso::mdat
