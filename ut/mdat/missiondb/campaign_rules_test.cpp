#include "mdat/missiondb/campaign_rules.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const std::string kRulesHead = "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'box.toml'\n";
const std::string kSpinScenario = "[scenario.s]\nseed = 1\nranges_m = [5]\n";
const std::string kRulesCampaign = "[campaign.c]\nscenario = 's'\ncases = 100\n";

class CampaignRulesTest : public ::testing::Test {
 protected:
  CampaignRulesTest() { folder_.write("box.toml", "[[part]]\nkind = 'box'\nsize = [1, 1, 1]\n"); }
  MissionSource load(const std::string& text, const std::string& scenario = kSpinScenario) {
    return load_mission(folder_.write("m.toml", kRulesHead + scenario + kRulesCampaign + text));
  }
  std::string error_of(const std::string& text, const std::string& scenario = kSpinScenario) {
    return mission_error_of([&] { static_cast<void>(load(text, scenario)); });
  }
  void expect_error(const std::string& text, const std::string& expected, const std::string& scenario = kSpinScenario) {
    const std::string error = error_of(text, scenario);
    EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 0) << error;
    EXPECT_NE(error.find(expected), std::string::npos) << "got: " << error << "\nexpected: " << expected;
  }
  void expect_warning(const std::string& text, const std::string& expected) {
    const std::vector<std::string> warnings = warnings_for(load(text), "");
    const auto says = [&](const std::string& warning) { return warning.find(expected) != std::string::npos; };
    EXPECT_EQ(std::count_if(warnings.begin(), warnings.end(), says), 1) << text;
  }
  Folder folder_;
};

const std::string kAsks = "[campaign.c.criteria.right]\nfigure = 'wrong'\nat_most = 0\nshare_min = 0.9\n";

TEST_F(CampaignRulesTest, LooksFitTheCases) {
  VERIFIES("LASSO-GND-045~1");
  EXPECT_EQ(load("look_every = 100\n" + kAsks).campaigns.at("c").look_every, 100U);
  expect_error("look_every = 101\n" + kAsks, "m.toml:13:14: campaign.c.look_every: 101: expected at most cases, which is 100");
  expect_error("look_every = 10\nsampling = 'latin_hypercube'\n" + kAsks, "goes with sampling = \"random\" alone");
  expect_error("look_every = 10\n", "campaign.c.look_every: 10: has nothing to decide: add [campaign.c.criteria.NAME]");
  const std::string table = "[[campaign.c.together]]\ntable = 't.csv'\n";
  folder_.write("t.csv", "truth.range_m\n3\n4\n");
  expect_error("look_every = 10\n" + kAsks + table, "campaign.c.together[0]: t.csv: in order does not go with look_every");
  EXPECT_EQ(error_of("look_every = 10\n" + kAsks + table + "rows = 'drawn'\n"), "");
}

TEST_F(CampaignRulesTest, AFigureOfSettledFramesNeedsSome) {
  VERIFIES("LASSO-GND-045~1");
  const std::string asks = "[campaign.c.criteria.rates]\nfigure = 'settled_degps'\nat_most = 1\nshare_min = 0.9\n";
  expect_error("frames = 20\n" + asks, "campaign.c.criteria.rates.figure: settled_degps: is of the frames after the first 20");
  EXPECT_EQ(error_of("frames = 21\n" + asks), "");
}

// It becomes that of a folder.
TEST_F(CampaignRulesTest, NamesArePlain) {
  VERIFIES("LASSO-GND-045~1");
  EXPECT_EQ(error_of("[campaign.Ab-9_]\nscenario = 's'\ncases = 1\n"), "");
  for (const std::string& name : {std::string(".."), std::string(), std::string("a/b"), std::string("a\\u001b"), std::string(65, 'x')})
    expect_error("[campaign.\"" + name + "\"]\nscenario = 's'\ncases = 1\n", "expected a name of letters, digits, - and _, at most 64");
}

TEST_F(CampaignRulesTest, OneOfSeveralRangesIsTold) {
  VERIFIES("LASSO-GND-045~1");
  const std::string scenario = "[scenario.s]\nranges_m = [5, 6]\n";
  const auto told = [&](const std::string& text) {
    const std::vector<std::string> warnings = warnings_for(load(text, scenario), "");
    return std::count_if(warnings.begin(), warnings.end(), [](const std::string& warning) {
      return warning.find("of which a case flies the first, 5 m") != std::string::npos;
    });
  };
  EXPECT_EQ(told(""), 1);
  EXPECT_EQ(told("truth.range_m = { one_of = [5, 6] }\n"), 0);
}

TEST_F(CampaignRulesTest, WhatTheScenarioSaysItselfDoesNotVary) {
  VERIFIES("LASSO-GND-045~1");
  expect_error("truth.range_m = 4\n", "flies a profile of ranges", "[scenario.s]\nranges_m = [5, 4]\ntimes_s = [0, 100]\n");
  expect_error("truth.attitude = 'any'\n", "write drawn = false", kSpinScenario + "drawn = true\n");
  expect_error("truth.tilt_deg = 4\n", "campaign.c.truth.tilt_deg: changes nothing", kSpinScenario + "drawn = true\n");
  expect_warning("truth.navigation_sigma_m = 2\n", "campaign.c.truth.navigation_sigma_m: truth.navigation_sigma_m: has no effect");
}

// A laser camera measures from 0.5 m on.
TEST_F(CampaignRulesTest, CasesKeepTheRulesOfTheMission) {
  VERIFIES("LASSO-GND-051~1");
  EXPECT_EQ(error_of("truth.range_m = { uniform = [1, 7] }\n"), "");
  expect_error("truth.range_m = { uniform = [0.25, 7] }\n", "with truth.range_m = 0.25: contradicts scenario.s.ranges_m: [0.25]");
  expect_error("truth.range_m = { one_of = [5, 0.25, 6] }\n", "with truth.range_m = 0.25");
  expect_error("truth.range_m = { normal = [1, 0.2] }\n", "with truth.range_m = 0.2");
  const std::string together = "[[campaign.c.together]]\n";
  expect_error(together + "keys = ['truth.range_m', 'truth.offset_m.x']\nmean = [1, 0]\ncovariance = [[0.04, 0.01], [0.01, 0.01]]\n",
               "with truth.range_m = 0.2, truth.offset_m.x = -0.2");
  expect_error(together + "keys = ['truth.offset_m.x', 'truth.range_m']\nmean = [0, 1]\ncovariance = [[0.01, 0.01], [0.01, 0.04]]\n",
               "with truth.offset_m.x = -0.2, truth.range_m = 0.2");
  folder_.write("t.csv", "truth.range_m\n3\n0.125\n");
  expect_error(together + "table = 't.csv'\n", "with truth.range_m = 0.125");
}

// Values that only fit together: the nominal turn of the sensor ends before it would begin.
TEST_F(CampaignRulesTest, NoCaseIsRefusedThatCannotBeDrawn) {
  VERIFIES("LASSO-GND-051~1");
  EXPECT_EQ(error_of("mission.sensor.use_from_m = { uniform = [12, 14] }\nmission.sensor.use_to_m = { uniform = [16, 18] }\n",
                     "[sensor]\nuse_to_m = 10\n" + kSpinScenario),
            "");
  expect_error("mission.sensor.use_from_m = { uniform = [12, 14] }\n", "contradicts", "[sensor]\nuse_to_m = 10\n" + kSpinScenario);
}

TEST_F(CampaignRulesTest, AShortTableIsTold) {
  VERIFIES("LASSO-GND-045~1");
  folder_.write("t.csv", "truth.range_m\n3\n4\n");
  expect_warning("[[campaign.c.together]]\ntable = 't.csv'\n", "t.csv: has 2 rows for 100 cases");
}

}  // namespace
}  // namespace lasso::mdat
