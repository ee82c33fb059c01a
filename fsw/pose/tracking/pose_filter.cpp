#include "fsw/pose/tracking/pose_filter.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/symmetric6.hpp"

namespace lasso {
namespace {

constexpr double kSymmetryTolerance = 1e-9;        // of the geometric mean of the two variances
constexpr double kMostExplained = 1.001;           // of a variance by common errors: all, and rounding
constexpr double kInnovationRatioDecay = 1.0 / 8;  // by each measurement
constexpr double kAlarm2 = 9;                      // three sigmas
constexpr double kSmallAngle2 = 1e-4;              // rad^2: below, series to three terms are exact to 1e-17

// The covariance in 6x6 blocks of pose and rates. Products stay at this size: Eigen writes them out, whereas 12x12 ones would bring in its
// blocked kernels and their allocations.
struct Blocks {
  Mat6 pose, cross, rates;  // cross: rows pose, columns rates
};

Blocks split(const Mat12& P) { return {P.block<6, 6>(0, 0), P.block<6, 6>(0, 6), P.block<6, 6>(6, 6)}; }

Mat6 symmetrised(const Mat6& m) { return 0.5 * (m + m.transpose()); }

void join(const Blocks& blocks, Mat12& P) {
  P.block<6, 6>(0, 0) = symmetrised(blocks.pose);
  P.block<6, 6>(0, 6) = blocks.cross;
  P.block<6, 6>(6, 0) = blocks.cross.transpose();
  P.block<6, 6>(6, 6) = symmetrised(blocks.rates);
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
  for (const double sigma : {noise.acceleration_mps2, noise.angular_acceleration_radps2, noise.precession, noise.common_memory_s}) {
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
  Mat6 pose_rows = F.pose * P.pose;
  pose_rows.noalias() += F.from_rates * P.cross.transpose();
  Blocks next;
  next.cross.noalias() = F.pose * P.cross;
  next.cross.noalias() += F.from_rates * P.rates;
  next.pose.noalias() = pose_rows * F.pose.transpose();
  next.pose.noalias() += next.cross * F.from_rates.transpose();
  next.rates = P.rates;
  add_process_noise(next, noise, state.rates.omega_radps.squaredNorm(), dt_s);
  Mat12 covariance;
  join(next, covariance);
  return covariance;
}

// The state's error moves on, and the common errors fade.
void predict_common(FilterState& state, double dt_s, double memory_s) {
  if (!(memory_s > 0)) return forget_common_errors(state);
  const double kept = exponential(-dt_s / memory_s);
  const Transition F = transition(state.rates.omega_radps, dt_s);
  state.common_pose = kept * (F.pose * state.common_pose + F.from_rates * state.common_rates);
  state.common_rates *= kept;
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

// K = [pose; rates]. What works with it is never inlined: beside each other its matrices would fill the stack.
struct Gain {
  Mat6 pose, rates;
};

[[gnu::noinline]] void set_gain(const FilterState& state, const CommonErrors& G, const Mat6& S_inverse, Gain& gain) {
  Mat6 rows = state.covariance.block<6, 6>(0, 0);
  rows.noalias() -= state.common_pose * G.transpose();
  gain.pose.noalias() = rows * S_inverse;
  rows = state.covariance.block<6, 6>(6, 0);
  rows.noalias() -= state.common_rates * G.transpose();
  gain.rates.noalias() = rows * S_inverse;
}

// P+ = (I - K H) P (I - K H)^T + K R K^T with H = [I 0].
[[gnu::noinline]] void update_by_joseph(const Mat6& R, const Gain& gain, Mat12& covariance) {
  const Blocks P = split(covariance);
  const Mat6 kept = Mat6::Identity() - gain.pose;
  Mat6 rows = kept * P.pose;
  Mat6 noise = gain.pose * R;
  Blocks next;
  next.pose.noalias() = rows * kept.transpose();
  next.pose.noalias() += noise * gain.pose.transpose();
  next.cross.noalias() = kept * P.cross;
  next.cross.noalias() -= rows * gain.rates.transpose();
  next.cross.noalias() += noise * gain.rates.transpose();
  rows = P.cross.transpose();
  rows.noalias() -= gain.rates * P.pose;
  noise.noalias() = gain.rates * R;
  next.rates = P.rates;
  next.rates.noalias() -= gain.rates * P.cross;
  next.rates.noalias() -= rows * gain.rates.transpose();
  next.rates.noalias() += noise * gain.rates.transpose();
  join(next, covariance);
}

// The innovation is v + G c - H e, e the state's error. Its covariance X with the common errors adds Y Z^T + Z Y^T to Joseph's form,
// Y = (I - K H) X and Z = K G, and is Y + Z afterwards.
[[gnu::noinline]] void join_common(const CommonErrors& G, const Gain& gain, FilterState& state) {
  const CommonErrors Z_pose = gain.pose * G;
  const CommonErrors Z_rates = gain.rates * G;
  state.common_rates -= gain.rates * state.common_pose;
  state.common_pose -= gain.pose * state.common_pose;
  Blocks P = split(state.covariance);
  P.pose.noalias() += state.common_pose * Z_pose.transpose();
  P.pose.noalias() += Z_pose * state.common_pose.transpose();
  P.cross.noalias() += state.common_pose * Z_rates.transpose();
  P.cross.noalias() += Z_pose * state.common_rates.transpose();
  P.rates.noalias() += state.common_rates * Z_rates.transpose();
  P.rates.noalias() += Z_rates * state.common_rates.transpose();
  join(P, state.covariance);
  state.common_pose += Z_pose;
  state.common_rates += Z_rates;
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
  const Status status = finite(measured.common) ? check_pose(measured.T_sensor_target) : Status::kNotFinite;
  return status == Status::kOk ? check_covariance(measured.covariance) : status;
}

// The innovation's square is on average the prediction's variance and the measurement's own, both for given common errors.
[[gnu::noinline]] void note_innovation_ratio(const Vec6& innovation, const FilterState& state, const PoseMeasurement& measured,
                                             Vec6& innovation_ratio) {
  for (int i = 0; i < 6; ++i) {
    const CommonErrors& G = measured.common;
    const double own = measured.covariance(i, i) - G.row(i).squaredNorm();
    const double claimed = state.covariance(i, i) + (G.row(i) - 2 * state.common_pose.row(i)).dot(G.row(i));
    const double square = innovation[i] * innovation[i];
    const bool alarming = square > kAlarm2 * (innovation_ratio[i] * claimed + own);
    const double seen = (square - own) / claimed;
    const double next = innovation_ratio[i] + (alarming ? 1 : kInnovationRatioDecay) * (seen - innovation_ratio[i]);
    innovation_ratio[i] =
        is_finite(next) ? clamp(next, kLeastInnovationRatio, 1.0) : 1.0;  // a flipped bit is over with the next measurement
  }
}

void join_measurement(FilterState& state, const PoseMeasurement& measured, const Vec6& innovation, const Mat6& S_inverse) {
  Gain gain;
  set_gain(state, measured.common, S_inverse, gain);
  note_innovation_ratio(innovation, state, measured, state.innovation_ratio);
  correct(state, gain.pose * innovation, gain.rates * innovation);
  update_by_joseph(measured.covariance, gain, state.covariance);
  join_common(measured.common, gain, state);
  ++state.accepted;
}

// Of the innovation.
[[gnu::noinline]] Mat6 innovation_covariance(const FilterState& state, const PoseMeasurement& measured) {
  Mat6 S = state.covariance.block<6, 6>(0, 0) + measured.covariance;
  S.noalias() -= 2 * state.common_pose * measured.common.transpose();
  return symmetrised(S);
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
  predict_common(state, dt_s, noise.common_memory_s);
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
  Mat6 S_inverse;
  result.status = invert_covariance(innovation_covariance(state, measured), S_inverse);
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

void forget_common_errors(FilterState& state) {
  state.common_pose.setZero();
  state.common_rates.setZero();
}

Mat6 relative_covariance(const FilterState& state) {
  Mat6 covariance = state.covariance.block<6, 6>(0, 0);
  covariance.noalias() -= state.common_pose * state.common_pose.transpose();
  return covariance;
}

double rate_sigma(double radius_m, const FilterState& state) {
  const double turn = state.covariance.block<3, 3>(6, 6).trace();
  const double shift = state.covariance.block<3, 3>(9, 9).trace();
  return square_root((radius_m * radius_m * turn + shift) / 3);
}

bool is_sound(const FilterState& state) {
  if (!is_finite(state.T_sensor_target.p.squaredNorm()) || !is_finite(state.T_sensor_target.q.squaredNorm())) return false;
  bool sound = true;
  for (int i = 0; i < 12; ++i) {
    const double explained = i < 6 ? state.common_pose.row(i).squaredNorm() : state.common_rates.row(i - 6).squaredNorm();
    sound = sound && explained <= kMostExplained * state.covariance(i, i);
  }
  return sound;
}

}  // namespace lasso
