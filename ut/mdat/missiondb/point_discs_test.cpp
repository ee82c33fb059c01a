#include "mdat/missiondb/point_discs.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <string>

#include "mdat/missiondb/mesh_import.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using Eigen::Vector3d;

std::string cloud_text(const std::string& count, const std::string& more, const std::string& rows) {
  return "ply\nformat ascii 1.0\nelement vertex " + count + "\nproperty float x\nproperty float y\nproperty float z\n" + more +
         "end_header\n" + rows;
}
const std::string kNormalRows = "property float nx\nproperty uchar red\nproperty float ny\nproperty float nz\n";

std::string reason_of(const std::string& text) {
  try {
    static_cast<void>(read_ply_points(text));
  } catch (const MeshError& error) {
    return error.what();
  }
  return "";
}

Vector3d any_direction(test::Generator& random) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return Vector3d(x, y, z).normalized();
}

// Twice the area, along the normal by the order of the corners.
Vector3d area2(const Mesh& mesh, const std::array<std::uint32_t, 3>& t) {
  return (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
}

TEST(PointCloud, IsThePointsOfAFileAndTheirNormals) {
  VERIFIES("LASSO-SCN-033~1");
  const PointCloud cloud = read_ply_points(cloud_text("2", kNormalRows, "1 2 3 0 9 3 4\n-1 -2 -3 2 9 0 0\n"));
  ASSERT_EQ(cloud.points.size(), 2U);
  EXPECT_EQ(cloud.points[1], Vector3d(-1, -2, -3));
  EXPECT_LT((cloud.normals.at(0) - Vector3d(0, 0.6, 0.8)).norm(), 1e-15);
  EXPECT_EQ(cloud.normals.at(1), Vector3d(1, 0, 0));
  EXPECT_TRUE(read_ply_points(cloud_text("1", "", "1 2 3\n")).normals.empty());
}

TEST(PointCloud, IsRefusedWithTheReason) {
  VERIFIES("LASSO-SCN-033~1");
  EXPECT_NE(reason_of(cloud_text("0", "", "")).find("no point"), std::string::npos);
  EXPECT_NE(reason_of(cloud_text("1", "", "1 nan 3\n")).find("point that is not finite"), std::string::npos)
      << reason_of(cloud_text("1", "", "1 nan 3\n"));
  EXPECT_NE(reason_of(cloud_text("1", kNormalRows, "1 2 3 0 9 0 0\n")).find("normal without a direction, of point 0"), std::string::npos);
  std::string many;
  for (std::size_t i = 0; i <= kMaxCloudPoints; ++i) many += "1 2 3\n";
  EXPECT_NE(reason_of(cloud_text(std::to_string(kMaxCloudPoints + 1), "", many)).find("thin it out"), std::string::npos);
  EXPECT_NE(reason_of("plie\n"), "");
  EXPECT_THROW(static_cast<void>(read_cloud("nowhere.ply")), MeshError);
}

TEST(DiscMesh, ADiscLiesAcrossItsNormalAndHasItsArea) {
  VERIFIES("LASSO-SCN-033~1");
  test::Generator random(33);
  for (int trial = 0; trial < 20; ++trial) {
    const PointCloud cloud{{Vector3d(1, -2, 3), 5 * any_direction(random)}, {any_direction(random), any_direction(random)}};
    const double radius_m = random.uniform(0.001, 0.5);
    const Mesh mesh = disc_mesh(cloud, radius_m);
    ASSERT_EQ(mesh.triangles.size(), 2 * kDiscTriangles);
    for (std::size_t disc = 0; disc < 2; ++disc) {
      Vector3d sum = Vector3d::Zero();
      for (std::size_t i = 0; i < kDiscTriangles; ++i) sum += 0.5 * area2(mesh, mesh.triangles[disc * kDiscTriangles + i]);
      ASSERT_LT((sum - M_PI * radius_m * radius_m * cloud.normals[disc]).norm(), 1e-12) << "flat, of that area, round the normal";
      Vector3d middle = Vector3d::Zero();
      for (std::size_t i = 0; i < 8; ++i) middle += mesh.vertices[8 * disc + i] / 8;
      ASSERT_LT((middle - cloud.points[disc]).norm(), 1e-12);
    }
  }
}

// Half of all triangles' areas across a direction are the shadow of a convex body.
TEST(DiscMesh, AGrainsMeanShadowIsThatDisc) {
  VERIFIES("LASSO-SCN-033~1");
  const Mesh mesh = disc_mesh({{Vector3d(0.5, 0.2, -0.1)}, {}}, 0.02);
  ASSERT_EQ(mesh.triangles.size(), kGrainTriangles);
  test::Generator random(34);
  double shadow_m2 = 0;
  constexpr int kDirections = 20000;
  for (int i = 0; i < kDirections; ++i) {
    const Vector3d direction = any_direction(random);
    for (const auto& triangle : mesh.triangles) shadow_m2 += 0.25 * std::abs(area2(mesh, triangle).dot(direction)) / kDirections;
  }
  EXPECT_NEAR(shadow_m2, M_PI * 0.02 * 0.02, 0.005 * M_PI * 0.02 * 0.02);
  for (const auto& triangle : mesh.triangles) {
    const Vector3d middle = (mesh.vertices[triangle[0]] + mesh.vertices[triangle[1]] + mesh.vertices[triangle[2]]) / 3;
    EXPECT_GT(area2(mesh, triangle).dot(middle - Vector3d(0.5, 0.2, -0.1)), 0) << "corners run round the outward normal";
  }
}

}  // namespace
}  // namespace lasso::mdat
