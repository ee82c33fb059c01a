// What the tests of the filter share: a truth that moves by other code than the flight's, starts and measurements drawn around it.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "fsw/pose/tracking/pose_filter.hpp"
#include "ut/support/dense.hpp"
#include "ut/support/generator.hpp"

namespace lasso::test {

using Vec12 = Eigen::Matrix<double, 12, 1>;

constexpr FilterNoise kNoise{0.01, 0.5 * kRadPerDeg};

template <class V>
V normals(Generator& random) {
  V v;
  for (int i = 0; i < v.size(); ++i) v[i] = random.normal();
  return v;
}

// Rotation by Eigen's angle and axis: independent of the flight code's exponential.
inline Quat turn(const Vec3& rotation) {
  const double angle = rotation.norm();
  return angle > 0 ? Quat(Eigen::AngleAxisd(angle, rotation / angle)) : Quat::Identity();
}

inline Vec3 rotation_between(const Quat& estimate, const Quat& truth) {
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

inline Vec12 error_of(const FilterState& state, const Truth& truth) {
  Vec12 e;
  e << rotation_between(state.T_sensor_target.q, truth.pose.q), state.T_sensor_target.p - truth.pose.p,
      state.rates.omega_radps - truth.rates.omega_radps, state.rates.v_mps - truth.rates.v_mps;
  return e;
}

// A correlated covariance with the given sigmas, as a weakly seen target gives one.
inline Mat6 covariance_of(Generator& random, double sigma_rotation, double sigma_translation) {
  Mat6 factor = 1.5 * Mat6::Identity();
  for (int i = 0; i < 36; ++i) factor.data()[i] += random.normal();
  Vec6 scale;
  scale << Vec3::Constant(sigma_rotation), Vec3::Constant(sigma_translation);
  return scale.asDiagonal() * (factor * factor.transpose() / 8) * scale.asDiagonal();
}

inline Pose disturbed(const Pose& pose, const Vec6& error) { return {turn(error.head<3>()) * pose.q, pose.p + error.tail<3>()}; }

inline PoseMeasurement measure(const Truth& truth, TimeUs t_us, const Mat6& covariance, Generator& random) {
  const Vec6 error = cholesky_of(covariance) * normals<Vec6>(random);
  return {t_us, disturbed(truth.pose, error), covariance};
}

inline FilterStart generic_start(Generator& random) {
  FilterStart start;
  start.t_us = 1'700'000'000'000'000;
  start.T_sensor_target = {Quat(normals<Eigen::Vector4d>(random).normalized()), Vec3(0.3, -0.2, 4.1)};
  start.rates = {Vec3(0.05, -0.08, 0.03), Vec3(0.02, -0.05, 0.1)};
  start.pose_covariance = covariance_of(random, 0.01, 0.005);
  start.sigma_omega_radps = 2 * kRadPerDeg;
  start.sigma_v_mps = 0.05;
  return start;
}

inline FilterState started(Generator& random) {
  FilterState state;
  EXPECT_EQ(start_filter(state, generic_start(random)), Status::kOk);
  return state;
}

// A state in which everything is correlated with everything.
inline FilterState generic_state(Generator& random) {
  FilterState state = started(random);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(predict_filter(state, state.t_us + 200'000, kNoise), Status::kOk);
    const PoseMeasurement measured{state.t_us, disturbed(state.T_sensor_target, 0.003 * normals<Vec6>(random)),
                                   covariance_of(random, 0.002, 0.003)};
    EXPECT_TRUE(update_filter(state, measured, kNoGate).accepted);
  }
  return state;
}

inline bool same(const FilterState& a, const FilterState& b) {
  return a.t_us == b.t_us && a.T_sensor_target.q.coeffs() == b.T_sensor_target.q.coeffs() && a.T_sensor_target.p == b.T_sensor_target.p &&
         a.rates.omega_radps == b.rates.omega_radps && a.rates.v_mps == b.rates.v_mps && a.covariance == b.covariance &&
         a.innovation_ratio == b.innovation_ratio && a.initialised == b.initialised && a.accepted == b.accepted && a.rejected == b.rejected;
}

inline void expect_symmetric_positive(const Mat12& P) {
  EXPECT_TRUE(P == P.transpose());
  EXPECT_GT(eigenvalues_of(P).minCoeff(), 0);
}

}  // namespace lasso::test
