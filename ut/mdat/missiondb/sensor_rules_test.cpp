#include "ut/mdat/missiondb/rules_support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

class SensorRules : public RuleTest {};

const std::string kLidar = "sensor.kind = 'time_of_flight'\nsensor.sigma_angle_rad = 1e-4\n";

TEST_F(SensorRules, BandsAreNotEmpty) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_said(said("sensor.range_min_m = 20"), "error: ", "sensor.range_min_m: 20: expected less than sensor.range_max_m, which is 20 m");
  expect_said(said("sensor.use_from_m = 5\nsensor.use_to_m = 5"),
              "error: ", "sensor.use_from_m: 5: expected less than sensor.use_to_m, which is 5 m");
  expect_edge("sensor.use_to_m = 5", "sensor.use_to_m = 4.9", "warning: ", "they have it from 5 m to 5 m");
  EXPECT_EQ(said("sensor.use_from_m = 19").find("never both"), std::string::npos);
  expect_said(said("sensor.use_from_m = 20"), "error: ", "used from 20 m to 1e+04 m, and measures from 0.5 m to 20 m: never both");
}

TEST_F(SensorRules, ASensorServesInAScenario) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  const std::string near = "further_sensor.near.use_to_m = ";
  expect_edge(near + "5", near + "4", "further_sensor.near.use_to_m: 4", "used from 0 m to 4 m, where no scenario has the target");
  EXPECT_EQ(said(near + "5.5", "ranges_m = [6, 5]\ntimes_s = [0, 20]\nframes = 100"), "");  // on its way
}

TEST_F(SensorRules, TheNoiseIsThatOfItsKind) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_edge(kLidar + "sensor.sigma_k_per_m = 9e-6", kLidar + "sensor.sigma_k_per_m = 1.1e-4", "sensor.sigma_k_per_m: 0.00011",
              "1.1 m at 100 m");
  expect_edge(kLidar + "sensor.sigma0_m = 0.0005", kLidar + "sensor.sigma0_m = 0.00015", "sensor.sigma0_m: 0.00015", "are 1 ps");
  expect_edge("sensor.sigma0_m = 0.001\nsensor.sigma_k_per_m = 0\nsensor.range_min_m = 2",
              "sensor.sigma0_m = 0.001\nsensor.sigma_k_per_m = 0\nsensor.range_min_m = 1.9", "sensor.sigma_k_per_m: 0", "time_of_flight");
  expect_edge("sensor.kind = 'time_of_flight'\nsensor.sigma_angle_rad = 2.6e-5", "sensor.kind = 'time_of_flight'",
              "sensor.sigma_angle_rad: 0", "0.025 m at 100 m");
}

TEST_F(SensorRules, AFlashLidarHasPhotonsForTheRangeAndKnowsItsPixels) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  const std::string flash = "sensor.kind = 'flash_lidar'\n";
  EXPECT_EQ(said(flash), "");
  expect_edge(flash + "sensor.sigma_angle_rad = 8.4e-4", flash + "sensor.sigma_angle_rad = 8.3e-4", "sensor.sigma_angle_rad: 0.00083",
              "a pixel is 0.00419 rad wide");
  expect_edge(flash + "sensor.flash_photons_at_10m = 2.51", flash + "sensor.flash_photons_at_10m = 2.49",
              "sensor.flash_photons_at_10m: a surface", "returns 9.96 counts from 5 m, and 5 make a return");
  expect_said(said(flash + "scan.aimed_share = 0.3"), "warning: ", "which cannot aim");
}

// Fields of 10 m tan 15 deg, 2.68 m, at 5 m.
TEST_F(SensorRules, StereoCamerasSeeSomethingInCommon) {
  VERIFIES("LASSO-SCN-024~1");
  const std::string stereo = "sensor.kind = 'stereo'\nsensor.fov_half_x_deg = 15\nstereo.baseline_m = ";
  EXPECT_EQ(said(stereo + "2.67").find("nothing in common"), std::string::npos);
  expect_said(said(stereo + "2.69"), "error: ", "stereo.baseline_m: the cameras see nothing in common: at 5 m the field of each is 2.68 m");
}

TEST_F(SensorRules, TheNoiseLeavesTheTargetItsShape) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_edge("sensor.sigma0_m = 0.083", "sensor.sigma0_m = 0.41",
              "warning: ", "one sigma of a range is 0.41 m at 5 m, 20.5 % of the target's length");
  expect_edge("sensor.sigma_k_per_m = 0.0033", "sensor.sigma_k_per_m = 0.004", "warning: ", "is by sigma_k_per_m");
  expect_edge("sensor.sigma0_m = 0.083", "sensor.sigma0_m = 1", "error: ", "in millimetres? 1 mm are 0.001 m (scenario s)");
}

TEST_F(SensorRules, TheFieldShowsTheTarget) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  for (const std::string key : {"sensor.fov_half_x_deg = ", "sensor.fov_half_y_deg = "}) {
    expect_edge(key + "2.87", key + "2.86", "warning: ", "the field is 0.5 m wide at 5 m, 25 % of the target's length of 2 m");
    expect_edge(key + "15", key + "0.26", "error: ", "in radians? 0.26 rad are 14.9 deg");
  }
  expect_said(said("sensor.fov_half_x_deg = 0.58"), "warning: ", "5.06 %");
}

TEST_F(SensorRules, WhatItMeasuresHoldsTheTarget) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_edge("sensor.range_min_m = 4.5", "sensor.range_min_m = 4.6", "scenario.s.ranges_m: [5]", "4.6 m to 20 m");
  expect_edge("sensor.range_max_m = 5.5", "sensor.range_max_m = 5.4", "scenario.s.ranges_m: [5]", "0.5 m to 5.4 m");
}

TEST_F(SensorRules, WhatScenariosHaveInCommonIsSaidOnce) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  const std::string text = said("sensor.sigma0_m = 0.41", "ranges_m = [5]\n[scenario.t]\nranges_m = [6]");
  expect_said(text, "sensor.sigma0_m: 0.41", "(scenarios s, t)");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
}

TEST_F(SensorRules, TheNoiseIsOneThatASensorCanHave) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  const std::string fine = "sensor.sigma0_m = 1e-5\nsensor.sigma_k_per_m = ";
  expect_edge(fine + "2e-5", fine + "1.1e-7", "sensor.sigma_k_per_m: 1.1e-07",
              "0.0104 mm at 5 m, less than the counts of a laser camera tell apart, about 0.5 mm");
  EXPECT_EQ(said(fine + "1.1e-7", "ranges_m = [5]\nnoise = false"), "");
  expect_edge("sensor.range_max_m = 2200", "sensor.range_max_m = 9000", "sensor.range_max_m: 9000", "9e+03 mm are 9 m");
  // 30 mm of 1 m
  expect_edge("sensor.sigma_angle_rad = 0.006", "sensor.sigma_angle_rad = 0.01", "sensor.sigma_angle_rad: 0.01", "50 mm at 5 m");
}

TEST_F(SensorRules, CommonErrorsLastLongerThanAScanAndLeavePosesThatAreNotWeak) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  const std::string sized = "sensor.common_sigma_m = 0.001\nsensor.common_memory_s = ";
  expect_edge(sized + "0.2", sized + "0.1", "error: ", "shorter than a scan of 0.18 s");
  expect_edge(sized + "0", "sensor.common_memory_s = 5", "sensor.common_memory_s: 5", "no common error is stated");
  // 2 mm/m2 at 5 m are 50 mm
  const std::string noisy = "sensor.sigma_k_per_m = 8e-4\nsensor.common_sigma_k_per_m = ";
  expect_edge(noisy + "1.9e-3", noisy + "2.1e-3", "warning: ", "52.5 mm at 5 m");
  const std::string plain = "sensor.sigma_k_per_m = 1e-4\nsensor.common_sigma_k_per_m = ";
  expect_edge(plain + "2.9e-4", plain + "3.1e-4", "warning: ", "3.1 times their noise at 5 m");
}

}  // namespace
}  // namespace lasso::mdat
