#include "mdat/modelc/topology.hpp"

#include <gtest/gtest.h>

#include "mdat/modelc/repair.hpp"
#include "ut/mdat/modelc/meshes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

int clashing_edges(const Surface& surface) {
  int clashes = 0;
  for_each_edge(edge_uses(surface),
                [&](const EdgeUse* first, const EdgeUse* last) { clashes += last - first == 2 && first[0].forward == first[1].forward; });
  return clashes;
}

TEST(Topology, NeighboursAgreeOnAWindingAfterwards) {
  VERIFIES("LASSO-MDL-010~1");
  Mesh mesh = shapes::sphere(0.5, 8, 12);
  shapes::append(mesh, shapes::box({2, 0, 0}, {3, 1, 1}));
  Random random(5);
  for (auto& t : mesh.triangles) {
    if (random.uniform() < 0.3) std::swap(t[0], t[1]);
  }
  CompileReport report;
  Surface surface = repair_mesh(mesh, 0, report);
  EXPECT_GT(clashing_edges(surface), 0);
  const Components components = orient_consistently(surface, report);
  EXPECT_EQ(clashing_edges(surface), 0);
  EXPECT_EQ(components.count(), 2u);
  EXPECT_EQ(report.open_components, 0u);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Vec3d n = (surface.corner(t, 1) - surface.corner(t, 0)).cross(surface.corner(t, 2) - surface.corner(t, 0)).normalized();
    EXPECT_LT((n - surface.normals[t]).norm(), 1e-12);
  }
}

TEST(Topology, AMoebiusStripIsOpen) {
  VERIFIES("LASSO-MDL-010~1");
  Mesh mesh;
  constexpr std::uint32_t kSteps = 24;
  for (std::uint32_t i = 0; i < kSteps; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSteps;
    const Vec3d radial(std::cos(angle), std::sin(angle), 0);
    const Vec3d across = std::cos(angle / 2) * radial + std::sin(angle / 2) * Vec3d::UnitZ();
    mesh.vertices.push_back(radial - 0.2 * across);
    mesh.vertices.push_back(radial + 0.2 * across);
  }
  for (std::uint32_t i = 0; i + 1 < kSteps; ++i) shapes::add_quad(mesh, 2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1);
  shapes::add_quad(mesh, 2 * kSteps - 2, 1, 0, 2 * kSteps - 1);
  CompileReport report;
  Surface surface = repair_mesh(mesh, 0, report);
  const Components components = orient_consistently(surface, report);
  EXPECT_EQ(components.count(), 1u);
  EXPECT_EQ(report.open_components, 1u);
  EXPECT_EQ(report.boundary_edges, 2u * kSteps);
}

TEST(Topology, ASliverIsAFlapOfTheNeighbourAcrossItsLongestEdge) {
  VERIFIES("LASSO-MDL-010~1");
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}};
  mesh.triangles = {{0, 1, 3}, {0, 2, 1}, {0, 4, 2}, {2, 4, 1}};  // the second has no area
  CompileReport report;
  const Surface surface = repair_mesh(mesh, 0, report);
  const auto flap_of = attach_slivers(surface, edge_uses(surface));
  EXPECT_EQ(flap_of, (std::vector<std::uint32_t>{0, 0, 2, 3}));
}

}  // namespace
}  // namespace lasso::mdat
