#include "mdat/missiondb/scenario_writer.hpp"

#include <set>

#include "mdat/missiondb/mission_source.hpp"
#include "mdat/missiondb/mission_writer.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

MissionSource mission_of(const Folder& folder, double largest_m, const Eigen::Vector3d& center_m) {
  NewMission mission;
  mission.name = "probe";
  mission.path = (kSourceFolder / "cfg/models/probe.toml").string();
  mission.sha256 = "";
  mission.parametric = true;
  mission.size.center = center_m;
  mission.size.largest_m = largest_m;
  mission.size.radius_m = 0.6 * largest_m;
  mission.cell_size_m = 0.01;
  std::string text = new_mission_text(mission);
  text.erase(text.find("sha256"), std::string("sha256 = \"\"\n").size());
  return load_mission(folder.write("new.toml", text));
}

// The sphere about the centre at the nearest and the farthest range, whatever the attitude.
void expect_seen(const MissionSource& source, const Scenario& scenario, double radius_m) {
  const double field_rad = source.parameters.fov_half_x_rad;
  for (const double range_m : scenario.ranges_m) {
    EXPECT_GT(range_m - radius_m, source.parameters.range_min_m);
    EXPECT_LT(range_m + radius_m, source.parameters.range_max_m);
    EXPECT_LT(std::asin(radius_m / range_m), field_rad);
    if (radius_m > 0.1) {
      EXPECT_GT(std::asin(radius_m / range_m), 0.4 * field_rad) << "and is not lost in it";
    }
    EXPECT_GT(range_m - radius_m, 0.4) << "a laser camera sees nothing nearer";
  }
  EXPECT_EQ(scenario.offset_m, std::vector<double>({0, 0}));
}

TEST(ScenarioWriter, TheTargetIsInTheFieldInEachScenarioWhateverItsSize) {
  VERIFIES("LASSO-GND-041~1");
  const Folder folder;
  for (const double largest_m : {0.02, 1.3, 40.0, 900.0}) {
    const MissionSource source = mission_of(folder, largest_m, {0, 0, 0});
    for (const char* name : {"paper", "spin", "search", "approach"}) {
      SCOPED_TRACE(std::string(name) + " " + std::to_string(largest_m));
      ASSERT_EQ(source.scenarios.count(name), 1U);
      expect_seen(source, source.scenarios.at(name), 0.6 * largest_m);
    }
    EXPECT_EQ(source.scenarios.at("search").prior, 0);
    EXPECT_EQ(source.scenarios.at("approach").autonomous, 1);
  }
}

TEST(ScenarioWriter, ScenariosTurnTheTargetAboutItsCentre) {
  VERIFIES("LASSO-GND-041~1");
  const Folder folder;
  const MissionSource source = mission_of(folder, 1, {0.5, -0.3, 0.25});
  for (const auto& [name, scenario] : source.scenarios) EXPECT_EQ(scenario.center_m, std::vector<double>({0.5, -0.3, 0.25})) << name;
}

// Limits of the start may be tightened, and what stands still needs no deskewing; nothing else is changed.
TEST(ScenarioWriter, NoneSwitchesOffWhatProtectsATrack) {
  VERIFIES("LASSO-GND-041~1");
  const Folder folder;
  const MissionSource source = mission_of(folder, 1.3, {0, 0, 0});
  const std::set<std::string> tightened{"tracking.start_sigma_m", "tracking.start_sigma_deg"};
  for (const auto& [name, scenario] : source.scenarios) {
    for (const auto& [key, value] : scenario.overrides)
      EXPECT_EQ(tightened.count(key) + (key == "estimation.deskew" && scenario.variants != 0 ? 1 : 0), 1U) << name << " " << key;
    const MissionParameters parameters = parameters_for(source, name);
    EXPECT_LE(parameters.start_sigma_m, source.parameters.start_sigma_m);
    EXPECT_LE(parameters.start_sigma_rad, source.parameters.start_sigma_rad);
  }
}

TEST(ScenarioWriter, RoundsToTwoDigits) {
  VERIFIES("LASSO-GND-041~1");
  EXPECT_EQ(rounded(0.0012345), 0.0012);
  EXPECT_EQ(rounded(-98.7), -99);
  EXPECT_EQ(rounded(0), 0);
  EXPECT_EQ(list_of({0.1 + 0.2, -0.0, 3}), std::vector<double>({0.3, 0, 3}));
}

}  // namespace
}  // namespace lasso::mdat
