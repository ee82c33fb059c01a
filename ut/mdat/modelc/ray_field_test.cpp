#include "mdat/modelc/ray_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "cfg/capacities.hpp"
#include "mdat/modelc/repair.hpp"
#include "ut/mdat/modelc/meshes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

std::vector<Element> elements_of(const Mesh& mesh) {
  CompileReport report;
  const Surface surface = repair_mesh(mesh, 0, report);
  const Polygons polygons = make_polygons(surface, edge_uses(surface), smooth_normals(surface, 0.5));
  return make_elements(polygons.list, LengthScale(4), surface.extent, report).list;
}

// Area left of the outline when clipped by the cube's six half-spaces, one after the other.
bool clipped_meets(const Element& e, const Vec3d& center, double half) {
  std::vector<Vec3d> polygon(e.outline.begin(), e.outline.begin() + e.sides);
  for (int i = 0; i < 6 && !polygon.empty(); ++i) {
    const Vec3d n = (i % 2 == 0 ? 1 : -1) * Vec3d::Unit(i / 2);
    std::vector<Vec3d> kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec3d& a = polygon[k];
      const Vec3d& b = polygon[(k + 1) % polygon.size()];
      const double x = n.dot(a - center) + half, y = n.dot(b - center) + half;
      if (x >= 0) kept.push_back(a);
      if ((x >= 0) != (y >= 0)) kept.push_back(a + x / (x - y) * (b - a));
    }
    polygon = kept;
  }
  return !polygon.empty();
}

TEST(RayField, TheBoxTestAgreesWithClipping) {
  VERIFIES("LASSO-MDL-001~1");
  Mesh mesh = shapes::soup(60, 1, 21);
  shapes::append(mesh, shapes::box({-0.4, -0.3, -0.2}, {0.1, 0.2, 0.3}));
  Random random(22);
  int meeting = 0, apart = 0;
  for (const Element& e : elements_of(mesh)) {
    const PolygonBoxTest test(e);
    for (int i = 0; i < 400; ++i) {
      const Vec3d center = e.corners[0] + 0.2 * shapes::random_vector(random);
      const double half = 0.1 * random.uniform();
      const bool truth = clipped_meets(e, center, half);
      (truth ? meeting : apart) += 1;
      // A disagreement must be one of rounding only.
      if (truth != test.meets(center, half)) {
        EXPECT_NE(clipped_meets(e, center, half + 1e-9), clipped_meets(e, center, half - 1e-9));
      }
    }
  }
  EXPECT_GT(meeting, 2000);
  EXPECT_GT(apart, 2000);
}

TEST(RayField, ListsAreExactlyTheElementsThatCrossTheWidenedCells) {
  VERIFIES("LASSO-MDL-001~1");
  const std::vector<Element> elements = elements_of(shapes::soup(40, 1, 23));
  Grid grid;
  grid.origin = Vec3d::Constant(-0.9);
  grid.cell_m = 0.03;
  grid.bricks = {8, 8, 8};
  CompileReport report;
  const RayField field = make_ray_field(elements, grid, report);
  Random random(24);
  int occupied = 0;
  for (int k = 0; k < 4000; ++k) {
    const Vec3d near_element = elements[static_cast<std::size_t>(k) % elements.size()].corners[0] + 0.1 * shapes::random_vector(random);
    const Vec3d anywhere = grid.origin + 0.96 * (shapes::random_vector(random) + Vec3d::Ones());
    const Vec3d at = ((k % 2 == 0 ? near_element : anywhere) - grid.origin) / grid.cell_m;
    const std::uint32_t x = static_cast<std::uint32_t>(at.x()), y = static_cast<std::uint32_t>(at.y()),
                        z = static_cast<std::uint32_t>(at.z());
    const Vec3d center = grid.origin + grid.cell_m * Vec3d(x + 0.5, y + 0.5, z + 0.5);
    std::vector<std::uint32_t> truth;
    for (std::uint32_t i = 0; i < elements.size(); ++i) {
      if (clipped_meets(elements[i], center, (1 + kCellTolerance) * grid.cell_m)) truth.push_back(i);
    }
    const std::uint32_t record = field.brick_words[grid.brick_index(x / 8, y / 8, z / 8)];
    const std::uint32_t word = (record & kEmptyBit) != 0 ? record : field.cells[512 * record + ((z & 7) << 6 | (y & 7) << 3 | (x & 7))];
    ASSERT_EQ((word & kEmptyBit) != 0, truth.empty());
    if (truth.empty()) continue;
    const auto first = field.lists.begin() + static_cast<std::ptrdiff_t>(word & kListOffsetMask);
    std::vector<std::uint32_t> list(first, first + static_cast<std::ptrdiff_t>(word >> kListOffsetBits));
    for (std::uint32_t& entry : list) entry &= ~kFinalEntry;
    std::sort(list.begin(), list.end());
    EXPECT_EQ(list, truth);
    ++occupied;
  }
  EXPECT_GT(occupied, 400);
}

TEST(RayField, EqualListsAreStoredOnceAndCounted) {
  VERIFIES("LASSO-MDL-001~1");
  const std::vector<Element> elements = elements_of(shapes::sheet(1, 1));
  Grid grid;
  grid.origin = Vec3d::Constant(-0.31);
  grid.cell_m = 0.05;
  grid.bricks = {4, 4, 2};
  CompileReport report;
  const RayField field = make_ray_field(elements, grid, report);
  EXPECT_EQ(field.lists, std::vector<std::uint32_t>{kFinalEntry});
  EXPECT_EQ(report.distinct_lists, 1u);
  EXPECT_EQ(report.ray_lists.mean, 1);
  EXPECT_EQ(report.ray_lists.max, 1u);
}

TEST(RayField, ATooLongListNamesItsPlace) {
  VERIFIES("LASSO-MDL-008~1");
  std::vector<Element> elements = elements_of(shapes::soup(kMaxElementsPerCell + 1, 0.01, 25));
  Grid grid;
  grid.origin = Vec3d::Constant(-1);
  grid.cell_m = 0.125;
  grid.bricks = {2, 2, 2};
  CompileReport report;
  try {
    make_ray_field(elements, grid, report);
    FAIL();
  } catch (const CompileError& error) {
    EXPECT_NE(std::string(error.what()).find("lists 501 elements; the limit is 500"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("the cell at ("), std::string::npos) << error.what();
  }
  elements.pop_back();
  EXPECT_NO_THROW(make_ray_field(elements, grid, report));
}

}  // namespace
}  // namespace lasso::mdat
