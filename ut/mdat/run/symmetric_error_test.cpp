#include "mdat/run/symmetric_error.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const Pose kTruth{normalized(Quat(0.8, 0.2, -0.3, 0.4)), Vec3(0.3, -0.2, 5)};

Mat6 sigmas(double rotation_rad, double translation_m) {
  Vec6 variance;
  variance << Vec3::Constant(rotation_rad * rotation_rad), Vec3::Constant(translation_m * translation_m);
  return variance.asDiagonal();
}

Quat turn(double angle_rad, const Vec3& axis) { return Quat(Eigen::AngleAxisd(angle_rad, axis)); }

// The pose off the truth by these, after a turn of the target about a point of it.
Pose off(const Quat& symmetry, const Vec3& center, const Vec3& rotation, const Vec3& translation) {
  Pose pose = kTruth * Pose{symmetry, center - symmetry * center};
  pose.q = exp_so3(rotation) * pose.q;
  pose.p += translation;
  return pose;
}

TEST(SymmetricError, OfNoSymmetryIsThePlainError) {
  VERIFIES("LASSO-GND-114~1");
  ExactSymmetry none;
  none.turns = {Quat::Identity()};
  const Pose pose = off(Quat::Identity(), Vec3::Zero(), {0.02, 0, 0}, {0, 0.003, 0});
  const SymmetricError error = symmetric_error(pose, kTruth, sigmas(0.01, 0.001), none);
  EXPECT_NEAR(error.squared, 4 + 9, 1e-9);
  EXPECT_NEAR(error.rotation_rad, 0.02, 1e-12);
  EXPECT_NEAR(error.translation_m, 0.003, 1e-12);
}

TEST(SymmetricError, IsThatOfTheImageThatLooksTheSame) {
  VERIFIES("LASSO-GND-114~1");
  ExactSymmetry symmetry;
  symmetry.center = Vec3(0.4, 0.1, 0);
  symmetry.turns = {Quat::Identity(), turn(kPi, Vec3::UnitY())};
  const Pose pose = off(symmetry.turns[1], symmetry.center, {0, 0, 0.02}, {0.002, 0, 0});
  const SymmetricError error = symmetric_error(pose, kTruth, sigmas(0.01, 0.001), symmetry);
  EXPECT_NEAR(error.squared, 4 + 4, 1e-9);
  EXPECT_NEAR(error.rotation_rad, 0.02, 1e-12);
  EXPECT_NEAR(error.translation_m, 0.002, 1e-12);
  symmetry.turns.pop_back();
  EXPECT_NEAR(symmetric_error(pose, kTruth, sigmas(0.01, 0.001), symmetry).rotation_rad, kPi, 0.03);
}

TEST(SymmetricError, OfARoundBodyDoesNotCountTheTurnAboutItsAxis) {
  VERIFIES("LASSO-GND-114~1");
  ExactSymmetry symmetry;
  symmetry.center = Vec3(0, 0.3, -0.2);
  symmetry.axis = Vec3(1, 2, -2).normalized();
  symmetry.turns = {Quat::Identity(), turn(kPi, symmetry.axis->unitOrthogonal())};
  for (const Quat& flip : symmetry.turns) {
    const Vec3 tilt = 0.02 * rotate(kTruth.q * flip, symmetry.axis->unitOrthogonal());
    const Pose pose = off(flip * turn(2.1, *symmetry.axis), symmetry.center, tilt, {0, 0, 0});
    const SymmetricError error = symmetric_error(pose, kTruth, sigmas(0.01, 1), symmetry);
    EXPECT_NEAR(error.rotation_rad, 0.02, 1e-3);
    EXPECT_NEAR(error.squared, 4, 0.05);
  }
}

TEST(SymmetricError, OfASphereIsThatOfItsCentre) {
  VERIFIES("LASSO-GND-114~1");
  ExactSymmetry symmetry;
  symmetry.sphere = true;
  symmetry.turns = {Quat::Identity()};
  symmetry.center = Vec3(0.2, 0, 0.1);
  const Pose pose = off(turn(1, Vec3(1, 1, 0).normalized()), symmetry.center, {0, 0, 0}, {0, 0.004, 0});
  const SymmetricError error = symmetric_error(pose, kTruth, sigmas(0, 0.001), symmetry);
  EXPECT_NEAR(error.squared, 16, 1e-6);
  EXPECT_NEAR(error.translation_m, 0.004, 1e-12);
  EXPECT_EQ(error.rotation_rad, 0);
}

TEST(SymmetricError, WrongIsFarAndBeyondItsSigma) {
  VERIFIES("LASSO-GND-114~1");
  EXPECT_TRUE(is_wrong({26, 0.016, 0}, 1));
  EXPECT_TRUE(is_wrong({26, 0, 1.01 * kRadPerDeg}, 1));
  EXPECT_FALSE(is_wrong({24, 0.5, 1}, 1));     // as its covariance says
  EXPECT_FALSE(is_wrong({1e6, 0.014, 0}, 1));  // near enough
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(is_wrong({kNan, kNan, kNan}, 1));
  EXPECT_FALSE(is_wrong({26, 0.016, 0}, 2));
}

}  // namespace
}  // namespace lasso::mdat
