#include "mdat/modelc/polygons.hpp"

#include <gtest/gtest.h>

#include "mdat/modelc/repair.hpp"
#include "ut/mdat/modelc/meshes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

struct Result {
  Surface surface;
  std::vector<std::array<Vec3d, 3>> normals;
  Polygons polygons;
};

Result polygons_of(const Mesh& mesh, double crease_deg) {
  CompileReport report;
  Result r;
  r.surface = repair_mesh(mesh, 0, report);
  r.normals = smooth_normals(r.surface, crease_deg * std::numbers::pi / 180);
  r.polygons = make_polygons(r.surface, edge_uses(r.surface), r.normals);
  return r;
}

double area(const Polygon& p) {
  Vec3d sum = Vec3d::Zero();
  for (std::size_t i = 1; i + 1 < static_cast<std::size_t>(p.sides); ++i) {
    sum += (p.corners[i] - p.corners[0]).cross(p.corners[i + 1] - p.corners[0]) / 2;
  }
  return p.normal.dot(sum);
}

TEST(Polygons, ABoxHasSixRectangles) {
  VERIFIES("LASSO-MDL-005~2");
  Mesh mesh = shapes::box({0, 0, 0}, {1, 2, 3});
  shapes::move(mesh, shapes::generic_turn(), {1, 2, 3});
  const Result r = polygons_of(mesh, 30);
  ASSERT_EQ(r.polygons.list.size(), 6u);
  double total = 0;
  for (const Polygon& p : r.polygons.list) {
    EXPECT_EQ(p.sides, 4);
    EXPECT_GT(area(p), 0);
    total += area(p);
  }
  EXPECT_NEAR(total, 22, 1e-9);
}

TEST(Polygons, DoNotJoinAcrossConcaveOutlinesCreasesOrDifferentSidedness) {
  VERIFIES("LASSO-MDL-005~2");
  Mesh dart;
  dart.vertices = {{0, 0, 0}, {1, 0.2, 0}, {0.2, 0.2, 0}, {0.2, 1, 0}};
  dart.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(polygons_of(dart, 30).polygons.list.size(), 2u);
  Mesh bent = shapes::sheet(1, 1);
  bent.vertices[3].z() = 1e-5;
  EXPECT_EQ(polygons_of(bent, 30).polygons.list.size(), 2u);
  bent.vertices[3].z() = 1e-8;
  EXPECT_EQ(polygons_of(bent, 30).polygons.list.size(), 1u);
  CompileReport report;
  Surface mixed = repair_mesh(shapes::sheet(1, 1), 0, report);
  mixed.two_sided[1] = 1;
  EXPECT_EQ(make_polygons(mixed, edge_uses(mixed), smooth_normals(mixed, 0.5)).list.size(), 2u);
}

TEST(Polygons, SmoothNormalsOfASphereAreRadial) {
  VERIFIES("LASSO-MDL-012~2");
  const Result r = polygons_of(shapes::sphere(0.5, 24, 32), 30);
  for (std::size_t t = 0; t < r.surface.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      EXPECT_LT((r.normals[t][static_cast<std::size_t>(i)] - r.surface.corner(t, i).normalized()).norm(), 0.02);
    }
  }
}

TEST(Polygons, NormalsStopAtCreases) {
  VERIFIES("LASSO-MDL-012~2");
  const Result r = polygons_of(shapes::cylinder(0.5, 1, 24), 30);  // facets meet at 15 degrees, caps at 90
  for (std::size_t t = 0; t < r.surface.triangles.size(); ++t) {
    const bool cap = std::abs(r.surface.normals[t].z()) > 0.5;
    for (int i = 0; i < 3; ++i) {
      const Vec3d corner = r.surface.corner(t, i);
      const Vec3d truth = cap ? Vec3d(0, 0, r.surface.normals[t].z()) : Vec3d(corner.x(), corner.y(), 0).normalized();
      EXPECT_LT((r.normals[t][static_cast<std::size_t>(i)] - truth).norm(), 1e-9);
    }
  }
  const Result sharp = polygons_of(shapes::cylinder(0.5, 1, 24), 10);
  for (std::size_t t = 0; t < sharp.surface.triangles.size(); ++t) EXPECT_LT((sharp.normals[t][0] - sharp.surface.normals[t]).norm(), 1e-9);
}

TEST(Polygons, TheElementOfASliverIsItsHosts) {
  VERIFIES("LASSO-MDL-010~1");
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0.5}};
  mesh.triangles = {{0, 1, 3}, {0, 2, 1}, {0, 4, 2}, {2, 4, 1}};
  const Result r = polygons_of(mesh, 30);
  EXPECT_EQ(r.polygons.of_triangle[1], r.polygons.of_triangle[0]);
  EXPECT_NE(r.polygons.of_triangle[2], r.polygons.of_triangle[0]);
}

}  // namespace
}  // namespace lasso::mdat
