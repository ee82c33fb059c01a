#include "mdat/missiondb/volume_reader.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const std::string kCloudHead = "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'box.toml'\n";  // 6 lines
const std::string kCloudNodes = "[node.body]\ntarget = true\n[node.head]\nsensor = true\nposition_m = [0, 0, -10]\n[scenario.one]\n";

class VolumeReaderTest : public ::testing::Test {
 protected:
  VolumeReaderTest() { folder_.write("box.toml", "[[part]]\nkind = 'box'\nsize = [1, 1, 1]\n"); }
  MissionSource load(const std::string& text) { return load_mission(folder_.write("m.toml", kCloudHead + text)); }
  void expect_complaint(const std::string& scatter, const std::string& expected) {
    const std::string said = mission_error_of([&] { static_cast<void>(load("[node.plume]\nscatter = {" + scatter + "}\n")); });
    EXPECT_NE(said.find(expected), std::string::npos) << "got: " << said << "\nexpected: " << expected;
  }
  Folder folder_;
};

TEST_F(VolumeReaderTest, ReadsACloudAndPutsItAtItsNode) {
  VERIFIES("LASSO-SIM-068~1");
  const MissionSource source = load(
      "[node.dust]\nscatter = {extinction_per_m = 0.2, radius_m = 3}\n"
      "[node.plume]\nscatter = {shape = 'cone', extinction_per_m = 2, half_angle_deg = 20, length_m = 6, core_m = 0.5}\n" +
      kCloudNodes);
  ASSERT_EQ(source.scene.volumes.size(), 2U);
  const sim::ScatterVolume& dust = *source.scene.volumes[0].volume;
  EXPECT_EQ(dust.extinction_per_m, 0.2);
  EXPECT_EQ(dust.core_m, 3);  // even
  EXPECT_EQ(dust.lidar_ratio_sr, 40);
  const sim::ScatterVolume& plume = *source.scene.volumes[1].volume;
  EXPECT_EQ(plume.shape, sim::ScatterShape::kCone);
  EXPECT_NEAR(plume.half_angle_rad, 20 * kRadPerDeg, 1e-15);
  EXPECT_EQ(plume.core_m, 0.5);
  const SceneRun& run = *source.scenarios.at("one").scene;
  ASSERT_EQ(run.volumes.size(), 2U);
  EXPECT_EQ(run.tree.name(run.volumes[1].first), "plume");
}

TEST_F(VolumeReaderTest, WhatIsMissingOrHasNoEffectIsToldWithItsPlace) {
  VERIFIES("LASSO-SIM-068~1");
  expect_complaint("extinction_per_m = 0.2", "node.plume.scatter.radius_m: 0: expected more than 0");
  expect_complaint("radius_m = 1", "m.toml:7:1: node.plume.scatter.extinction_per_m: 0: expected more than 0");
  expect_complaint("extinction_per_m = 1, radius_m = 1, length_m = 2",
                   "m.toml:8:59: node.plume.scatter.length_m: 2: has no effect on a sphere");
  expect_complaint("shape = 'cube'", "node.plume.scatter.shape: 'cube': expected one of \"sphere\", \"cone\"");
}

}  // namespace
}  // namespace lasso::mdat
