#include "fsw/mode/tracker.hpp"

#include "fsw/geometry/portable_math.hpp"

namespace lasso {
namespace {

// Squared sigmas between a start and the registration that would confirm it: of six degrees of freedom, 1 of 2,900 right starts is farther
// off where both covariances are honest (chi squared; docs/validity.md).
constexpr double kStartGate = 25;
constexpr std::uint32_t kEstablished = 5;  // scans until the filter's word counts more than a scan's: a start may have been wrong

PoseMeasurement measurement_of(const Registration& registration) {
  return {registration.t_us, registration.T_sensor_target, registration.covariance, registration.common};
}

// From what the start is known by. Never inlined, as the next one: their offers would lie on the stack while a measurement is joined.
[[gnu::noinline]] Status start_as_known(const MissionParameters& p, const FilterState& filter, FilterState& begun) {
  const StartOffer known{filter.t_us, filter.T_sensor_target, filter.rates, filter.covariance.topLeftCorner<6, 6>()};
  const Status status = start_filter(begun, filter_start(p, known));
  if (status == Status::kOk) begun.common_pose = filter.common_pose;
  return status;
}

// From the registration alone.
[[gnu::noinline]] Status start_alone(const MissionParameters& p, const Registration& registration, FilterState& filter) {
  const StartOffer alone{registration.t_us, registration.T_sensor_target, filter.rates, registration.covariance};
  const Status status = start_filter(filter, filter_start(p, alone));
  if (status == Status::kOk) filter.common_pose = registration.common;
  return status;
}

// Does the start, where it is known, take the registration in? Its rates stay unknown.
bool begin_from(const MissionParameters& p, const Registration& registration, const FilterState& filter, FilterState& begun) {
  if (!filter.initialised || start_as_known(p, filter, begun) != Status::kOk) return false;
  return update_filter(begun, measurement_of(registration), kNoGate).accepted;
}

// A track begins with the registration and, where that shows nothing (observability.hpp), with what its start was known by: a plate's shift
// would otherwise begin unknown by three radii, and what views from a little aside tell of so much is beyond a linear filter.
Status restart_from(const MissionParameters& p, const Registration& registration, FilterState& filter) {
  FilterState begun;
  if (!begin_from(p, registration, filter, begun)) return start_alone(p, registration, filter);
  filter = begun;
  filter.accepted = 0;
  return Status::kOk;
}

// `filter` is predicted to the registration's time. A filter that cannot be asked has nothing against the registration.
bool far_from(const FilterState& filter, const Registration& registration, double gate) {
  FilterState asked = filter;
  const FilterUpdate update = update_filter(asked, measurement_of(registration), gate);
  return update.status == Status::kOk && !update.accepted;
}

// A least share, raised; a scan without any fault always passes.
double raised(double least, double by) { return least + by < 1 ? least + by : 1; }

// The least agreement, raised, but not farther than to half as many contradicting rays: few right poses have none.
double agreement_to_begin(double least, double by) { return least + clamp(by, 0.0, 0.5 * (1 - least)); }

// A registration that is valid by itself: do its shares let this mode take it, and in a start the prediction?
PoseReason confirm(const MissionParameters& p, const ModeProperties& mode, const FilterState& filter, const Registration& registration) {
  if (!mode.takes_up) return PoseReason::kValid;
  if (!(registration.inlier_share >= raised(p.inlier_share_min, p.hysteresis))) return PoseReason::kLowInlierShare;
  if (!(registration.agreement >= agreement_to_begin(p.agreement_min, p.hysteresis))) return PoseReason::kModelMismatch;
  if (!mode.confirms) return PoseReason::kValid;
  if (!(registration.inlier_share >= p.start_inlier_share_min)) return PoseReason::kLowInlierShare;
  return far_from(filter, registration, kStartGate) ? PoseReason::kFarFromStart : PoseReason::kValid;
}

// A start by search has been compared with all other poses, and one whose attitude is known excludes them.
bool is_checked(const MissionParameters& p, const TrackState& state) {
  return p.start_check > 0.5 && properties(state.mode).tries_start && state.source != InitialPoseSource::kSearch && state.rough;
}

// By the sensor's axis about which it is known worst.
bool is_attitude_rough(const FilterState& start) {
  return start.covariance.diagonal().head<3>().maxCoeff() > kKnownAttitude_rad * kKnownAttitude_rad;
}

// No frame counts against the start meanwhile.
void await_check(TrackStep& step) {
  TrackState& state = step.after;
  Registration& registration = step.registration;
  registration.reason = PoseReason::kUnchecked;
  step.event = has_transition(state.mode, ModeEvent::kCheck) ? ModeEvent::kCheck : ModeEvent::kPoseInvalid;
  change_mode(step.event, state);
  if (state.check.stage != StartCheck::Stage::kSearching) {
    state.check = {StartCheck::Stage::kSearching, state.check.undecided, registration.t_us, registration.T_sensor_target};
    ++state.searches;
  }
  state.missed = 0;
}

// Joins a valid registration to `filter`, which is predicted to its time: kValid, or why the pose is not to be believed after all. A wrong
// minimum explains its scan, sometimes as well as the right one does: only the motion since the scans before tells.
PoseReason join(const MissionParameters& p, bool starts, const Registration& registration, FilterState& filter) {
  if (!starts) {
    const double gate_nis = filter.accepted < kEstablished ? kNoGate : p.innovation_max * p.innovation_max;
    const FilterUpdate update = update_filter(filter, measurement_of(registration), gate_nis);
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

double frames_of(const MissionParameters& p, TrackingMode mode) {
  if (properties(mode).tries_start) return p.start_frames;
  if (mode == TrackingMode::kSearching) return p.search_frames;
  return mode == TrackingMode::kReacquiring ? p.reacquire_frames : p.coast_frames;
}

// Is the target as far away as it has to be for the mode?
bool suits_range(const MissionParameters& p, const TrackState& state) {
  const double range2_m2 = state.filter.T_sensor_target.p.squaredNorm();
  if (state.mode == TrackingMode::kShortRange) return range2_m2 <= p.short_range_leave_m * p.short_range_leave_m;
  return range2_m2 >= p.short_range_enter_m * p.short_range_enter_m;
}

ModeEvent event_of_valid(const MissionParameters& p, const TrackState& state) {
  if (state.held || state.range_awaited || suits_range(p, state)) return ModeEvent::kPoseValid;
  if (state.mode == TrackingMode::kTracking) return ModeEvent::kNear;
  return state.mode == TrackingMode::kShortRange ? ModeEvent::kFar : ModeEvent::kPoseValid;
}

// Where no scan confirms a start, a search is a source that is left, unless the start is its own; its turn comes in bearing.
bool leaves_search(const MissionParameters& p, const TrackState& state) {
  return properties(state.mode).tries_start && state.source != InitialPoseSource::kSearch && is_in_order(p, InitialPoseSource::kSearch);
}

ModeEvent event_of(const MissionParameters& p, const TrackState& state, bool valid) {
  if (valid) return event_of_valid(p, state);
  if (state.held || state.missed <= frames_of(p, state.mode)) return ModeEvent::kPoseInvalid;
  if (state.interrupts) return ModeEvent::kFallBack;
  return p.recover > 0.5 || leaves_search(p, state) ? ModeEvent::kRecover : ModeEvent::kExhausted;
}

// Joins the step's registration to its filter if it is valid, and changes the mode accordingly.
void take(const MissionParameters& p, const ModeProperties& mode, TrackStep& step) {
  Registration& registration = step.registration;
  if (registration.valid()) registration.reason = join(p, mode.confirms, registration, step.after.filter);
  const bool awaits = is_checked(p, step.after) && step.after.check.stage != StartCheck::Stage::kPassed;
  if (registration.valid() && awaits) return await_check(step);
  count_and_change(p, registration.valid(), step);
  if (registration.reason == PoseReason::kImplausible) confirm_anew(step);  // what is followed is not what is checked
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
  const Mat6 covariance = relative_covariance(filter);
  const double turn_m2 = mission.radius_m * mission.radius_m * covariance.topLeftCorner<3, 3>().trace();
  const double shift_m2 = covariance.block<3, 3>(3, 3).trace();
  return turn_m2 + shift_m2 > mission.parameters.gate_first_m * mission.parameters.gate_first_m;
}

// Where predictions have been better than they claim, so is this one: a target need not accelerate as much as the mission allows it to.
Mat6 likely_covariance(const FilterState& predicted) {
  Vec6 share;
  for (int i = 0; i < 6; ++i) share[i] = square_root(clamp(predicted.innovation_ratio[i], kLeastInnovationRatio, 1.0));
  return share.asDiagonal() * relative_covariance(predicted) * share.asDiagonal();
}

// A track; a further start, the one that the first interrupted.
bool would_interrupt(const TrackState& state) {
  const ModeProperties& mode = properties(state.mode);
  if (mode.tries_start) return state.interrupts;
  return mode.scans && !mode.full_field && !mode.searches && state.filter.initialised;
}

}  // namespace

void change_mode(ModeEvent event, TrackState& state) {
  const TrackingMode next = next_mode(state.mode, event);
  if (next == state.mode) return;
  const bool same_start = properties(state.mode).tries_start && properties(next).tries_start;
  state.mode = next;
  state.check = StartCheck{};
  if (same_start) return;
  state.interrupts = false;
  if (next != TrackingMode::kCoasting) state.missed = 0;
  if (properties(next).confirms) state.range_awaited = false;  // where the mode was is of no account to the track that is found
  if (event == ModeEvent::kNear || event == ModeEvent::kFar) state.range_awaited = true;
  if (properties(next).by_parts) state.parts = PartsState{};
  if (properties(next).searches) ++state.searches;
  if (properties(next).full_field || properties(next).searches) state.filter = FilterState{};
  if (properties(next).full_field) state.bearing = BearingState{};
}

void count_and_change(const MissionParameters& p, bool valid, TrackStep& step) {
  TrackState& state = step.after;
  if (valid) state.missed = 0;
  if (!valid && state.missed < UINT16_MAX) ++state.missed;
  if (valid && suits_range(p, state)) state.range_awaited = false;
  step.event = event_of(p, state, valid);
  change_mode(step.event, state);
}

StartRefusal start_track(const Mission& mission, InitialPoseSource source, const StartOffer& offer, TimeUs t_us, TrackState& state) {
  if (!has_transition(state.mode, ModeEvent::kStart)) return StartRefusal::kNotFromHere;
  const bool interrupts = would_interrupt(state);
  const StartRefusal refusal = start_from(mission, offer, t_us, state.bearing, state.filter);
  if (refusal != StartRefusal::kNone) return refusal;
  change_mode(ModeEvent::kStart, state);
  state.interrupts = interrupts;
  state.missed = 0;
  state.rough = is_attitude_rough(state.filter);
  state.source = source;
  return StartRefusal::kNone;
}

TrackStep track_scan(const Mission& mission, Estimator& estimator, const RangeImage& scan, const TrackState& before) {
  TrackStep step;
  step.after = before;
  FilterState& filter = step.after.filter;
  const MissionParameters& p = mission.parameters;
  const ModeProperties& mode = properties(before.mode);
  predict_or_hold(p, scan.reference_time_us(), filter);
  const bool wide = (mode.wide_start || is_rough(mission, filter)) && p.wide_start > 0.5;
  Registration& registration = step.registration;
  registration = estimator.estimate(
      mission, scan, StartPoint{filter.T_sensor_target, filter.rates, wide, rate_sigma(mission.radius_m, filter), false, true});
  if (registration.valid()) registration.reason = confirm(p, mode, filter, registration);
  take(p, mode, step);
  return step;
}

void end_check(const MissionParameters& p, CheckOutcome verdict, TrackStep& step) {
  TrackState& state = step.after;
  Registration& registration = step.registration;
  const bool again = verdict == CheckOutcome::kUndecided && !state.check.undecided;
  if (verdict == CheckOutcome::kContradicted) {
    if (registration.reason == PoseReason::kUnchecked) registration.reason = PoseReason::kContradicted;
    step.refusal = StartRefusal::kContradicted;
    state.missed = UINT16_MAX;
    count_and_change(p, false, step);
    return confirm_anew(step);  // where the mode is held
  }
  state.check = StartCheck{};
  state.check.stage = again ? StartCheck::Stage::kNone : StartCheck::Stage::kPassed;
  state.check.undecided = again;
  if (again) return;
  if (registration.reason != PoseReason::kUnchecked) return;
  registration.reason = PoseReason::kValid;
  count_and_change(p, true, step);
}

void confirm_anew(TrackStep& step) {
  if (!has_transition(step.after.mode, ModeEvent::kConfirmAnew)) return;
  step.event = ModeEvent::kConfirmAnew;
  change_mode(step.event, step.after);
}

TrackStep track_part(const Mission& mission, const Parts& parts, PartNumber part, Estimator& estimator, const RangeImage& scan,
                     const TrackState& before) {
  TrackStep step;
  step.after = before;
  step.parts.scanned = part;
  FilterState& filter = step.after.filter;
  predict_or_hold(mission.parameters, scan.reference_time_us(), filter);
  Registration& registration = step.registration;
  registration = register_part(mission, parts[part - 1U], estimator, scan, filter);
  const PoseReason own = compare_parts(parts, registration, filter, step.after.parts, step.parts);
  registration.reason = own;
  take(mission.parameters, properties(before.mode), step);
  if (registration.reason != own) refuse_part(scan.scan_id, step.after.parts.of[part - 1U]);
  return step;
}

PartNumber next_part(const Mission& mission, const Parts& parts, PartNumber in_flight, std::uint32_t scan_id, TimeUs t_us,
                     TrackStep& step) {
  if (!properties(step.after.mode).by_parts) return kWhole;
  NextScan next{scan_id, step.after.filter, in_flight};
  if (predict_filter(next.predicted, t_us, filter_noise(mission.parameters)) != Status::kOk) return kWhole;
  return choose_part(mission, parts, next, step.after.parts);
}

void aim_next(const Mission& mission, Estimator& estimator, const TrackStep& step, std::uint32_t scan_id, TimeUs t_us, AimedRays& rays) {
  rays.clear();
  if (!step.registration.valid()) return;
  FilterState predicted = step.after.filter;
  if (predict_filter(predicted, t_us, filter_noise(mission.parameters)) != Status::kOk) return;
  const RayPlacementRequest request{scan_id, predicted.T_sensor_target, predicted.rates, likely_covariance(predicted)};
  aim_rays(mission, request, estimator.workspace(), rays);
}

TrackStep bearing_scan(const Mission& mission, BearingFinder& finder, const RangeImage& scan, const TrackState& before) {
  TrackStep step;
  step.after = before;
  step.bearing = finder.find(mission, scan, step.after.bearing);
  step.registration.scan_id = scan.scan_id;
  step.registration.t_us = scan.reference_time_us();
  step.registration.reason = PoseReason::kOnlyBearing;
  step.event = step.bearing.valid() ? ModeEvent::kBearingKnown : ModeEvent::kBearingUnknown;
  change_mode(step.event, step.after);
  return step;
}

TrackStep track_without_scan(const Mission& mission, PoseReason reason, std::uint32_t scan_id, TimeUs t_us, const TrackState& before) {
  TrackStep step;
  step.after = before;
  step.bearing.scan_id = scan_id;
  predict_or_hold(mission.parameters, t_us, step.after.filter);
  step.registration = not_registered(reason, scan_id, step.after.filter);
  if (properties(before.mode).full_field || properties(before.mode).searches) {
    step.event = ModeEvent::kBearingUnknown;
    change_mode(step.event, step.after);
  } else {
    count_and_change(mission.parameters, false, step);
  }
  return step;
}

TrackStep no_track(std::uint32_t scan_id, const TrackState& before) {
  TrackStep step;
  step.after = before;
  step.registration = not_registered(PoseReason::kNoTrack, scan_id, before.filter);
  return step;
}

}  // namespace lasso
