// Campaigns of the shipped missions: other numbers from the command line, and the page that lists them.
#include <gtest/gtest.h>

#include <algorithm>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

// Lines below the heading.
std::ptrdiff_t rows_of(const std::string& table) { return std::count(table.begin(), table.end(), '\n') - 1; }

TEST(ShippedCampaigns, TakeNumbersFromTheCommandLine) {
  VERIFIES("LASSO-MDT-031~1");
  const WorkFolder work;
  const std::string expand = "campaign expand missions/test.toml --campaign montecarlo --set campaign.montecarlo.cases=3 ";
  ASSERT_EQ(work.mdat(expand + "--out one").exit_code, 0);
  ASSERT_EQ(
      work.mdat(expand + "--set campaign.montecarlo.seed=2 --set 'campaign.montecarlo.truth.range_m={ uniform = [3, 3.1] }' --out two")
          .exit_code,
      0);
  EXPECT_EQ(rows_of(work.read("one/cases.csv")), 3);
  EXPECT_EQ(rows_of(work.read("two/cases.csv")), 3);
  EXPECT_NE(work.read("one/cases.csv"), work.read("two/cases.csv"));
  const std::string list =
      work.mdat("campaign list missions/test.toml --set 'campaign.montecarlo.truth.range_m={ uniform = [3, 3.1] }'").out;
  EXPECT_NE(list.find("truth.range_m: uniform, 3 to 3.1\n"), std::string::npos) << list;
}

TEST(ShippedCampaigns, SettingsAreCheckedAsTheFilesKeysAre) {
  VERIFIES("LASSO-MDT-031~1");
  const WorkFolder work;
  const auto refused = [&](const std::string& setting) {
    const Answer answer = work.mdat("campaign expand missions/test.toml --campaign basin --out none --set " + setting);
    EXPECT_EQ(answer.exit_code, 2) << setting;
    return answer.err;
  };
  EXPECT_NE(refused("campaign.basin.cases=0").find("campaign.basin.cases"), std::string::npos);
  EXPECT_NE(refused("campaign.basin.case=5").find("did you mean campaign.basin.cases?"), std::string::npos);
  EXPECT_NE(refused("campaign.basin.criteria.found_in_place.share_min=2").find("share_min"), std::string::npos);
  EXPECT_NE(refused("campaign.other.cases=5").find("campaign.other.scenario"), std::string::npos);
}

TEST(ShippedCampaigns, ArePrintedOnTheirPage) {
  VERIFIES("LASSO-GND-093~1");
  const WorkFolder work;
  const std::string page = read_text(source_path("docs/campaigns.md"));
  for (const char* mission : {"cfg/missions/hubble_tenth.toml", "cfg/missions/hubble.toml"}) {
    const Answer table = work.mdat("campaign list --markdown " + source_path(mission));
    ASSERT_EQ(table.exit_code, 0) << table.err;
    EXPECT_NE(page.find(table.out), std::string::npos)
        << "docs/campaigns.md is not what " << mission << " says: make write WHAT=campaign-table writes it";
  }
}

}  // namespace
}  // namespace lasso::ft
