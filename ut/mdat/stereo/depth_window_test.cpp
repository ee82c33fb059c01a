#include "mdat/stereo/depth_window.hpp"

#include <gtest/gtest.h>

#include "ut/mdat/render/shapes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// Off its origin, so that its reach depends on the attitude.
Mesh ball_beside() {
  Mesh mesh = ball(0.5, 4);
  for (Vec3& vertex : mesh.vertices) vertex += Vec3(0.3, -0.2, 0.4);
  return mesh;
}

TEST(DepthWindow, HoldsTheTargetAtItsRangesInAnyAttitude) {
  VERIFIES("LASSO-STE-004~1 LASSO-STE-013~1");
  const Mesh target = ball_beside();
  const MatchDepths depths = depths_at(target, Vec3(0.3, 0, 0), {6, 4, 9}, 0.2);
  const double reach_m = 0.5 + Vec3(0, -0.2, 0.4).norm();
  EXPECT_NEAR(depths.nearest_m, 0.9 * (4 - reach_m), 0.01);
  EXPECT_NEAR(depths.farthest_m, 1.1 * (9 + reach_m), 0.01);
  for (const double turn_rad : {0.3, 1.1, 2.9}) {
    const Quat q = exp_so3(turn_rad * Vec3(1, -2, 0.5).normalized());
    for (const Vec3& vertex : target.vertices) {
      for (const double range_m : {4.0, 9.0}) {
        const double depth_m = (rotate(q, Vec3(vertex - Vec3(0.3, 0, 0))) + range_m * Vec3(0.1, -0.2, 1).normalized()).z();
        EXPECT_GT(depth_m, depths.nearest_m);
        EXPECT_LT(depth_m, depths.farthest_m);
      }
    }
  }
}

TEST(DepthWindow, NeverBeginsAtTheCamera) {
  VERIFIES("LASSO-STE-004~1");
  const MatchDepths depths = depths_at(ball(0.5, 4), Vec3::Zero(), {0.2}, 0.2);
  EXPECT_NEAR(depths.nearest_m, 0.6, 1e-12);
  EXPECT_GT(depths.farthest_m, depths.nearest_m);
}

TEST(DepthWindow, IsThatOfTheMissionsRangesWhereverTheTargetIs) {
  VERIFIES("LASSO-STE-013~1");
  const Mesh target = ball_beside();
  CaseSetup setup;
  setup.range_m = 3;
  setup.scenario.ranges_m = {2, 3, 7};
  const MatchDepths one = depths_at(target, Vec3::Zero(), {3}, 0.3), all = depths_at(target, Vec3::Zero(), {2, 7}, 0.3);
  EXPECT_EQ(stated_depths(target, setup, 0.3).nearest_m, one.nearest_m);
  EXPECT_EQ(stated_depths(target, setup, 0.3).farthest_m, one.farthest_m);
  setup.scenario.times_s = {0, 10, 20};
  EXPECT_EQ(stated_depths(target, setup, 0.3).nearest_m, all.nearest_m);
  EXPECT_EQ(stated_depths(target, setup, 0.3).farthest_m, all.farthest_m);
}

}  // namespace
}  // namespace lasso::mdat
