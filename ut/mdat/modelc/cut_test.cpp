#include "mdat/modelc/cut.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "ut/mdat/modelc/meshes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using Eigen::Vector3d;

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const Vector3d& a = mesh.vertices[t[0]];
    area += 0.5 * (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm();
  }
  return area;
}

TEST(CutByBox, KeepsTheSurfaceWithinTheBox) {
  VERIFIES("LASSO-GND-001~1");
  const Mesh unit = shapes::box({0, 0, 0}, {1, 1, 1});
  // A corner of 0.3 x 0.4 x 0.5: three faces, open where it was cut.
  const Mesh corner = cut_by_box(unit, {-1, -1, -1}, {0.3, 0.4, 0.5});
  EXPECT_NEAR(area_of(corner), 0.3 * 0.4 + 0.3 * 0.5 + 0.4 * 0.5, 1e-12);
  for (const Vector3d& v : corner.vertices) EXPECT_TRUE((v.array() <= Vector3d(0.3, 0.4, 0.5).array() + 1e-12).all());
  // A slice through the middle: four faces, and none across.
  EXPECT_NEAR(area_of(cut_by_box(unit, {0.25, -1, -1}, {0.75, 2, 2})), 4 * 0.5, 1e-12);
}

TEST(CutByBox, KeepsTheWindings) {
  VERIFIES("LASSO-GND-001~1");
  const Mesh slice = cut_by_box(shapes::box({0, 0, 0}, {1, 1, 1}), {0.2, -1, 0.1}, {0.7, 2, 2});
  for (const auto& t : slice.triangles) {
    const Vector3d& a = slice.vertices[t[0]];
    const Vector3d n = (slice.vertices[t[1]] - a).cross(slice.vertices[t[2]] - a);
    EXPECT_GT(n.dot(a - Vector3d(0.5, 0.5, 0.5)), 0);
  }
}

TEST(CutByBox, LeavesNothingOfWhatLiesBeside) {
  VERIFIES("LASSO-GND-001~1");
  const Mesh unit = shapes::box({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(cut_by_box(unit, {2, 0, 0}, {3, 1, 1}).triangles.empty());
  EXPECT_TRUE(cut_by_box(unit, {0.4, 0.4, 0.4}, {0.6, 0.6, 0.6}).vertices.empty());
  EXPECT_EQ(cut_by_box(unit, {-1, -1, -1}, {2, 2, 2}).triangles.size(), unit.triangles.size());
}

}  // namespace
}  // namespace lasso::mdat
