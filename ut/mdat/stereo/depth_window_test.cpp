#include "mdat/stereo/depth_window.hpp"

#include <gtest/gtest.h>

#include "ut/mdat/render/shapes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(DepthWindow, HoldsTheTargetAndATenthMore) {
  VERIFIES("LASSO-STE-004~1");
  const MatchDepths depths = predicted_depths(ball(0.5, 4), {generic_attitude(), Vec3(0.3, -0.2, 6)}, 0.2);
  EXPECT_NEAR(depths.nearest_m, 0.9 * 5.5, 0.01);
  EXPECT_NEAR(depths.farthest_m, std::max(2 * 0.9 * 5.5, 1.1 * 6.5), 0.01);
}

TEST(DepthWindow, NeverBeginsAtTheCamera) {
  VERIFIES("LASSO-STE-004~1");
  for (const double z_m : {0.2, -5.0}) {
    const MatchDepths depths = predicted_depths(ball(0.5, 4), {generic_attitude(), Vec3(0, 0, z_m)}, 0.2);
    EXPECT_NEAR(depths.nearest_m, 0.6, 1e-12);
    EXPECT_GT(depths.farthest_m, depths.nearest_m);
  }
}

}  // namespace
}  // namespace lasso::mdat
