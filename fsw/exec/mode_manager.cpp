#include "fsw/exec/mode_manager.hpp"

#include "fsw/core/renew.hpp"

namespace lasso {
namespace {

Pose initial_pose(const MissionParameters& p) {
  Pose pose;
  pose.q = Quat(p.initial_qw, p.initial_qx, p.initial_qy, p.initial_qz);
  pose.p = Vec3(p.initial_x_m, p.initial_y_m, p.initial_z_m);
  return pose;
}

Twist initial_rates(const MissionParameters& p) {
  Twist rates;
  rates.omega_radps = Vec3(p.initial_wx_radps, p.initial_wy_radps, p.initial_wz_radps);
  rates.v_mps = Vec3(p.initial_vx_mps, p.initial_vy_mps, p.initial_vz_mps);
  return rates;
}

}  // namespace

// Where the mission's pose is refused the other sources are tried in bearing.
void ModeManager::begin(TimeUs boundary_0_us) {
  const MissionParameters& p = mission().parameters;
  if (p.initial_present <= 0.5) return;
  const StartRefusal refusal = offer_start(InitialPoseSource::kApriori, rough_offer(p, initial_pose(p), initial_rates(p), boundary_0_us));
  if (refusal == StartRefusal::kNone) return request_start(InitialPoseSource::kApriori);
  request_.kind = Request::Kind::kCommand;
  request_.event = ModeEvent::kSeek;
}

StartRefusal ModeManager::offer_start(InitialPoseSource source, const StartOffer& offer) {
  if (!context_.executive.begun()) return StartRefusal::kNotBegun;
  const auto index = static_cast<std::size_t>(source);
  if (index == 0 || source == InitialPoseSource::kSearch || index >= kInitialPoseSources) return StartRefusal::kNoSuchSource;
  TrackState tried = track_;
  StartRefusal refusal = start_track(mission(), source, offer, context_.executive.next_boundary_us(), tried);
  if (safe_requested()) refusal = StartRefusal::kNotFromHere;
  if (refusal != StartRefusal::kNone) {
    refuse_start(source, refusal);
    return refusal;
  }
  sources_.put(source, offer);
  if (source == InitialPoseSource::kHandover || source == InitialPoseSource::kUplink) request_start(source);
  return StartRefusal::kNone;
}

// What was asked for does not come later.
void ModeManager::drop_request() {
  if (request_.kind == Request::Kind::kStart) static_cast<void>(sources_.take(request_.source));
  request_.kind = Request::Kind::kNone;
}

// A command takes the place of one that no boundary has carried out yet.
void ModeManager::request_start(InitialPoseSource source) {
  if (request_.kind == Request::Kind::kStart && request_.source != source) static_cast<void>(sources_.take(request_.source));
  request_.kind = Request::Kind::kStart;
  request_.source = source;
}

ModeRefusal ModeManager::refusal_of(TrackingMode mode, ModeEvent& event) const {
  if (!command_event(mode, event)) return ModeRefusal::kNotByCommand;
  if (event == ModeEvent::kReacquire && !track_.filter.initialised) return ModeRefusal::kNoPrediction;
  const bool reachable = track_.mode == mode || has_transition(track_.mode, event);
  return safe_requested() || !reachable ? ModeRefusal::kNotFromHere : ModeRefusal::kNone;
}

ModeRefusal ModeManager::command_mode(TrackingMode mode) {
  if (!context_.executive.begun()) return ModeRefusal::kNotBegun;
  ModeEvent event = ModeEvent::kStop;
  const ModeRefusal refusal = refusal_of(mode, event);
  if (refusal != ModeRefusal::kNone) {
    ++counters_.refused_commands;
    return refusal;
  }
  drop_request();
  request_.kind = Request::Kind::kCommand;
  request_.event = event;
  return refusal;
}

void ModeManager::check_mode() {
  TrackingMode voted = TrackingMode::kSafe;
  const bool known = mode_.get(voted);
  const bool agreed = mode_.agreed() && voted == track_.mode;
  if (!agreed) context_.health.note_mode_repair();
  context_.health.see(Fault::kModeLost, !known);
  context_.health.see(Fault::kModeCorrupt, !agreed);
  if (!known) note_change({TrackingMode::kStandby, ModeEvent::kMakeSafe, TrackingMode::kSafe});
  if (!known) context_.interlocks.inhibit_laser();
  track_.mode = voted;
  mode_.set(voted);
}

void ModeManager::follow(TrackStep& step) {
  refuse_in(step);
  if (step.after.mode == TrackingMode::kTracking) sources_.put(InitialPoseSource::kSearch, StartOffer{});
  if (step.parts.inconsistent != kWhole) {
    ++counters_.inconsistent_parts;
    context_.telemetry.raise<EventId::kPartInconsistent>(step.parts.inconsistent, step.parts.inconsistency_sigmas);
  }
  if (step.event == ModeEvent::kFallBack) resume_former(step);
  const TrackingMode next = next_mode(track_.mode, step.event);
  if (next != track_.mode) note_change({track_.mode, step.event, next});
  context_.health.see(Fault::kModeCorrupt, step.after.mode != next);
  watch_filter(step);
  step.after.mode = next;  // what is sent of this step states the table's mode
  track_ = step.after;
}

// Its prediction is what is reported of it. Where it is too old for one it stays as it was, and is reported so.
void ModeManager::resume_former(TrackStep& step) {
  const Mission& of_sensor = context_.images.view(track_.sensor).mission;
  static_cast<void>(predict_filter(former_, step.registration.t_us, filter_noise(of_sensor.parameters)));
  step.after.filter = former_;
}

// A start that ends without a track, by its frames or by a check; or the pose that a search found.
void ModeManager::refuse_in(const TrackStep& step) {
  const bool starting = properties(track_.mode).tries_start;
  const bool given_up = starting && step.event != ModeEvent::kPoseValid && !properties(next_mode(track_.mode, step.event)).tries_start;
  const bool refused = step.refusal != StartRefusal::kNone;
  if (refused) return refuse_start(starting ? track_.source : InitialPoseSource::kSearch, step.refusal);
  if (given_up) refuse_start(track_.source, StartRefusal::kNotConfirmed);
}

// A filter that excludes what scan after scan says, or has no numbers any more, is the one that is wrong.
void ModeManager::watch_filter(const TrackStep& step) {
  const bool implausible = step.registration.reason == PoseReason::kImplausible;
  context_.health.see(Fault::kImplausiblePose, implausible);
  context_.health.see(Fault::kFilterDivergence, implausible || !is_sound(step.after.filter));
}

void ModeManager::refuse_start(InitialPoseSource source, StartRefusal refusal) {
  ++counters_.refused_starts;
  counters_.refused_source = source;
  counters_.refusal = refusal;
  context_.telemetry.raise<EventId::kStartRefused>(source, refusal);
}

// At most four at a boundary (a scan's, an image's or a fault's, a command's, a start's), and a packet takes four: there is always room. A
// fault that makes safe leaves no command. A jump of the clock takes the place of the scan's.
void ModeManager::note_change(const ModeChange& change) {
  context_.telemetry.raise<EventId::kModeChanged>(change.from, change.event, change.to);
  invariant(changes_.push_back(change), "more changes of the mode than can wait for a packet");
}

void ModeManager::answer(FaultReaction reaction) {
  if (reaction == FaultReaction::kReacquire) doubt_track();
  if (reaction != FaultReaction::kMakeSafe) return;
  drop_request();
  take(ModeEvent::kMakeSafe);
}

// The prediction is as good as a start that somebody guesses; where it has no numbers, nobody knows even that.
void ModeManager::doubt_track() {
  if (!properties(track_.mode).scans || !has_transition(track_.mode, ModeEvent::kReacquire)) return;
  const MissionParameters& p = mission().parameters;
  FilterState& filter = track_.filter;
  const StartOffer guess = rough_offer(p, filter.T_sensor_target, filter.rates, filter.t_us);
  const bool known = start_filter(filter, filter_start(p, guess)) == Status::kOk;
  take(known ? ModeEvent::kReacquire : ModeEvent::kSeek);
}

void ModeManager::apply_request() {
  const Request request = request_;
  request_.kind = Request::Kind::kNone;
  track_.held = held_;
  if (request.kind == Request::Kind::kStart) try_start(request.source);
  if (request.kind == Request::Kind::kCommand) take(request.event);
  try_sources();
}

// Nothing where the mode is there already, or has changed since the event was asked for. Between tracking and short_range the track goes
// on, with the scans that are on their way.
void ModeManager::take(ModeEvent event) {
  if (event == ModeEvent::kMakeSafe) context_.interlocks.inhibit_laser();
  if (!has_transition(track_.mode, event)) return;
  follow_table(event);
  context_.scans.look_at_whole();
  if (event == ModeEvent::kNear || event == ModeEvent::kFar) return;
  context_.scans.drop_plans();
  forget_before_trial();
}

// Nothing where the table has no such way.
void ModeManager::follow_table(ModeEvent event) {
  if (!has_transition(track_.mode, event)) return;
  note_change({track_.mode, event, next_mode(track_.mode, event)});
  change_mode(event, track_);
}

void ModeManager::try_start(InitialPoseSource source) {
  const TrackingMode before = track_.mode;
  if (!track_.interrupts) former_ = track_.filter;
  const StartRefusal refusal = start_track(mission(), source, sources_.take(source), context_.executive.next_slot_us(), track_);
  if (refusal != StartRefusal::kNone) {
    refuse_start(source, refusal);
    return;
  }
  note_change({before, ModeEvent::kStart, track_.mode});
  context_.scans.drop_plans();
  forget_before_trial();
}

// Loop bound: each try takes an offer, of which there is one a source; a search awaits no other start. Where all are refused a search is
// the next source, whose turn comes in bearing.
void ModeManager::try_sources() {
  if (track_.held) return;
  const std::uint32_t refused = counters_.refused_starts;
  InitialPoseSource source = next_source();
  while (properties(track_.mode).awaits_start && source != InitialPoseSource::kNone) {
    take_source(source);
    source = next_source();
  }
  const bool left = properties(track_.mode).awaits_start && is_in_order(mission().parameters, InitialPoseSource::kSearch);
  if (left && counters_.refused_starts != refused) take(ModeEvent::kSeek);
}

InitialPoseSource ModeManager::next_source() const {
  return sources_.next(mission().parameters, properties(track_.mode).full_field && track_.bearing.started);
}

void ModeManager::take_source(InitialPoseSource source) {
  if (source != InitialPoseSource::kSearch) return try_start(source);
  static_cast<void>(sources_.take(source));
  take(ModeEvent::kSearch);
}

void ModeManager::forget_before_trial() {
  renew(before_trial_, [] { return TrackState{}; });
}

// What was offered is of another time, or of another target. A start that waits for the boundary is refused, as all that comes too late.
void ModeManager::forget_offers() {
  if (request_.kind == Request::Kind::kStart) {
    refuse_start(request_.source, StartRefusal::kTooOld);
    drop_request();
  }
  renew(sources_, [] { return InitialPoseSources{}; });
}

void ModeManager::use_sensor(SensorNumber sensor) {
  if (track_.sensor == sensor) return;
  forget_common_errors(track_.filter);
  forget_common_errors(former_);
  track_.sensor = sensor;
}

void ModeManager::follow_jump(DurationUs moved_us) {
  track_.filter.t_us += moved_us;
  confirm_anew();                                           // the scan that a check searches is of another time
  if (properties(track_.mode).searches) ++track_.searches;  // so are those that the search has joined: it begins anew
  former_.t_us += moved_us;
  track_.bearing.t_us += moved_us;
  forget_before_trial();
  forget_offers();
}

void ModeManager::take_over_track(bool kept, bool on_trial) {
  forget_before_trial();
  if (kept && on_trial) before_trial_ = track_;
  context_.scans.drop_plans();
  if (!kept) return leave_target();
  follow_table(ModeEvent::kConfirmAnew);  // a check searches the other image's tables
}

// Between boundaries, so that the copies are compared before, and follow.
void ModeManager::confirm_anew() {
  check_mode();
  follow_table(ModeEvent::kConfirmAnew);
  keep_mode();
}

// The mode is its own: a track that was lost is looked for again. In bearing a start is awaited, and nothing leads back to the prediction.
void ModeManager::restore_track() {
  if (properties(track_.mode).full_field) return;
  track_.filter = before_trial_.filter;
  track_.sensor = before_trial_.sensor;
  track_.parts = before_trial_.parts;
  track_.missed = 0;
  if (track_.mode == TrackingMode::kLost) take(ModeEvent::kReacquire);
}

// What was known of the target, and of the sensors, is of no use with an image of another one.
void ModeManager::leave_target() {
  forget_offers();
  context_.scans.forget_sensors();
  track_.filter = FilterState{};
  track_.sensor = 0;  // the other image may have fewer
  if (track_.mode != TrackingMode::kSafe) follow_table(ModeEvent::kStop);
}

void ModeManager::report(PoseTelemetry& report) {
  report.refused_starts = counters_.refused_starts;
  report.refused_commands = counters_.refused_commands;
  report.inconsistent_parts = counters_.inconsistent_parts;
  report.refused_source = static_cast<std::uint8_t>(counters_.refused_source);
  report.refusal = static_cast<std::uint8_t>(counters_.refusal);
  move_changes(report);
}

void ModeManager::move_changes(PoseTelemetry& report) {
  const std::size_t reported = changes_.size() < kPoseChanges ? changes_.size() : kPoseChanges;
  report.changes = static_cast<std::uint8_t>(reported);
  for (std::size_t i = 0; i < reported; ++i) {
    report.change_from[i] = static_cast<std::uint8_t>(changes_[i].from);
    report.change_event[i] = static_cast<std::uint8_t>(changes_[i].event);
    report.change_to[i] = static_cast<std::uint8_t>(changes_[i].to);
  }
  const Span<const ModeChange> all = changes_.span();
  changes_.clear();
  for (std::size_t i = reported; i < all.size(); ++i) invariant(changes_.push_back(all[i]), "fewer changes than before");
}

}  // namespace lasso
