#include "mdat/missiondb/old_keys.hpp"

#include <gtest/gtest.h>

#include "mdat/missiondb/mission_source.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

constexpr const char* kRetiredKeys[] = {"sensing.rest_frames",     "sensing.look_scans", "estimation.stop_rotation_deg",
                                        "estimation.label_error",  "start.gate",         "short_range.disagreement_max",
                                        "short_range.rest_frames", "search.hits_min",    "search.disagreement_max",
                                        "search.ratio_min",        "search.scans_max",   "search.work_max"};

TEST(OldKeys, SayWhatIsInTheirPlace) {
  VERIFIES("LASSO-GND-003~1");
  EXPECT_EQ(remedy_of_old_key("search.hits_min"), "is 80 in every mission: leave it out");
  EXPECT_EQ(remedy_of_old_key("search.work_max"), "is 2500000 in every mission: leave it out");
  EXPECT_EQ(remedy_of_old_key("tracking.normalized_residual_max").substr(0, 29), "is sensor.noise_tolerance now");
  EXPECT_EQ(remedy_of_old_key("search.hits"), "");
}

// Each id that is retired had a key, and each of these keys is a row's no more.
TEST(OldKeys, AreThoseOfTheRetiredIds) {
  VERIFIES("LASSO-GND-003~1 LASSO-IMG-006~1");
  EXPECT_EQ(std::size(kRetiredKeys), std::size(kRetiredParameterIds));
  for (const char* key : kRetiredKeys) {
    EXPECT_NE(remedy_of_old_key(key).find("in every mission"), std::string::npos) << key;
    for (const ParameterRow& row : parameter_rows()) EXPECT_STRNE(row.key, key);
  }
}

// One error, wherever a mission has such a key, at its place.
TEST(OldKeys, AreRefusedInAllTablesOfAMission) {
  VERIFIES("LASSO-GND-003~1");
  Folder folder;
  folder.write("box.toml", "[[part]]\nkind = 'box'\nsize = [2, 1, 1]\n");
  const std::string head = "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'box.toml'\n";
  const std::string place = "m.toml:8:", said = "search.ratio_min: is 1.3 in every mission: leave it out";
  const struct {
    const char* table;
    const char* line;
    const char* prefix;
  } cases[] = {
      {"[search]\n", "ratio_min = 2\n", ""},
      {"[scenario.s]\n", "override.search.ratio_min = 2\nranges_m = [5]\n", "scenario.s.override."},
      {"[campaign.c]\n", "mission.search.ratio_min = 2\ncases = 1\nscenario = 's'\n[scenario.s]\nranges_m = [5]\n", "campaign.c.mission."}};
  for (const auto& c : cases) {
    const std::string text = mission_error_of([&] { static_cast<void>(load_mission(folder.write("m.toml", head + c.table + c.line))); });
    EXPECT_NE(text.find(place), std::string::npos) << text;
    EXPECT_NE(text.find(c.prefix + said), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace lasso::mdat
