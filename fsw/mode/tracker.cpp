#include "fsw/mode/tracker.hpp"

#include "fsw/geometry/portable_math.hpp"

namespace lasso {
namespace {

constexpr std::uint32_t kEstablished = 5;  // scans until the filter's word counts more than a scan's: a start may have been wrong

FilterNoise filter_noise(const MissionParameters& p) { return {p.acceleration_mps2, p.angular_acceleration_radps2}; }

FilterStart filter_start(const MissionParameters& p, const Pose& T_sensor_target, const Twist& rates, TimeUs t_us) {
  FilterStart from;
  from.t_us = t_us;
  from.T_sensor_target = T_sensor_target;
  from.rates = rates;
  from.sigma_omega_radps = p.initial_angular_rate_radps;
  from.sigma_v_mps = p.initial_rate_mps;
  return from;
}

// A start is believed this well until a scan confirms it.
Mat6 start_covariance(const MissionParameters& p) {
  Vec6 variances;
  variances.head<3>().setConstant(p.start_sigma_rad * p.start_sigma_rad);
  variances.tail<3>().setConstant(p.start_sigma_m * p.start_sigma_m);
  return variances.asDiagonal();
}

Status restart_from(const MissionParameters& p, const Registration& registration, FilterState& filter) {
  FilterStart from = filter_start(p, registration.T_sensor_target, filter.rates, registration.t_us);
  from.pose_covariance = registration.covariance;
  return start_filter(filter, from);
}

// Joins a valid registration to `filter`, which is predicted to its time: kValid, or why the pose is not to be believed after all. A wrong
// minimum explains its scan, sometimes as well as the right one does: only the motion since the scans before tells.
PoseReason join(const MissionParameters& p, TrackingMode mode, const Registration& registration, FilterState& filter) {
  const PoseMeasurement measured{registration.t_us, registration.T_sensor_target, registration.covariance};
  if (mode != TrackingMode::kStarting) {
    const double gate_nis = filter.accepted < kEstablished ? kNoGate : p.innovation_max * p.innovation_max;
    const FilterUpdate update = update_filter(filter, measured, gate_nis);
    if (update.status == Status::kOk) return update.accepted ? PoseReason::kValid : PoseReason::kImplausible;
  }
  return restart_from(p, registration, filter) == Status::kOk ? PoseReason::kValid : PoseReason::kSingular;
}

// Where the prediction has no meaning any more (too long a step), pose and rates stay as they were and a valid scan starts anew.
void predict_or_hold(const MissionParameters& p, TimeUs t_us, FilterState& filter) {
  if (predict_filter(filter, t_us, filter_noise(p)) == Status::kOk) return;
  filter.t_us = t_us;
  filter.initialised = false;
}

ModeEvent event_of(const MissionParameters& p, bool valid, std::uint16_t missed) {
  if (valid) return ModeEvent::kPoseValid;
  return missed > p.coast_frames ? ModeEvent::kExhausted : ModeEvent::kPoseInvalid;
}

// coast_frames is at most 1000, and exhausted counts end the scans: no overflow.
void change_mode(const Mission& mission, bool valid, TrackState& state) {
  state.missed = valid ? std::uint16_t{0} : static_cast<std::uint16_t>(state.missed + 1);
  state.mode = next_mode(state.mode, event_of(mission.parameters, valid, state.missed));
}

Registration not_registered(PoseReason reason, std::uint32_t scan_id, const FilterState& filter) {
  Registration registration;
  registration.scan_id = scan_id;
  registration.t_us = filter.t_us;
  registration.T_sensor_target = filter.T_sensor_target;
  registration.reason = reason;
  return registration;
}

// A prediction less certain than the registration's gate (after weak views, or coasting) is a rough start.
bool is_rough(const Mission& mission, const FilterState& filter) {
  const double turn_m2 = mission.radius_m * mission.radius_m * filter.covariance.topLeftCorner<3, 3>().trace();
  const double shift_m2 = filter.covariance.block<3, 3>(3, 3).trace();
  return turn_m2 + shift_m2 > mission.parameters.gate_first_m * mission.parameters.gate_first_m;
}

bool finite(const Twist& rates) { return is_finite(rates.omega_radps.squaredNorm()) && is_finite(rates.v_mps.squaredNorm()); }

}  // namespace

Status start_track(const Mission& mission, const Pose& T_sensor_target, const Twist& rates, TimeUs stated_us, TimeUs t_us,
                   TrackState& state) {
  if (!finite(rates)) return Status::kNotFinite;
  if (stated_us < t_us - kMaxPredictionUs || stated_us > t_us + kMaxPredictionUs || !is_valid(T_sensor_target)) return Status::kBadValue;
  const DurationUs dt_us = t_us - stated_us;
  FilterStart from = filter_start(mission.parameters, propagate(T_sensor_target, rates, to_seconds(dt_us)), rates, t_us);
  from.pose_covariance = start_covariance(mission.parameters);
  FilterState filter;
  const Status status = start_filter(filter, from);
  if (status != Status::kOk) return status;
  state.mode = next_mode(state.mode, ModeEvent::kStart);
  state.missed = 0;
  state.filter = filter;
  return Status::kOk;
}

TrackStep track_scan(const Mission& mission, Estimator& estimator, const RangeImage& scan, const TrackState& before) {
  TrackStep step;
  step.after = before;
  FilterState& filter = step.after.filter;
  predict_or_hold(mission.parameters, scan.reference_time_us(), filter);
  const bool wide = (properties(before.mode).wide_start || is_rough(mission, filter)) && mission.parameters.wide_start > 0.5;
  step.registration = estimator.estimate(mission, scan, StartPoint{filter.T_sensor_target, filter.rates, wide});
  if (step.registration.valid()) step.registration.reason = join(mission.parameters, before.mode, step.registration, filter);
  change_mode(mission, step.registration.valid(), step.after);
  return step;
}

TrackStep track_without_scan(const Mission& mission, PoseReason reason, std::uint32_t scan_id, TimeUs t_us, const TrackState& before) {
  TrackStep step;
  step.after = before;
  predict_or_hold(mission.parameters, t_us, step.after.filter);
  step.registration = not_registered(reason, scan_id, step.after.filter);
  change_mode(mission, false, step.after);
  return step;
}

TrackStep no_track(std::uint32_t scan_id, const TrackState& before) {
  return {before, not_registered(PoseReason::kNoTrack, scan_id, before.filter)};
}

}  // namespace lasso
