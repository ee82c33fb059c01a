#include "fsw/pose/scan/path_pose.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fsw/mission/mission.hpp"
#include "ut/pose/pose_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

double distance(const Pose& a, const Pose& b) { return pose_difference(a, b).norm(); }

// The step by the exponential map.
Pose exact_step(const Pose& pose, const Vec6& x) {
  const Quat step = exp_so3(x.head<3>());
  return {step * pose.q, rotate(step, pose.p) + x.tail<3>()};
}

TEST(PathPose, StepsTurnByTwiceTheArcTangentOfHalf) {
  VERIFIES("LASSO-REG-001~1");
  test::Generator random(1);
  for (int i = 0; i < 50; ++i) {
    const Pose pose = test::random_box_pose(random);
    Vec6 x = test::random_vec6(random, 1.5);
    const Pose stepped = step_pose(pose, x);
    const double length = x.head<3>().norm();
    x.head<3>() *= 2 * std::atan(length / 2) / length;
    EXPECT_LT(distance(stepped, exact_step(pose, x)), 1e-14);
    EXPECT_NEAR(stepped.q.coeffs().norm(), 1, 1e-15);
  }
}

TEST(PathPose, StepsAgreeWithTheExponentialMapToSecondOrder) {
  VERIFIES("LASSO-REG-001~1");
  test::Generator random(2);
  for (int i = 0; i < 50; ++i) {
    const Pose pose = test::random_box_pose(random);
    const Vec6 x = test::random_vec6(random, 0.1);
    const double whole = distance(step_pose(pose, x), exact_step(pose, x));
    const double half = distance(step_pose(pose, 0.5 * x), exact_step(pose, 0.5 * x));
    EXPECT_NEAR(whole / half, 8, 0.1);  // what is left is of third order
  }
}

// What the normal equations are linearised for.
TEST(PathPose, PointsMoveByTheStepToFirstOrder) {
  VERIFIES("LASSO-REG-001~1");
  test::Generator random(3);
  for (int i = 0; i < 50; ++i) {
    const Pose pose = test::random_box_pose(random);
    const Vec6 x = test::random_vec6(random, 1e-3);
    const Vec3 p = test::random_vec3(random, 1);
    const Vec3 m = pose * p;
    const Vec3 moved = m + x.head<3>().cross(m) + x.tail<3>();
    EXPECT_LT((step_pose(pose, x) * p - moved).norm(), x.head<3>().squaredNorm() * m.norm());
  }
}

TEST(PathPose, PathTransformsAsThePoseDoes) {
  VERIFIES("LASSO-REG-001~1");
  test::Generator random(4);
  for (int i = 0; i < 50; ++i) {
    const Pose pose = test::random_box_pose(random);
    const PathPose<N> path = to_path<N>(pose);
    const Vec3 v = test::random_vec3(random, 3);
    const auto in = test::path_vector<N::Length>(v);
    N::Length moved[3];
    N::Length turned[3];
    transform(path, in.data(), moved);
    rotate(path, in.data(), turned);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(static_cast<double>(moved[k]), (pose * v)[k], 2e-6);
      EXPECT_NEAR(static_cast<double>(turned[k]), rotate(pose.q, v)[k], 2e-6);
    }
  }
}

}  // namespace
}  // namespace lasso
