#include "mdat/missiondb/flash_rows.hpp"

#include "mdat/missiondb/mission_text.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const std::string kFlashHead = "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'box.toml'\n";

class FlashRowsTest : public ::testing::Test {
 protected:
  FlashRowsTest() { folder_.write("box.toml", "[[part]]\nkind = 'box'\nsize = [1, 1, 1]\n"); }
  MissionSource load(const std::string& text) { return load_mission(folder_.write("m.toml", kFlashHead + text)); }
  Folder folder_;
};

TEST_F(FlashRowsTest, ReadsAFlashLidarWithItsPresets) {
  VERIFIES("LASSO-GND-001~1 LASSO-SIM-050~1");
  const MissionSource source = load(
      "[sensor]\nkind = 'flash_lidar'\nflash_columns = 256\nflash_photons_at_10m = 1500.5\n[further_sensor.near]\nkind = "
      "'flash_lidar'\nflash_threshold = 9\nflash_materials = true\nuse_to_m = 5\n");
  EXPECT_EQ(source.sensor, SensorKind::kFlashLidar);
  EXPECT_EQ(source.flash.columns, 256);
  EXPECT_EQ(source.flash.rows, sim::FlashModel{}.rows);
  EXPECT_EQ(source.flash.photons_at_10m, 1500.5);
  EXPECT_EQ(source.parameters.sigma0_m, sim::FlashModel{}.stated_sigma0_m);
  EXPECT_EQ(source.parameters.sigma_angle_rad, 1.2e-3);
  EXPECT_EQ(source.parameters.range_max_m, 60);
  ASSERT_EQ(source.further_sensors.size(), 1U);
  EXPECT_EQ(source.further_sensors[0].flash.threshold, 9);
  EXPECT_TRUE(source.further_sensors[0].flash.materials);
  EXPECT_FALSE(source.flash.materials);
  EXPECT_EQ(source.further_sensors[0].flash.columns, sim::FlashModel{}.columns);
  EXPECT_EQ(source.further_sensors[0].parameters.sigma_k_per_m, sim::FlashModel{}.stated_sigma_k_per_m);
}

TEST_F(FlashRowsTest, WrongValuesAndKeysOfOtherKindsAreNamedWithTheirPlace) {
  VERIFIES("LASSO-GND-001~1");
  const auto error = [&](const std::string& text) { return mission_error_of([&] { static_cast<void>(load(text)); }); };
  EXPECT_NE(error("[sensor]\nkind = 'flash_lidar'\nflash_rows = 257\n").find("m.toml:9:14: sensor.flash_rows"), std::string::npos);
  const std::string other = error("[sensor]\nkind = 'time_of_flight'\nflash_rows = 64\n");
  EXPECT_NE(other.find("m.toml:9:14: sensor.flash_rows"), std::string::npos) << other;
  EXPECT_NE(other.find("has no effect in a time_of_flight: leave it out, or write kind = \"flash_lidar\""), std::string::npos) << other;
  const std::string further = error("[further_sensor.near]\nflash_pulse_m = 0.1\n");
  EXPECT_NE(further.find("further_sensor.near.flash_pulse_m"), std::string::npos) << further;
}

TEST(FlashRows, EachRowsPresetIsTheModelsValue) {
  for (const ValueRow& row : flash_rows()) {
    EXPECT_EQ(flash_value(sim::FlashModel{}, row), row.preset.at(0)) << row.key;
    EXPECT_GE(row.preset.at(0), row.minimum);
    EXPECT_LE(row.preset.at(0), row.maximum);
  }
}

}  // namespace
}  // namespace lasso::mdat
