#include "hal_sim/trajectory.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "ut/hal_sim/shapes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

Mat3 about_x(double a) { return (Mat3() << 1, 0, 0, 0, std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a)).finished(); }
Mat3 about_z(double a) { return (Mat3() << std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a), 0, 0, 0, 1).finished(); }

constexpr double kDeg = M_PI / 180;

// The geometry of the peers' benchmark, written out as matrices.
TEST(UprightAttitude, FollowsThePaper) {
  VERIFIES("LASSO-SIM-005~1");
  const Mat3 x_up = (Mat3() << 0, 1, 0, -1, 0, 0, 0, 0, 1).finished();
  const Mat3 expected = about_z(5 * kDeg) * about_x(-15 * kDeg) * x_up;
  const Quat q = upright_attitude(15 * kDeg, 5 * kDeg);
  EXPECT_NEAR((q.toRotationMatrix() - expected).norm(), 0, 1e-14);
  const Vec3 aft = rotate(q, Vec3(-0.66, 0, 0)), aperture = rotate(q, Vec3(0.66, 0, 0));
  EXPECT_NEAR(aperture.z() - aft.z(), 1.32 * std::sin(15 * kDeg), 1e-12) << "the aft end is nearer";
  EXPECT_LT(aperture.y(), aft.y()) << "y points down";
}

// Central differences of the pose give back the rates that the truth states.
TEST(ConstantTwist, PosesAndRatesAgree) {
  VERIFIES("LASSO-SIM-006~1");
  test::Generator generator(5);
  for (int trial = 0; trial < 20; ++trial) {
    TruthState initial;
    initial.T_sensor_target.q = exp_so3(generator.uniform(0, 3) * test::random_unit(generator));
    initial.T_sensor_target.p = Vec3(0.3, -0.2, generator.uniform(2, 7));
    initial.rates.omega_radps = generator.uniform(0, 0.4) * test::random_unit(generator);
    initial.rates.v_mps = generator.uniform(0, 0.2) * test::random_unit(generator);
    const TimeUs epoch_us = 5000000;
    const ConstantTwist motion(initial, epoch_us);
    const TimeUs t_us = epoch_us + static_cast<TimeUs>(generator.uniform(-3e6, 9e6));
    const TruthState now = motion.at(t_us);
    const Vec6 step = pose_difference(motion.at(t_us + 1000).T_sensor_target, motion.at(t_us - 1000).T_sensor_target) / 0.002;
    ASSERT_NEAR((step.head<3>() - now.rates.omega_radps).norm(), 0, 1e-9);
    ASSERT_NEAR((step.tail<3>() - now.rates.v_mps).norm(), 0, 1e-9);
    const double dt_s = static_cast<double>(t_us - epoch_us) * 1e-6;
    const Vec3 omega = initial.rates.omega_radps;
    const Mat3 turned = Eigen::AngleAxisd(omega.norm() * dt_s, omega.normalized()) * initial.T_sensor_target.q.toRotationMatrix();
    ASSERT_NEAR((now.T_sensor_target.q.toRotationMatrix() - turned).norm(), 0, 1e-13);
    ASSERT_NEAR((now.T_sensor_target.p - initial.T_sensor_target.p - dt_s * initial.rates.v_mps).norm(), 0, 1e-13);
  }
}

TEST(ConstantTwist, ASpinAboutATargetAxisLeavesThatAxisInPlace) {
  VERIFIES("LASSO-SIM-006~1");
  TruthState initial;
  initial.T_sensor_target = Pose{upright_attitude(0.3, -0.2), Vec3(0.1, 0.2, 4)};
  const Vec3 axis(0.6, 0, -0.8);
  initial.rates.omega_radps = spin_in_sensor_axes(initial.T_sensor_target, axis, 0.087);
  const ConstantTwist motion(initial, 0);
  const Pose later = motion.at(7000000).T_sensor_target;
  EXPECT_NEAR((later * axis - initial.T_sensor_target * axis).norm(), 0, 1e-14);
  const Mat3 expected = initial.T_sensor_target.q.toRotationMatrix() * Eigen::AngleAxisd(0.087 * 7, axis).toRotationMatrix();
  EXPECT_NEAR((later.q.toRotationMatrix() - expected).norm(), 0, 1e-14);
}

TEST(ConstantTwist, RefusesWhatHasNoMeaning) {
  VERIFIES("LASSO-SIM-006~1");
  TruthState initial;
  initial.rates.v_mps.x() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(ConstantTwist(initial, 0), std::invalid_argument);
  initial = TruthState{};
  initial.T_sensor_target.q.coeffs().setZero();
  EXPECT_THROW(ConstantTwist(initial, 0), std::invalid_argument);
}

}  // namespace
}  // namespace lasso::sim
