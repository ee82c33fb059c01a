#include <gtest/gtest.h>

#include <cmath>

#include "fsw/pose/register.hpp"
#include "ut/pose/search_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

class PullTest : public test::SearchFixture {};

TEST_F(PullTest, DrawsAHypothesisToTheModel) {
  VERIFIES("LASSO-MOD-111~1");
  int near = 0;
  for (int i = 0; i < 20; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    const Pose pulled = pull_in(mission_, inverse(test::disturb(scan_.T_sensor_target, 0.12, 0.03, random_)), *workspace_);
    near += error_of(pulled).head<3>().norm() < 0.03 && error_of(pulled).tail<3>().norm() < 0.02 ? 1 : 0;
  }
  EXPECT_GE(near, 17);
}

TEST_F(PullTest, StaysAtTheTruthOnRays) {
  VERIFIES("LASSO-MOD-111~1");
  scan();
  const Pose pulled = pull_on_rays(mission_, truth(), *workspace_);
  EXPECT_LT(error_of(pulled).head<3>().norm(), 0.01);
  EXPECT_LT(error_of(pulled).tail<3>().norm(), 0.005);
}

TEST_F(PullTest, LeavesTheStartWhereThereIsTooLittle) {
  VERIFIES("LASSO-MOD-111~1");
  scan();
  keep_first_points(11);
  EXPECT_EQ(pull_in(mission_, truth(), *workspace_).p, truth().p);
  EXPECT_EQ(pull_on_rays(mission_, truth(), *workspace_).p, truth().p);
}

TEST_F(PullTest, DistancesAreThoseToTheBoxes) {
  VERIFIES("LASSO-IMG-001~1");
  const SearchTables<FlightNumber>& tables = mission_.search;
  const double cell = 1 / static_cast<double>(tables.cells_per_m);
  const float above[3] = {0.02F, -0.01F, static_cast<float>(-0.09 - 1.3 * cell)};  // below the main box
  const SurfaceDistance d = surface_distance(tables, above);
  EXPECT_NEAR(d.distance_m, 1.3 * cell, 0.1 * cell);
  EXPECT_NEAR(d.away[2], -1, 0.05);
  EXPECT_NEAR(d.away[0], 0, 0.05);
  for (const float x : {-90.0F, 90.0F}) {
    const float outside[3] = {x, 0, 0};
    EXPECT_FLOAT_EQ(surface_distance(tables, outside).distance_m, tables.truncation_m);
  }
}

}  // namespace
}  // namespace lasso
