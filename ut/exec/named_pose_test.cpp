#include "fsw/exec/named_pose.hpp"

#include "ut/support/box_frames.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using StateError = Eigen::Matrix<double, 12, 1>;

struct KnownPose {
  Pose pose{normalized(Quat(0.8, 0.2, 0.5, -0.1)), Vec3(0.2, -0.1, 3)};
  Twist rates{Vec3(0.1, -0.2, 0.05), Vec3(0.05, 0.02, -0.1)};
};

// What an error of the filter's states makes of it.
KnownPose known_off(const KnownPose& truth, const StateError& error) {
  KnownPose known;
  known.pose.q = normalized(exp_so3(Vec3(error.segment<3>(0))) * truth.pose.q);
  known.pose.p = truth.pose.p + error.segment<3>(3);
  known.rates.omega_radps = truth.rates.omega_radps + error.segment<3>(6);
  known.rates.v_mps = truth.rates.v_mps + error.segment<3>(9);
  return known;
}

// Of the same, stated of the named frames, by products of poses and by the derivative of the position.
StateError difference_in(const NamedFrame& frame, const KnownPose& estimate, const KnownPose& truth) {
  const auto pose_in = [&](const KnownPose& of) { return frame.T_in_sensor * of.pose * frame.T_target_of; };
  const auto velocity_in = [&](const KnownPose& of) {
    constexpr double kStep_s = 1e-4;
    const auto at = [&](double dt_s) { return frame.T_in_sensor * (propagate(of.pose, of.rates, dt_s) * frame.T_target_of.p); };
    return Vec3((at(kStep_s) - at(-kStep_s)) / (2 * kStep_s));
  };
  StateError error;
  error.head<6>() = pose_difference(pose_in(estimate), pose_in(truth));
  error.segment<3>(6) = rotate(frame.T_in_sensor.q, Vec3(estimate.rates.omega_radps - truth.rates.omega_radps));
  error.tail<3>() = velocity_in(estimate) - velocity_in(truth);
  return error;
}

Mat12 full_covariance() {
  test::Generator random(12);
  Mat12 root;
  for (double& term : root.reshaped()) term = random.uniform(-1, 1);
  return root * root.transpose();
}

// The Jacobian by central differences, which knows no lever arms.
TEST(NamedPose, CovarianceIsMovedByTheDerivative) {
  VERIFIES("LASSO-LNK-050~1");
  const NamedFrame frame = test::grapple_in_port();
  const KnownPose truth;
  Mat12 J;
  constexpr double kStep = 1e-5;
  for (int k = 0; k < 12; ++k) {
    const StateError error = kStep * StateError::Unit(k);
    J.col(k) = (difference_in(frame, known_off(truth, error), truth) - difference_in(frame, known_off(truth, -error), truth)) / (2 * kStep);
  }
  const Mat12 expected = J * full_covariance() * J.transpose();
  const Mat12 moved = covariance_in(frame, truth.pose, truth.rates.omega_radps, full_covariance());
  EXPECT_LT((moved - expected).norm(), 1e-6 * expected.norm());
  EXPECT_GT((moved - full_covariance()).norm(), 0.1 * expected.norm()) << "the frames are apart";
}

TEST(NamedPose, RatesAreThoseOfTheFramesOwnOrigin) {
  VERIFIES("LASSO-LNK-050~1");
  const NamedFrame frame = test::grapple_in_port();
  const KnownPose truth;
  const Twist rates = rates_in(frame, truth.pose, truth.rates);
  const auto at = [&](double dt_s) { return frame.T_in_sensor * propagate(truth.pose, truth.rates, dt_s) * frame.T_target_of; };
  const Vec6 moved = pose_difference(at(1e-4), at(-1e-4)) / 2e-4;
  EXPECT_LT((rates.omega_radps - moved.head<3>()).norm(), 1e-7);
  EXPECT_LT((rates.v_mps - moved.tail<3>()).norm(), 1e-7);
}

TEST(NamedPose, TellsRegistrationAndFilterEach) {
  VERIFIES("LASSO-LNK-050~1");
  const NamedFrame frame = test::grapple_in_port();
  const KnownPose truth;
  Registration registration;
  registration.scan_id = 5;
  registration.t_us = 77;
  registration.T_sensor_target = truth.pose;
  registration.covariance = full_covariance().topLeftCorner<6, 6>();
  FilterState filter;
  filter.t_us = 78;
  filter.T_sensor_target = known_off(truth, 0.01 * StateError::Ones()).pose;
  filter.rates = truth.rates;
  filter.covariance = full_covariance();
  NamedPoseTelemetry told = make_named_pose_report(frame, registration, filter);
  EXPECT_EQ(told.scan_id, 5U);
  EXPECT_EQ(told.t_measurement_us, 77);
  EXPECT_EQ(told.t_filter_us, 78);
  EXPECT_EQ(told.valid, 0);
  EXPECT_EQ(told.started, 0);
  const Pose measured = frame.T_in_sensor * registration.T_sensor_target * frame.T_target_of;
  const Pose filtered = frame.T_in_sensor * filter.T_sensor_target * frame.T_target_of;
  const Twist rates = rates_in(frame, filter.T_sensor_target, filter.rates);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(told.q_in_of[i], measured.q.coeffs()[i]);
    EXPECT_EQ(told.filter_q_in_of[i], filtered.q.coeffs()[i]);
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(told.p_in_of_m[i], measured.p[i]);
    EXPECT_EQ(told.filter_p_in_of_m[i], filtered.p[i]);
    EXPECT_EQ(told.filter_omega_radps[i], rates.omega_radps[i]);
    EXPECT_EQ(told.filter_v_mps[i], rates.v_mps[i]);
  }
  const Mat12 of_filter = covariance_in(frame, filter.T_sensor_target, filter.rates.omega_radps, filter.covariance);
  const Mat12 of_pose = covariance_in(frame, truth.pose, Vec3::Zero(), full_covariance());
  std::size_t term = 0;
  for (int row = 0; row < 12; ++row) {
    for (int column = row; column < 12; ++column) EXPECT_EQ(told.filter_covariance[term++], static_cast<float>(of_filter(row, column)));
  }
  term = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) EXPECT_NEAR(told.covariance[term++], of_pose(row, column), 1e-6);
  }
  filter.initialised = true;
  registration.reason = PoseReason::kValid;
  told = make_named_pose_report(frame, registration, filter);
  EXPECT_EQ(told.started, 1);
  EXPECT_EQ(told.valid, 1);
}

}  // namespace
}  // namespace lasso
