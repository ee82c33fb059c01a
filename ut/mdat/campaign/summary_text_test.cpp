#include "mdat/campaign/summary_text.hpp"

#include <gtest/gtest.h>

#include "ut/mdat/campaign/tables.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

void expect_line(const std::string& text, const std::string& line) { EXPECT_NE(text.find(line + "\n"), std::string::npos) << text; }

TEST(SummaryText, HasVerdictsWorstCasesAndWhatGoesWithThem) {
  VERIFIES("LASSO-GND-057~1");
  const test::MixedCampaign mixed;
  const std::string text = summary_text(find(mixed.campaign, mixed.table, "out/rough"));
  expect_line(text, "Campaign rough, scenario spin: 40 cases; 1 failed to run, which counts as outside");
  expect_line(text, "  no_wrong_pose  wrong <= 0 in at least 80 %   39 of 40      97.5 %  86.8 % to 99.937 % (95 %)  met");
  expect_line(text, "  precise        rms_mm <= 4 in at least 90 %  19 of 40      47.5 %  31.5 % to 63.9 % (95 %)    failed");
  expect_line(text, "  precise: Cases without rms_mm (such as those without a valid pose) count as outside: 1.");
  expect_line(text, "           rms_mm 5.9  outside  mdat campaign case out/rough 39");
  expect_line(text, "  worker ended, by \"signal\" 11  mdat campaign case out/rough 3");
  expect_line(text, "  precise  worse where larger:  truth.range_m  +0.76  p < 0.001");
}

TEST(SummaryText, HasTimesToAlertAndProtectionLevels) {
  VERIFIES("LASSO-GND-130~1 LASSO-GND-131~1");
  const CampaignSource campaign = test::campaign_of({});
  const std::string text = summary_text(find(campaign, test::table_with_counts(), "d"));
  EXPECT_NE(text.find("  valid and wrong             2 of 300, 0.080 % to 2.4 %; 1 episode; flights with one: 1 of 3, 0.84 % to 90.6 %\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("2 of 300, 0.080 % to 2.4 %; by position 2, by attitude 0\n"), std::string::npos) << text;
}

TEST(SummaryText, IsShortWhereThereIsNothingToSay) {
  VERIFIES("LASSO-GND-057~1");
  const CampaignSource campaign = test::campaign_of({});
  const ResultTable table = test::table_of({1});
  EXPECT_EQ(summary_text(find(campaign, table, "d")),
            "Campaign rough, scenario spin: 1 case\nIt has no criteria, so there is no verdict.\n\n" + std::string(kNoCounts) + "\n");
  EXPECT_EQ(probability_text(0.0231), "p = 0.023");
}

}  // namespace
}  // namespace lasso::mdat
