#include "mdat/campaign/campaign_list.hpp"

#include <gtest/gtest.h>

#include "ut/mdat/campaign/tables.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

CampaignSource rough() {
  CampaignSource campaign = test::campaign_of({test::at_most("no_wrong_pose", "wrong", 0, 0.98)});
  campaign.cases = 500;
  campaign.frames = 25;
  campaign.dispersions = {{{"truth.drift_mps.x"}, NumberLaw(Uniform{0, 1}), "campaign.rough.truth.drift_mps[0]"},
                          {{"truth.drift_mps.y"}, NumberLaw(Uniform{0, 2}), "campaign.rough.truth.drift_mps[1]"},
                          {{"truth.offset_m.x"}, NumberLaw(Uniform{-1, 1}), "campaign.rough.truth.offset_m[0]"},
                          {{"truth.offset_m.y"}, NumberLaw(Uniform{-1, 1}), "campaign.rough.truth.offset_m[1]"},
                          {{"truth.spin_degps.x"}, NumberLaw(Fixed{0}), "campaign.rough.truth.spin_degps[0]"},
                          {{"truth.spin_degps.y"}, NumberLaw(Fixed{2.5}), "campaign.rough.truth.spin_degps[1]"},
                          {{"truth.range_m", "truth.roll_deg"}, Rows{"cases.csv", true, {}}, "campaign.rough.together[0]"}};
  return campaign;
}

TEST(CampaignList, SaysWhatEachVariesAndAsks) {
  VERIFIES("LASSO-GND-093~1");
  CampaignSource plain;
  plain.name = plain.scenario = "spin";
  plain.cases = 10;
  plain.look_every = 5;
  EXPECT_EQ(campaign_list({{"rough", rough()}, {"spin", plain}}),
            "rough: 500 cases of 25 frames, scenario spin\n"
            "  varies  truth.drift_mps: uniform, 0 to 1; uniform, 0 to 2\n"
            "          truth.offset_m: each uniform, -1 to 1\n"
            "          truth.spin_degps: 0, 2.5 in every case\n"
            "          truth.range_m, truth.roll_deg: rows of cases.csv, in order\n"
            "  asks    wrong <= 0 in at least 98 %\n"
            "spin: at most 10 cases, scenario spin\n");
}

TEST(CampaignList, OfNoneSaysHowToWriteOne) {
  VERIFIES("LASSO-GND-093~1");
  EXPECT_NE(campaign_list({}).find("[campaign.NAME]"), std::string::npos);
  EXPECT_EQ(campaign_table({}), "");
}

TEST(CampaignList, IsATableOfAPage) {
  VERIFIES("LASSO-GND-093~1");
  const std::string table = campaign_table({{"rough", rough()}});
  EXPECT_EQ(table.find("| campaign | scenario | cases | varies | asks |\n| --- |"), 0U);
  EXPECT_NE(
      table.find("\n| `rough` | `spin` | 500 cases of 25 frames | truth.drift_mps: uniform, 0 to 1; uniform, 0 to 2<br>truth.offset_m: "
                 "each uniform, -1 to 1<br>truth.spin_degps: 0, 2.5 in every case<br>truth.range_m, truth.roll_deg: rows of cases.csv, in "
                 "order | wrong <= 0 in at least 98 % |\n"),
      std::string::npos)
      << table;
}

}  // namespace
}  // namespace lasso::mdat
