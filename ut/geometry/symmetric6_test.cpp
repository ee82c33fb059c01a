#include "fsw/geometry/symmetric6.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fsw/geometry/so3.hpp"
#include "ut/geometry/random_inputs.hpp"
#include "ut/support/dense.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

Mat6 random_matrix(test::Generator& generator) {
  Mat6 M;
  for (int i = 0; i < 36; ++i) M.data()[i] = generator.uniform(-1, 1);
  return M;
}

// Positive definite, of a condition that is mild before its axes get scales of 10^-spread to 10^spread.
Mat6 random_spd(test::Generator& generator, double spread) {
  const Mat6 M = random_matrix(generator);
  Mat6 A = M * M.transpose() + 0.05 * Mat6::Identity();
  Vec6 scale;
  for (int i = 0; i < 6; ++i) scale[i] = std::pow(10.0, generator.uniform(-spread, spread));
  A = (scale.asDiagonal() * A * scale.asDiagonal()).eval();
  const Mat6 symmetric = 0.5 * (A + A.transpose());
  return symmetric;
}

// Rank five to rounding, every five of its rows far from dependent; the dependent row is `weak`.
Mat6 random_deficient(test::Generator& generator, int weak) {
  Mat6 A = random_spd(generator, 0);
  Vec6 mix;
  for (int i = 0; i < 6; ++i) mix[i] = i == weak ? 0.0 : generator.uniform(0.3, 1);
  A.col(weak) = (A * mix).eval();
  A.row(weak) = A.col(weak).transpose();
  A(weak, weak) = mix.dot(A.col(weak));  // mix[weak] is 0
  return A;
}

// |A x - b| against |A| |x| + |b|, component by component (Oettli and Prager): small if and only if x solves a system near to A x = b.
double backward_error(const Mat6& A, const Vec6& x, const Vec6& b) {
  const Vec6 size = A.cwiseAbs() * x.cwiseAbs() + b.cwiseAbs();
  return ((A * x - b).cwiseAbs().array() / size.array()).maxCoeff();
}

// In units of the diagonal.
double condition_of(const Mat6& A) {
  const Vec6 inverse = A.diagonal().cwiseSqrt().cwiseInverse();
  const Vec6 values = eigen6(inverse.asDiagonal() * A * inverse.asDiagonal()).values;
  return values[5] / values[0];
}

TEST(Solve6, SolvesWhateverTheScales) {
  VERIFIES("LASSO-GEO-016~2");
  test::Generator generator(71);
  double worst_condition = 0;
  for (int i = 0; i < 20000; ++i) {
    const Mat6 A = random_spd(generator, i % 3);
    if (i % 20 == 0) worst_condition = std::max(worst_condition, condition_of(A));
    Vec6 b;
    for (int k = 0; k < 6; ++k) b[k] = generator.uniform(-1, 1) * std::sqrt(A(k, k));
    Vec6 x;
    ASSERT_EQ(solve6(A, b, x), Status::kOk);
    const Vec6 truth = test::solution_of(A, b);
    const Vec6 scale = A.diagonal().cwiseSqrt();
    ASSERT_LE(scale.cwiseProduct(x - truth).norm(), 1e-11 * scale.cwiseProduct(truth).norm());
    ASSERT_LE(backward_error(A, x, b), 1e-12);
  }
  EXPECT_GT(worst_condition, 100);
}

TEST(Solve6, ReadsTheLowerTriangleOnly) {
  VERIFIES("LASSO-GEO-016~2");
  test::Generator generator(72);
  const Mat6 A = random_spd(generator, 1);
  Mat6 spoiled = A;
  for (int i = 0; i < 6; ++i) {
    for (int j = i + 1; j < 6; ++j) spoiled(i, j) = 1e6;
  }
  const Vec6 b = Vec6::LinSpaced(-1, 2);
  Vec6 x;
  Vec6 y;
  ASSERT_EQ(solve6(A, b, x), Status::kOk);
  ASSERT_EQ(solve6(spoiled, b, y), Status::kOk);
  EXPECT_EQ(x, y);
}

// A matrix of rank five, an indefinite matrix, and zero: refused, and x stays as it was.
TEST(Solve6, SingularSystemsAreRefused) {
  VERIFIES("LASSO-GEO-017~1");
  test::Generator generator(73);
  const Vec6 b = Vec6::Ones();
  Vec6 x = Vec6::Constant(7);
  Mat6 inverse = Mat6::Constant(8);
  for (int i = 0; i < 2000; ++i) {
    const Mat6 deficient = random_deficient(generator, i % 6);
    const Mat6 indefinite = random_spd(generator, 0) - 20 * Vec6::Unit(i % 6) * Vec6::Unit(i % 6).transpose();
    for (const Mat6& A : {deficient, indefinite, Mat6(-random_spd(generator, 1)), Mat6(Mat6::Zero())}) {
      ASSERT_EQ(solve6(A, b, x), Status::kSingular) << A;
      ASSERT_EQ(invert6(A, inverse), Status::kSingular) << A;
    }
  }
  EXPECT_EQ(x, Vec6(Vec6::Constant(7)));
  EXPECT_EQ(inverse, Mat6(Mat6::Constant(8)));
}

TEST(Solve6, PivotLimitIsWhereTheContractSays) {
  VERIFIES("LASSO-GEO-017~1");
  Vec6 x;
  for (int weak = 0; weak < 6; ++weak) {
    Mat6 A = 3 * Mat6::Identity();
    A(weak, weak) = 3 * 1.01e-12;
    EXPECT_EQ(solve6(A, Vec6::Ones(), x), Status::kOk);
    A(weak, weak) = 3 * 0.99e-12;
    EXPECT_EQ(solve6(A, Vec6::Ones(), x), Status::kSingular);
  }
}

TEST(Solve6, WhatIsNotFiniteIsRefused) {
  VERIFIES("LASSO-GEO-017~1");
  Vec6 x = Vec6::Constant(7);
  Mat6 inverse = Mat6::Constant(8);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (int i = 0; i < 36; ++i) {
      Mat6 A = Mat6::Identity();
      A.data()[i] = bad;
      EXPECT_EQ(solve6(A, Vec6::Ones(), x), Status::kNotFinite);
      EXPECT_EQ(invert6(A, inverse), Status::kNotFinite);
    }
    for (int i = 0; i < 6; ++i) {
      Vec6 b = Vec6::Ones();
      b[i] = bad;
      EXPECT_EQ(solve6(Mat6::Identity(), b, x), Status::kNotFinite);
      EXPECT_EQ(solve6(Mat6::Zero(), b, x), Status::kNotFinite);
    }
  }
  // Finite input, a result too large for a double.
  EXPECT_EQ(solve6(1e-300 * Mat6::Identity(), 1e300 * Vec6::Ones(), x), Status::kSingular);
  EXPECT_EQ(invert6(std::numeric_limits<double>::denorm_min() * Mat6::Identity(), inverse), Status::kSingular);
  EXPECT_EQ(x, Vec6(Vec6::Constant(7)));
  EXPECT_EQ(inverse, Mat6(Mat6::Constant(8)));
}

TEST(Invert6, IsTheInverseAndExactlySymmetric) {
  VERIFIES("LASSO-GEO-016~2");
  test::Generator generator(74);
  for (int i = 0; i < 20000; ++i) {
    const Mat6 A = random_spd(generator, i % 3);
    Mat6 inverse;
    ASSERT_EQ(invert6(A, inverse), Status::kOk);
    const Mat6 truth = test::inverse_of(A);
    const Vec6 scale = A.diagonal().cwiseSqrt();
    const Mat6 error = scale.asDiagonal() * (inverse - truth) * scale.asDiagonal();
    const Mat6 size = scale.asDiagonal() * truth * scale.asDiagonal();
    ASSERT_LE(error.norm(), 1e-11 * size.norm());
    ASSERT_EQ(inverse, inverse.transpose().eval());
  }
}

void expect_decomposition(const Mat6& A, const Eigen6& e, double tolerance) {
  const double size = A.norm();
  ASSERT_LE((A * e.vectors - e.vectors * e.values.asDiagonal()).norm(), tolerance * size);
  ASSERT_LE((e.vectors.transpose() * e.vectors - Mat6::Identity()).norm(), tolerance);
  for (int i = 1; i < 6; ++i) ASSERT_LE(e.values[i - 1], e.values[i]);
}

// The other solver does not converge in PowerPC's pairs of doubles; the decomposition itself is checked everywhere.
constexpr bool kHasExtendedPrecision = std::numeric_limits<long double>::digits != 106;

TEST(Eigen6, AgreesWithAnotherSolver) {
  VERIFIES("LASSO-GEO-018~1");
  test::Generator generator(75);
  for (int i = 0; i < 1000; ++i) {
    Mat6 A = random_spd(generator, 0.5 * (i % 4));
    if (i % 5 == 0) A -= 2 * Mat6::Identity();  // indefinite
    const Eigen6 e = eigen6(A);
    expect_decomposition(A, e, 5e-15);
    if (!kHasExtendedPrecision) continue;
    ASSERT_LE((e.values - test::eigenvalues_of(A)).norm(), 5e-15 * A.norm());
  }
}

// The least eigenvalues of information matrices tell the weak directions: they must not drown in the rounding of the largest.
TEST(Eigen6, SmallEigenvaluesOfBadlyScaledMatricesAreAccurate) {
  VERIFIES("LASSO-GEO-022~1");
  if (!kHasExtendedPrecision) GTEST_SKIP() << "no reference of higher precision on this target";
  test::Generator generator(76);
  for (int i = 0; i < 3000; ++i) {
    const Mat6 A = random_spd(generator, 3);
    const Eigen6 e = eigen6(A);
    ASSERT_NEAR(e.values[0] / test::least_eigenvalue_of(A), 1.0, 1e-11);
    ASSERT_GT(e.values[0], 0.0);
  }
}

TEST(Eigen6, MultipleValuesAndSpecialMatrices) {
  VERIFIES("LASSO-GEO-018~1");
  test::Generator generator(77);
  for (int i = 0; i < 2000; ++i) {
    const Mat6 Q = eigen6(random_spd(generator, 0)).vectors;
    Vec6 values;
    values << -2, 1, 1, 1, 5, 5;
    const Mat6 A = Q * values.asDiagonal() * Q.transpose();
    const Mat6 symmetric = 0.5 * (A + A.transpose());
    const Eigen6 e = eigen6(symmetric);
    expect_decomposition(symmetric, e, 5e-15);
    ASSERT_LE((e.values - values).norm(), 5e-14);
  }
  EXPECT_EQ(eigen6(Mat6::Zero()).values, Vec6(Vec6::Zero()));
  EXPECT_EQ(eigen6(Mat6::Identity()).vectors, Mat6(Mat6::Identity()));
  const Eigen6 ones = eigen6(Mat6::Ones());
  EXPECT_NEAR(ones.values[5], 6, 1e-14);
  EXPECT_LE(ones.values.head<5>().norm(), 1e-14);
  EXPECT_TRUE(std::isnan(eigen6(Mat6::Constant(std::numeric_limits<double>::quiet_NaN())).values.sum()));
}

// By its blocks.
TEST(RotatedCovariance, TurnsBothHalvesAlike) {
  VERIFIES("LASSO-GEO-018~1");
  test::Generator generator(78);
  const Mat3 R = to_matrix(exp_so3(Vec3(0.4, -1.1, 0.7)));
  const Mat6 C = random_spd(generator, 0);
  const Mat6 rotated = rotated_covariance(R, C);
  for (int i = 0; i < 6; i += 3) {
    for (int j = 0; j < 6; j += 3) {
      const Mat3 block = R * C.block<3, 3>(i, j) * R.transpose();
      EXPECT_LT((rotated.block<3, 3>(i, j) - block).norm(), 1e-12 * C.norm());
    }
  }
}

}  // namespace
}  // namespace lasso
