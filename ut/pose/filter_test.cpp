#include "fsw/pose/filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "fsw/geometry/portable_math.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using Vec12 = Eigen::Matrix<double, 12, 1>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr FilterNoise kNoise{0.01, 0.5 * kRadPerDeg};

// SplitMix64 (Steele, Lea & Flood 2014) and the polar method: the same numbers with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double uniform() {
    state_ += 0x9E3779B97F4A7C15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
  double normal() {
    for (;;) {
      const double u = 2 * uniform() - 1;
      const double v = 2 * uniform() - 1;
      const double s = u * u + v * v;
      if (s > 0 && s < 1) return u * std::sqrt(-2 * std::log(s) / s);
    }
  }
  template <class V>
  V normals() {
    V v;
    for (int i = 0; i < v.size(); ++i) v[i] = normal();
    return v;
  }
  Quat attitude() { return Quat(normals<Eigen::Vector4d>().normalized()); }

 private:
  std::uint64_t state_;
};

// Rotation by Eigen's angle and axis: independent of the flight code's exponential.
Quat turn(const Vec3& rotation) {
  const double angle = rotation.norm();
  return angle > 0 ? Quat(Eigen::AngleAxisd(angle, rotation / angle)) : Quat::Identity();
}

Vec3 rotation_between(const Quat& estimate, const Quat& truth) {
  const Eigen::AngleAxisd difference((estimate * truth.conjugate()).normalized());
  const double angle = difference.angle() > kPi ? difference.angle() - 2 * kPi : difference.angle();
  return angle * difference.axis();
}

struct Truth {
  Pose pose;
  Twist rates;

  // Constant accelerations over the step; the attitude by 20 midpoint turns.
  void move(double dt, const Vec3& angular_acceleration, const Vec3& acceleration) {
    const double h = dt / 20;
    for (int i = 0; i < 20; ++i) pose.q = turn((rates.omega_radps + (i + 0.5) * h * angular_acceleration) * h) * pose.q;
    pose.q.normalize();
    pose.p += rates.v_mps * dt + 0.5 * dt * dt * acceleration;
    rates.omega_radps += dt * angular_acceleration;
    rates.v_mps += dt * acceleration;
  }
};

Vec12 error_of(const FilterState& state, const Truth& truth) {
  Vec12 e;
  e << rotation_between(state.T_sensor_target.q, truth.pose.q), state.T_sensor_target.p - truth.pose.p,
      state.rates.omega_radps - truth.rates.omega_radps, state.rates.v_mps - truth.rates.v_mps;
  return e;
}

// A correlated covariance with the given sigmas, as a weakly seen target gives one.
Mat6 covariance_of(Random& random, double sigma_rotation, double sigma_translation) {
  Mat6 factor = 1.5 * Mat6::Identity();
  for (int i = 0; i < 36; ++i) factor.data()[i] += random.normal();
  Vec6 scale;
  scale << Vec3::Constant(sigma_rotation), Vec3::Constant(sigma_translation);
  return scale.asDiagonal() * (factor * factor.transpose() / 8) * scale.asDiagonal();
}

Pose disturbed(const Pose& pose, const Vec6& error) { return {turn(error.head<3>()) * pose.q, pose.p + error.tail<3>()}; }

PoseMeasurement measure(const Truth& truth, TimeUs t_us, const Mat6& covariance, Random& random) {
  const Vec6 error = covariance.llt().matrixL() * random.normals<Vec6>();
  return {t_us, disturbed(truth.pose, error), covariance};
}

FilterStart generic_start(Random& random) {
  FilterStart start;
  start.t_us = 1'700'000'000'000'000;
  start.T_sensor_target = {random.attitude(), Vec3(0.3, -0.2, 4.1)};
  start.rates = {Vec3(0.05, -0.08, 0.03), Vec3(0.02, -0.05, 0.1)};
  start.pose_covariance = covariance_of(random, 0.01, 0.005);
  start.sigma_omega_radps = 2 * kRadPerDeg;
  start.sigma_v_mps = 0.05;
  return start;
}

FilterState started(Random& random) {
  FilterState state;
  EXPECT_EQ(start_filter(state, generic_start(random)), Status::kOk);
  return state;
}

// A state in which everything is correlated with everything.
FilterState generic_state(Random& random) {
  FilterState state = started(random);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(predict_filter(state, state.t_us + 200'000, kNoise), Status::kOk);
    const PoseMeasurement measured{state.t_us, disturbed(state.T_sensor_target, 0.003 * random.normals<Vec6>()),
                                   covariance_of(random, 0.002, 0.003)};
    EXPECT_TRUE(update_filter(state, measured, kNoGate).accepted);
  }
  return state;
}

bool same(const FilterState& a, const FilterState& b) {
  return a.t_us == b.t_us && a.T_sensor_target.q.coeffs() == b.T_sensor_target.q.coeffs() && a.T_sensor_target.p == b.T_sensor_target.p &&
         a.rates.omega_radps == b.rates.omega_radps && a.rates.v_mps == b.rates.v_mps && a.covariance == b.covariance &&
         a.initialised == b.initialised && a.accepted == b.accepted && a.rejected == b.rejected;
}

void expect_symmetric_positive(const Mat12& P) {
  EXPECT_TRUE(P == P.transpose());
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Mat12>(P).eigenvalues().minCoeff(), 0);
}

TEST(Filter, StartTakesPoseRatesAndSigmas) {
  VERIFIES("LASSO-FLT-001~1");
  Random random(1);
  const FilterStart start = generic_start(random);
  FilterState state;
  ASSERT_EQ(start_filter(state, start), Status::kOk);
  EXPECT_TRUE(state.initialised);
  EXPECT_EQ(state.t_us, start.t_us);
  EXPECT_TRUE(state.T_sensor_target.q.coeffs() == start.T_sensor_target.q.coeffs());
  EXPECT_TRUE(state.rates.v_mps == start.rates.v_mps);
  Mat12 expected = Mat12::Zero();
  expected.topLeftCorner<6, 6>() = start.pose_covariance;
  expected.diagonal().segment<3>(6).setConstant(start.sigma_omega_radps * start.sigma_omega_radps);
  expected.diagonal().segment<3>(9).setConstant(start.sigma_v_mps * start.sigma_v_mps);
  EXPECT_LT((state.covariance - expected).cwiseAbs().maxCoeff(), 1e-18);
}

TEST(Filter, ErrorTransitionIsTheDerivativeOfThePropagation) {
  VERIFIES("LASSO-FLT-002~1");
  Random random(2);
  for (const double rate : {1e-3, 0.04, 0.9, 6.0}) {  // with dt, both sides of the series' limit, up to more than a radian a step
    const double dt = 0.23, h = 1e-6;
    const Pose pose{random.attitude(), random.normals<Vec3>()};
    const Twist rates{rate * random.normals<Vec3>(), random.normals<Vec3>()};
    const Mat12 F = error_transition(rates.omega_radps, dt);
    for (int column = 0; column < 12; ++column) {
      Vec12 after[2];
      for (int side = 0; side < 2; ++side) {
        Vec12 e = Vec12::Zero();
        e[column] = side == 0 ? h : -h;
        Truth moved{disturbed(pose, e.head<6>()), {rates.omega_radps + e.segment<3>(6), rates.v_mps + e.tail<3>()}}, truth{pose, rates};
        moved.move(dt, Vec3::Zero(), Vec3::Zero());
        truth.move(dt, Vec3::Zero(), Vec3::Zero());
        after[side] << pose_difference(moved.pose, truth.pose), moved.rates.omega_radps - truth.rates.omega_radps,
            moved.rates.v_mps - truth.rates.v_mps;
      }
      EXPECT_LT(((after[0] - after[1]) / (2 * h) - F.col(column)).cwiseAbs().maxCoeff(), 2e-9) << rate << " " << column;
    }
  }
}

TEST(Filter, PredictionFollowsConstantRatesAndTheDenseCovarianceEquation) {
  VERIFIES("LASSO-FLT-002~1 LASSO-FLT-003~1");
  Random random(3);
  FilterState state = generic_state(random);
  const FilterState before = state;
  const double dt = 0.35;
  ASSERT_EQ(predict_filter(state, before.t_us + 350'000, kNoise), Status::kOk);
  Truth truth{before.T_sensor_target, before.rates};
  truth.move(dt, Vec3::Zero(), Vec3::Zero());
  EXPECT_LT(error_of(state, truth).norm(), 1e-12);
  EXPECT_EQ(state.t_us, before.t_us + 350'000);
  const Mat12 F = error_transition(before.rates.omega_radps, dt);
  Eigen::Matrix<double, 12, 6> G = Eigen::Matrix<double, 12, 6>::Zero();  // how an acceleration acts on the state
  G.topRows<6>() = 0.5 * dt * dt * Mat6::Identity();
  G.bottomRows<6>() = dt * Mat6::Identity();
  Vec6 sigma;
  sigma << Vec3::Constant(kNoise.angular_acceleration_radps2), Vec3::Constant(kNoise.acceleration_mps2);
  const Mat6 accelerations = sigma.cwiseAbs2().asDiagonal();
  const Mat12 expected = F * before.covariance * F.transpose() + G * accelerations * G.transpose();
  EXPECT_LT((state.covariance - expected).cwiseAbs().maxCoeff(), 1e-16);
}

TEST(Filter, UpdateEqualsTheInformationForm) {
  VERIFIES("LASSO-FLT-004~1");
  Random random(4);
  FilterState state = generic_state(random);
  const FilterState before = state;
  const Vec6 offset = 0.002 * random.normals<Vec6>();
  const PoseMeasurement measured{state.t_us, disturbed(state.T_sensor_target, offset), covariance_of(random, 0.003, 0.002)};
  const FilterUpdate result = update_filter(state, measured, kNoGate);
  ASSERT_EQ(result.status, Status::kOk);
  EXPECT_TRUE(result.accepted);
  EXPECT_EQ(state.accepted, before.accepted + 1);
  const Mat6 R_inverse = measured.covariance.inverse();
  Mat12 information = before.covariance.inverse();
  information.topLeftCorner<6, 6>() += R_inverse;
  const Mat12 expected = information.inverse();
  EXPECT_LT((state.covariance - expected).norm() / expected.norm(), 1e-9);
  const Vec12 step = expected.leftCols<6>() * R_inverse * offset;
  const Truth prior{before.T_sensor_target, before.rates};
  EXPECT_LT((error_of(state, prior) - step).norm(), 1e-11);
  const Mat6 S = before.covariance.topLeftCorner<6, 6>() + measured.covariance;
  EXPECT_NEAR(result.nis, offset.dot(S.llt().solve(offset)), 1e-8 * result.nis);
}

TEST(Filter, WeakDirectionsOfTheMeasurementCoast) {
  VERIFIES("LASSO-FLT-005~1");
  Random random(5);
  FilterState state = generic_state(random);
  const FilterState before = state;
  Vec6 weak = random.normals<Vec6>().normalized();
  // Nothing is known along `weak`; one millimetre or milliradian across it.
  const Mat6 R = 1e-6 * Mat6::Identity() + 1e2 * weak * weak.transpose();
  const Vec6 across = 0.003 * (Mat6::Identity() - weak * weak.transpose()) * random.normals<Vec6>();
  const PoseMeasurement measured{state.t_us, disturbed(state.T_sensor_target, across), R};
  ASSERT_TRUE(update_filter(state, measured, kNoGate).accepted);
  Mat12 information = before.covariance.inverse();
  information.topLeftCorner<6, 6>() += 1e6 * (Mat6::Identity() - weak * weak.transpose()) + 1e-2 * weak * weak.transpose();
  const Mat12 expected = information.inverse();
  EXPECT_LT((state.covariance - expected).norm() / expected.norm(), 1e-6);
  expect_symmetric_positive(state.covariance);
  // Far off along the weak direction: it changes almost nothing.
  const FilterState middle = state;
  const PoseMeasurement slid{state.t_us, disturbed(state.T_sensor_target, 0.2 * weak), R};
  ASSERT_TRUE(update_filter(state, slid, kNoGate).accepted);
  EXPECT_LT(pose_difference(state.T_sensor_target, middle.T_sensor_target).norm(), 2e-6);
}

struct Honesty {
  double nees = 0, nis = 0;
  int count = 0;
};

void track(Random& random, Honesty& sums) {
  const FilterStart start = generic_start(random);
  Truth truth{start.T_sensor_target, start.rates};
  FilterStart drawn = start;
  drawn.T_sensor_target = measure(truth, 0, start.pose_covariance, random).T_sensor_target;
  drawn.rates.omega_radps += start.sigma_omega_radps * random.normals<Vec3>();
  drawn.rates.v_mps += start.sigma_v_mps * random.normals<Vec3>();
  FilterState state;
  ASSERT_EQ(start_filter(state, drawn), Status::kOk);
  for (int frame = 0; frame < 60; ++frame) {
    truth.move(0.2, kNoise.angular_acceleration_radps2 * random.normals<Vec3>(), kNoise.acceleration_mps2 * random.normals<Vec3>());
    ASSERT_EQ(predict_filter(state, state.t_us + 200'000, kNoise), Status::kOk);
    const FilterUpdate result = update_filter(state, measure(truth, state.t_us, covariance_of(random, 0.0007, 0.0005), random), kNoGate);
    ASSERT_TRUE(result.accepted);
    const Vec12 error = error_of(state, truth);
    sums.nees += error.dot(state.covariance.ldlt().solve(error));
    sums.nis += result.nis;
    ++sums.count;
  }
}

TEST(Filter, CovarianceIsHonest) {
  VERIFIES("LASSO-FLT-006~1");
  Random random(6);
  Honesty sums;
  for (int run = 0; run < 200; ++run) ASSERT_NO_FATAL_FAILURE(track(random, sums));
  const double nees = sums.nees / sums.count, nis = sums.nis / sums.count;
  RecordProperty("nees_of_12", std::to_string(nees));
  RecordProperty("nis_of_6", std::to_string(nis));
  EXPECT_NEAR(nees, 12, 0.1 * 12);
  EXPECT_NEAR(nis, 6, 0.1 * 6);
}

TEST(Filter, RatesConvergeToASpinAndADrift) {
  VERIFIES("LASSO-FLT-007~1");
  Random random(7);
  for (const bool noisy : {false, true}) {
    FilterStart start = generic_start(random);
    Truth truth{start.T_sensor_target, {5 * kRadPerDeg * Vec3(0.48, -0.6, 0.64), 0.1 * Vec3(-0.6, 0.48, 0.64)}};
    start.rates = Twist{};
    start.sigma_omega_radps = 10 * kRadPerDeg;
    FilterState state;
    ASSERT_EQ(start_filter(state, start), Status::kOk);
    for (int frame = 0; frame < 150; ++frame) {
      truth.move(0.2, Vec3::Zero(), Vec3::Zero());
      ASSERT_EQ(predict_filter(state, state.t_us + 200'000, kNoise), Status::kOk);
      PoseMeasurement measured = measure(truth, state.t_us, covariance_of(random, 0.0007, 0.001), random);
      if (!noisy) measured.T_sensor_target = truth.pose;
      ASSERT_TRUE(update_filter(state, measured, kNoGate).accepted);
    }
    const Vec12 error = error_of(state, truth);
    EXPECT_LT(error.segment<3>(6).norm(), noisy ? 0.3 * kRadPerDeg : 1e-9) << noisy;
    EXPECT_LT(error.tail<3>().norm(), noisy ? 0.01 : 1e-9) << noisy;
  }
}

TEST(Filter, TheGateKeepsOutliersOutAndCountsThem) {
  VERIFIES("LASSO-FLT-008~1");
  Random random(8);
  FilterState state = generic_state(random);
  const FilterState before = state;
  Vec6 offset = Vec6::Zero();
  offset[4] = 0.05;
  const PoseMeasurement measured{state.t_us, disturbed(state.T_sensor_target, offset), 1e-6 * Mat6::Identity()};
  const FilterUpdate result = update_filter(state, measured, 22.46);
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_FALSE(result.accepted);
  EXPECT_GT(result.nis, 22.46);
  EXPECT_EQ(state.rejected, 1u);
  state.rejected = 0;
  EXPECT_TRUE(same(state, before));
  EXPECT_TRUE(update_filter(state, measured, 1.01 * result.nis).accepted);
}

TEST(Filter, StaysSymmetricPositiveAndOfUnitLengthForADay) {
  VERIFIES("LASSO-FLT-009~1 LASSO-FLT-012~1");
  Random random(9);
  FilterState state = started(random);
  Truth truth{state.T_sensor_target, {5 * kRadPerDeg * Vec3(0.48, -0.6, 0.64), Vec3::Zero()}};
  const Mat6 R = covariance_of(random, 0.0007, 0.0005);
  Mat12 settled = Mat12::Zero();
  for (int frame = 1; frame <= 86400; ++frame) {
    truth.pose.q = (turn(truth.rates.omega_radps) * truth.pose.q).normalized();
    ASSERT_EQ(predict_filter(state, state.t_us + 1'000'000, kNoise), Status::kOk);
    ASSERT_TRUE(update_filter(state, {state.t_us, truth.pose, R}, kNoGate).accepted);
    ASSERT_NEAR(state.T_sensor_target.q.coeffs().norm(), 1, 4e-16);
    if (frame == 3600) settled = state.covariance;
  }
  EXPECT_EQ(state.accepted, 86400u);
  EXPECT_LT((state.covariance - settled).norm() / settled.norm(), 1e-6) << "the covariance neither grows nor fades";
  expect_symmetric_positive(state.covariance);
  EXPECT_LT(error_of(state, truth).norm(), 1e-9);
}

TEST(Filter, SignOfTheQuaternionIsKept) {
  VERIFIES("LASSO-FLT-009~1");
  Random random(10);
  FilterState state = started(random);
  state.rates.omega_radps = Vec3(0.5, -1.0, 0.8);
  Quat last = state.T_sensor_target.q;
  for (int frame = 0; frame < 200; ++frame) {
    ASSERT_EQ(predict_filter(state, state.t_us + 200'000, kNoise), Status::kOk);
    // Measured with the other sign: the same rotation.
    PoseMeasurement measured{state.t_us, state.T_sensor_target, covariance_of(random, 1e-3, 1e-3)};
    measured.T_sensor_target.q.coeffs() *= -1;
    ASSERT_TRUE(update_filter(state, measured, kNoGate).accepted);
    ASSERT_GT(state.T_sensor_target.q.dot(last), 0.9);
    last = state.T_sensor_target.q;
  }
}

TEST(Filter, PredictedPoseIsTheFiltersOwnAndChangesNothing) {
  VERIFIES("LASSO-FLT-003~1");
  Random random(11);
  FilterState state = generic_state(random);
  PredictedPose predicted;
  ASSERT_EQ(predict_pose(state, state.t_us + 123'456, predicted), Status::kOk);
  ASSERT_EQ(predict_filter(state, state.t_us + 123'456, kNoise), Status::kOk);
  EXPECT_TRUE(predicted.T_sensor_target.q.coeffs() == state.T_sensor_target.q.coeffs());
  EXPECT_TRUE(predicted.T_sensor_target.p == state.T_sensor_target.p);
  EXPECT_TRUE(predicted.rates.omega_radps == state.rates.omega_radps);
  EXPECT_TRUE(predicted.rates.v_mps == state.rates.v_mps);
}

TEST(FilterInput, BadStartsAreRefused) {
  VERIFIES("LASSO-FLT-010~1");
  Random random(12);
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
  Random random(13);
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
  EXPECT_EQ(predict_filter(state, next, {1e200, 1}), Status::kNotFinite);
  EXPECT_TRUE(same(state, before));
  EXPECT_EQ(predict_filter(state, state.t_us + kMaxPredictionUs, kNoise), Status::kOk);
  FilterState early = before;
  early.t_us = std::numeric_limits<TimeUs>::min();
  EXPECT_EQ(predict_filter(early, std::numeric_limits<TimeUs>::max(), kNoise), Status::kBadValue);
}

TEST(FilterInput, RatesOutOfAllBoundsAreRefused) {
  VERIFIES("LASSO-FLT-010~1");
  Random random(14);
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
  Random random(15);
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
  Random random(16);
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
}  // namespace lasso
