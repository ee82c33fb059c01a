#include "mdat/modelc/view_table.hpp"

#include <gtest/gtest.h>

#include "mdat/modelc/near_symmetry.hpp"
#include "mdat/modelc/repair.hpp"
#include "ut/mdat/modelc/meshes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

Surface surface_of(const Mesh& mesh) {
  CompileReport report;
  return repair_mesh(mesh, 0, report);
}

TEST(ViewTable, DirectionsAreSpreadOverTheSphere) {
  VERIFIES("LASSO-MOD-111~1 LASSO-MDL-019~1");
  const auto directions = spread_directions(kViewCount);
  ASSERT_EQ(directions.size(), kViewCount);
  double worst = 0;
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const Vec3d u = shapes::random_unit(random);
    double nearest = 10;
    for (const Vec3d& d : directions) nearest = std::min(nearest, std::acos(std::min(1.0, d.dot(u))));
    worst = std::max(worst, nearest);
  }
  EXPECT_LT(worst, 0.105);  // 6 deg
}

TEST(ViewTable, ASpheresCentroidLiesTowardsTheEye) {
  VERIFIES("LASSO-MOD-111~1 LASSO-MDL-019~1");
  const Vec3d shift(0.11, -0.07, 0.05);
  Mesh mesh = shapes::sphere(0.4, 60, 90);
  shapes::move(mesh, shapes::generic_turn(), shift);
  for (const View& view : make_views(surface_of(mesh))) {
    // Of a hemisphere's points, weighted by their area across the line of sight: 2/3 of the radius before the middle.
    EXPECT_LT((view.centroid - shift - 2.0 / 3 * 0.4 * view.direction).norm(), 0.01);
    const double near = (view.near_centroid - shift).dot(view.direction);
    EXPECT_GT(near, 0.27);  // the eye sees less of the rim
    EXPECT_LT(near, 0.33);
  }
}

TEST(NearSymmetry, ABoxHasThreeHalfTurns) {
  VERIFIES("LASSO-MOD-121~1");
  Mesh mesh = shapes::box({-0.3, -0.2, -0.1}, {0.3, 0.2, 0.1});
  const Eigen::Quaterniond turn = shapes::generic_turn();
  const Vec3d shift(0.11, -0.07, 0.05);
  shapes::move(mesh, turn, shift);
  const Surface surface = surface_of(mesh);
  CompileReport report;
  const auto uses = edge_uses(surface);
  const LengthScale scale(2);
  const ElementSet elements = make_elements(make_polygons(surface, uses, smooth_normals(surface, 0.5)).list, scale, surface.extent, report);
  const NearestSearch nearest(elements.list);
  const SearchGrid grid = make_search_grid(surface, nearest, scale);
  const auto motions = find_near_symmetries(make_views(surface), grid, nearest);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Quaterniond half = turn * Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, Vec3d::Unit(axis))) * turn.conjugate();
    bool found = false;
    for (const NearSymmetryMotion& motion : motions) {
      found = found || (motion.q.angularDistance(half) < 0.01 && (motion.q * shift + motion.p - shift).norm() < 0.005);
    }
    EXPECT_TRUE(found) << axis;
  }
}

TEST(SearchGrid, DistancesAreThoseToTheSurface) {
  VERIFIES("LASSO-IMG-001~1");
  const Surface surface = surface_of(shapes::box({-0.3, -0.2, -0.1}, {0.3, 0.2, 0.1}));
  CompileReport report;
  const LengthScale scale(2);
  const ElementSet elements =
      make_elements(make_polygons(surface, edge_uses(surface), smooth_normals(surface, 0.5)).list, scale, surface.extent, report);
  const NearestSearch nearest(elements.list);
  const SearchGrid grid = make_search_grid(surface, nearest, scale);
  for (std::size_t i = 0; i < grid.distances.size(); i += 7) {
    const Vec3d p = grid.center(i);
    const double share = std::min(nearest.closest(p).distance_m / 0.06, 1.0);
    EXPECT_NEAR(grid.distance_m(p), 0.06 * share, 0.06 / 255);
  }
  EXPECT_DOUBLE_EQ(grid.distance_m(Vec3d(9, 0, 0)), grid.truncation_m);
  const auto words = distance_words(grid);
  EXPECT_EQ(words.size() * 4, grid.distances.size());
  EXPECT_EQ(words[5] >> 24, grid.distances[20]);
  EXPECT_EQ(words[5] & 255, grid.distances[23]);
}

}  // namespace
}  // namespace lasso::mdat
