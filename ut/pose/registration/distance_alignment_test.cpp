#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fsw/mission/search_tables.hpp"
#include "fsw/pose/registration/registration.hpp"
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
    const Pose alignment = align_on_both(mission_, inverse(test::disturb(scan_.T_sensor_target, 0.12, 0.03, random_)), *workspace_);
    near += error_of(alignment).head<3>().norm() < 0.03 && error_of(alignment).tail<3>().norm() < 0.02 ? 1 : 0;
  }
  EXPECT_GE(near, 17);
}

TEST_F(PullTest, StaysAtTheTruthOnRays) {
  VERIFIES("LASSO-MOD-111~1");
  scan();
  const Pose alignment = align_on_rays(mission_, truth(), *workspace_);
  EXPECT_LT(error_of(alignment).head<3>().norm(), 0.01);
  EXPECT_LT(error_of(alignment).tail<3>().norm(), 0.005);
}

TEST_F(PullTest, LeavesTheStartWhereThereIsTooLittle) {
  VERIFIES("LASSO-MOD-111~1");
  scan();
  keep_first_points(11);
  EXPECT_EQ(align_on_both(mission_, truth(), *workspace_).p, truth().p);
  EXPECT_EQ(align_on_rays(mission_, truth(), *workspace_).p, truth().p);
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

// A byte of the grid is the distance at the centre of its cell, in 255ths of the truncation.
TEST_F(PullTest, AtTheCentreOfACellTheDistanceIsThatOfItsByte) {
  VERIFIES("LASSO-IMG-001~1");
  const SearchTables<FlightNumber>& tables = mission_.search;
  std::uint32_t between = 0;
  for (std::uint32_t i = 1; i + 1 < tables.cells[0]; ++i) {
    const std::uint32_t cell[3] = {i, tables.cells[1] / 2, tables.cells[2] / 2};
    float m[3];
    for (int k = 0; k < 3; ++k) m[k] = tables.origin_m[k] + (static_cast<float>(cell[k]) + 0.5F) / tables.cells_per_m;
    const std::uint32_t byte = distance_byte(tables, cell[0], cell[1], cell[2]);
    EXPECT_NEAR(surface_distance(tables, m).distance_m, static_cast<float>(byte) / 255 * tables.truncation_m, 2e-5F) << i;
    between += byte > 100 && byte < 255 ? 1 : 0;
  }
  EXPECT_GT(between, 0U);
}

// Between centres it is linear along each axis, and its gradient the difference.
TEST_F(PullTest, TheWayOffTheSurfaceIsTheGradientOfTheDistance) {
  VERIFIES("LASSO-IMG-001~1");
  const SearchTables<FlightNumber>& tables = mission_.search;
  const float step_m = 0.1F / tables.cells_per_m;
  Vec3 most = Vec3::Zero();
  for (int i = 0; i < 300; ++i) {
    float m[3];
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto cell = static_cast<float>(1 + random_.below(tables.cells[k] - 3));
      m[k] = tables.origin_m[k] + (cell + static_cast<float>(random_.uniform(0.7, 1.3))) / tables.cells_per_m;
    }
    const SurfaceDistance here = surface_distance(tables, m);
    for (int k = 0; k < 3; ++k) {
      float before[3] = {m[0], m[1], m[2]}, behind[3] = {m[0], m[1], m[2]};
      before[k] -= step_m;
      behind[k] += step_m;
      const float change_m = surface_distance(tables, behind).distance_m - surface_distance(tables, before).distance_m;
      EXPECT_NEAR(here.away[k], change_m / (2 * step_m), 1e-3) << k;
      most[k] = std::max(most[k], std::abs(static_cast<double>(here.away[k])));
    }
  }
  EXPECT_GT(most.minCoeff(), 0.5);
}

}  // namespace
}  // namespace lasso
