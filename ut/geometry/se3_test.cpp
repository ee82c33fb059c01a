#include "fsw/geometry/se3.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "ut/geometry/random_inputs.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using Mat4 = Eigen::Matrix<double, 4, 4>;

Pose random_pose(test::Generator& generator) {
  Pose pose;
  pose.q = test::random_rotation(generator);
  pose.p = test::random_vector(generator, 10);
  return pose;
}

// Homogeneous matrices: another representation with the same algebra.
Mat4 matrix(const Pose& pose) {
  Mat4 M = Mat4::Identity();
  M.topLeftCorner<3, 3>() = to_matrix(pose.q);
  M.topRightCorner<3, 1>() = pose.p;
  return M;
}

double distance(const Mat4& A, const Mat4& B) { return (A - B).cwiseAbs().maxCoeff(); }

TEST(Pose, ComposesAsMatricesDo) {
  VERIFIES("LASSO-GEO-013~1");
  test::Generator generator(61);
  for (int i = 0; i < 10000; ++i) {
    const Pose T_a_b = random_pose(generator);
    const Pose T_b_c = random_pose(generator);
    const Vec3 v = test::random_vector(generator, 5);
    ASSERT_LE(distance(matrix(T_a_b * T_b_c), matrix(T_a_b) * matrix(T_b_c)), 1e-13);
    ASSERT_LE(((T_a_b * T_b_c) * v - T_a_b * (T_b_c * v)).norm(), 1e-13);
  }
}

TEST(Pose, InverseUndoes) {
  VERIFIES("LASSO-GEO-013~1");
  test::Generator generator(62);
  for (int i = 0; i < 10000; ++i) {
    const Pose T = random_pose(generator);
    ASSERT_LE(distance(matrix(inverse(T)) * matrix(T), Mat4::Identity()), 1e-13);
    ASSERT_LE(distance(matrix(T * inverse(T)), Mat4::Identity()), 1e-13);
  }
}

// Many small steps of the differential equation, q' = omega x q in sensor axes, p' = v.
TEST(Propagate, SolvesTheEquationOfMotion) {
  VERIFIES("LASSO-GEO-014~2");
  test::Generator generator(63);
  for (int i = 0; i < 20; ++i) {
    const Pose start = random_pose(generator);
    const Twist rates{test::random_vector(generator, 1), test::random_vector(generator, 1)};
    Mat3 R = to_matrix(start.q);
    constexpr int kSteps = 500;
    const double dt_s = i % 2 == 0 ? 1 : -1;
    const Mat3 W = skew(rates.omega_radps) * (dt_s / kSteps);
    for (int k = 0; k < kSteps; ++k) R = R + W * (R + W * (R / 2 + W * (R / 6 + W * R / 24)));  // fourth order
    const Pose end = propagate(start, rates, dt_s);
    ASSERT_LE((to_matrix(end.q) - R).cwiseAbs().maxCoeff(), 1e-11);
    ASSERT_LE((end.p - (start.p + dt_s * rates.v_mps)).norm(), 1e-14);
  }
}

TEST(Propagate, StepsAddUpAndRunBackwards) {
  VERIFIES("LASSO-GEO-014~2");
  test::Generator generator(64);
  for (int i = 0; i < 1000; ++i) {
    const Pose start = random_pose(generator);
    const Twist rates{test::random_vector(generator, 2), test::random_vector(generator, 2)};
    const Pose once = propagate(start, rates, 0.5);
    const Pose twice = propagate(propagate(start, rates, 0.2), rates, 0.3);
    ASSERT_LE(pose_difference(once, twice).norm(), 1e-14);
    ASSERT_LE(pose_difference(propagate(once, rates, -0.5), start).norm(), 1e-14);
  }
}

TEST(Propagate, UnitLengthLastsAMillionFrames) {
  VERIFIES("LASSO-GEO-021~1");
  Pose pose;
  const Twist rates{Vec3(0.03, -0.02, 0.05), Vec3::Zero()};
  double shortest = 1, longest = 1;
  for (int i = 0; i < 1000000; ++i) {
    pose = propagate(pose, rates, 0.2);
    const double length = pose.q.norm();
    shortest = length < shortest ? length : shortest;
    longest = length > longest ? length : longest;
  }
  EXPECT_GE(shortest, 1 - 4e-16);
  EXPECT_LE(longest, 1 + 4e-16);
}

TEST(PoseDifference, FindsTheRotationAndTranslationApplied) {
  VERIFIES("LASSO-GEO-013~1");
  test::Generator generator(65);
  for (int i = 0; i < 20000; ++i) {
    const Pose truth = random_pose(generator);
    const Vec3 rotation = test::random_vector(generator, i % 2 == 0 ? 1.7 : 1e-3);
    const Vec3 translation = test::random_vector(generator, 0.5);
    Pose estimate;
    estimate.q = exp_so3(rotation) * truth.q;
    estimate.p = truth.p + translation;
    if (i % 3 == 0) estimate.q.coeffs() = -estimate.q.coeffs();  // the same rotation
    const Vec6 difference = pose_difference(estimate, truth);
    ASSERT_LE((difference.head<3>() - rotation).norm(), 1e-14);
    ASSERT_LE((difference.tail<3>() - translation).norm(), 1e-14);
    Pose turn, shift;
    turn.q = exp_so3(difference.head<3>());
    shift.p = difference.tail<3>();
    Mat4 turned = matrix(turn) * matrix(truth);
    turned.topRightCorner<3, 1>() = truth.p;
    ASSERT_LE(distance(matrix(shift) * turned, matrix(estimate)), 1e-13);
  }
}

TEST(IsValid, RefusesWhatIsNoPose) {
  VERIFIES("LASSO-GEO-015~2");
  test::Generator generator(66);
  for (int i = 0; i < 1000; ++i) {
    Pose pose = random_pose(generator);
    ASSERT_TRUE(is_valid(pose));
    Pose scaled = pose;
    for (const double factor : {1 + 0.9e-6, 1 - 0.9e-6}) {
      scaled.q.coeffs() = pose.q.coeffs() * factor;
      ASSERT_TRUE(is_valid(scaled)) << factor;
    }
    for (const double factor : {1 + 1.1e-6, 1 - 1.1e-6, 0.0, 1e200, 1e300}) {
      scaled.q.coeffs() = pose.q.coeffs() * factor;
      ASSERT_FALSE(is_valid(scaled)) << factor;
    }
  }
}

TEST(IsValid, RefusesEachComponentThatIsNotFinite) {
  VERIFIES("LASSO-GEO-015~2");
  constexpr double kBad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity()};
  for (const double bad : kBad) {
    for (int i = 0; i < 7; ++i) {
      Pose pose;
      if (i < 4) {
        pose.q.coeffs()[i] = bad;
      } else {
        pose.p[i - 4] = bad;
      }
      EXPECT_FALSE(is_valid(pose)) << i << ' ' << bad;
    }
  }
}

}  // namespace
}  // namespace lasso
