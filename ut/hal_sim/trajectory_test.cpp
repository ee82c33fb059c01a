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

SteppedSpin::Setup paper_setup() {
  SteppedSpin::Setup setup;
  setup.T_sensor_target_frame0 = Pose{upright_attitude(15 * kDeg, 5 * kDeg), Vec3(0.02, -0.01, 4)};
  setup.step_rad = kDeg;
  setup.epoch_us = 1000000;
  setup.period_us = 200000;
  return setup;
}

// The geometry of the peers' benchmark, written out as matrices.
TEST(SteppedSpin, FollowsThePaper) {
  VERIFIES("LASSO-SIM-005~1");
  const SteppedSpin spin(paper_setup());
  const Mat3 x_up = (Mat3() << 0, 1, 0, -1, 0, 0, 0, 0, 1).finished();
  for (int frame = -1; frame < 360; ++frame) {
    const Mat3 expected = about_z(5 * kDeg) * about_x(-15 * kDeg) * x_up * about_x(frame * kDeg);
    const Pose pose = spin.at(1000000 + frame * 200000 + 137).T_sensor_target;
    ASSERT_NEAR((pose.q.toRotationMatrix() - expected).norm(), 0, 1e-14) << frame;
    ASSERT_EQ(pose.p, Vec3(0.02, -0.01, 4));
    ASSERT_TRUE(is_valid(pose));
  }
}

TEST(SteppedSpin, TheAftEndIsNearerAndTheApertureIsUp) {
  VERIFIES("LASSO-SIM-005~1");
  const SteppedSpin spin(paper_setup());
  const Pose pose = spin.at_frame(77).T_sensor_target;
  const Vec3 aft = pose * Vec3(-0.66, 0, 0);
  const Vec3 aperture = pose * Vec3(0.66, 0, 0);
  EXPECT_NEAR(aperture.z() - aft.z(), 1.32 * std::sin(15 * kDeg), 1e-12);
  EXPECT_LT(aperture.y(), aft.y());  // y points down
}

TEST(SteppedSpin, StandsStillDuringAFrame) {
  VERIFIES("LASSO-SIM-005~1");
  const SteppedSpin spin(paper_setup());
  const TruthState begin = spin.at(spin.frame_begin_us(5));
  const TruthState last = spin.at(spin.frame_begin_us(6) - 1);
  const TruthState next = spin.at(spin.frame_begin_us(6));
  EXPECT_EQ(begin.T_sensor_target.q.coeffs(), last.T_sensor_target.q.coeffs());
  EXPECT_EQ(begin.rates.omega_radps.norm() + begin.rates.v_mps.norm(), 0);
  EXPECT_NEAR(last.T_sensor_target.q.angularDistance(next.T_sensor_target.q), kDeg, 1e-7);
  EXPECT_EQ(spin.frame_of(spin.frame_begin_us(0) - 1), -1);
  EXPECT_EQ(spin.frame_of(spin.frame_begin_us(-3)), -3);
}

TEST(SteppedSpin, TurnsAboutAGeneralAxisOfTheTarget) {
  VERIFIES("LASSO-SIM-005~1");
  SteppedSpin::Setup setup = paper_setup();
  setup.axis_target = Vec3(0.36, -0.48, 0.8);
  setup.step_rad = 0.07;
  const SteppedSpin spin(setup);
  const Mat3 first = setup.T_sensor_target_frame0.q.toRotationMatrix();
  const Mat3 turn = Eigen::AngleAxisd(0.07 * 13, setup.axis_target).toRotationMatrix();
  const Pose pose = spin.at_frame(13).T_sensor_target;
  EXPECT_NEAR((pose.q.toRotationMatrix() - first * turn).norm(), 0, 1e-14);
  EXPECT_NEAR((pose * setup.axis_target - spin.at_frame(0).T_sensor_target * setup.axis_target).norm(), 0, 1e-14);
}

TEST(SteppedSpin, RefusesWhatHasNoMeaning) {
  VERIFIES("LASSO-SIM-006~1");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](auto change) {
    SteppedSpin::Setup setup = paper_setup();
    change(setup);
    EXPECT_THROW(SteppedSpin{setup}, std::invalid_argument);
  };
  refused([](auto& s) { s.T_sensor_target_frame0.q.coeffs() *= 1.1; });
  refused([](auto& s) { s.axis_target = Vec3(1, 1, 0); });
  refused([nan](auto& s) { s.step_rad = nan; });
  refused([](auto& s) { s.period_us = 0; });
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

// The point stays where the motion has it, and the origin goes round: poses and rates agree there, too.
TEST(AboutPoint, TheTargetTurnsAboutThePointAndRatesAreThoseOfItsOrigin) {
  VERIFIES("LASSO-SIM-006~1");
  TruthState initial;
  initial.T_sensor_target = Pose{upright_attitude(0.3, -0.2), Vec3(0.1, 0.2, 4)};
  initial.rates = Twist{Vec3(0.1, -0.2, 0.15), Vec3(0.02, 0.01, -0.05)};
  const Vec3 point_m(2.5, -1.2, 0.7);
  const ConstantTwist alone(initial, 0);
  const AboutPoint motion(std::make_unique<ConstantTwist>(initial, 0), point_m);
  for (const TimeUs t_us : {TimeUs{0}, TimeUs{7000000}}) {
    const TruthState now = motion.at(t_us);
    EXPECT_NEAR((now.T_sensor_target * point_m - alone.at(t_us).T_sensor_target.p).norm(), 0, 1e-12);
    EXPECT_NEAR((now.T_sensor_target * (point_m + Vec3::UnitX()) - alone.at(t_us).T_sensor_target * Vec3::UnitX()).norm(), 0, 1e-12);
    const Vec6 step = pose_difference(motion.at(t_us + 1000).T_sensor_target, motion.at(t_us - 1000).T_sensor_target) / 0.002;
    EXPECT_NEAR((step.head<3>() - now.rates.omega_radps).norm(), 0, 1e-9);
    EXPECT_NEAR((step.tail<3>() - now.rates.v_mps).norm(), 0, 1e-6);
  }
  EXPECT_THROW(AboutPoint(nullptr, point_m), std::invalid_argument);
  EXPECT_THROW(AboutPoint(std::make_unique<ConstantTwist>(initial, 0), Vec3(0, 0, std::numeric_limits<double>::quiet_NaN())),
               std::invalid_argument);
}

RangeProfile::Setup approach_setup() {
  RangeProfile::Setup setup;
  setup.T_sensor_target_at_epoch = Pose{upright_attitude(0.3, -0.2), Vec3(0.1, 0.2, 99)};
  setup.omega_radps = Vec3(0.02, -0.01, 0.03);
  setup.times_s = {1, 11, 31};
  setup.ranges_m = {60, 20, 30};
  setup.epoch_us = 5000000;
  return setup;
}

TEST(RangeProfile, IsAtItsRangesAtItsTimesAndRestsThere) {
  VERIFIES("LASSO-SIM-035~1");
  const RangeProfile motion(approach_setup());
  const double expected[][2] = {{-3, 60}, {0, 60}, {1, 60}, {6, 40}, {11, 20}, {21, 25}, {31, 30}, {500, 30}};
  for (const auto& [t_s, range_m] : expected) {
    const TruthState state = motion.at(5000000 + static_cast<TimeUs>(1e6 * t_s));
    EXPECT_NEAR((state.T_sensor_target.p - Vec3(0.1, 0.2, range_m)).norm(), 0, 1e-12) << t_s;
    const bool middle = t_s == 6 || t_s == 21;
    EXPECT_NEAR(state.rates.v_mps.z(), middle ? (t_s == 6 ? -6.0 : 0.75) : 0.0, 1e-12) << "half as fast again as on average";
  }
}

TEST(RangeProfile, PosesAndRatesAgree) {
  VERIFIES("LASSO-SIM-035~1");
  const RangeProfile motion(approach_setup());
  test::Generator generator(6);
  for (int trial = 0; trial < 50; ++trial) {
    const TimeUs t_us = 5000000 + static_cast<TimeUs>(generator.uniform(-2e6, 40e6));
    const TruthState now = motion.at(t_us);
    const Vec6 step = pose_difference(motion.at(t_us + 1000).T_sensor_target, motion.at(t_us - 1000).T_sensor_target) / 0.002;
    ASSERT_NEAR((step.head<3>() - now.rates.omega_radps).norm(), 0, 1e-9);
    ASSERT_NEAR((step.tail<3>() - now.rates.v_mps).norm(), 0, 1e-5);
  }
}

TEST(RangeProfile, RefusesWhatHasNoMeaning) {
  VERIFIES("LASSO-SIM-035~1");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const auto& change) {
    RangeProfile::Setup setup = approach_setup();
    change(setup);
    EXPECT_THROW(RangeProfile{setup}, std::invalid_argument);
  };
  refused([](auto& s) { s.T_sensor_target_at_epoch.q.coeffs() *= 1.1; });
  refused([nan](auto& s) { s.omega_radps.x() = nan; });
  refused([nan](auto& s) { s.times_s[1] = nan; });
  refused([nan](auto& s) { s.ranges_m[1] = nan; });
  refused([](auto& s) { s.times_s[1] = s.times_s[0]; });
  refused([](auto& s) { s.ranges_m.pop_back(); });
  refused([](auto& s) { s.times_s.clear(), s.ranges_m.clear(); });
}

}  // namespace
}  // namespace lasso::sim
