#include "mdat/campaign/conclusion.hpp"

#include <gtest/gtest.h>

#include "mdat/campaign/conclusion_text.hpp"
#include "mdat/campaign/sequence.hpp"
#include "mdat/common/errors.hpp"
#include "ut/mdat/campaign/tables.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using test::at_most;
using test::campaign_of;
using test::kInfinite;
using test::kNoNumber;
using test::table_of;
using test::table_with;

Conclusion conclusion_of(const Criterion& criterion, const ResultTable& table) { return conclude(campaign_of({criterion}), table).at(0); }

TEST(Conclusion, IsMetFailedOrUndecidedByTheLimits) {
  VERIFIES("LASSO-GND-054~1");
  const ResultTable table = table_with(497, 500);  // 98.26 % to 99.88 %
  EXPECT_EQ(conclusion_of(at_most("low", "rms_mm", 1, 0.982), table).verdict, Verdict::kMet);
  EXPECT_EQ(conclusion_of(at_most("middle", "rms_mm", 1, 0.99), table).verdict, Verdict::kUndecided);
  EXPECT_EQ(conclusion_of(at_most("high", "rms_mm", 1, 0.999), table).verdict, Verdict::kFailed);
  const Conclusion one = conclusion_of(at_most("middle", "rms_mm", 1, 0.99), table);
  EXPECT_EQ(one.cases, 500U);
  EXPECT_EQ(one.within, 497U);
  EXPECT_NEAR(one.limits.lower, 0.98256, 1e-5);
  EXPECT_NEAR(one.limits.upper, 0.99876, 1e-5);
}

TEST(Conclusion, BoundsBelongToTheRange) {
  VERIFIES("LASSO-GND-054~1");
  const Criterion between{"between", "rms_mm", 1, 2, 0.5, 0.95};
  EXPECT_EQ(conclusion_of(between, table_of({0.999, 1, 1.5, 2, 2.001})).within, 3U);
  const Criterion above{"above", "rms_mm", 2, kInfinite, 0.5, 0.95};
  EXPECT_EQ(conclusion_of(above, table_of({0.999, 1, 1.5, 2, 2.001})).within, 2U);
}

TEST(Conclusion, CountsWhatFailedToRunOrHasNoFigureAsOutside) {
  VERIFIES("LASSO-GND-054~1");
  ResultTable table = table_of({0.5, kNoNumber, 0.5, 0.5});
  table.rows[2] = {2, "failed:worker ended by signal 11", {kNoNumber}, {2.02}};
  table.rows[3].status = "failed:refused";  // even if a figure stands there
  const Criterion unbounded{"any", "rms_mm", -kInfinite, kInfinite, 0.5, 0.95};
  const Conclusion conclusion = conclusion_of(unbounded, table);
  EXPECT_EQ(conclusion.cases, 4U);
  EXPECT_EQ(conclusion.within, 1U);
  EXPECT_EQ(conclusion.not_run, 2U);
  EXPECT_EQ(conclusion.unknown, 1U);
}

// The number that decides is the least one whose limits do, at the same share.
TEST(Conclusion, SaysHowManyMoreCasesWouldDecide) {
  VERIFIES("LASSO-GND-054~1");
  const Conclusion conclusion = conclusion_of(at_most("precise", "rms_mm", 1, 0.99), table_with(497, 500));
  ASSERT_TRUE(conclusion.more);
  const double cases = 500 + *conclusion.more;
  EXPECT_GE(share_limits(0.994 * cases, cases, 0.95).lower, 0.99);
  EXPECT_LT(share_limits(0.994 * (cases - 1), cases - 1, 0.95).lower, 0.99);
  EXPECT_FALSE(conclusion_of(at_most("even", "rms_mm", 1, 0.5), table_with(5, 10)).more);  // the truth may be 0.5
  EXPECT_FALSE(conclusion_of(at_most("all", "rms_mm", 1, 1), table_with(10, 10)).more);
  EXPECT_FALSE(conclusion_of(at_most("met", "rms_mm", 1, 0.5), table_with(500, 500)).more);
  EXPECT_FALSE(conclusion_of(at_most("none", "rms_mm", 1, 0.5), table_of({})).more);
}

TEST(Conclusion, RefusesAFigureThatNoCaseHas) {
  VERIFIES("LASSO-GND-054~1");
  try {
    conclusion_of(at_most("fine", "rms_m", 1, 0.5), table_of({1}));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "criterion fine: a case has no figure rms_m; it has rms_mm");
  }
}

TEST(StoppingRule, StopsAtTheFirstLookThatDecidesAll) {
  VERIFIES("LASSO-GND-055~1");
  CampaignSource campaign = campaign_of({at_most("precise", "rms_mm", 1, 0.9)});
  campaign.look_every = 10;
  std::uint32_t expected = 10;  // all cases are within
  while (share_sequence(expected, expected, 0.95).lower < 0.9) expected += 10;
  const ResultTable table = table_with(200, 200);
  EXPECT_EQ(stop_at(campaign, table), expected);
  EXPECT_EQ(conclude(campaign, table_with(expected, expected))[0].verdict, Verdict::kMet);
  EXPECT_EQ(conclude(campaign, table_with(expected - 10, expected - 10))[0].verdict, Verdict::kUndecided);
  campaign.criteria.push_back(at_most("perfect", "rms_mm", 0.1, 0.5));  // never: that fails soon
  EXPECT_EQ(stop_at(campaign, table), expected);
  campaign.criteria.push_back(at_most("all", "rms_mm", 1, 1));  // is never decided
  EXPECT_EQ(stop_at(campaign, table), std::nullopt);
}

TEST(StoppingRule, WaitsForCasesThatAreNotThere) {
  VERIFIES("LASSO-GND-055~1");
  CampaignSource campaign = campaign_of({at_most("precise", "rms_mm", 1, 0.9)});
  ResultTable table = table_with(200, 200);
  EXPECT_EQ(stop_at(campaign, table), std::nullopt);  // no rule: all are flown
  campaign.look_every = 10;
  const std::uint32_t end = stop_at(campaign, table).value();
  ResultTable without_a_later_one = table, without_an_earlier_one = table;
  without_a_later_one.rows.erase(without_a_later_one.rows.begin() + end);
  without_an_earlier_one.rows.erase(without_an_earlier_one.rows.begin() + 3);
  EXPECT_EQ(stop_at(campaign, without_a_later_one), end);
  EXPECT_EQ(stop_at(campaign, without_an_earlier_one), std::nullopt);
  campaign.criteria.clear();
  EXPECT_EQ(stop_at(campaign, table), std::nullopt);
}

// Stopped campaigns: the verdict that stops them is wrong in at most 5 %, though it is looked for every 20 cases.
TEST(StoppingRule, TakesTheLimitsOfASequence) {
  VERIFIES("LASSO-GND-055~1");
  CampaignSource campaign = campaign_of({at_most("precise", "rms_mm", 1, 0.9)});
  const ResultTable table = table_with(97, 100);
  EXPECT_EQ(conclude(campaign, table)[0].limits.lower, share_limits(97, 100, 0.95).lower);
  campaign.look_every = 20;
  EXPECT_EQ(conclude(campaign, table)[0].limits.lower, share_sequence(97, 100, 0.95).lower);
}

}  // namespace
}  // namespace lasso::mdat
