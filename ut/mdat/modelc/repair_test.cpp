#include "mdat/modelc/repair.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "ut/mdat/modelc/meshes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

std::string message_of(const Mesh& mesh) {
  CompileReport report;
  try {
    repair_mesh(mesh, 0, report);
  } catch (const CompileError& error) {
    return error.what();
  }
  return "";
}

TEST(RepairMesh, WeldsTheVerticesOfAnStlBox) {
  VERIFIES("LASSO-MDL-009~1");
  Mesh mesh = shapes::unwelded(shapes::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}));
  Random random(1);
  for (Vec3d& v : mesh.vertices) v += 3e-7 * shapes::random_vector(random);
  mesh.vertices.emplace_back(5, 5, 5);  // used by no triangle
  CompileReport report;
  const Surface surface = repair_mesh(mesh, 2e-6, report);
  EXPECT_EQ(surface.vertices.size(), 8u);
  EXPECT_EQ(report.welded_vertices, 28u);
  EXPECT_EQ(report.unused_vertices, 1u);
  EXPECT_EQ(surface.triangles.size(), 12u);
  EXPECT_NEAR(surface.extent, 1, 1e-6);
}

TEST(RepairMesh, DropsTrianglesWithoutAreaAndDoubles) {
  VERIFIES("LASSO-MDL-009~1");
  Mesh mesh = shapes::box({0, 0, 0}, {1, 1, 1});
  mesh.triangles.push_back({0, 0, 1});          // two corners are one
  mesh.vertices.emplace_back(0.5, 0, 0);        // in the middle of an edge
  mesh.triangles.push_back({0, 8, 1});          // collinear: kept as a sliver
  mesh.triangles.push_back(mesh.triangles[3]);  // the same again
  const auto& t = mesh.triangles[5];
  mesh.triangles.push_back({t[0], t[2], t[1]});  // the same from behind
  CompileReport report;
  const Surface surface = repair_mesh(mesh, 0, report);
  EXPECT_EQ(report.dropped_degenerate, 2u);
  EXPECT_EQ(report.dropped_duplicates, 2u);
  ASSERT_EQ(surface.triangles.size(), 13u);
  EXPECT_EQ(surface.sliver[12], 1);
  for (std::size_t i = 0; i < 13; ++i) EXPECT_EQ(surface.two_sided[i], i == 5) << i;
}

TEST(RepairMesh, NamesTheVertexOrTriangleAtFault) {
  VERIFIES("LASSO-MDL-008~1");
  Mesh mesh = shapes::box({0, 0, 0}, {1, 1, 1});
  EXPECT_NE(message_of(Mesh{}).find("no triangles"), std::string::npos);
  mesh.triangles[7][2] = 99;
  EXPECT_NE(message_of(mesh).find("triangle 7 names vertex 99 of 8"), std::string::npos);
  mesh = shapes::box({0, 0, 0}, {1, 1, 1});
  mesh.vertices[3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message_of(mesh).find("vertex 3 is not finite"), std::string::npos);
}

TEST(RepairMesh, DoubtsTheScaleOfAbsurdExtents) {
  VERIFIES("LASSO-MDL-008~1");
  for (const double size : {1e-4, 1e6, 1e300}) {
    const std::string message = message_of(shapes::box({0, 0, 0}, {size, size, size}));
    EXPECT_NE(message.find("is the scale right?"), std::string::npos) << size << ": " << message;
  }
  EXPECT_NE(message_of(shapes::box({1e5, 0, 0}, {1e5 + 1, 1, 1})).find("is the scale right?"), std::string::npos);
  const auto of_size = [](double size) { return message_of(shapes::box({0, 0, 0}, {size, size / 2, size / 3})); };
  EXPECT_EQ(of_size(1.001e-3), "");
  EXPECT_NE(of_size(0.999e-3).find("extent is 0.000999 m, at least 0.001 m are expected"), std::string::npos) << of_size(0.999e-3);
  EXPECT_EQ(of_size(999.9), "");
  EXPECT_NE(of_size(1001).find("extent is 1001 m"), std::string::npos) << of_size(1001);
  EXPECT_NE(of_size(1001).find("at most 1000 m are expected"), std::string::npos) << of_size(1001);
}

TEST(RepairMesh, RefusesAMeshOfSliversOnly) {
  VERIFIES("LASSO-MDL-008~1");
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0.5, 1e-9, 0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_NE(message_of(mesh).find("thinner than the weld tolerance"), std::string::npos);
}

}  // namespace
}  // namespace lasso::mdat
