#include <Eigen/Geometry>

#include "mdat/missiondb/mission_source.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const std::string kMission = "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\n";  // 5 lines
const std::string kPart = "range_m = [1, 5]\nview = [0, 0, -2]\n";

// A triangle of a mesh, and a line beside it, which is no surface.
const char kObj[] = "v 0 0 0\nv 2 0 0\nv 0 4 0\nf 1 2 3\nl 1 2\n";

class MissionTarget : public ::testing::Test {
 protected:
  MissionTarget() {
    folder_.write("box.toml", "[[part]]\nkind = 'box'\nsize = [1, 1, 1]\n");
    folder_.write("triangle.obj", kObj);
    folder_.write("broken.stl", "solid x\nendsolid x\n");
  }
  MissionSource load(const std::string& text) { return load_mission(folder_.write("m.toml", kMission + text)); }
  MissionSource load_with_part(const std::string& text) { return load("model = 'box.toml'\n" + text + kPart); }  // which begins on line 7
  Folder folder_;
};

Eigen::AlignedBox3d extent_of(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : mesh.vertices) box.extend(v);
  return box;
}

void expect_extent(const Mesh& mesh, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  const Eigen::AlignedBox3d box = extent_of(mesh);
  EXPECT_LT((box.min() - low).norm(), 1e-6) << box.min().transpose();
  EXPECT_LT((box.max() - high).norm(), 1e-6) << box.max().transpose();
}

// First by its scale to metres, then by its origin, which is stated in metres.
TEST_F(MissionTarget, IsScaledAndThenMovedToItsOrigin) {
  VERIFIES("LASSO-GND-001~1");
  expect_extent(load_target(load("model = 'box.toml'\nscale = 3\norigin_m = [0.5, 1, -2]\n")), {-2, -2.5, 0.5}, {1, 0.5, 3.5});
  expect_extent(load_target(load("mesh = 'triangle.obj'\nscale = 0.5\norigin_m = [1, 0, 3]\n")), {-1, 0, -3}, {0, 2, -3});
}

TEST_F(MissionTarget, WhatAFileHoldsAndIsNoSurfaceIsTold) {
  VERIFIES("LASSO-GND-001~1");
  const MissionSource source = load("mesh = 'triangle.obj'\n");
  std::vector<std::string> warnings;
  EXPECT_EQ(load_target(source, &warnings).triangles.size(), 1U);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("triangle.obj: not read: "), std::string::npos) << warnings[0];
}

TEST_F(MissionTarget, ABrokenFileIsToldWhereItIsNamed) {
  VERIFIES("LASSO-GND-001~1");
  const MissionSource source = load("mesh = 'broken.stl'\n");
  const std::string message = mission_error_of([&] { static_cast<void>(load_target(source)); });
  EXPECT_NE(message.find("m.toml:6:8: target.mesh"), std::string::npos) << message;
}

TEST_F(MissionTarget, APartIsCutOrReadAndPutIntoItsFrame) {
  VERIFIES("LASSO-GND-001~1 LASSO-MDL-024~1");
  const MissionSource source = load_with_part(
      "[part.a]\nbox_m = [0, -1, -1, 1, 1, 1]\norigin_m = [0.25, 0, 0]\n"
      "quaternion = [0, 0, 0.70710678, 0.70710678]\n" +
      kPart + "[part.b]\nmodel = 'box.toml'\nscale = 0.5\n");
  const Mesh target = load_target(source);
  // the target's x from 0 to 0.5 is the part's y from 0.25 down to -0.25
  expect_extent(load_part(source, source.parts[0], target), {-0.5, -0.25, -0.5}, {0.5, 0.25, 0.5});
  expect_extent(load_part(source, source.parts[1], target), {-0.25, -0.25, -0.25}, {0.25, 0.25, 0.25});
}

TEST_F(MissionTarget, APartWithoutASurfaceIsToldWhereItIsNamed) {
  VERIFIES("LASSO-MOD-182~2");
  const MissionSource empty = load_with_part("[part.bay]\nbox_m = [5, 5, 5, 6, 6, 6]\n");
  const std::string nothing = mission_error_of([&] { static_cast<void>(load_part(empty, empty.parts[0], load_target(empty))); });
  EXPECT_NE(nothing.find("m.toml:8:9: part.bay.box_m: nothing of the target lies in the box: the part has no model"), std::string::npos)
      << nothing;
  const MissionSource broken = load_with_part("[part.bay]\nmesh = 'broken.stl'\n");
  const std::string message = mission_error_of([&] { static_cast<void>(load_part(broken, broken.parts[0], Mesh{})); });
  EXPECT_NE(message.find("m.toml:8:8: part.bay.mesh"), std::string::npos) << message;
  EXPECT_NE(message.find("give the part another file, or delete it"), std::string::npos) << message;
}

}  // namespace
}  // namespace lasso::mdat
