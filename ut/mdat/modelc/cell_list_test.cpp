#include "mdat/modelc/cell_list.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "mdat/modelc/repair.hpp"
#include "ut/mdat/modelc/meshes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

constexpr double kTolerance = 1e-6;

std::vector<Element> elements_of(const Mesh& mesh) {
  CompileReport report;
  const Surface surface = repair_mesh(mesh, 0, report);
  const Polygons polygons = make_polygons(surface, edge_uses(surface), smooth_normals(surface, 0.5));
  return make_elements(polygons.list, LengthScale(4), surface.extent, report).list;
}

std::vector<std::uint32_t> all_of(const std::vector<Element>& elements) {
  std::vector<std::uint32_t> indices(elements.size());
  std::iota(indices.begin(), indices.end(), 0u);
  return indices;
}

// Where the ray from + t u meets the element's front within the cube; infinity: nowhere.
double meeting(const Element& e, const SampleCube& cube, const Vec3d& from, const Vec3d& u) {
  const double nowhere = std::numeric_limits<double>::infinity();
  const double tilt = e.n.dot(u);
  if (tilt == 0 || (tilt > 0 && !e.two_sided)) return nowhere;
  const double t = (e.d - e.n.dot(from)) / tilt;
  const Vec3d p = from + t * u;
  if ((p - cube.center).cwiseAbs().maxCoeff() > cube.half_m) return nowhere;
  for (std::size_t i = 0; i < static_cast<std::size_t>(e.sides); ++i) {
    if (e.m[i].dot(p) < e.c[i]) return nowhere;
  }
  return t;
}

struct Counts {
  int final_hits = 0, other_hits = 0;
};

// Rays through the cube: before a hit on a final entry no other element was met, by more than the tolerance across a plane.
Counts expect_final_entries_are_first(const std::vector<Element>& elements, const SampleCube& cube, Random& random) {
  Counts counts;
  const auto entries = make_cell_list(elements, all_of(elements), cube, kTolerance);
  for (int k = 0; k < 300; ++k) {
    const Element& aim = elements[static_cast<std::size_t>(k) % elements.size()];
    const Vec3d through = (aim.corners[0] + aim.corners[1] + aim.corners[2]) / 3;
    const Vec3d u = shapes::random_vector(random).normalized();
    double first = std::numeric_limits<double>::infinity();
    for (const Element& e : elements) first = std::min(first, meeting(e, cube, through, u));
    for (const std::uint32_t entry : entries) {
      const Element& e = elements[entry & ~kFinalEntry];
      const double t = meeting(e, cube, through, u);
      if (std::isinf(t)) continue;
      ((entry & kFinalEntry) != 0 ? counts.final_hits : counts.other_hits) += 1;
      if ((entry & kFinalEntry) == 0) continue;
      EXPECT_LE((t - first) * std::abs(e.n.dot(u)), 3 * kTolerance);
    }
  }
  return counts;
}

TEST(CellList, NothingIsMetBeforeAFinalEntry) {
  VERIFIES("LASSO-MDL-021~2");
  Random random(31);
  Counts all;
  for (int k = 0; k < 150; ++k) {
    const std::vector<Element> elements = elements_of(shapes::soup(25, 1, 100 + static_cast<std::uint64_t>(k)));
    const Counts counts = expect_final_entries_are_first(elements, {elements[0].corners[0], 0.6}, random);
    all.final_hits += counts.final_hits;
    all.other_hits += counts.other_hits;
  }
  EXPECT_GT(all.final_hits, 500);
  EXPECT_GT(all.other_hits, 500);
}

TEST(CellList, EveryEntryOfAConvexBodyIsFinal) {
  VERIFIES("LASSO-MDL-021~2");
  Mesh mesh = shapes::sphere(0.5, 9, 14);
  shapes::move(mesh, shapes::generic_turn(), {0.1, -0.2, 0.3});
  const std::vector<Element> elements = elements_of(mesh);
  for (const std::uint32_t entry : make_cell_list(elements, all_of(elements), {{0.1, -0.2, 0.3}, 1}, kTolerance)) {
    EXPECT_NE(entry & kFinalEntry, 0u) << entry;
  }
}

TEST(CellList, OfTwoPlatesThatFaceOneWayTheFrontOneIsFinal) {
  VERIFIES("LASSO-MDL-021~2");
  Mesh mesh;
  for (const double z : {0.0, 0.3}) {
    for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) mesh.vertices.emplace_back(x, y, z);
  }
  shapes::add_quad(mesh, 0, 1, 2, 3);
  shapes::add_quad(mesh, 4, 5, 6, 7);
  std::vector<Element> elements = elements_of(mesh);
  ASSERT_EQ(elements.size(), 2u);
  for (Element& e : elements) e.two_sided = false;
  const double ahead = elements[0].n.dot(elements[0].corners[0] - elements[1].corners[0]);
  const std::uint32_t front = ahead > 0 ? 0 : 1;
  const auto is_final = [&](std::uint32_t element) {
    for (const std::uint32_t entry : make_cell_list(elements, {0, 1}, {Vec3d::Zero(), 0.5}, kTolerance)) {
      if ((entry & ~kFinalEntry) == element) return (entry & kFinalEntry) != 0;
    }
    ADD_FAILURE() << "element " << element << " is not in the list";
    return false;
  };
  EXPECT_TRUE(is_final(front));
  EXPECT_FALSE(is_final(1 - front));
  // Seen from both sides, either can come first; and so where the cube holds one of them alone.
  for (Element& e : elements) e.two_sided = true;
  EXPECT_FALSE(is_final(front));
  const auto alone = make_cell_list(elements, {1 - front}, {Vec3d::Zero(), 0.5}, kTolerance);
  EXPECT_EQ(alone, std::vector<std::uint32_t>{(1 - front) | kFinalEntry});
}

TEST(CellList, TheElementWithTheLargestPartInTheCubeComesFirst) {
  VERIFIES("LASSO-MDL-021~2");
  const std::vector<Element> elements = elements_of(shapes::box({-1, -1, -1}, {1, 1, 1}));
  ASSERT_EQ(elements.size(), 6u);
  // Around a point of the edge x = y = 1, nearer to the face x = 1.
  const auto entries = make_cell_list(elements, all_of(elements), {{1, 0.8, 0}, 0.4}, kTolerance);
  EXPECT_EQ(elements[entries[0] & ~kFinalEntry].n, Vec3d(1, 0, 0));
  EXPECT_EQ(elements[entries[1] & ~kFinalEntry].n, Vec3d(0, 1, 0));
}

}  // namespace
}  // namespace lasso::mdat
