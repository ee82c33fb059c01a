#include "mdat/modelc/silhouette_edges.hpp"

#include <gtest/gtest.h>

#include "cfg/capacities.hpp"
#include "mdat/modelc/repair.hpp"
#include "ut/mdat/modelc/meshes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

struct DecodedEdge {
  Vec3d a, b, n0, n1;
  double d0, d1;
  std::uint32_t flags;
};

std::vector<DecodedEdge> edges_of(const Mesh& mesh) {
  CompileReport report;
  const Surface surface = repair_mesh(mesh, 0, report);
  const auto uses = edge_uses(surface);
  const Polygons polygons = make_polygons(surface, uses, smooth_normals(surface, 0.5));
  const LengthScale scale(4);
  const auto elements = make_elements(polygons.list, scale, surface.extent, report).list;
  const auto words = make_edges(surface, uses, polygons, elements, scale, report);
  std::vector<DecodedEdge> edges;
  for (std::size_t at = 0; at < words.size(); at += kEdgeWords) {
    const auto length = [&](std::size_t i) { return static_cast<std::int32_t>(words[at + i]) * scale.resolution_m(); };
    const auto unit = [&](std::size_t i) { return std::ldexp(static_cast<double>(static_cast<std::int32_t>(words[at + i])), -30); };
    edges.push_back({{length(0), length(1), length(2)},
                     {length(3), length(4), length(5)},
                     {unit(6), unit(7), unit(8)},
                     {unit(10), unit(11), unit(12)},
                     length(9),
                     length(13),
                     words[at + 14]});
  }
  return edges;
}

// Both end points lie in both planes.
void expect_in_planes(const DecodedEdge& e) {
  for (const Vec3d& p : {e.a, e.b}) {
    EXPECT_NEAR(e.n0.dot(p), e.d0, 1e-7);
    EXPECT_NEAR(e.n1.dot(p), e.d1, 1e-7);
  }
}

TEST(SilhouetteEdges, ABoxHasItsTwelve) {
  VERIFIES("LASSO-MDL-014~2");
  Mesh mesh = shapes::box({0, 0, 0}, {1, 2, 0.5});
  shapes::move(mesh, shapes::generic_turn(), {0.1, 0.2, 0.3});
  const auto edges = edges_of(mesh);
  ASSERT_EQ(edges.size(), 12u);
  double length = 0;
  for (const DecodedEdge& e : edges) {
    expect_in_planes(e);
    EXPECT_NEAR(e.n0.dot(e.n1), 0, 1e-8);
    EXPECT_EQ(e.flags, 0u);
    length += (e.b - e.a).norm();
  }
  EXPECT_NEAR(length, 14, 1e-6);
}

TEST(SilhouetteEdges, BoundariesHaveOpposedPlanes) {
  VERIFIES("LASSO-MDL-014~2");
  const auto edges = edges_of(shapes::sheet(1, 3));
  ASSERT_EQ(edges.size(), 12u);  // the outline; inner edges are coplanar
  for (const DecodedEdge& e : edges) {
    EXPECT_EQ(e.flags, kEdgeBoundary);
    EXPECT_EQ(e.n1, Vec3d(-e.n0));
    EXPECT_EQ(e.d1, -e.d0);
    expect_in_planes(e);
  }
}

TEST(SilhouetteEdges, EverySphereEdgeIsThereOnce) {
  VERIFIES("LASSO-MDL-014~2");
  const auto edges = edges_of(shapes::sphere(0.5, 8, 12));
  EXPECT_EQ(edges.size(), 7u * 12 + 8u * 12);  // parallels and meridians; quads of a sphere's grid are planar
  for (const DecodedEdge& e : edges) {
    expect_in_planes(e);
    EXPECT_GT(e.n0.dot(e.a + e.b), 0);
    EXPECT_GT(e.n1.dot(e.a + e.b), 0);
  }
}

TEST(SilhouetteEdges, BodiesThatTouchInAnEdgeKeepOneEdgeEach) {
  VERIFIES("LASSO-MDL-014~2");
  Mesh mesh = shapes::box({0, 0, 0}, {1, 1, 1});
  shapes::append(mesh, shapes::box({1, 1, 0}, {2, 2, 1}));
  const auto edges = edges_of(mesh);
  ASSERT_EQ(edges.size(), 24u);
  int shared = 0;
  for (const DecodedEdge& e : edges) {
    EXPECT_EQ(e.flags, 0u);
    if ((e.a + e.b - Vec3d(2, 2, 1)).norm() > 1e-6) continue;
    ++shared;
    const bool first = (e.n0 + e.n1 - Vec3d(1, 1, 0)).norm() < 1e-6, second = (e.n0 + e.n1 + Vec3d(1, 1, 0)).norm() < 1e-6;
    EXPECT_TRUE(first || second);
  }
  EXPECT_EQ(shared, 2);
}

TEST(SilhouetteEdges, AVertexInTheMiddleOfAFlatEdgeMakesNoBoundary) {
  VERIFIES("LASSO-MDL-014~2");
  Mesh mesh;  // a flat square whose lower half has a vertex more, joined by a triangle without area
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}};
  mesh.triangles = {{0, 1, 3}, {0, 2, 1}, {0, 4, 2}, {2, 4, 1}};
  EXPECT_EQ(edges_of(mesh).size(), 4u);
}

// Two faces that meet in an edge: as a roof, as a valley, and as one that is seen from below, too.
TEST(SilhouetteEdges, AConcaveEdgeIsThereWhereItsFacesAreSeenFromBothSides) {
  VERIFIES("LASSO-MDL-014~2");
  const auto meeting = [](double rise, bool two_sided) {
    Mesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, rise}, {0.5, -1, rise}};
    mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
    if (two_sided) {
      mesh.triangles.push_back({0, 2, 1});
      mesh.triangles.push_back({1, 3, 0});
    }
    int inner = 0;
    for (const DecodedEdge& e : edges_of(mesh)) inner += e.flags == 0 ? 1 : 0;
    return inner;
  };
  EXPECT_EQ(meeting(-1, false), 1);
  EXPECT_EQ(meeting(1, false), 0) << "whoever saw one of its faces from behind would look through the solid";
  EXPECT_EQ(meeting(1, true), 1);
  EXPECT_EQ(meeting(-1.5e-4 / 2, false), 0) << "0.15 mrad are as flat";
  EXPECT_EQ(meeting(-2.5e-4 / 2, false), 1);
}

// As many boundaries of one face along a line.
TEST(SilhouetteEdges, MoreThanTheFlightComponentHoldsAreRefused) {
  VERIFIES("LASSO-MDL-008~1");
  const auto edges_found = [](std::uint32_t count) {
    Surface surface;
    std::vector<EdgeUse> uses(count);
    for (std::uint32_t i = 0; i <= count; ++i) surface.vertices.emplace_back(1e-5 * i, 0, 0);
    for (std::uint32_t i = 0; i < count; ++i) uses[i] = {i, i + 1, 0, 0, true};
    Polygons polygons;
    polygons.of_triangle = {0};
    std::vector<Element> elements(1);
    elements[0].n = Vec3d::UnitZ();
    CompileReport report;
    try {
      make_edges(surface, uses, polygons, elements, LengthScale(4), report);
    } catch (const CompileError& error) {
      return std::string(error.what());
    }
    return std::to_string(report.edges);
  };
  EXPECT_EQ(edges_found(kMaxEdges), std::to_string(kMaxEdges));
  EXPECT_EQ(edges_found(kMaxEdges + 1).find("the model has 131073 edges; the limit is 131072"), 0U);
}

TEST(SilhouetteEdges, ClashingWindingsTurnTheSecondPlaneRound) {
  VERIFIES("LASSO-MDL-014~2");
  Mesh roof;
  roof.vertices = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, -1}, {0.5, -1, -1}};
  roof.triangles = {{0, 1, 2}, {0, 1, 3}};  // one up, one down
  for (const DecodedEdge& e : edges_of(roof)) {
    if (e.flags != 0) continue;
    EXPECT_GT(e.n0.dot(Vec3d(0, 0, 1)) * e.n1.dot(Vec3d(0, 0, 1)), 0);
    expect_in_planes(e);
  }
}

}  // namespace
}  // namespace lasso::mdat
