#include "mdat/modelc/near_field.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "mdat/modelc/repair.hpp"
#include "ut/mdat/modelc/meshes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

constexpr double kNowhere = std::numeric_limits<double>::infinity();

std::vector<Element> field_elements(const Mesh& mesh) {
  CompileReport report;
  const Surface surface = repair_mesh(mesh, 0, report);
  const Polygons polygons = make_polygons(surface, edge_uses(surface), smooth_normals(surface, 0.5));
  return make_elements(polygons.list, LengthScale(2), surface.extent, report).list;
}

double brute_force(const std::vector<Element>& elements, const Vec3d& p, const Vec3d* against) {
  double best = kNowhere;
  for (const Element& e : elements) {
    if (against == nullptr || e.n.dot(*against) < -1e-6) best = std::min(best, (closest_point(e, p) - p).norm());
  }
  return best;
}

TEST(NearField, SearchMatchesBruteForceNearAndFar) {
  VERIFIES("LASSO-MDL-003~1");
  for (const auto& [name, mesh] : shapes::property_meshes()) {
    SCOPED_TRACE(name);
    const std::vector<Element> elements = field_elements(mesh);
    const NearestSearch search(elements);
    Random random(41);
    for (int i = 0; i < 1500; ++i) {
      const Vec3d p = (i % 3 == 0 ? 5 : 0.5) * shapes::random_vector(random);
      const NearestElement found = search.closest(p);
      ASSERT_NE(found.element, kNone);
      EXPECT_NEAR(found.distance_m, brute_force(elements, p, nullptr), 2e-9);
      EXPECT_NEAR((found.point - p).norm(), found.distance_m, 1e-12);
      const Vec3d& n = elements[found.element].n;
      const double truth = brute_force(elements, p, &n);
      const NearestElement other = search.closest_opposing(p, n, 0.1);
      if (truth > 0.1) {
        EXPECT_EQ(other.element, kNone);
      } else {
        ASSERT_NE(other.element, kNone);
        EXPECT_LT(elements[other.element].n.dot(n), 0);
        EXPECT_NEAR(other.distance_m, truth, 2e-9);
      }
    }
  }
}

TEST(NearField, AtAnEdgeTheFaceThatLooksAtThePointIsTaken) {
  VERIFIES("LASSO-MDL-003~1");
  const std::vector<Element> elements = field_elements(shapes::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}));
  const NearestSearch search(elements);
  // Closest to the edge x = y = 0.5, but much more in front of the face x = 0.5.
  const NearestElement found = search.closest({0.9, 0.51, 0.1});
  EXPECT_NEAR(elements[found.element].n.x(), 1, 1e-9);
}

TEST(NearField, CellsHoldTheClosestElementsOfTheirCentres) {
  VERIFIES("LASSO-MDL-003~1");
  for (const auto& [name, mesh] : shapes::property_meshes()) {
    SCOPED_TRACE(name);
    const std::vector<Element> elements = field_elements(mesh);
    Grid grid;
    grid.origin = Vec3d(-0.7, -0.8, -0.75);
    grid.cell_m = 0.02;
    grid.bricks = {10, 10, 10};
    constexpr double kBand = 0.06;
    CompileReport report;
    const NearField field = make_near_field(elements, grid, LengthScale(2), kBand, report);
    std::size_t near = 0;
    for (std::uint32_t b = 0; b < grid.brick_count(); ++b) {
      if (field.brick_words[b] == 0) continue;
      EXPECT_EQ(field.brick_words[b], ++near);  // records in the order of the bricks
      for (std::uint32_t k = b % 7; k < 64; k += 7) {
        const Vec3d center = grid.brick_corner(b) + 0.04 * Vec3d((k & 3) + 0.5, (k >> 2 & 3) + 0.5, (k >> 4) + 0.5);
        const std::uint32_t* words = &field.cells[kNearWordsPerBrick * (near - 1) + 2 * k];
        const Element& first = elements.at(words[0] - 1);
        EXPECT_NEAR((closest_point(first, center) - center).norm(), brute_force(elements, center, nullptr), 2e-9);
        const double opposing = brute_force(elements, center, &first.n);
        ASSERT_EQ(words[1] != 0, opposing <= kBand);
        if (words[1] != 0) {
          EXPECT_NEAR((closest_point(elements[words[1] - 1], center) - center).norm(), opposing, 2e-9);
        }
      }
    }
    EXPECT_EQ(near, report.near_bricks);
    EXPECT_GT(near, 20u);
  }
}

}  // namespace
}  // namespace lasso::mdat
