// What the filter refuses (pose_filter.hpp).
#include <limits>

#include "ut/pose/filter_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(FilterInput, BadStartsAreRefused) {
  VERIFIES("LASSO-FLT-010~1");
  Generator random(12);
  FilterState state = generic_state(random);
  const FilterState before = state;
  const FilterStart good = generic_start(random);
  const auto refused = [&](auto damage) {
    FilterStart start = good;
    damage(start);
    const Status status = start_filter(state, start);
    EXPECT_TRUE(same(state, before));
    return status;
  };
  EXPECT_EQ(refused([](FilterStart& s) { s.T_sensor_target.q.x() = kNan; }), Status::kNotFinite);
  EXPECT_EQ(refused([](FilterStart& s) { s.T_sensor_target.p.y() = kNan; }), Status::kNotFinite);
  EXPECT_EQ(refused([](FilterStart& s) { s.T_sensor_target.q.coeffs() *= 1.001; }), Status::kBadValue);
  EXPECT_EQ(refused([](FilterStart& s) { s.rates.omega_radps.z() = kNan; }), Status::kNotFinite);
  EXPECT_EQ(refused([](FilterStart& s) { s.rates.v_mps.z() = kNan; }), Status::kNotFinite);
  EXPECT_EQ(refused([](FilterStart& s) { s.sigma_omega_radps = kNan; }), Status::kNotFinite);
  EXPECT_EQ(refused([](FilterStart& s) { s.sigma_v_mps = kNan; }), Status::kNotFinite);
  EXPECT_EQ(refused([](FilterStart& s) { s.sigma_omega_radps = 0; }), Status::kBadValue);
  EXPECT_EQ(refused([](FilterStart& s) { s.sigma_v_mps = -1; }), Status::kBadValue);
  EXPECT_EQ(refused([](FilterStart& s) { s.sigma_v_mps = 1e200; }), Status::kNotFinite) << "its square";
  EXPECT_EQ(refused([](FilterStart& s) { s.pose_covariance(2, 3) = kNan; }), Status::kNotFinite);
  EXPECT_EQ(refused([](FilterStart& s) { s.pose_covariance(4, 4) = 0; }), Status::kBadValue);
  EXPECT_EQ(refused([](FilterStart& s) { s.pose_covariance(1, 0) += 1e-6; }), Status::kBadValue) << "not symmetric";
  EXPECT_EQ(refused([](FilterStart& s) { s.pose_covariance(1, 0) = s.pose_covariance(0, 1) = 1; }), Status::kBadValue);
}

TEST(FilterInput, BadPredictionsAreRefused) {
  VERIFIES("LASSO-FLT-010~1");
  Generator random(13);
  FilterState state = generic_state(random);
  const FilterState before = state;
  PredictedPose predicted;
  const TimeUs next = state.t_us + 200'000;
  EXPECT_EQ(predict_filter(state, state.t_us - 1, kNoise), Status::kBadOrder);
  EXPECT_EQ(predict_pose(state, state.t_us - 1, predicted), Status::kBadOrder);
  EXPECT_EQ(predict_filter(state, state.t_us + kMaxPredictionUs + 1, kNoise), Status::kBadValue);
  EXPECT_EQ(predict_pose(state, std::numeric_limits<TimeUs>::max(), predicted), Status::kBadValue);
  EXPECT_EQ(predict_filter(state, next, {kNan, 1}), Status::kNotFinite);
  EXPECT_EQ(predict_filter(state, next, {1, kNan}), Status::kNotFinite);
  EXPECT_EQ(predict_filter(state, next, {-1, 1}), Status::kBadValue);
  EXPECT_EQ(predict_filter(state, next, {1, -1}), Status::kBadValue);
  EXPECT_EQ(predict_filter(state, next, {1, 1, kNan}), Status::kNotFinite);
  EXPECT_EQ(predict_filter(state, next, {1, 1, -1}), Status::kBadValue);
  EXPECT_EQ(predict_filter(state, next, {1e200, 1}), Status::kNotFinite);
  EXPECT_TRUE(same(state, before));
  EXPECT_EQ(predict_filter(state, state.t_us + kMaxPredictionUs, kNoise), Status::kOk);
  FilterState early = before;
  early.t_us = std::numeric_limits<TimeUs>::min();
  EXPECT_EQ(predict_filter(early, std::numeric_limits<TimeUs>::max(), kNoise), Status::kBadValue);
}

TEST(FilterInput, RatesOutOfAllBoundsAreRefused) {
  VERIFIES("LASSO-FLT-010~1");
  Generator random(14);
  FilterStart start = generic_start(random);
  FilterState state;
  PredictedPose predicted;
  start.rates.omega_radps = Vec3(1e5, 0, 0);
  ASSERT_EQ(start_filter(state, start), Status::kOk);
  EXPECT_EQ(predict_filter(state, state.t_us + 1'000'000, kNoise), Status::kBadValue);
  start.rates = {Vec3::Zero(), Vec3(1.7e308, 0, 0)};
  ASSERT_EQ(start_filter(state, start), Status::kOk);
  EXPECT_EQ(predict_filter(state, state.t_us + 2'000'000, kNoise), Status::kNotFinite);
  EXPECT_EQ(predict_pose(state, state.t_us + 2'000'000, predicted), Status::kNotFinite);
}

TEST(FilterInput, BadMeasurementsAreRefused) {
  VERIFIES("LASSO-FLT-010~1");
  Generator random(15);
  FilterState state = generic_state(random);
  const FilterState before = state;
  const PoseMeasurement good{state.t_us, state.T_sensor_target, covariance_of(random, 1e-3, 1e-3)};
  const auto refused = [&](auto damage, double gate = kNoGate) {
    PoseMeasurement measured = good;
    damage(measured);
    const FilterUpdate result = update_filter(state, measured, gate);
    EXPECT_FALSE(result.accepted);
    EXPECT_TRUE(same(state, before));
    return result.status;
  };
  EXPECT_EQ(refused([](PoseMeasurement& m) { ++m.t_us; }), Status::kBadOrder);
  EXPECT_EQ(refused([](PoseMeasurement& m) { --m.t_us; }), Status::kBadOrder);
  EXPECT_EQ(refused([](PoseMeasurement& m) { m.T_sensor_target.p.x() = kNan; }), Status::kNotFinite);
  EXPECT_EQ(refused([](PoseMeasurement& m) { m.T_sensor_target.p.x() = 1e200; }), Status::kNotFinite) << "its square";
  EXPECT_EQ(refused([](PoseMeasurement& m) { m.T_sensor_target.q.w() = kNan; }), Status::kNotFinite);
  EXPECT_EQ(refused([](PoseMeasurement& m) { m.T_sensor_target.q.coeffs() *= 0.5; }), Status::kBadValue);
  EXPECT_EQ(refused([](PoseMeasurement& m) { m.covariance(0, 5) = kNan; }), Status::kNotFinite);
  EXPECT_EQ(refused([](PoseMeasurement& m) { m.covariance.setZero(); }), Status::kBadValue);
  EXPECT_EQ(refused([](PoseMeasurement&) {}, kNan), Status::kNotFinite);
  EXPECT_EQ(refused([](PoseMeasurement&) {}, -1), Status::kBadValue);
}

TEST(FilterInput, AnInnovationWithoutInverseIsSingular) {
  VERIFIES("LASSO-FLT-010~1");
  Generator random(16);
  FilterStart start = generic_start(random);
  const Vec6 one = Vec6::Constant(1e-3);
  start.pose_covariance = one * one.transpose();  // six names for one direction
  FilterState state;
  ASSERT_EQ(start_filter(state, start), Status::kOk);
  const FilterState before = state;
  EXPECT_EQ(update_filter(state, {state.t_us, state.T_sensor_target, one * one.transpose()}, kNoGate).status, Status::kSingular);
  EXPECT_TRUE(same(state, before));
}

TEST(FilterInput, NothingWorksBeforeTheStart) {
  VERIFIES("LASSO-FLT-010~1");
  FilterState state;
  PredictedPose predicted;
  EXPECT_EQ(predict_filter(state, 0, kNoise), Status::kNoData);
  EXPECT_EQ(predict_pose(state, 0, predicted), Status::kNoData);
  PoseMeasurement measured;
  measured.covariance.setIdentity();
  EXPECT_EQ(update_filter(state, measured, kNoGate).status, Status::kNoData);
}

}  // namespace
}  // namespace lasso::test
