#include "mdat/missiondb/laser_safety.hpp"

#include <map>

#include "mdat/missiondb/mission_text.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const std::string kLaserHead = "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'box.toml'\n";

class LaserSafetyTest : public ::testing::Test {
 protected:
  LaserSafetyTest() { folder_.write("box.toml", "[[part]]\nkind = 'box'\nsize = [1, 1, 1]\n"); }
  MissionSource load(const std::string& text) { return load_mission(folder_.write("m.toml", kLaserHead + text)); }
  static std::string value(const MissionSource& source, const std::string& key) {
    for (const EffectiveValue& line : effective_values(source, "paper")) {
      if (line.key == key) return line.value + " " + line.unit;
    }
    return "";
  }
  Folder folder_;
};

const std::string kScenario = "[scenario.paper]\nranges_m = [4.0]\n";

TEST_F(LaserSafetyTest, WhatIsStatedOfEachSensorIsShown) {
  VERIFIES("LASSO-LCS-021~2");
  const MissionSource source = load(
      "[sensor]\nlaser_class = '3B'\nlaser_hazard_distance_m = 42.5\nlaser_inhibits = 2\n[further_sensor.near]\nkind = "
      "'flash_lidar'\nlaser_class = '1M'\n" +
      kScenario);
  EXPECT_EQ(value(source, "sensor.laser_class"), "\"3B\" ");
  EXPECT_EQ(value(source, "sensor.laser_hazard_distance_m"), "42.5 m");
  EXPECT_EQ(value(source, "sensor.laser_inhibits"), "2 ");
  EXPECT_EQ(value(source, "further_sensor.near.laser_class"), "\"1M\" ");
  EXPECT_EQ(value(source, "further_sensor.near.laser_inhibits"), "0 ");
}

// As 0 is what holds where nothing is stated, too.
TEST_F(LaserSafetyTest, ThatThereIsNoInhibitIsListedAmongWhatIsNoPreset) {
  VERIFIES("LASSO-LCS-021~2");
  const MissionSource source =
      load("[sensor]\nlaser_inhibits = 0\nlaser_class = 'not_stated'\n[further_sensor.near]\nkind = 'flash_lidar'\nlaser_inhibits = 0\n" +
           kScenario);
  std::map<std::string, std::string> listed;
  for (const Deviation& deviation : deviations(source, "paper"))
    listed[deviation.value.key] = deviation.value.value + ' ' + deviation.value.place;
  EXPECT_EQ(listed["sensor.laser_inhibits"], "0 m.toml:8");
  EXPECT_EQ(listed["sensor.laser_class"], "\"not_stated\" m.toml:9");
  EXPECT_EQ(listed["further_sensor.near.laser_inhibits"], "0 m.toml:12");
  EXPECT_EQ(listed.count("sensor.laser_hazard_distance_m"), 0U) << "of which nothing is stated";
  EXPECT_EQ(listed.count("sensor.range_min_m"), 0U);
}

TEST_F(LaserSafetyTest, NothingIsShownWhereNothingIsStated) {
  VERIFIES("LASSO-LCS-021~2");
  EXPECT_EQ(value(load(kScenario), "sensor.laser_class"), "");
}

TEST_F(LaserSafetyTest, WrongValuesAreNamedWithTheirPlace) {
  VERIFIES("LASSO-LCS-021~2");
  const auto error = [&](const std::string& text) { return mission_error_of([&] { static_cast<void>(load(text)); }); };
  EXPECT_NE(error("[sensor]\nlaser_class = '3C'\n").find("m.toml:8:15: sensor.laser_class"), std::string::npos);
  EXPECT_NE(error("[sensor]\nlaser_class = '1'\nlaser_hazard_distance_m = -1\n").find("sensor.laser_hazard_distance_m"), std::string::npos);
  const std::string classless = error("[sensor]\nlaser_hazard_distance_m = 5\n");
  EXPECT_NE(classless.find("m.toml:8:27: sensor.laser_hazard_distance_m"), std::string::npos) << classless;
  EXPECT_NE(classless.find("state sensor.laser_class, too"), std::string::npos) << classless;
  const std::string stereo = error("[further_sensor.eyes]\nkind = 'stereo'\nlaser_inhibits = 1\n");
  EXPECT_NE(stereo.find("further_sensor.eyes.laser_inhibits"), std::string::npos) << stereo;
  EXPECT_NE(stereo.find("has no laser: leave it out"), std::string::npos) << stereo;
}

TEST(LaserSafety, NothingStatedIsThePreset) {
  for (const ValueRow& row : laser_safety_rows()) EXPECT_EQ(laser_safety_value(LaserSafety{}, row), row.preset.at(0)) << row.key;
}

}  // namespace
}  // namespace lasso::mdat
