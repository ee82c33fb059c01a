#include "mdat/campaign/findings.hpp"

#include <gtest/gtest.h>

#include "ut/mdat/campaign/tables.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(Findings, AreOfEachCriterion) {
  VERIFIES("LASSO-GND-056~1");
  const test::MixedCampaign mixed;
  const Findings all = find(mixed.campaign, mixed.table, "out/rough");
  ASSERT_EQ(all.findings.size(), 2U);
  EXPECT_EQ(all.not_run, 1U);
  EXPECT_FALSE(all.stopped);
  EXPECT_EQ(all.findings[1].figure, 1U);
  EXPECT_EQ(all.findings[1].worst.size(), 10U);
  EXPECT_EQ(all.findings[1].correlations.at(0).column, 0U);
  EXPECT_EQ(case_text(all, all.findings[1], 39), "rms_mm 5.9");
  EXPECT_EQ(case_text(all, all.findings[1], 5), "no rms_mm");
  EXPECT_EQ(failed_cases(all.table, 10), (std::vector<std::size_t>{3}));
  EXPECT_EQ(reason_text(all.table.rows[3]), "worker ended, by \"signal\" 11");
  EXPECT_EQ(cases_text(all), "40 cases; 1 failed to run, which counts as outside");
}

TEST(Findings, CountCasesOfAStoppedCampaign) {
  VERIFIES("LASSO-GND-056~1");
  test::MixedCampaign mixed;
  mixed.campaign.cases = 500;
  mixed.campaign.look_every = 20;
  EXPECT_EQ(cases_text(find(mixed.campaign, mixed.table, "d")),
            "40 of at most 500 cases, as its rule stopped it; 1 failed to run, which counts as outside");
  mixed.campaign.look_every = 0;
  mixed.table.rows.resize(1);
  EXPECT_EQ(cases_text(find(mixed.campaign, mixed.table, "d")),
            "1 of 500 cases; the others are missing, so that all that follows is preliminary");
}

// A rule that has decided nothing has stopped nothing, though cases are missing.
TEST(Findings, DoNotTakeMissingCasesForAStop) {
  VERIFIES("LASSO-GND-055~1 LASSO-GND-056~1");
  test::MixedCampaign mixed;
  mixed.campaign.cases = 500;
  mixed.campaign.look_every = 20;
  mixed.table.rows.resize(30);
  const Findings all = find(mixed.campaign, mixed.table, "d");
  EXPECT_FALSE(all.stopped);
  EXPECT_FALSE(all.complete());
  EXPECT_EQ(cases_text(all).find("30 of at most 500 cases; the others are missing"), 0U) << cases_text(all);
}

// Bad where it spins fast: no component shows it, their length does.
TEST(Findings, HaveLengthsOfVectors) {
  VERIFIES("LASSO-GND-056~1");
  ResultTable table{{"rms_mm"}, {"spin.x", "range", "spin.y", "lone.z"}, {}};
  for (std::uint32_t i = 0; i < 40; ++i) {
    const double sign = i % 2 == 0 ? 1 : -1;
    table.rows.push_back({i, "ok", {1.0 * i}, {3 * sign * i, 1.0 * (i % 3), -4 * sign * i, 0}});
  }
  const ResultTable wider = with_lengths(table);
  EXPECT_EQ(wider.columns, (std::vector<std::string>{"spin.x", "range", "spin.y", "lone.z", "|spin|"}));
  EXPECT_DOUBLE_EQ(wider.rows[7].drawn[4], 35);
  const CampaignSource campaign = test::campaign_of({test::at_most("", "rms_mm", 5, 0.5)});
  const Findings all = find(campaign, table, "d");
  EXPECT_EQ(all.findings[0].correlations.at(0).column, 4U);
  EXPECT_EQ(all.findings[0].correlations.at(0).rho, 1);
  EXPECT_GT(all.findings[0].correlations.at(1).probability, kSignificance);
}

TEST(Findings, CommandsAreWhatAShellReads) {
  VERIFIES("LASSO-GND-056~1");
  const test::MixedCampaign mixed;
  EXPECT_EQ(case_command(find(mixed.campaign, mixed.table, "out/rough"), 17), "mdat campaign case out/rough 17");
  EXPECT_EQ(case_command(find(mixed.campaign, mixed.table, "it's mine"), 0), "mdat campaign case 'it'\\''s mine' 0");
}

TEST(Findings, HaveTheIntegrityOfAllCasesTogether) {
  VERIFIES("LASSO-GND-130~1 LASSO-GND-131~1");
  const std::optional<Integrity> all = integrity_of(test::table_with_counts());
  ASSERT_TRUE(all);
  EXPECT_EQ(all->wrong, 2U);
  EXPECT_EQ(all->flights, 3U);
  EXPECT_EQ(all->wrong_flights, 1U);
  EXPECT_EQ(all->alert.episodes, 1U);
  EXPECT_DOUBLE_EQ(all->alert.worst_s, 0.4);
  EXPECT_EQ(all->protection.poses, 300U);
  EXPECT_EQ(all->protection.misleading, 2U);
  EXPECT_EQ(all->protection.position_mm.misleading, 2U);
  EXPECT_EQ(all->protection.attitude_deg.misleading, 0U);
  EXPECT_NEAR(all->protection.position_mm.median, 4, 0.045 * 4);
  EXPECT_DOUBLE_EQ(all->protection.position_mm.worst, 9);
  EXPECT_DOUBLE_EQ(all->protection.attitude_deg.worst, 0.5);
  EXPECT_FALSE(integrity_of(test::table_of({1}))) << "an earlier mdat kept no counts";
}

}  // namespace
}  // namespace lasso::mdat
