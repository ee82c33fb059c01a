#include "mdat/trial/pair_trial.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fsw/geometry/so3.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(PairTrial, ViewsAreSpreadOverTheScenario) {
  VERIFIES("LASSO-STE-014~1");
  std::vector<double> times_s = view_times_s(8, 60);
  EXPECT_EQ(times_s[0], 0);
  std::sort(times_s.begin(), times_s.end());
  EXPECT_LT(times_s.back(), 60);
  for (std::size_t i = 1; i < times_s.size(); ++i) {
    EXPECT_GT(times_s[i] - times_s[i - 1], 60.0 / 8 / 3);
    EXPECT_LT(times_s[i] - times_s[i - 1], 3 * 60.0 / 8);
  }
}

// A diagonal covariance: each axis is off by a known number of its sigmas.
TEST(PairTrial, APoseIsJudgedByItsCovariance) {
  VERIFIES("LASSO-STE-014~1");
  const Pose truth{exp_so3(Vec3(0.3, -0.5, 0.2)), Vec3(0.1, 0.2, 3)};
  Registration registration;
  registration.reason = PoseReason::kValid;
  registration.returns = 77;
  const Vec3 turn(0.001, -0.002, 0.002), shift(0.002, 0.003, -0.006);
  registration.T_sensor_target = {normalized(exp_so3(turn) * truth.q), truth.p + shift};
  for (int axis = 0; axis < 3; ++axis) {
    registration.covariance(axis, axis) = 1e-6;
    registration.covariance(axis + 3, axis + 3) = 4e-6;
  }
  TrialPose pose = trial_pose(registration, truth);
  EXPECT_TRUE(pose.valid());
  EXPECT_FALSE(pose.wrong);
  EXPECT_EQ(pose.returns, 77);
  EXPECT_NEAR(pose.off_m, 0.007, 1e-12);
  EXPECT_NEAR(pose.off_rad, 0.003, 1e-12);
  EXPECT_NEAR(pose.squared_attitude, 9.0 / 3, 1e-6);
  EXPECT_NEAR(pose.squared_position, 49.0 / 4 / 3, 1e-6);
  EXPECT_NEAR(pose.nees, 9 + 49.0 / 4, 1e-4);
  EXPECT_NEAR(pose.sigma_m, std::sqrt(12e-6), 1e-12);
  registration.T_sensor_target.p.x() += 0.05;
  EXPECT_TRUE(trial_pose(registration, truth).wrong) << "25 sigmas, 52 mm";
  registration.reason = PoseReason::kModelMismatch;
  pose = trial_pose(registration, truth);
  EXPECT_FALSE(pose.valid() || pose.wrong) << "it does not say that it can be trusted";
}

}  // namespace
}  // namespace lasso::mdat
