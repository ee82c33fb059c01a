#include "fsw/geometry/so3.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ut/geometry/random_inputs.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

// The matrix exponential by its power series with halving and squaring: knows nothing of quaternions.
Mat3 matrix_exponential(const Mat3& S) {
  const Mat3 X = S / 1024.0;
  Mat3 term = Mat3::Identity();
  Mat3 sum = Mat3::Identity();
  for (int k = 1; k < 12; ++k) {
    term = term * X / k;
    sum += term;
  }
  for (int i = 0; i < 10; ++i) sum = sum * sum;
  return sum;
}

double distance(const Mat3& A, const Mat3& B) { return (A - B).cwiseAbs().maxCoeff(); }

Mat3 axis_rotation(int axis, double angle) {
  const int i = (axis + 1) % 3;
  const int j = (axis + 2) % 3;
  Mat3 R = Mat3::Identity();
  R(i, i) = std::cos(angle);
  R(j, j) = std::cos(angle);
  R(i, j) = -std::sin(angle);
  R(j, i) = std::sin(angle);
  return R;
}

TEST(Skew, IsTheCrossProduct) {
  VERIFIES("LASSO-GEO-010~1");
  test::Generator generator(51);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a = test::random_vector(generator, 3);
    const Vec3 b = test::random_vector(generator, 3);
    const Vec3 c = skew(a) * b;
    ASSERT_NEAR(c.x(), a.y() * b.z() - a.z() * b.y(), 1e-14);
    ASSERT_NEAR(c.y(), a.z() * b.x() - a.x() * b.z(), 1e-14);
    ASSERT_NEAR(c.z(), a.x() * b.y() - a.y() * b.x(), 1e-14);
  }
}

TEST(ExpSo3, IsTheMatrixExponential) {
  VERIFIES("LASSO-GEO-010~1");
  test::Generator generator(52);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 r = test::random_vector(generator, std::ldexp(6.0, -(i % 40)));
    const Quat q = exp_so3(r);
    ASSERT_NEAR(q.norm(), 1.0, 5e-16);
    ASSERT_LE(distance(to_matrix(q), matrix_exponential(skew(r))), 1e-12) << r.transpose();
  }
  EXPECT_EQ(exp_so3(Vec3::Zero()).coeffs(), Quat(1, 0, 0, 0).coeffs());
}

// Across the seam between series and closed form the function has no step.
TEST(ExpSo3, SeriesMeetsTheClosedForm) {
  VERIFIES("LASSO-GEO-010~1");
  const Vec3 axis = Vec3(1, 2, -2) / 3.0;
  for (const double angle : {0.00999, 0.0099999999, 0.0100000001, 0.01001}) {
    const Quat q = exp_so3(angle * axis);
    EXPECT_NEAR(q.w(), std::cos(angle / 2), 2e-16) << angle;
    EXPECT_NEAR(q.x(), std::sin(angle / 2) / 3, 2e-18) << angle;
  }
}

TEST(LogSo3, InvertsTheExponential) {
  VERIFIES("LASSO-GEO-010~1");
  test::Generator generator(53);
  for (int i = 0; i < 50000; ++i) {
    Vec3 r = test::random_vector(generator, std::ldexp(1.8, -(i % 60)));
    if (i % 3 == 0) r *= (kPi - std::ldexp(1.0, -(i % 45))) / r.norm();  // near half a turn
    const Vec3 back = log_so3(exp_so3(r));
    ASSERT_LE((back - r).norm(), 2e-15 * (1 + 2 * r.norm())) << r.transpose();
    if (i % 3 == 0) continue;
    ASSERT_LE((back - r).norm(), 4e-15 * r.norm()) << r.transpose();  // relative, also for tiny ones
  }
}

TEST(LogSo3, BothSignsOfAQuaternionAreOneRotation) {
  VERIFIES("LASSO-GEO-010~1 LASSO-GEO-011~2");
  test::Generator generator(54);
  for (int i = 0; i < 20000; ++i) {
    const Quat q = test::random_rotation(generator);
    const Quat minus(-q.w(), -q.x(), -q.y(), -q.z());
    const Vec3 r = log_so3(q);
    ASSERT_EQ(r, log_so3(minus));
    ASSERT_LE(r.norm(), kPi * (1 + 1e-15));
    ASSERT_LE(distance(matrix_exponential(skew(r)), to_matrix(q)), 1e-12);
  }
  EXPECT_NEAR(log_so3(Quat(0, 0, 0, -1)).norm(), kPi, 1e-15);
  EXPECT_EQ(log_so3(Quat(-1, 0, 0, 0)), Vec3(Vec3::Zero()));
}

TEST(ToMatrix, BothSignsOfAQuaternionTurnAlike) {
  VERIFIES("LASSO-GEO-011~2");
  test::Generator generator(60);
  for (int i = 0; i < 1000; ++i) {
    const Quat q = test::random_rotation(generator);
    const Quat minus(-q.w(), -q.x(), -q.y(), -q.z());
    const Vec3 v = test::random_vector(generator, 5);
    ASSERT_EQ(to_matrix(q), to_matrix(minus));
    ASSERT_EQ(rotate(q, v), rotate(minus, v));
  }
}

TEST(Normalized, UnitLengthForEverySize) {
  VERIFIES("LASSO-GEO-020~1");
  test::Generator generator(55);
  for (int i = 0; i < 20000; ++i) {
    const Quat q = test::random_rotation(generator);
    const double size = std::ldexp(1.0, i % 2000 - 1000);
    const Quat n = normalized(Quat(size * q.w(), size * q.x(), size * q.y(), size * q.z()));
    ASSERT_LE((n.coeffs() - q.coeffs()).norm(), 1e-15) << size;  // the sign stays
    ASSERT_NEAR(n.norm(), 1.0, 4e-16);
  }
}

TEST(Normalized, ZeroIsIdentityAndNanStaysNan) {
  EXPECT_EQ(normalized(Quat(0, 0, 0, 0)).coeffs(), Quat(1, 0, 0, 0).coeffs());
  EXPECT_EQ(normalized(Quat(0, -0.0, 0, 0)).coeffs(), Quat(1, 0, 0, 0).coeffs());
  EXPECT_TRUE(std::isnan(normalized(Quat(kNoNumber, 0, 0, 0)).x()));
  EXPECT_TRUE(std::isnan(normalized(Quat(1, kNoNumber, 0, 0)).w()));
}

TEST(ToMatrix, TurnsVectorsAsRotateDoes) {
  VERIFIES("LASSO-GEO-010~1 LASSO-SYS-024~1");
  test::Generator generator(56);
  for (int i = 0; i < 20000; ++i) {
    const Quat q = test::random_rotation(generator);
    const Vec3 v = test::random_vector(generator, 5);
    const Quat sandwich = q * Quat(0, v.x(), v.y(), v.z()) * q.conjugate();
    ASSERT_LE((rotate(q, v) - sandwich.vec()).norm(), 2e-14);
    ASSERT_LE((to_matrix(q) * v - sandwich.vec()).norm(), 2e-14);
  }
  const double h = std::sqrt(0.5);
  EXPECT_LE((rotate(Quat(h, 0, 0, h), Vec3(1, 0, 0)) - Vec3(0, 1, 0)).norm(), 1e-15);  // the right hand
}

TEST(ToQuaternion, InvertsToMatrixOnEveryBranch) {
  VERIFIES("LASSO-GEO-010~1");
  test::Generator generator(57);
  int branch[4] = {};
  for (int i = 0; i < 40000; ++i) {
    const Quat q = test::random_rotation(generator);
    int largest = 0;
    q.coeffs().cwiseAbs().maxCoeff(&largest);
    ++branch[largest];
    const Quat back = to_quaternion(to_matrix(q));
    const double sign = back.coeffs().dot(q.coeffs()) < 0 ? -1.0 : 1.0;
    ASSERT_LE((sign * back.coeffs() - q.coeffs()).norm(), 2e-15) << q.coeffs().transpose();
    ASSERT_NEAR(back.norm(), 1.0, 4e-16);
  }
  for (const int hits : branch) EXPECT_GT(hits, 5000);
}

TEST(ToQuaternion, HalfTurns) {
  VERIFIES("LASSO-GEO-010~1");
  for (int axis = 0; axis < 3; ++axis) {
    Mat3 R = -Mat3::Identity();
    R(axis, axis) = 1;
    const Quat q = to_quaternion(R);
    EXPECT_EQ(q.coeffs()[axis], 1.0);
    EXPECT_EQ(q.w(), 0.0);
  }
}

TEST(EulerZyx, AnglesGiveTheMatrixBack) {
  VERIFIES("LASSO-GEO-012~1");
  test::Generator generator(58);
  for (int i = 0; i < 20000; ++i) {
    Mat3 R = to_matrix(test::random_rotation(generator));
    const double near_pole = (i % 4 == 0 ? 1 : -1) * (kPi / 2 - std::ldexp(1.0, -(i % 55)));
    if (i % 2 == 0)
      R = axis_rotation(2, generator.uniform(-3, 3)) * axis_rotation(1, near_pole) * axis_rotation(0, generator.uniform(-3, 3));
    const Vec3 e = euler_zyx(R);
    ASSERT_LE(distance(axis_rotation(2, e[0]) * axis_rotation(1, e[1]) * axis_rotation(0, e[2]), R), 3e-15) << R;
    ASSERT_LE(std::fabs(e[1]), kPi / 2);
  }
}

TEST(EulerZyx, RecoversTheAngles) {
  VERIFIES("LASSO-GEO-012~1");
  test::Generator generator(59);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 angles(generator.uniform(-kPi, kPi), generator.uniform(-1.5, 1.5), generator.uniform(-kPi, kPi));
    const Vec3 e = euler_zyx(axis_rotation(2, angles[0]) * axis_rotation(1, angles[1]) * axis_rotation(0, angles[2]));
    ASSERT_LE((e - angles).norm(), 2e-14) << angles.transpose();
  }
}

TEST(EulerZyx, AtThePoleYawIsZero) {
  VERIFIES("LASSO-GEO-012~1");
  Mat3 R;
  R << 0, 0, 1, 0, 1, 0, -1, 0, 0;  // Ry(90 deg)
  EXPECT_LE((euler_zyx(R) - Vec3(0, kPi / 2, 0)).norm(), 1e-15);
  EXPECT_LE((euler_zyx(R * axis_rotation(0, 0.5)) - Vec3(0, kPi / 2, 0.5)).norm(), 1e-15);
}

}  // namespace
}  // namespace lasso
