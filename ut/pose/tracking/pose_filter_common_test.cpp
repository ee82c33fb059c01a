// The filter where the scans' errors have a part in common: against a dense filter of state and common errors, and against chance.
#include "fsw/pose/tracking/pose_filter.hpp"
#include "ut/pose/filter_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::test {
namespace {

CommonErrors generic_common(Generator& random, double size) {
  CommonErrors G = CommonErrors::Zero();
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 4; ++column) G(row, column) = size * random.normal();
  }
  return G;
}

FilterNoise with_memory(double memory_s) {
  FilterNoise noise = kNoise;
  noise.common_memory_s = memory_s;
  return noise;
}

// State error and common errors together, 16 x 16, as the definition has it: the common errors get no correction.
struct DenseFilter {
  Dense P = Dense::Zero(16, 16);

  explicit DenseFilter(const Mat12& covariance) {
    P.topLeftCorner(12, 12) = covariance;
    P.bottomRightCorner(4, 4).setIdentity();
  }
  void predict(const Mat12& F, const Mat12& Q, double kept) {
    Dense step = Dense::Zero(16, 16);
    step.topLeftCorner(12, 12) = F;
    step.bottomRightCorner(4, 4) = kept * Dense::Identity(4, 4);
    P = congruence(step, P);
    P.topLeftCorner(12, 12) += Q;
    P.bottomRightCorner(4, 4) += (1 - kept * kept) * Dense::Identity(4, 4);
  }
  // Answers the gain.
  Dense update(const Mat6& R_white, const CommonErrors& G) {
    Dense H = Dense::Zero(6, 16);
    H.leftCols(6).setIdentity();
    H.rightCols(4) = -G;
    const Dense S = congruence(H, P) + R_white;
    Dense K = P * H.transpose() * inverse_of(S);
    K.bottomRows(4).setZero();
    P = congruence(Dense(Dense::Identity(16, 16) - K * H), P) + congruence(K, R_white);
    return K;
  }
};

Mat12 process_noise(const Vec3& omega_radps, double dt) {
  FilterState still;
  Generator random(1);
  still = started(random);
  still.rates.omega_radps = omega_radps;
  still.covariance.setZero();
  still.covariance.diagonal().setConstant(1e-30);
  EXPECT_EQ(predict_filter(still, still.t_us + static_cast<DurationUs>(dt * 1e6), kNoise), Status::kOk);
  return still.covariance;
}

TEST(FilterCommon, StateAndCovarianceAreThoseOfTheDenseConsiderFilter) {
  VERIFIES("LASSO-FLT-015~1");
  Generator random(11);
  FilterState state = started(random);
  DenseFilter dense(state.covariance);
  const double memory_s = 1.7, dt = 0.2;
  for (int k = 0; k < 12; ++k) {
    const Mat12 F = error_transition(state.rates.omega_radps, dt), Q = process_noise(state.rates.omega_radps, dt);
    ASSERT_EQ(predict_filter(state, state.t_us + 200'000, with_memory(memory_s)), Status::kOk);
    dense.predict(F, Q, std::exp(-dt / memory_s));
    const CommonErrors G = generic_common(random, 2e-3);
    const Mat6 white = covariance_of(random, 0.002, 0.003);
    const Vec6 offset = 0.002 * normals<Vec6>(random);
    const PoseMeasurement measured{state.t_us, disturbed(state.T_sensor_target, offset), white + G * G.transpose(), G};
    const Dense before = dense.P;
    const FilterState predicted = state;
    const FilterUpdate update = update_filter(state, measured, kNoGate);
    const Dense K = dense.update(white, G);
    ASSERT_TRUE(update.accepted);
    Dense H = Dense::Zero(6, 16);
    H.leftCols(6).setIdentity();
    H.rightCols(4) = -G;
    const Dense S = congruence(H, before) + white;
    EXPECT_NEAR(update.nis, offset.dot(Vec6(inverse_of(S) * offset)), 1e-6 * update.nis) << k;
    const Dense step = K * offset;
    EXPECT_LT((state.T_sensor_target.p - predicted.T_sensor_target.p - Vec3(step.block(3, 0, 3, 1))).norm(), 1e-9) << k;
    EXPECT_LT((state.rates.v_mps - predicted.rates.v_mps - Vec3(step.block(9, 0, 3, 1))).norm(), 1e-9) << k;
    EXPECT_LT((state.covariance - dense.P.topLeftCorner(12, 12)).cwiseAbs().maxCoeff(), 1e-10) << k;
    EXPECT_LT((state.common_pose - dense.P.block(0, 12, 6, 4)).cwiseAbs().maxCoeff(), 1e-10) << k;
    EXPECT_LT((state.common_rates - dense.P.block(6, 12, 6, 4)).cwiseAbs().maxCoeff(), 1e-10) << k;
  }
  expect_symmetric_positive(state.covariance);
}

// A common error that lasts is not averaged out: its variance stays in the pose's, whatever the number of scans.
TEST(FilterCommon, WhatLastsStaysAndWhatIsNewInEachScanAveragesOut) {
  VERIFIES("LASSO-FLT-015~1");
  for (const double memory_s : {0.0, 1e6}) {
    Generator random(12);
    FilterStart start = generic_start(random);
    start.pose_covariance *= 1e6;  // nothing else tells where the target is
    FilterState state;
    ASSERT_EQ(start_filter(state, start), Status::kOk);
    FilterNoise noise;  // nothing disturbs the target
    noise.common_memory_s = memory_s;
    CommonErrors G = CommonErrors::Zero();
    G(5, 0) = 0.01;
    const Mat6 white = covariance_of(random, 1e-4, 1e-4);
    for (int k = 0; k < 400; ++k) {
      ASSERT_EQ(predict_filter(state, state.t_us + 200'000, noise), Status::kOk);
      ASSERT_TRUE(update_filter(state, {state.t_us, state.T_sensor_target, white + G * G.transpose(), G}, kNoGate).accepted);
    }
    const double sigma_m = std::sqrt(state.covariance(5, 5));
    EXPECT_EQ(sigma_m > 0.0099, memory_s > 0) << sigma_m;
    EXPECT_EQ(sigma_m < 0.0015, memory_s == 0) << sigma_m;  // 0.01 * 2 / sqrt(400) at the end of a line that is fitted to them
  }
}

// By chance: truth, scans and common errors are drawn, and the errors at the end weighed by the covariance.
double mean_square_of_errors(bool told) {
  Generator random(13);
  const double memory_s = 3, dt = 0.2, kept = std::exp(-dt / memory_s);
  double sum = 0;
  constexpr int kTrials = 60;
  for (int trial = 0; trial < kTrials; ++trial) {
    const FilterStart start = generic_start(random);
    const Dense root = cholesky_of(start.pose_covariance);
    Truth truth{disturbed(start.T_sensor_target, Vec6(root * normals<Vec6>(random))), start.rates};
    truth.rates.omega_radps += start.sigma_omega_radps * normals<Vec3>(random);
    truth.rates.v_mps += start.sigma_v_mps * normals<Vec3>(random);
    FilterState state;
    EXPECT_EQ(start_filter(state, start), Status::kOk);
    Eigen::Vector4d common = normals<Eigen::Vector4d>(random);
    const CommonErrors G = generic_common(random, 4e-3);
    const Mat6 white = covariance_of(random, 0.001, 0.001);
    for (int k = 0; k < 25; ++k) {
      truth.move(dt, kNoise.angular_acceleration_radps2 * normals<Vec3>(random), kNoise.acceleration_mps2 * normals<Vec3>(random));
      common = kept * common + std::sqrt(1 - kept * kept) * normals<Eigen::Vector4d>(random);
      EXPECT_EQ(predict_filter(state, state.t_us + 200'000, with_memory(memory_s)), Status::kOk);
      PoseMeasurement measured = measure(truth, state.t_us, white, random);
      measured.T_sensor_target = disturbed(measured.T_sensor_target, G * common);
      measured.covariance += G * G.transpose();
      if (told) measured.common = G;
      EXPECT_TRUE(update_filter(state, measured, kNoGate).accepted);
    }
    const Vec12 error = error_of(state, truth);
    sum += error.dot(Vec12(solution_of(state.covariance, error)));
  }
  return sum / kTrials;
}

TEST(FilterCommon, ErrorsAreWithinTheCovarianceWhereCommonErrorsAreTold) {
  VERIFIES("LASSO-FLT-015~1");
  const double told = mean_square_of_errors(true);
  EXPECT_NEAR(told, 12, 4 * std::sqrt(2 * 12 / 60.0));
  EXPECT_GT(mean_square_of_errors(false), 2 * told) << "the same scans, taken for independent";
}

// For given common errors, by the Schur complement; and how far predictions were off is measured beside them.
TEST(FilterCommon, WhatCommonErrorsExplainIsNotTheFilters) {
  VERIFIES("LASSO-FLT-015~1 LASSO-FLT-013~1");
  Generator random(15);
  FilterState state = started(random);
  CommonErrors G = CommonErrors::Zero();
  G(3, 0) = G(4, 1) = G(5, 2) = 0.02;
  const Mat6 white = covariance_of(random, 1e-3, 1e-3);
  for (int k = 0; k < 200; ++k) {
    ASSERT_EQ(predict_filter(state, state.t_us + 200'000, with_memory(1e6)), Status::kOk);
    const Vec6 noise = cholesky_of(white) * normals<Vec6>(random);
    const Vec6 jump = 4e-3 * normals<Vec6>(random);  // of the target
    const PoseMeasurement measured{state.t_us, disturbed(state.T_sensor_target, noise + jump), white + G * G.transpose(), G};
    ASSERT_TRUE(update_filter(state, measured, kNoGate).accepted);
  }
  Dense joint = Dense::Zero(10, 10);
  joint.topLeftCorner(6, 6) = state.covariance.topLeftCorner<6, 6>();
  joint.topRightCorner(6, 4) = state.common_pose;
  joint.bottomLeftCorner(4, 6) = state.common_pose.transpose();
  joint.bottomRightCorner(4, 4).setIdentity();
  const Dense given = inverse_of(Dense(inverse_of(joint).topLeftCorner(6, 6)));
  const Mat6 relative = relative_covariance(state);
  EXPECT_LT((relative - given).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(std::sqrt(relative(5, 5)), 0.005) << "the error of 20 mm is in all scans";
  EXPECT_GT(state.innovation_ratio[5], 2 * kLeastInnovationRatio) << "predictions are off, beside it";
  EXPECT_TRUE(is_sound(state));
  forget_common_errors(state);
  EXPECT_EQ(relative_covariance(state)(5, 5), state.covariance(5, 5));
  state.common_pose(5, 0) = 0.03;
  EXPECT_FALSE(is_sound(state)) << "a flipped bit";
}

TEST(FilterCommon, CommonErrorsThatAreNoNumbersAreRefused) {
  VERIFIES("LASSO-FLT-015~1");
  Generator random(16);
  FilterState state = started(random);
  const FilterState before = state;
  PoseMeasurement measured{state.t_us, state.T_sensor_target, covariance_of(random, 1e-3, 1e-3)};
  measured.common(2, 1) = std::nan("");
  EXPECT_EQ(update_filter(state, measured, kNoGate).status, Status::kNotFinite);
  EXPECT_TRUE(same(state, before));
}

TEST(FilterCommon, AMemoryThatIsNoneIsRefused) {
  VERIFIES("LASSO-FLT-015~1");
  Generator random(14);
  FilterState state = started(random);
  EXPECT_EQ(predict_filter(state, state.t_us + 1000, with_memory(-1)), Status::kBadValue);
}

}  // namespace
}  // namespace lasso::test
