#include "fsw/pose/filter.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/symmetric6.hpp"

namespace lasso {
namespace {

constexpr double kSymmetryTolerance = 1e-9;  // of the geometric mean of the two variances
constexpr double kSurpriseFades = 1.0 / 8;   // by each measurement
constexpr double kAlarm2 = 9;                // three sigmas
constexpr double kSmallAngle2 = 1e-4;        // rad^2: below, series to three terms are exact to 1e-17

// The covariance in 6x6 blocks of pose and rates. Products stay at this size: Eigen writes them out, whereas 12x12 ones would bring in its
// blocked kernels and their allocations.
struct Blocks {
  Mat6 pose, cross, rates;  // cross: rows pose, columns rates
};

Blocks split(const Mat12& P) { return {P.block<6, 6>(0, 0), P.block<6, 6>(0, 6), P.block<6, 6>(6, 6)}; }

Mat6 symmetrised(const Mat6& m) { return 0.5 * (m + m.transpose()); }

Mat12 join(const Blocks& blocks) {
  Mat12 P;
  P.block<6, 6>(0, 0) = symmetrised(blocks.pose);
  P.block<6, 6>(0, 6) = blocks.cross;
  P.block<6, 6>(6, 0) = blocks.cross.transpose();
  P.block<6, 6>(6, 6) = symmetrised(blocks.rates);
  return P;
}

template <class M>
bool finite(const M& m) {
  bool ok = true;
  for (int i = 0; i < m.size(); ++i) ok = ok && is_finite(m.data()[i]);
  return ok;
}

bool finite(const Pose& pose) { return finite(pose.q.coeffs()) && finite(pose.p); }

Status check_pose(const Pose& pose) {
  if (!finite(pose)) return Status::kNotFinite;
  return is_valid(pose) ? Status::kOk : Status::kBadValue;
}

Status check_covariance(const Mat6& C) {
  if (!finite(C)) return Status::kNotFinite;
  for (int i = 0; i < 6; ++i) {
    if (!(C(i, i) > 0)) return Status::kBadValue;
    for (int j = 0; j < i; ++j) {
      const double bound2 = C(i, i) * C(j, j);
      const double skewness = C(i, j) - C(j, i);
      if (C(i, j) * C(i, j) > bound2 * (1 + kSymmetryTolerance)) return Status::kBadValue;
      if (skewness * skewness > bound2 * kSymmetryTolerance * kSymmetryTolerance) return Status::kBadValue;
    }
  }
  return Status::kOk;
}

Status check_noise(const FilterNoise& noise) {
  for (const double sigma : {noise.acceleration_mps2, noise.angular_acceleration_radps2, noise.precession}) {
    if (!is_finite(sigma)) return Status::kNotFinite;
    if (sigma < 0) return Status::kBadValue;
  }
  return Status::kOk;
}

Status check_step(const FilterState& state, TimeUs t_us) {
  if (!state.initialised) return Status::kNoData;
  if (t_us < state.t_us) return Status::kBadOrder;
  // Unsigned, so that even the farthest instants have a difference.
  const std::uint64_t step_us = static_cast<std::uint64_t>(t_us) - static_cast<std::uint64_t>(state.t_us);
  if (step_us > static_cast<std::uint64_t>(kMaxPredictionUs)) return Status::kBadValue;
  const Vec3 rotation = to_seconds(t_us - state.t_us) * state.rates.omega_radps;
  return rotation.squaredNorm() <= kMaxStepRotationRad * kMaxStepRotationRad ? Status::kOk : Status::kBadValue;
}

// J with exp(r + J^-1 d) = exp(d) exp(r) to first order.
Mat3 left_jacobian(const Vec3& rotation) {
  const double a2 = rotation.squaredNorm();
  double first = 0.5 - a2 * (1.0 / 24 - a2 * (1.0 / 720));         // (1 - cos a) / a^2
  double second = 1.0 / 6 - a2 * (1.0 / 120 - a2 * (1.0 / 5040));  // (a - sin a) / a^3
  if (a2 >= kSmallAngle2) {
    const double a = square_root(a2);
    const SinCos turn = sin_cos(a);
    first = (1 - turn.cos) / a2;
    second = (a - turn.sin) / (a2 * a);
  }
  const Mat3 cross = skew(rotation);
  return Mat3::Identity() + first * cross + second * (cross * cross);
}

struct Transition {
  Mat6 pose;        // pose error from pose error
  Mat6 from_rates;  // pose error from rate error; rate errors stay as they are
};

Transition transition(const Vec3& omega_radps, double dt_s) {
  const Vec3 rotation = dt_s * omega_radps;
  Transition F{Mat6::Identity(), dt_s * Mat6::Identity()};
  F.pose.block<3, 3>(0, 0) = to_matrix(exp_so3(rotation));
  F.from_rates.block<3, 3>(0, 0) = dt_s * left_jacobian(rotation);
  return F;
}

double square(double x) { return x * x; }

// Discrete white-noise acceleration: a moves the rate by a dt and the pose by a dt^2/2 (Bar-Shalom, Li & Kirubarajan 2001, 6.3.2).
void add_process_noise(Blocks& P, const FilterNoise& noise, double omega2, double dt_s) {
  const double dt2 = dt_s * dt_s;
  const double q_turn = square(noise.angular_acceleration_radps2) + square(noise.precession * omega2);
  const double q_shift = square(noise.acceleration_mps2);
  for (int i = 0; i < 6; ++i) {
    const double q = i < 3 ? q_turn : q_shift;
    P.pose(i, i) += 0.25 * q * dt2 * dt2;
    P.cross(i, i) += 0.5 * q * dt2 * dt_s;
    P.rates(i, i) += q * dt2;
  }
}

Mat12 predicted_covariance(const FilterState& state, double dt_s, const FilterNoise& noise) {
  const Blocks P = split(state.covariance);
  const Transition F = transition(state.rates.omega_radps, dt_s);
  const Mat6 pose_rows = F.pose * P.pose + F.from_rates * P.cross.transpose();
  Blocks next;
  next.cross = F.pose * P.cross + F.from_rates * P.rates;
  next.pose = pose_rows * F.pose.transpose() + next.cross * F.from_rates.transpose();
  next.rates = P.rates;
  add_process_noise(next, noise, state.rates.omega_radps.squaredNorm(), dt_s);
  return join(next);
}

// Inverse through the correlation matrix: variances of rad^2 and m^2, of weak and strong directions, differ by many orders of magnitude.
Status invert_covariance(const Mat6& S, Mat6& inverse) {
  Vec6 scale;
  for (int i = 0; i < 6; ++i) scale[i] = 1 / square_root(S(i, i));
  Mat6 correlation;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) correlation(i, j) = S(i, j) * scale[i] * scale[j];
  }
  Mat6 inverse_correlation;
  const Status status = invert6(correlation, inverse_correlation);
  if (status != Status::kOk) return status;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) inverse(i, j) = inverse_correlation(i, j) * scale[i] * scale[j];
  }
  return Status::kOk;
}

// P+ = (I - K H) P (I - K H)^T + K R K^T with H = [I 0] and K = [pose_gain; rates_gain].
Mat12 joseph(const Blocks& P, const Mat6& R, const Mat6& pose_gain, const Mat6& rates_gain) {
  const Mat6 kept = Mat6::Identity() - pose_gain;
  const Mat6 pose_rows = kept * P.pose;
  const Mat6 cross_rows = kept * P.cross;
  const Mat6 rates_rows = P.rates - rates_gain * P.cross;
  const Mat6 rates_pose = P.cross.transpose() - rates_gain * P.pose;
  const Mat6 pose_noise = pose_gain * R;
  Blocks next;
  next.pose = pose_rows * kept.transpose() + pose_noise * pose_gain.transpose();
  next.cross = cross_rows - pose_rows * rates_gain.transpose() + pose_noise * rates_gain.transpose();
  next.rates = rates_rows - rates_pose * rates_gain.transpose() + rates_gain * R * rates_gain.transpose();
  return join(next);
}

// The gains act on measured - estimate; the corrections bring the estimate towards the truth.
void correct(FilterState& state, const Vec6& pose_step, const Vec6& rates_step) {
  state.T_sensor_target.q = normalized(exp_so3(pose_step.head<3>()) * state.T_sensor_target.q);
  state.T_sensor_target.p += pose_step.tail<3>();
  state.rates.omega_radps += rates_step.head<3>();
  state.rates.v_mps += rates_step.tail<3>();
}

Status check_measurement(const FilterState& state, const PoseMeasurement& measured, double gate_nis) {
  if (!state.initialised) return Status::kNoData;
  if (measured.t_us != state.t_us) return Status::kBadOrder;
  if (!is_finite(gate_nis)) return Status::kNotFinite;
  if (gate_nis < 0) return Status::kBadValue;
  const Status status = check_pose(measured.T_sensor_target);
  return status == Status::kOk ? check_covariance(measured.covariance) : status;
}

// The innovation's square is on average the prediction's variance and the measurement's own.
void note_surprise(const Vec6& innovation, const Mat6& predicted, const Mat6& measured, Vec6& surprise) {
  for (int i = 0; i < 6; ++i) {
    const double square = innovation[i] * innovation[i];
    const bool alarming = square > kAlarm2 * (surprise[i] * predicted(i, i) + measured(i, i));
    const double seen = (square - measured(i, i)) / predicted(i, i);
    const double next = surprise[i] + (alarming ? 1 : kSurpriseFades) * (seen - surprise[i]);
    surprise[i] = is_finite(next) ? clamp(next, kLeastSurprise, 1.0) : 1.0;  // a flipped bit is over with the next measurement
  }
}

void join_measurement(FilterState& state, const PoseMeasurement& measured, const Vec6& innovation, const Mat6& S_inverse) {
  const Blocks P = split(state.covariance);
  const Mat6 pose_gain = P.pose * S_inverse;
  const Mat6 rates_gain = P.cross.transpose() * S_inverse;
  note_surprise(innovation, P.pose, measured.covariance, state.surprise);
  correct(state, pose_gain * innovation, rates_gain * innovation);
  state.covariance = joseph(P, measured.covariance, pose_gain, rates_gain);
  ++state.accepted;
}

}  // namespace

FilterState::FilterState() = default;
FilterState::FilterState(const FilterState& other) = default;
FilterState& FilterState::operator=(const FilterState& other) = default;

Status start_filter(FilterState& state, const FilterStart& from) {
  const Status pose_status = check_pose(from.T_sensor_target);
  if (pose_status != Status::kOk) return pose_status;
  if (!finite(from.rates.omega_radps) || !finite(from.rates.v_mps)) return Status::kNotFinite;
  if (!is_finite(from.sigma_omega_radps) || !is_finite(from.sigma_v_mps)) return Status::kNotFinite;
  if (!(from.sigma_omega_radps > 0 && from.sigma_v_mps > 0)) return Status::kBadValue;
  const Status covariance_status = check_covariance(from.pose_covariance);
  if (covariance_status != Status::kOk) return covariance_status;

  FilterState started;
  started.t_us = from.t_us;
  started.T_sensor_target = from.T_sensor_target;
  started.rates = from.rates;
  started.covariance.block<6, 6>(0, 0) = symmetrised(from.pose_covariance);
  for (int i = 6; i < 12; ++i) {
    const double sigma = i < 9 ? from.sigma_omega_radps : from.sigma_v_mps;
    started.covariance(i, i) = sigma * sigma;
  }
  if (!finite(started.covariance)) return Status::kNotFinite;
  started.initialised = true;
  state = started;
  return Status::kOk;
}

Status predict_filter(FilterState& state, TimeUs t_us, const FilterNoise& noise) {
  const Status step_status = check_step(state, t_us);
  if (step_status != Status::kOk) return step_status;
  const Status noise_status = check_noise(noise);
  if (noise_status != Status::kOk) return noise_status;
  const double dt_s = to_seconds(t_us - state.t_us);
  const Mat12 covariance = predicted_covariance(state, dt_s, noise);
  const Pose pose = propagate(state.T_sensor_target, state.rates, dt_s);
  if (!finite(covariance) || !finite(pose)) return Status::kNotFinite;
  state.covariance = covariance;
  state.T_sensor_target = pose;
  state.t_us = t_us;
  return Status::kOk;
}

FilterUpdate update_filter(FilterState& state, const PoseMeasurement& measured, double gate_nis) {
  FilterUpdate result;
  result.status = check_measurement(state, measured, gate_nis);
  if (result.status != Status::kOk) return result;
  const Vec6 innovation = pose_difference(measured.T_sensor_target, state.T_sensor_target);
  const Mat6 S = symmetrised(state.covariance.block<6, 6>(0, 0) + measured.covariance);
  Mat6 S_inverse;
  result.status = invert_covariance(S, S_inverse);
  if (result.status != Status::kOk) return result;
  result.nis = innovation.dot(S_inverse * innovation);
  // A finite nis bounds the correction, too: |K y|^2 <= nis * P.
  if (!is_finite(result.nis)) {
    result.status = Status::kNotFinite;
    return result;
  }
  if (gate_nis > 0 && result.nis > gate_nis) {
    ++state.rejected;
    return result;
  }
  join_measurement(state, measured, innovation, S_inverse);
  result.accepted = true;
  return result;
}

Status predict_pose(const FilterState& state, TimeUs t_us, PredictedPose& predicted) {
  const Status status = check_step(state, t_us);
  if (status != Status::kOk) return status;
  const Pose pose = propagate(state.T_sensor_target, state.rates, to_seconds(t_us - state.t_us));
  if (!finite(pose)) return Status::kNotFinite;
  predicted = {pose, state.rates};
  return Status::kOk;
}

Mat12 error_transition(const Vec3& omega_radps, double dt_s) {
  const Transition F = transition(omega_radps, dt_s);
  Mat12 full = Mat12::Identity();
  full.block<6, 6>(0, 0) = F.pose;
  full.block<6, 6>(0, 6) = F.from_rates;
  return full;
}

double rate_sigma(double radius_m, const FilterState& state) {
  const double turn = state.covariance.block<3, 3>(6, 6).trace();
  const double shift = state.covariance.block<3, 3>(9, 9).trace();
  return square_root((radius_m * radius_m * turn + shift) / 3);
}

bool is_sound(const FilterState& state) {
  if (!is_finite(state.T_sensor_target.p.squaredNorm()) || !is_finite(state.T_sensor_target.q.squaredNorm())) return false;
  return (state.covariance.diagonal().array() >= 0).all();
}

}  // namespace lasso
