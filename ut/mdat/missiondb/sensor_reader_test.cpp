#include "mdat/missiondb/sensor_reader.hpp"

#include <cmath>

#include "cfg/capacities.hpp"
#include "fsw/geometry/portable_math.hpp"
#include "mdat/missiondb/calibration_file.hpp"
#include "mdat/missiondb/mission_text.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const std::string kSensorHead =
    "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'box.toml'\n";  // what follows begins on line 7

class SensorReaderTest : public ::testing::Test {
 protected:
  SensorReaderTest() { folder_.write("box.toml", "[[part]]\nkind = 'box'\nsize = [1, 1, 1]\n"); }
  MissionSource load(const std::string& text) { return load_mission(folder_.write("m.toml", kSensorHead + text)); }
  void expect_error(const std::string& text, const std::string& expected) {
    const std::string message = mission_error_of([&] { static_cast<void>(load(text)); });
    EXPECT_NE(message.find(expected), std::string::npos) << "got: " << message << "\nexpected: " << expected;
  }
  Folder folder_;
};

TEST_F(SensorReaderTest, ReadsEachSensorWithThePresetsOfItsKind) {
  VERIFIES("LASSO-GND-001~1 LASSO-SNS-041~1");
  const MissionSource source = load(
      "[further_sensor.near]\nfov_half_x_deg = 25\nuse_to_m = 18\n[further_sensor.far]\nkind = 'time_of_flight'\nrange_min_m = 2\n"
      "use_from_m = 16\n");
  ASSERT_EQ(source.further_sensors.size(), 2U);
  const FurtherSensor& far = source.further_sensors[0];
  EXPECT_EQ(far.name, "far");
  EXPECT_EQ(far.kind, SensorKind::kTimeOfFlight);
  EXPECT_EQ(far.parameters.sigma0_m, 0.02);
  EXPECT_EQ(far.parameters.range_min_m, 2);
  EXPECT_EQ(far.parameters.range_max_m, 100);
  EXPECT_EQ(far.parameters.use_from_m, 16);
  const FurtherSensor& near = source.further_sensors[1];
  EXPECT_EQ(near.kind, SensorKind::kLaserCamera);
  EXPECT_NEAR(near.parameters.fov_half_x_rad, 25 * kRadPerDeg, 1e-15);
  EXPECT_EQ(near.parameters.sigma0_m, preset_parameters().sigma0_m);
  EXPECT_EQ(near.parameters.use_to_m, 18);
  EXPECT_EQ(source.origins.at("further_sensor.near.use_to_m").line, 9);
  EXPECT_TRUE(source.origins.at("further_sensor.near.use_from_m").preset());
}

TEST_F(SensorReaderTest, WrongValuesAreNamedWithTheirPlace) {
  VERIFIES("LASSO-GND-001~1 LASSO-SNS-047~1");
  expect_error("[further_sensor.near]\nfov_half_x_deg = 80\n", "m.toml:8:18: further_sensor.near.fov_half_x_deg");
  expect_error("[further_sensor.near]\nsigma = 1\n", "further_sensor.near.sigma");
  const std::string message =
      mission_error_of([&] { static_cast<void>(load_mission(folder_.write("n.toml", "further_sensor = 3\n" + kSensorHead))); });
  EXPECT_NE(message.find("expected tables [further_sensor.NAME]"), std::string::npos) << message;
  expect_error("[further_sensor]\nnear = 3\n", "expected a table [further_sensor.near]");
}

TEST_F(SensorReaderTest, ASensorWithoutARangeOrATurnIsRefused) {
  VERIFIES("LASSO-SNS-047~1");
  expect_error("[further_sensor.near]\nrange_min_m = 30\n", "expected less than further_sensor.near.range_max_m, which is 20 m");
  expect_error("[further_sensor.near]\nuse_from_m = 30\nuse_to_m = 20\n", "m.toml:8:14: further_sensor.near.use_from_m");
  expect_error("[sensor]\nuse_from_m = 30\nuse_to_m = 20\n", "expected less than sensor.use_to_m, which is 20 m");
}

TEST_F(SensorReaderTest, ReadsTheCalibrationsThatSensorsName) {
  VERIFIES("LASSO-LCS-007~2 LASSO-GND-001~1");
  TriangulationCalibration camera;
  camera.serial = 31;
  camera.residual[4] = 0.25;
  folder_.write("a.toml", calibration_text(camera));
  camera.serial = 32;
  folder_.write("b.toml", calibration_text(camera));
  const MissionSource source =
      load("[sensor]\ncalibration = 'a.toml'\n[further_sensor.near]\ncalibration = 'b.toml'\n[further_sensor.far]\n");
  ASSERT_EQ(source.calibrations.size(), 2U);
  EXPECT_EQ(source.calibrations.at(0).at(0).serial, 31U);
  EXPECT_EQ(source.calibrations.at(0).at(0).residual[4], 0.25);
  EXPECT_EQ(source.calibrations.at(2).at(0).serial, 32U) << "after far";
  EXPECT_TRUE(load("").calibrations.empty());
  const std::string text = info_text(source, "");
  EXPECT_NE(text.find("further_sensor.near.calibration"), std::string::npos);
  EXPECT_NE(text.find("a.toml"), std::string::npos);
}

TEST_F(SensorReaderTest, ASensorMayNameSeveralCalibrations) {
  VERIFIES("LASSO-LCS-020~1 LASSO-GND-001~1");
  TriangulationCalibration camera;
  for (const char* name : {"a.toml", "b.toml"}) {
    ++camera.serial;
    folder_.write(name, calibration_text(camera));
  }
  const MissionSource source =
      load("[sensor]\ncalibration = ['b.toml', 'a.toml', 'b.toml', 'b.toml']\n[further_sensor.near]\ncalibration = ['a.toml', 'b.toml']\n");
  ASSERT_EQ(source.calibrations.at(0).size(), 4U);
  EXPECT_EQ(source.calibrations.at(0)[0].serial, 2U) << "in the order of the list";
  EXPECT_EQ(source.calibrations.at(0)[1].serial, 1U);
  EXPECT_EQ(source.calibrations.at(1)[1].serial, 2U);
  EXPECT_NE(info_text(source, "").find("b.toml, a.toml"), std::string::npos);
  expect_error("[sensor]\ncalibration = []\n", "m.toml:8:15: sensor.calibration");
  expect_error("[sensor]\ncalibration = ['a.toml', 'a.toml', 'a.toml', 'a.toml', 'a.toml']\n", "or a list of at most 4");
  expect_error("[sensor]\ncalibration = ['a.toml', 3]\n", "sensor.calibration[1]");
  expect_error("[sensor]\ncalibration = ['a.toml', 'none.toml']\n", "none.toml");
}

TEST_F(SensorReaderTest, CalibrationsThatAreNotRightAreNamed) {
  VERIFIES("LASSO-LCS-015~2 LASSO-GND-001~1");
  expect_error("[sensor]\ncalibration = 'none.toml'\n", "m.toml:8:15: sensor.calibration");
  expect_error("[sensor]\ncalibration = 'none.toml'\n", "mdat calibrate writes one");
  folder_.write("flat.toml", "serial = 3\n");
  expect_error("[sensor]\ncalibration = 'flat.toml'\n", "flat.toml");
  folder_.write("a.toml", calibration_text([] {
                  TriangulationCalibration camera;
                  camera.serial = 31;
                  return camera;
                }()));
  expect_error("[further_sensor.far]\nkind = 'time_of_flight'\ncalibration = 'a.toml'\n", "only laser cameras have one");
}

TEST_F(SensorReaderTest, MoreThanTheComponentHasRoomForAreRefused) {
  VERIFIES("LASSO-SNS-047~1");
  std::string text;
  for (std::size_t i = 0; i < kMaxSensors - 1; ++i) text += "[further_sensor.s" + std::to_string(i) + "]\n";
  EXPECT_EQ(load(text).further_sensors.size(), kMaxSensors - 1);
  expect_error(text + "[further_sensor.one_more]\n", "expected at most 3");
}

const std::string kMastNodes =
    "[motion.turn]\nkind = 'rates'\nspin_degps = [0, 0, 1]\n[node.body]\ntarget = true\nposition_m = [0, 0, 5]\nmotion = 'turn'\n"
    "[node.head]\nsensor = true\nposition_m = [0.1, 0, 0]\n"
    "[node.mast]\nposition_m = [0.1, 0.4, -0.1]\nquaternion = [0, 0.0871557427, 0, 0.9961946981]\n";  // 10 deg about y

// By hand: 0.4 m below and 0.1 m behind the head, turned to the right.
TEST_F(SensorReaderTest, ASensorStandsAtANode) {
  VERIFIES("LASSO-SCN-034~1");
  const MissionSource source = load(kMastNodes + "[further_sensor.far]\nnode = 'mast'\n[further_sensor.near]\n[scenario.s]\n");
  const Pose& pose = source.further_sensors[0].T_sensor_own.value();
  EXPECT_LT((pose.p - Vec3(0, 0.4, -0.1)).norm(), 1e-12);
  EXPECT_LT((pose.q * Vec3::UnitZ() - Vec3(std::sin(10 * kRadPerDeg), 0, std::cos(10 * kRadPerDeg))).norm(), 1e-8);
  EXPECT_FALSE(source.further_sensors[1].T_sensor_own);
  EXPECT_NE(info_text(source, "").find("further_sensor.far.node"), std::string::npos);
  for (const std::string& warning : source.warnings) EXPECT_EQ(warning.find("node.mast"), std::string::npos) << warning;
}

TEST_F(SensorReaderTest, ANodeThatIsNoPlaceForASensorIsRefused) {
  VERIFIES("LASSO-SCN-034~1 LASSO-SCN-024~1");
  const auto at = [](const std::string& node) { return "[further_sensor.far]\nnode = '" + node + "'\n[scenario.s]\n"; };
  expect_error(kMastNodes + at("mats"), "further_sensor.far.node");
  expect_error(kMastNodes + at("mats"), "did you mean mast");
  expect_error(kMastNodes + at("body"), "moves against head");
  expect_error(kMastNodes + "[node.back]\nquaternion = [0, 1, 0, 0]\n" + at("back"), "180 deg away from where head looks");
  expect_error("[node.body]\ntarget = true\n" + at("body"), "no node of the mission has sensor = true");
  expect_error(kMastNodes + "[further_sensor.far]\nnode = 'mast'\n[scenario.s]\nmotion = {mast = 'turn'}\n", "in scenario s");
}

TEST_F(SensorReaderTest, TwoSensorsOfOneNameAreRefused) {
  VERIFIES("LASSO-SCN-024~1");
  expect_error("[sensor]\nkind = 'time_of_flight'\n[further_sensor.time_of_flight]\n",
               "m.toml:9:1: further_sensor.time_of_flight: is the name of [sensor] already");
  expect_error("[further_sensor.laser_camera]\nkind = 'time_of_flight'\n", "is the name of [sensor] already");
  expect_error("[node.mast]\ncamera = {fov_half_x_deg = 10}\n[further_sensor.mast]\n", "is the name of the camera at [node.mast], too");
}

}  // namespace
}  // namespace lasso::mdat
