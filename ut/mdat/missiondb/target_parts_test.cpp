#include "mdat/missiondb/target_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "ut/support/places.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

std::string part_at(const TargetParts& parts, const Mesh& mesh, const Eigen::Vector3d& place_m) {
  std::size_t nearest = 0;
  double least = 1e9;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const double off = ((mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3 - place_m).norm();
    if (off < least) nearest = i;
    least = std::min(least, off);
  }
  return parts.names[parts.of_triangle[nearest]];
}

TEST(TargetParts, OfAParametricModelAreItsSolids) {
  VERIFIES("LASSO-PIC-013~1");
  const MissionSource source = load_mission(test::source_folder() / "cfg/missions/hubble_tenth.toml");
  const Mesh mesh = load_target(source);
  const TargetParts parts = target_parts(source, mesh);
  ASSERT_EQ(parts.of_triangle.size(), mesh.triangles.size());
  EXPECT_EQ(part_at(parts, mesh, {0.2, 0.365, 0}), "solar array +y");
  EXPECT_EQ(part_at(parts, mesh, {0.2, -0.365, 0}), "solar array -y");
  EXPECT_EQ(part_at(parts, mesh, {-0.06, 0, 0}), "body");
  EXPECT_EQ(std::count(parts.names.begin(), parts.names.end(), "standoff, aft"), 1);  // three copies are one part
}

TEST(TargetParts, OfAMeshAreTheMissionsBoxes) {
  VERIFIES("LASSO-PIC-013~1");
  MissionSource source;
  PartSource end, all;
  end.name = "end";
  end.box_m = {0.5, -1, -1, 2, 1, 1};
  all.name = "other end";
  all.box_m = {-2, -1, -1, -0.5, 1, 1};
  source.parts = {end, all};
  const Mesh mesh{{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {1, 0, 0}, {1.1, 0, 0}, {1, 0.1, 0}, {-1, 0, 0}, {-1.1, 0, 0}, {-1, 0.1, 0}},
                  {{3, 4, 5}, {0, 1, 2}, {6, 7, 8}, {3, 5, 4}}};
  const TargetParts parts = target_parts(source, mesh);
  ASSERT_EQ(parts.of_triangle.size(), 4U);
  EXPECT_EQ(parts.names[parts.of_triangle[0]], "end");
  EXPECT_EQ(parts.names[parts.of_triangle[1]], "target");
  EXPECT_EQ(parts.names[parts.of_triangle[2]], "other end");
  EXPECT_EQ(parts.of_triangle[3], parts.of_triangle[0]);
}

}  // namespace
}  // namespace lasso::mdat
