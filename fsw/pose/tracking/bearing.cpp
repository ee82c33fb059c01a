#include "fsw/pose/tracking/bearing.hpp"

#include "fsw/geometry/portable_math.hpp"

namespace lasso {
namespace {

// What a return of this sensor can look like.
struct Limits {
  double tan_x, tan_y, range_min_m, range_max_m;

  explicit Limits(const MissionParameters& p)
      : tan_x(tangent(p.fov_half_x_rad) * kRounding),
        tan_y(tangent(p.fov_half_y_rad) * kRounding),
        range_min_m(p.range_min_m),
        range_max_m(p.range_max_m) {}

  BearingReason judge(const Vec3& direction, double range_m) const {
    if (!is_finite(direction.sum()) || !is_finite(range_m)) return BearingReason::kNotFinite;
    const double x = direction.x() < 0 ? -direction.x() : direction.x();
    const double y = direction.y() < 0 ? -direction.y() : direction.y();
    if (!(direction.z() > 0) || x > tan_x * direction.z() || y > tan_y * direction.z()) return BearingReason::kOutsideField;
    if (range_m <= range_min_m || range_m > range_max_m) return BearingReason::kOutsideRange;
    return BearingReason::kValid;
  }

 private:
  static constexpr double kRounding = 1 + 1e-5;  // directions come in single precision
};

BearingReason check_times(const RangeImage& scan, const BearingState& state) {
  TimeUs last_us = scan.samples[0].t_us;
  for (const RangeSample& sample : scan.samples) {
    if (sample.t_us < last_us) return BearingReason::kOutOfOrder;
    last_us = sample.t_us;
  }
  if (!state.looked || scan.reference_time_us() > state.looked_us) return BearingReason::kValid;
  return scan.reference_time_us() == state.looked_us ? BearingReason::kSameScan : BearingReason::kOutOfOrder;
}

BearingReason collect(const MissionParameters& parameters, const RangeImage& scan, FieldReturns& returns, Bearing& bearing) {
  const Limits limits(parameters);
  BearingReason first = BearingReason::kNothingSeen;
  returns.clear();
  for (const RangeSample& sample : scan.samples) {
    if (sample.state != RayState::kHit) continue;
    const Vec3 direction(static_cast<double>(sample.direction[0]), static_cast<double>(sample.direction[1]),
                         static_cast<double>(sample.direction[2]));
    const BearingReason verdict = limits.judge(direction, static_cast<double>(sample.range_m));
    if (bearing.returns == 0) first = verdict;
    ++bearing.returns;
    if (verdict != BearingReason::kValid) continue;
    FieldReturn found{};
    for (int i = 0; i < 3; ++i) found.p[i] = sample.range_m * sample.direction[i];
    found.after_us = static_cast<std::int32_t>(sample.t_us - scan.reference_time_us());
    invariant(returns.push_back(found), "as many returns as a scan has rays");
  }
  bearing.credible = static_cast<std::uint16_t>(returns.size());
  return returns.empty() ? first : BearingReason::kValid;
}

bool one_direction(const FieldReturns& returns) {
  const FieldReturn& first = returns[0];
  for (const FieldReturn& other : returns) {
    for (int i = 0; i < 2; ++i) {
      const double apart = static_cast<double>(other.p[i] / other.p[2]) - static_cast<double>(first.p[i] / first.p[2]);
      if (apart > kOneDirection || apart < -kOneDirection) return false;
    }
  }
  return true;
}

BearingReason choose(const Mission& mission, FieldReturns& returns, Bearing& bearing) {
  const auto least = static_cast<std::size_t>(mission.parameters.bearing_returns_min);
  if (returns.size() < least) return BearingReason::kTooFewReturns;
  if (one_direction(returns)) return BearingReason::kOneDirection;
  if (!keep_target_cluster(mission.radius_m, returns)) return BearingReason::kOnlyBackground;
  bearing.used = static_cast<std::uint16_t>(returns.size());
  return returns.size() < least ? BearingReason::kTooFewReturns : BearingReason::kValid;
}

Vec3 place_of(const FieldReturn& found) {
  return {static_cast<double>(found.p[0]), static_cast<double>(found.p[1]), static_cast<double>(found.p[2])};
}

struct Centroid {
  TimeUs t_us = 0;
  Vec3 p_m = Vec3::Zero();
  Mat3 covariance = Mat3::Zero();
};

// A mean of n places drawn from the visible surface, each with the sensor's noise (taken in all directions: no axis is exact).
Centroid centroid_of(const MissionParameters& parameters, TimeUs reference_us, const FieldReturns& returns) {
  const auto n = static_cast<double>(returns.size());
  Centroid centroid;
  std::int64_t after_us = 0;
  for (const FieldReturn& found : returns) {
    centroid.p_m += place_of(found) / n;
    after_us += found.after_us;
  }
  centroid.t_us = reference_us + after_us / static_cast<std::int64_t>(returns.size());
  const double grown_m = parameters.sigma_k_per_m * centroid.p_m.squaredNorm();
  centroid.covariance.diagonal().setConstant((parameters.sigma0_m * parameters.sigma0_m + grown_m * grown_m) / n);
  for (const FieldReturn& found : returns) {
    const Vec3 off = place_of(found) - centroid.p_m;
    centroid.covariance += off * off.transpose() / (n * n);
  }
  return centroid;
}

void start(const MissionParameters& parameters, const Centroid& centroid, BearingState& state) {
  state.started = true;
  state.t_us = centroid.t_us;
  state.p_m = centroid.p_m;
  state.v_mps.setZero();
  state.covariance.setZero();
  state.covariance.block<3, 3>(0, 0) = centroid.covariance;
  state.covariance.diagonal().tail<3>().setConstant(parameters.bearing_rate_mps * parameters.bearing_rate_mps);
  state.scans = 1;
  state.jumps = 0;
}

BearingState predicted(const MissionParameters& parameters, TimeUs t_us, const BearingState& state) {
  const double dt = to_seconds(t_us - state.t_us);
  const double q = parameters.acceleration_mps2 * parameters.acceleration_mps2;
  Mat6 F = Mat6::Identity();
  F.block<3, 3>(0, 3).diagonal().setConstant(dt);
  BearingState next = state;
  next.t_us = t_us;
  next.p_m += dt * state.v_mps;
  const Mat6 moved = F * state.covariance;
  next.covariance = moved * F.transpose();
  for (int i = 0; i < 3; ++i) {
    next.covariance(i, i) += 0.25 * q * dt * dt * dt * dt;
    next.covariance(i, i + 3) += 0.5 * q * dt * dt * dt;
    next.covariance(i + 3, i) += 0.5 * q * dt * dt * dt;
    next.covariance(i + 3, i + 3) += q * dt * dt;
  }
  return next;
}

// False, and nothing changes, where the centroid is not where the state can be. `state` is predicted to the centroid's time.
bool join(const Centroid& centroid, BearingState& state) {
  using Mat63 = Eigen::Matrix<double, 6, 3>;
  const Mat3 S = state.covariance.block<3, 3>(0, 0) + centroid.covariance;
  const Mat3 S_inverse = S.inverse();  // never singular: each return has noise in all directions
  const Vec3 innovation = centroid.p_m - state.p_m;
  if (!(innovation.dot(S_inverse * innovation) <= kBearingGate)) return false;
  const Mat63 gain = state.covariance.block<6, 3>(0, 0) * S_inverse;
  const Mat63 spread = gain * S;
  state.p_m += gain.block<3, 3>(0, 0) * innovation;
  state.v_mps += gain.block<3, 3>(3, 0) * innovation;
  const Mat6 less = state.covariance - spread * gain.transpose();
  state.covariance = 0.5 * (less + less.transpose());
  ++state.scans;
  state.jumps = 0;
  return true;
}

BearingReason follow(const MissionParameters& parameters, const Centroid& centroid, BearingState& state) {
  const bool forgotten = to_seconds(centroid.t_us - state.t_us) > parameters.bearing_memory_s;
  if (!state.started || forgotten) {
    start(parameters, centroid, state);
    return BearingReason::kValid;
  }
  if (centroid.t_us <= state.t_us) return BearingReason::kOutOfOrder;  // scans that overlap
  BearingState next = predicted(parameters, centroid.t_us, state);
  if (join(centroid, next) && next.p_m.z() > 0) {
    state = next;
    return BearingReason::kValid;
  }
  ++state.jumps;
  if (state.jumps < kBearingJumpsMax) return BearingReason::kJump;
  start(parameters, centroid, state);
  return BearingReason::kValid;
}

void describe(double left_out_m, const BearingState& state, Bearing& bearing) {
  bearing.t_us = state.t_us;
  bearing.scans = state.scans;
  bearing.value = detail::bearing_of(state.p_m, state.v_mps);
  const Mat6 J = detail::bearing_jacobian(state.p_m, state.v_mps);
  Mat6 covariance = state.covariance;
  covariance.diagonal().head<3>().array() += left_out_m * left_out_m;
  const Mat6 rows = J * covariance;
  bearing.covariance = rows * J.transpose();
}

}  // namespace

namespace detail {

Vec6 bearing_of(const Vec3& p, const Vec3& v) {
  const double rho2 = p.x() * p.x() + p.z() * p.z();
  const double rho = square_root(rho2);
  const double range = square_root(p.squaredNorm());
  const double level = p.x() * v.x() + p.z() * v.z();
  Vec6 value;
  value << arc_tangent2(p.x(), p.z()), arc_tangent2(-p.y(), rho), range,  //
      (p.z() * v.x() - p.x() * v.z()) / rho2, (p.y() * level - v.y() * rho2) / (rho * range * range), p.dot(v) / range;
  return value;
}

Mat6 bearing_jacobian(const Vec3& p, const Vec3& v) {
  const Vec6 value = bearing_of(p, v);
  const double rho2 = p.x() * p.x() + p.z() * p.z();
  const double rho = square_root(rho2);
  const double range = value[2];
  const double D = rho * range * range;
  const double level = p.x() * v.x() + p.z() * v.z();
  const Vec3 u = p / range;
  Mat3 place;  // of the angles and the range by the place, which is that of the rates by the velocity
  place << p.z() / rho2, 0, -p.x() / rho2, p.x() * p.y() / D, -rho2 / D, p.y() * p.z() / D, u.x(), u.y(), u.z();
  const Vec3 dN(p.y() * v.x() - 2 * p.x() * v.y(), level, p.y() * v.z() - 2 * p.z() * v.y());  // of the elevation rate's numerator
  const double grown = range * range / rho + 2 * rho;
  const Vec3 dD(p.x() * grown, 2 * p.y() * rho, p.z() * grown);  // of its denominator
  Mat3 rates;
  rates << (-v.z() - 2 * p.x() * value[3]) / rho2, 0, (v.x() - 2 * p.z() * value[3]) / rho2,  //
      ((dN - value[4] * dD) / D).transpose(),                                                 //
      ((v - value[5] * u) / range).transpose();
  Mat6 J = Mat6::Zero();
  J.block<3, 3>(0, 0) = place;
  J.block<3, 3>(3, 0) = rates;
  J.block<3, 3>(3, 3) = place;
  return J;
}

}  // namespace detail

const char* to_string(BearingReason reason) {
  static constexpr const char* kNames[] = {"valid",           "no_scan",       "out_of_order",    "same_scan",
                                           "nothing_seen",    "not_finite",    "outside_field",   "outside_range",
                                           "too_few_returns", "one_direction", "only_background", "jump"};
  const auto index = static_cast<std::size_t>(reason);
  return index < sizeof(kNames) / sizeof(kNames[0]) ? kNames[index] : "unknown";
}

Bearing BearingFinder::find(const Mission& mission, const RangeImage& scan, BearingState& state) {
  Bearing bearing;
  bearing.scan_id = scan.scan_id;
  bearing.t_us = scan.reference_time_us();
  if (scan.samples.empty()) return bearing;
  bearing.reason = check_times(scan, state);
  if (!bearing.valid()) return bearing;
  state.looked = true;
  state.looked_us = scan.reference_time_us();
  bearing.reason = collect(mission.parameters, scan, returns_, bearing);
  if (bearing.valid()) bearing.reason = choose(mission, returns_, bearing);
  if (!bearing.valid()) return bearing;
  bearing.reason = follow(mission.parameters, centroid_of(mission.parameters, scan.reference_time_us(), returns_), state);
  if (bearing.valid()) describe(mission.radius_m / kStrayShare, state, bearing);
  return bearing;
}

}  // namespace lasso
