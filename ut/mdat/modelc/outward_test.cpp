#include "mdat/modelc/outward.hpp"

#include <gtest/gtest.h>

#include "mdat/modelc/repair.hpp"
#include "ut/mdat/modelc/meshes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

Surface outward(const Mesh& mesh, CompileReport& report) {
  Surface surface = repair_mesh(mesh, 0, report);
  const Components components = orient_consistently(surface, report);
  turn_outward(surface, components, report);
  return surface;
}

TEST(TurnOutward, ASphereWithInwardWindingsIsTurned) {
  VERIFIES("LASSO-MDL-011~2");
  Mesh mesh = shapes::sphere(0.5, 8, 12);
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  CompileReport report;
  const Surface surface = outward(mesh, report);
  EXPECT_EQ(report.flipped_components, 1u);
  EXPECT_EQ(report.two_sided_triangles, 0u);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) EXPECT_GT(surface.normals[t].dot(surface.corner(t, 0)), 0);
}

TEST(TurnOutward, ThinClosedPlatesKeepTwoOneSidedFaces) {
  VERIFIES("LASSO-MDL-011~2");
  CompileReport report;
  const Surface surface = outward(shapes::box({0, 0, 0}, {1, 1, 0.001}), report);
  EXPECT_EQ(report.two_sided_triangles, 0u);
  EXPECT_EQ(report.flipped_triangles, 0u);
  EXPECT_EQ(surface.triangles.size(), 12u);
}

TEST(TurnOutward, OpenSheetsAndCupsAreSeenFromBothSides) {
  VERIFIES("LASSO-MDL-011~2");
  CompileReport sheet, cup;
  outward(shapes::sheet(1, 3), sheet);
  EXPECT_EQ(sheet.two_sided_triangles, 18u);
  EXPECT_EQ(sheet.two_sided_components, 1u);
  outward(shapes::cylinder(0.5, 1, 16, true, false), cup);
  EXPECT_EQ(cup.two_sided_triangles, cup.triangles);
}

TEST(TurnOutward, WhereNotAllAreAskedTheOthersHaveTheirComponentsAnswer) {
  VERIFIES("LASSO-MDL-011~2");
  const Mesh cup = shapes::cylinder(0.5, 1, 16, true, false);
  for (const double asked : {1.0, 0.0}) {
    CompileReport report;
    Surface surface = repair_mesh(cup, 0, report);
    const Components components = orient_consistently(surface, report);
    std::vector<double> of_first(surface.triangles.size(), 0);
    of_first[0] = asked;
    turn_outward(surface, components, report, of_first);
    EXPECT_EQ(report.two_sided_triangles, asked > 0 ? report.triangles : 0);
  }
}

TEST(TurnOutward, ACrackDoesNotMakeABodyTwoSided) {
  VERIFIES("LASSO-MDL-011~2");
  Mesh mesh = shapes::box({0, 0, 0}, {1, 1, 1});
  mesh.vertices.push_back(mesh.vertices[7] + Vec3d(0, 0, -1e-4));
  for (std::size_t t = 10; t < 12; ++t) {
    for (auto& v : mesh.triangles[t]) v = v == 7 ? 8 : v;
  }
  CompileReport report;
  outward(mesh, report);
  EXPECT_GT(report.boundary_edges, 0u);
  EXPECT_EQ(report.two_sided_triangles, 0u);
}

TEST(TurnOutward, HiddenPartsTurnToPositiveVolume) {
  VERIFIES("LASSO-MDL-011~2");
  Mesh inner = shapes::box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1});
  for (auto& t : inner.triangles) std::swap(t[0], t[1]);
  Mesh mesh = shapes::box({-1, -1, -1}, {1, 1, 1});
  shapes::append(mesh, inner);
  CompileReport report;
  const Surface surface = outward(mesh, report);
  EXPECT_EQ(report.hidden_components, 1u);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) EXPECT_GT(surface.normals[t].dot(surface.corner(t, 0)), 0);
}

}  // namespace
}  // namespace lasso::mdat
