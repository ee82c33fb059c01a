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
  EXPECT_EQ(case_text(all, all.findings[1], 3), "failed: worker ended, by \"signal\" 11");
  EXPECT_EQ(cases_text(all), "40 cases; 1 failed to run");
}

TEST(Findings, CountCasesOfAStoppedCampaign) {
  VERIFIES("LASSO-GND-056~1");
  test::MixedCampaign mixed;
  mixed.campaign.cases = 500;
  mixed.campaign.look_every = 20;
  EXPECT_EQ(cases_text(find(mixed.campaign, mixed.table, "d")), "40 of at most 500 cases, as its rule stopped it; 1 failed to run");
  mixed.campaign.look_every = 0;
  mixed.table.rows.resize(1);
  EXPECT_EQ(cases_text(find(mixed.campaign, mixed.table, "d")), "1 of 500 cases");
}

TEST(Findings, CommandsAreWhatAShellReads) {
  VERIFIES("LASSO-GND-056~1");
  const test::MixedCampaign mixed;
  EXPECT_EQ(case_command(find(mixed.campaign, mixed.table, "out/rough"), 17), "mdat campaign case out/rough 17");
  EXPECT_EQ(case_command(find(mixed.campaign, mixed.table, "it's mine"), 0), "mdat campaign case 'it'\\''s mine' 0");
}

}  // namespace
}  // namespace lasso::mdat
