// Passes with an axis held, and the bounded cost: what the profile of a cost is made of.
#include <gtest/gtest.h>

#include "fsw/pose/registration/gauss_newton.hpp"
#include "fsw/pose/registration/observability.hpp"
#include "ut/pose/brute_pass.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

class HeldPassTest : public test::BrutePassFixture {};

// Tukey's rho with a kernel of sqrt(12) sigmas, point by point in double.
TEST_F(HeldPassTest, TheBoundedCostIsThatOfABruteForcePass) {
  VERIFIES("LASSO-REG-031~2");
  for (int i = 0; i < 8; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    parameters().incidence_max_rad = i % 2 == 0 ? 0.9 : 1.5;
    scan();
    const Pose pose = inverse(test::disturb(scan_.T_sensor_target, 0.001, 0.001, random_));
    keep_clear_points(pose);
    const double bounded = brute_bounded(pose);
    ASSERT_GT(bounded, 0);
    ASSERT_LT(bounded, kMostOfAReturn);
    EXPECT_NEAR(bounded_cost(mission_, pose, 20, Lookup::kWalk, *workspace_), 20 * bounded, 0.01);
    const Pose near = inverse(test::disturb(inverse(pose), 1e-5, 1e-5, random_));
    const double asked_last = bounded_cost(mission_, near, 20, Lookup::kLast, *workspace_);
    EXPECT_NEAR(asked_last, bounded_cost(mission_, near, 20, Lookup::kWalk, *workspace_), 1e-9) << "the surfaces met at the pose beside it";
  }
}

TEST_F(HeldPassTest, WithoutAReturnTheBoundedCostIsMoreThanAny) {
  VERIFIES("LASSO-REG-031~2");
  scan();
  Pose behind = truth();
  behind.p *= -20;
  EXPECT_EQ(bounded_cost(mission_, behind, 7, Lookup::kWalk, *workspace_), 7 * kMostOfAReturn) << "all are left out";
  const auto count = static_cast<double>(workspace_->points.size());
  EXPECT_EQ(bounded_cost(mission_, behind, 2 * count, Lookup::kWalk, *workspace_), 2 * count * kMostOfAReturn);
  EXPECT_GT(bounded_cost(mission_, behind, 2.01 * count, Lookup::kWalk, *workspace_), 1e200)
      << "fewer than half of those of the registration";
  for (auto& point : workspace_->points) point.aimed = true;
  EXPECT_GT(bounded_cost(mission_, behind, 7, Lookup::kWalk, *workspace_), 1e200) << "those at a contour may well be";
  workspace_->points.clear();
  EXPECT_GT(bounded_cost(mission_, truth(), 7, Lookup::kWalk, *workspace_), 1e200);
}

// Against the least squares over the five directions that are left, in double, of brute-force sums.
TEST_F(HeldPassTest, AHeldAxisStaysAndTheOthersAreSolved) {
  VERIFIES("LASSO-REG-031~2");
  scan();
  const Pose start = inverse(test::disturb(scan_.T_sensor_target, 0.004, 0.003, random_));
  keep_clear_points(start);
  const test::BruteSums sums = brute(start, 0, 1);
  for (const double radius_m : {mission_.radius_m, mission_.radius_m, 6.0, 30.0}) {
    mission_.radius_m = radius_m;
    parameters().gate_first_m = radius_m;  // no step is cut
    const Vec6 axis = test::random_vec6(random_, 1).normalized();
    const Vec6 row = axis.cwiseProduct(radius_scale(radius_m));
    const Eigen::Matrix<double, 6, 5> free = Eigen::FullPivLU<Eigen::Matrix<double, 1, 6>>(row.transpose()).kernel();
    const Vec6 x = free * (free.transpose() * sums.H * free).ldlt().solve(free.transpose() * sums.b);
    Pose pose = start;
    take_held_pass(mission_, axis, Lookup::kWalk, *workspace_, pose);
    const Pose expected = step_pose(start, x);
    EXPECT_LT(pose_difference(pose, expected).norm(), 5e-3 * x.norm()) << radius_m;
  }
  parameters().gate_first_m = 1e-3;
  Pose cut = start;
  take_held_pass(mission_, Vec6::Unit(0), Lookup::kWalk, *workspace_, cut);
  EXPECT_NEAR(length_of(pose_difference(cut, start), mission_.radius_m), longest_step_m(parameters(), settings()), 1e-4);
  keep_first_points(kMinimumPoints - 1);
  Pose pose = start;
  take_held_pass(mission_, Vec6::Unit(0), Lookup::kWalk, *workspace_, pose);
  EXPECT_EQ(pose.p, start.p);
}

}  // namespace
}  // namespace lasso
