#include "mdat/missiondb/optics_reader.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "mdat/missiondb/mission_text.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const std::string kOpticsHead =
    "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'box.toml'\n[node.body]\ntarget = true\n"
    "[node.head]\nsensor = true\nposition_m = [0, 0, -5]\n[scenario.s]\n";  // 12 lines

class OpticsReaderTest : public ::testing::Test {
 protected:
  OpticsReaderTest() { folder_.write("box.toml", "[[part]]\nkind = 'box'\nsize = [1, 1, 1]\n"); }
  MissionSource load(const std::string& text) { return load_mission(folder_.write("m.toml", kOpticsHead + text)); }
  void expect_problem(const std::string& text, const std::string& expected) {
    const std::string said = mission_error_of([&] { static_cast<void>(load(text)); });
    EXPECT_NE(said.find(expected), std::string::npos) << "got: " << said << "\nexpected: " << expected;
  }
  Folder folder_;
};

TEST_F(OpticsReaderTest, LampsAndCamerasStandAtNodes) {
  VERIFIES("LASSO-SCN-035~1");
  const MissionSource source = load(
      "[node.spot]\nparent = 'head'\nposition_m = [0.2, 0, 0]\nlamp = {intensity_Wpsr = 40, half_angle_deg = 15}\n"
      "[node.bulb]\nparent = 'body'\nposition_m = [0, 2, 0]\nlamp = {intensity_Wpsr = 3}\n"
      "[node.view]\nposition_m = [3, 0, -3]\ntowards = 'body'\ncamera = {fov_half_x_deg = 12}\n");
  ASSERT_EQ(source.scene.lamps.size(), 2U);  // in the order of their names
  EXPECT_EQ(source.scene.lamps[0].node, "bulb");
  EXPECT_NEAR(source.scene.lamps[0].half_angle_rad, kPi, 1e-12);
  EXPECT_EQ(source.scene.lamps[1].intensity_Wpsr, 40);
  EXPECT_NEAR(source.scene.lamps[1].half_angle_rad, 15 * kRadPerDeg, 1e-12);
  ASSERT_EQ(source.scene.cameras.size(), 1U);
  EXPECT_NEAR(source.scene.cameras[0].fov_half_x_rad, 12 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(source.scene.cameras[0].fov_half_y_rad, 20 * kRadPerDeg, 1e-12);
  EXPECT_TRUE(source.warnings.empty() || source.warnings.front().find("node.") == std::string::npos) << source.warnings.front();
  EXPECT_NE(info_text(source, "").find("node.spot.lamp.intensity_Wpsr"), std::string::npos);
}

TEST_F(OpticsReaderTest, ALampInsideOfASensorIsRefused) {
  VERIFIES("LASSO-SCN-035~1 LASSO-SCN-024~1");
  expect_problem("[node.spot]\nparent = 'head'\nposition_m = [0, 0.009, 0]\nlamp = {intensity_Wpsr = 40}\n",
                 "m.toml:16:26: node.spot.lamp.intensity_Wpsr: a lamp inside of the sensors' frame, node head");
  expect_problem("[node.spot]\nlamp = {intensity_Wpsr = 40}\ncamera = {fov_half_x_deg = 12}\n", "a lamp inside of the camera, node spot");
  expect_problem("[node.spot]\nposition_m = [0, 0.3, -5]\nlamp = {intensity_Wpsr = 40}\n[further_sensor.far]\nnode = 'spot'\n",
                 "a lamp inside of sensor far, node spot");
  expect_problem("[node.spot]\nlamp = {half_angle_deg = 40}\n", "give it lamp.intensity_Wpsr as well");
  expect_problem("[node.spot]\nlamp = {intensity_Wpsr = -1}\n", "node.spot.lamp.intensity_Wpsr: -1: out of range");
  EXPECT_EQ(load("[node.spot]\nparent = 'head'\nposition_m = [0, 0.011, 0]\nlamp = {intensity_Wpsr = 40}\n").scene.lamps.size(), 1U);
}

}  // namespace
}  // namespace lasso::mdat
