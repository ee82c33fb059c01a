#include "fsw/exec/component.hpp"

#include "fsw/core/renew.hpp"
#include "fsw/exec/named_pose.hpp"
#include "fsw/exec/report.hpp"
#include "fsw/exec/self_test.hpp"
#include "fsw/geometry/portable_math.hpp"

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

Component::Component(const SensorBank& sensors, const Identity& identity)
    : identity_(identity), acquisition_(sensors), downlink_(identity.apid), receiver_(identity.apid) {
  invariant(is_valid(identity), "an APID that a component can have");
  images_.use_parameters(parameter_area_);
}

Component::Component(Sensor& sensor, const Identity& identity) : Component(only(sensor), identity) {}

Status Component::begin(TimeUs boundary_0_us) {
  const Running running(identity_);
  if (!images_.started()) return Status::kMissing;
  if (executive_.begun()) return Status::kBadOrder;
  const MissionParameters& p = mission().parameters;
  invariant(executive_.begin(boundary_0_us, to_us(p.period_s)) == Status::kOk, "slots of a valid period");
  events_.set_time(boundary_0_us);
  inhibit_laser();
  events_.raise<EventId::kBegun>(software_version(), software_build(), mission().image_crc, health_.reset_cause);
  static_cast<void>(restore_parameters());
  health_.failed_tests = static_cast<std::uint8_t>(failed_self_tests());
  if (p.initial_present > 0.5) start_from_mission(boundary_0_us);
  return Status::kOk;
}

// The ways that are left are tried in bearing.
void Component::start_from_mission(TimeUs t_us) {
  const MissionParameters& p = mission().parameters;
  const StartRefusal refusal = offer_start(InitialPoseSource::kApriori, rough_offer(p, initial_pose(p), initial_rates(p), t_us));
  if (refusal == StartRefusal::kNone) return request_start(InitialPoseSource::kApriori);
  request_ = Request::kCommand;
  requested_event_ = ModeEvent::kSeek;
}

StartRefusal Component::offer_start(InitialPoseSource way, const StartOffer& offer) {
  const Running running(identity_);
  if (!executive_.begun()) return StartRefusal::kNotBegun;
  const auto index = static_cast<std::size_t>(way);
  if (index == 0 || way == InitialPoseSource::kSearch || index >= kInitialPoseSources) return StartRefusal::kNoSuchSource;
  TrackState tried = track_;
  StartRefusal refusal = start_track(mission(), way, offer, executive_.next_boundary_us(), tried);
  if (safe_requested()) refusal = StartRefusal::kNotFromHere;
  if (refusal != StartRefusal::kNone) {
    refuse_start(way, refusal);
    return refusal;
  }
  sources_.put(way, offer);
  if (way == InitialPoseSource::kHandover || way == InitialPoseSource::kUplink) request_start(way);
  return StartRefusal::kNone;
}

// What was asked for does not come later.
void Component::drop_request() {
  if (request_ == Request::kStart) static_cast<void>(sources_.take(requested_way_));
  request_ = Request::kNone;
}

// A command takes the place of one that no boundary has carried out yet.
void Component::request_start(InitialPoseSource way) {
  if (request_ == Request::kStart && requested_way_ != way) static_cast<void>(sources_.take(requested_way_));
  request_ = Request::kStart;
  requested_way_ = way;
}

Status Component::start_tracking(const Pose& T_sensor_target, const Twist& rates, TimeUs t_us) {
  const StartRefusal refusal = offer_start(InitialPoseSource::kUplink, rough_offer(mission().parameters, T_sensor_target, rates, t_us));
  if (refusal == StartRefusal::kNone) return Status::kOk;
  if (refusal == StartRefusal::kNotBegun) return Status::kBadOrder;
  return refusal == StartRefusal::kNotFinite ? Status::kNotFinite : Status::kBadValue;
}

ModeRefusal Component::command_mode(TrackingMode mode) {
  if (!executive_.begun()) return ModeRefusal::kNotBegun;
  ModeRefusal refusal = ModeRefusal::kNone;
  ModeEvent event = ModeEvent::kStop;
  if (!command_event(mode, event)) {
    refusal = ModeRefusal::kNotByCommand;
  } else if (event == ModeEvent::kReacquire && !track_.filter.initialised) {
    refusal = ModeRefusal::kNoPrediction;
  } else if (safe_requested() || (track_.mode != mode && !has_transition(track_.mode, event))) {
    refusal = ModeRefusal::kNotFromHere;
  }
  if (refusal != ModeRefusal::kNone) {
    ++counters_.refused_commands;
    return refusal;
  }
  drop_request();
  request_ = Request::kCommand;
  requested_event_ = event;
  return refusal;
}

Status Component::stop_tracking() { return command_mode(TrackingMode::kStandby) == ModeRefusal::kNone ? Status::kOk : Status::kBadOrder; }

void Component::run_slot(TimeUs now_us) {
  const Running running(identity_);
  invariant(executive_.begun(), "slot before begin");
  if (executive_.jumped(now_us)) follow_jump(now_us);
  executive_.note_start(now_us);
  events_.set_time(now_us);
  const std::uint32_t slot = executive_.next_slot();
  for (const SlotRow& row : slot_table()) {
    if (is_due(row, slot)) run_task(row.task, now_us);
  }
  check_in_.slot(slot);
  executive_.advance();
}

void Component::run_task(TaskId task, TimeUs now_us) {
  if (task == TaskId::kPollSensor) return acquisition_.poll(now_us);
  if (task == TaskId::kTendMemory) return tend_memory();
  check_mode();
  check_laser();
  seen_.add(Fault::kImageCorrupt, !images_.keep_selection());
  publish_estimate(now_us);
  feed_watchdog();
  pass_link_boundary(now_us);
  check_area();
  pass_memory_boundary();
  apply_parameters();
  answer_faults(now_us);
  apply_request();
  choose_sensor();
  hand_over_scan();
  start_scan(now_us);
  mode_.set(track_.mode);
  send_sensors(now_us);
  send_image(now_us);
  send_events();
}

void Component::publish_estimate(TimeUs now_us) {
  TrackStep step;
  const bool in_time = estimation_.collect(step);
  aimed_.clear();
  part_ = kWhole;
  if (estimated_.active) {
    if (!in_time) renew(step, [&] { return step_without_estimate(); });
    if (in_time) aimed_ = estimation_.aimed();
    if (in_time) part_ = estimation_.part();
    follow(step);
    send(step, now_us);
  } else if (properties(track_.mode).says_lost || report_overdue() || housekeeping_.asked(kPoseStructureId)) {
    const std::uint32_t frame = executive_.frame();
    renew(step, [&] { return no_track(frame > kPipelineFrames ? frame - kPipelineFrames : 0, track_); });
    send(step, now_us);
  }
  if (housekeeping_.due(kFilterStructureId, estimated_.active)) send_filter(step.registration.common, now_us);
  if (housekeeping_.due(kNamedPoseStructureId, estimated_.active)) send_named_poses(step.registration, now_us);
}

// Changes of the mode wait for the next packet, if one is on its way.
bool Component::report_overdue() const { return changes_.size() >= kPoseChanges || (!changes_.empty() && !acquired_.active); }

void Component::follow(TrackStep& step) {
  trial_.note(step.registration, track_.mode);
  refuse_in(step);
  if (step.after.mode == TrackingMode::kTracking) sources_.put(InitialPoseSource::kSearch, StartOffer{});
  if (step.parts.inconsistent != kWhole) {
    ++counters_.odd_parts;
    events_.raise<EventId::kPartOdd>(step.parts.inconsistent, step.parts.inconsistency_sigmas);
  }
  if (step.event == ModeEvent::kFallBack) take_up_former(step);
  const TrackingMode next = next_mode(track_.mode, step.event);
  if (next != track_.mode) note_change({track_.mode, step.event, next});
  seen_.add(Fault::kModeCorrupt, step.after.mode != next);
  watch_filter(step);
  step.after.mode = next;  // what is sent of this step tells the table's mode
  track_ = step.after;
}

// Its prediction is what is told of it. Where it is too old for one it stays as it was, and so it is told.
void Component::take_up_former(TrackStep& step) {
  static_cast<void>(predict_filter(former_, step.registration.t_us, filter_noise(images_.view(track_.sensor).mission.parameters)));
  step.after.filter = former_;
}

// A start that ends without a track, by its frames or by a check; or the pose that a search found.
void Component::refuse_in(const TrackStep& step) {
  const bool starting = track_.mode == TrackingMode::kStarting;
  const bool given_up = starting && step.event != ModeEvent::kPoseValid && next_mode(track_.mode, step.event) != track_.mode;
  const bool refused = step.refusal != StartRefusal::kNone;
  if (refused) return refuse_start(starting ? track_.way : InitialPoseSource::kSearch, step.refusal);
  if (given_up) refuse_start(track_.way, StartRefusal::kNotConfirmed);
}

void Component::refuse_start(InitialPoseSource way, StartRefusal refusal) {
  ++counters_.refused_starts;
  refused_way_ = way;
  refusal_ = refusal;
  events_.raise<EventId::kStartRefused>(way, refusal);
}

void Component::run_estimation() {
  const Running running(identity_);
  estimation_.run();
}

// At most four at a boundary (a scan's, a fault's, a command's, a start's), and a packet takes four: there is always room.
void Component::note_change(const ModeChange& change) {
  events_.raise<EventId::kModeChanged>(change.from, change.event, change.to);
  invariant(changes_.push_back(change), "more changes of the mode than can wait for a packet");
}

TrackStep Component::step_without_estimate() {
  ++counters_.overruns;
  events_.raise<EventId::kEstimateLate>(estimated_.scan_id);
  seen_.add(Fault::kEstimateOverrun);
  const Mission& mission = images_.view(track_.sensor).mission;
  TrackStep step = track_without_scan(mission, PoseReason::kOverrun, estimated_.scan_id, estimated_.t_nominal_us, track_);
  step.parts.scanned = estimated_.part;
  if (properties(track_.mode).searches) count_and_change(mission.parameters, false, step);  // a search that is always late ends, too
  return step;
}

void Component::apply_request() {
  const Request request = request_;
  request_ = Request::kNone;
  track_.held = held_;
  if (request == Request::kStart) try_start(requested_way_);
  if (request == Request::kCommand) take(requested_event_);
  try_ways();
}

// Nothing where the mode is there already, or has changed since the event was asked for. Between tracking and short_range the track goes
// on, with the scans that are on their way.
void Component::take(ModeEvent event) {
  if (event == ModeEvent::kMakeSafe) inhibit_laser();
  if (!has_transition(track_.mode, event)) return;
  note_change({track_.mode, event, next_mode(track_.mode, event)});
  change_mode(event, track_);
  part_ = kWhole;
  if (event == ModeEvent::kNear || event == ModeEvent::kFar) return;
  leave_track();
  before_trial_ = TrackState{};
}

void Component::try_start(InitialPoseSource way) {
  const TrackingMode before = track_.mode;
  if (!track_.interrupts) former_ = track_.filter;
  const StartRefusal refusal = start_track(mission(), way, sources_.take(way), executive_.next_slot_us(), track_);
  if (refusal != StartRefusal::kNone) {
    refuse_start(way, refusal);
    return;
  }
  note_change({before, ModeEvent::kStart, track_.mode});
  leave_track();
  before_trial_ = TrackState{};
}

// What was planned by the track that ends here counts no more.
void Component::leave_track() {
  acquired_.active = false;
  aimed_.clear();
  part_ = kWhole;
}

// Loop bound: each try takes an offer, of which there is one a way; a search awaits no other start. Where all are refused a search is the
// next way, whose turn comes in bearing.
void Component::try_ways() {
  if (track_.held) return;
  const std::uint32_t refused = counters_.refused_starts;
  InitialPoseSource way = next_way();
  while (properties(track_.mode).awaits_start && way != InitialPoseSource::kNone) {
    take_way(way);
    way = next_way();
  }
  const bool left = properties(track_.mode).awaits_start && is_in_order(mission().parameters, InitialPoseSource::kSearch);
  if (left && counters_.refused_starts != refused) take(ModeEvent::kSeek);
}

InitialPoseSource Component::next_way() const {
  return sources_.next(mission().parameters, properties(track_.mode).full_field && track_.bearing.started);
}

void Component::take_way(InitialPoseSource way) {
  if (way != InitialPoseSource::kSearch) return try_start(way);
  static_cast<void>(sources_.take(way));
  take(ModeEvent::kSearch);
}

// What no packet tells of a change, its event has told.
void Component::send(const TrackStep& step, TimeUs now_us) {
  PoseTelemetry report = make_report(mission(), step, estimated_.plan, now_us);
  report.sensor = estimated_.sensor.sensor;
  report.sensor_reason = static_cast<std::uint8_t>(estimated_.sensor.reason);
  report.sensors_failed = chooser_.failed(estimated_.scan_id);
  if (!step.registration.valid()) ++counters_.invalid_frames;
  if (!housekeeping_.due(kPoseStructureId, true)) return changes_.clear();
  set_counters(report);
  set_changes(report);
  std::uint8_t packet[kMaxPosePacketBytes];
  const PacketHeader header = downlink_.next_header(kHousekeepingReport, now_us);
  downlink_.send({packet, encode_pose(report, header, Bytes(packet))});
}

void Component::send_filter(const CommonErrors& common, TimeUs now_us) {
  const FilterTelemetry report = make_filter_report(estimated_.scan_id, track_.filter, common);
  std::uint8_t packet[kMaxFilterBytes];
  downlink_.send({packet, encode_filter(report, downlink_.next_header(kHousekeepingReport, now_us), Bytes(packet))});
}

// Frames that have decayed are not told before the scrub has put them right. Loop bound: kMaxNamedFrames.
void Component::send_named_poses(const Registration& registration, TimeUs now_us) {
  const ImageSlot& image = images_.active();
  const auto pairs = static_cast<std::uint8_t>(image.named_frames());
  NamedFrame frame;
  for (std::uint8_t i = 0; i < pairs; ++i) {
    if (!image.find_named_frame(i, frame)) continue;
    NamedPoseTelemetry report = make_named_pose_report(frame, registration, track_.filter);
    report.scan_id = estimated_.scan_id;
    report.pair = static_cast<std::uint8_t>(i + 1);
    report.pairs = pairs;
    std::uint8_t packet[kMaxNamedPoseBytes];
    downlink_.send({packet, encode_named_pose(report, downlink_.next_header(kHousekeepingReport, now_us), Bytes(packet))});
  }
}

void Component::set_changes(PoseTelemetry& report) {
  const std::size_t told = changes_.size() < kPoseChanges ? changes_.size() : kPoseChanges;
  report.changes = static_cast<std::uint8_t>(told);
  for (std::size_t i = 0; i < told; ++i) {
    report.change_from[i] = static_cast<std::uint8_t>(changes_[i].from);
    report.change_event[i] = static_cast<std::uint8_t>(changes_[i].event);
    report.change_to[i] = static_cast<std::uint8_t>(changes_[i].to);
  }
  const Span<const ModeChange> all = changes_.span();
  changes_.clear();
  for (std::size_t i = told; i < all.size(); ++i) invariant(changes_.push_back(all[i]), "fewer changes than before");
}

void Component::set_counters(PoseTelemetry& report) const {
  report.frames = executive_.frame() + 1;
  report.invalid_frames = counters_.invalid_frames;
  report.lost_scans = counters_.lost_scans;
  report.overruns = counters_.overruns;
  report.refused_starts = counters_.refused_starts;
  report.refused_commands = counters_.refused_commands;
  report.odd_parts = counters_.odd_parts;
  report.sensor_changes = chooser_.changes();
  report.refused_way = static_cast<std::uint8_t>(refused_way_);
  report.refusal = static_cast<std::uint8_t>(refusal_);
  report.slot_slips = executive_.slips();
  report.dropped_packets = downlink_.queue().dropped();
}

}  // namespace lasso
