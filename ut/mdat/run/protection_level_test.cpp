#include "mdat/run/protection_level.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// Of chi with 3 and 2 degrees of freedom and of the normal, by the C library.
double chi3_beyond(double s) { return std::erfc(s / std::sqrt(2.0)) + s * std::sqrt(2 / kPi) * std::exp(-0.5 * s * s); }
double chi2_beyond(double s) { return std::exp(-0.5 * s * s); }
double normal_beyond(double s) { return std::erfc(s / std::sqrt(2.0)); }

// Where a falling function of s is the risk, by bisection.
double at_risk(double (*beyond)(double)) {
  double low = 0, high = 20;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (beyond(middle) > kProtectionRisk ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Mat3 generic_rotation(test::Generator& random) {
  const Vec3 turn(random.normal(), random.normal(), random.normal());
  return to_matrix(exp_so3(turn));
}

Mat3 covariance_of(const Mat3& axes, const Vec3& sigmas) { return axes * sigmas.cwiseAbs2().asDiagonal() * axes.transpose(); }

TEST(ProtectionLevel, IsTheQuantileOfChiWhereTheAxesAreAlike) {
  VERIFIES("LASSO-GND-131~1");
  test::Generator random(1);
  EXPECT_NEAR(at_risk(chi3_beyond), 4.5943, 5e-5);  // the square is chi^2's 99.99 % point with 3 degrees of freedom, 21.1075
  for (const double sigma : {3e-6, 0.002, 40.0}) {
    const double level = protection_level(covariance_of(generic_rotation(random), Vec3(sigma, sigma, sigma)));
    EXPECT_NEAR(level / (sigma * at_risk(chi3_beyond)), 1, 1e-6);
  }
}

TEST(ProtectionLevel, IsTheQuantileOfTheNormalWhereOneAxisIsAll) {
  VERIFIES("LASSO-GND-131~1");
  test::Generator random(2);
  EXPECT_NEAR(at_risk(normal_beyond), 3.8906, 5e-5);
  for (const double other : {0.0, 1e-7, 1e-4}) {
    const double level = protection_level(covariance_of(generic_rotation(random), Vec3(other, 0.003, other)));
    EXPECT_NEAR(level / (0.003 * at_risk(normal_beyond)), 1, other > 1e-5 ? 1e-3 : 1e-6) << other;
  }
}

TEST(ProtectionLevel, IsTheQuantileOfTwoAxesWhereTheThirdIsNone) {
  VERIFIES("LASSO-GND-131~1");
  test::Generator random(3);
  const double level = protection_level(covariance_of(generic_rotation(random), Vec3(0.02, 0, 0.02)));
  EXPECT_NEAR(level / (0.02 * at_risk(chi2_beyond)), 1, 1e-6);  // Rayleigh: sqrt(2 ln 10^4)
  EXPECT_NEAR(at_risk(chi2_beyond), std::sqrt(2 * std::log(1e4)), 1e-9);
}

// The integral over one axis of what the plane of the others leaves, each by the trapezoidal rule: no direction, no quadrature of Gauss.
double beyond_by_axes(const Vec3& sigmas, double radius) {
  constexpr int kSteps = 4000;
  constexpr double kReach = 9;
  const double step = 2 * kReach / kSteps;
  const auto density = [](double z) { return std::exp(-0.5 * z * z) / std::sqrt(2 * kPi); };
  double outer = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const double y = -kReach + step * i, left = radius * radius - std::pow(sigmas.y() * y, 2);
    if (left <= 0) {
      outer += step * density(y);
      continue;
    }
    // The circle's angle as the variable, so that the integrand is smooth at its edge: x = sqrt(left) sin(angle) / sigmas.x()
    constexpr int kAngles = 400;
    double within = 0;
    for (int j = 0; j <= kAngles; ++j) {
      const double angle = kPi * (static_cast<double>(j) / kAngles - 0.5);
      const double x = std::sqrt(left) * std::sin(angle) / sigmas.x();
      const double z = std::sqrt(left) * std::cos(angle) / sigmas.z();
      within += kPi / kAngles * std::sqrt(left) * std::cos(angle) / sigmas.x() * density(x) * std::erf(z / std::sqrt(2.0));
    }
    outer += step * density(y) * (1 - within);
  }
  return outer;
}

TEST(ProtectionLevel, LeavesTheRiskOfAGenericCovarianceByAnotherIntegral) {
  VERIFIES("LASSO-GND-131~1");
  test::Generator random(4);
  for (const Vec3& sigmas : {Vec3(1, 0.7, 0.4), Vec3(0.3, 1, 0.9), Vec3(1, 0.2, 0.25)}) {
    const double level = protection_level(covariance_of(generic_rotation(random), sigmas));
    EXPECT_NEAR(beyond_by_axes(sigmas, level) / kProtectionRisk, 1, 2e-3) << sigmas.transpose();
    EXPECT_NEAR(exceedance(sigmas.cwiseAbs2(), level) / kProtectionRisk, 1, 1e-6);
  }
}

// By Box and Muller: the generator's own has no tails.
double normal_of(test::Generator& random) {
  const double radius = std::sqrt(-2 * std::log(1 - random.uniform(0, 1)));
  return radius * std::cos(random.uniform(0, 2 * kPi));
}

// Directions are drawn, in an order that is the same with every compiler; how far an error goes along each is known in closed form.
double beyond_by_draws(const Mat3& root, double radius, test::Generator& random) {
  constexpr int kDraws = 60000;
  double sum = 0;
  for (int i = 0; i < kDraws; ++i) {
    Vec3 way;
    for (double& value : way) value = normal_of(random);
    sum += chi3_beyond(radius / (root * way.normalized()).norm());
  }
  return sum / kDraws;
}

TEST(ProtectionLevel, IsExceededAtTheRiskByDrawsOfGenericCovariances) {
  VERIFIES("LASSO-GND-131~1");
  test::Generator random(5);
  for (int i = 0; i < 6; ++i) {
    Mat3 root;
    for (int k = 0; k < 9; ++k) root(k / 3, k % 3) = random.normal();
    const double level = protection_level(root * root.transpose());
    EXPECT_NEAR(beyond_by_draws(root, level, random) / kProtectionRisk, 1, 0.03) << root;
  }
}

TEST(ProtectionLevel, GrowsWithEveryAxisBetweenTheClosedForms) {
  VERIFIES("LASSO-GND-131~1");
  double before = at_risk(normal_beyond) * (1 - 1e-7);
  for (int i = 1; i <= 20; ++i) {
    const double other = 0.05 * i;
    const double level = protection_level(Vec3(1, other * other, 0.25 * other * other).asDiagonal());
    EXPECT_GT(level, before);
    before = level;
  }
  EXPECT_LT(before, at_risk(chi3_beyond));
}

TEST(ProtectionLevel, OfNoCovarianceNothingIsPromised) {
  VERIFIES("LASSO-GND-131~1");
  Mat3 broken = Mat3::Identity();
  broken(0, 1) = broken(1, 0) = std::nan("");
  EXPECT_TRUE(std::isinf(protection_level(broken)));
  EXPECT_EQ(protection_level(Mat3::Zero()), 0);
  EXPECT_NEAR(protection_level(Vec3(4, -1e-9, 0).asDiagonal()), 2 * at_risk(normal_beyond), 1e-5);
}

TEST(ProtectionLevels, ArePositionsAndAttitudesOwn) {
  VERIFIES("LASSO-GND-131~1");
  Mat6 covariance = Mat6::Zero();
  covariance.topLeftCorner<3, 3>() = 1e-6 * Mat3::Identity();      // rotation
  covariance.bottomRightCorner<3, 3>() = 4e-6 * Mat3::Identity();  // translation
  covariance(0, 5) = covariance(5, 0) = 1e-6;                      // what both have in common does not matter
  EXPECT_NEAR(protection_levels(covariance).attitude_rad, 1e-3 * at_risk(chi3_beyond), 1e-8);
  EXPECT_NEAR(protection_levels(covariance).position_m, 2e-3 * at_risk(chi3_beyond), 1e-8);
  covariance.topLeftCorner<3, 3>() = 100 * Mat3::Identity();
  EXPECT_EQ(protection_levels(covariance).attitude_rad, kPi) << "no attitude is farther off";
}

}  // namespace
}  // namespace lasso::mdat
