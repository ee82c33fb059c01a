#include "fsw/exec/component.hpp"

#include "fsw/exec/report.hpp"
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

// The whole's scans and each part's end within the period.
bool scans_fit(const Mission& mission, const Parts& parts) {
  const double period_s = mission.parameters.period_s;
  bool fit = mission.parameters.duration_s <= period_s;
  for (const Part& part : parts) fit = fit && part.mission.parameters.duration_s <= period_s;
  return fit;
}

const char* fault_of(const SensorParameters& sensor) {
  if (!(sensor.range_min_m < sensor.range_max_m)) return "sensor.range_min_m is not below sensor.range_max_m";
  return sensor.use_from_m < sensor.use_to_m ? nullptr : "sensor.use_from_m is not below sensor.use_to_m";
}

// Parameters that are right by themselves but not together, or not on this board; nullptr: none.
const char* fault_of(const Mission& mission, const Parts& parts, std::size_t sensors) {
  const MissionParameters& p = mission.parameters;
  if (mission.sensors.size() > sensors) return "the mission has more sensors than are connected";
  for (const SensorParameters& sensor : mission.sensors) {
    const char* fault = fault_of(sensor);
    if (fault != nullptr) return fault;
  }
  if (!scans_fit(mission, parts)) return "scan.duration_s exceeds filter.period_s";
  if (p.short_range_enter_m > 0 && !(p.short_range_leave_m > p.short_range_enter_m)) {
    return "short_range.leave_m is not above short_range.enter_m";
  }
  return nullptr;
}

}  // namespace

Component::Component(const SensorBank& sensors) : acquisition_(sensors) {}

Component::Component(Sensor& sensor) : Component(only(sensor)) {}

LoadFailure Component::load_image(Bytes image) {
  LoadFailure failure;
  if (executive_.begun()) {
    failure.status = Status::kBadOrder;
    failure.what = "the component has begun";
    return failure;
  }
  loaded_ = false;  // whatever follows, the image that was loaded before may have been overwritten
  failure = lasso::load_image(image, views_[0].mission, views_[0].parts);
  if (failure.status != Status::kOk) return failure;
  const char* fault = fault_of(mission(), parts(), acquisition_.sensors());
  loaded_ = fault == nullptr;
  if (loaded_) make_views();
  if (!loaded_) {
    failure.status = Status::kBadValue;
    failure.what = fault;
  }
  return failure;
}

void Component::make_views() {
  for (std::size_t i = 1; i < mission().sensors.size(); ++i) {
    views_[i] = views_[0];
    use_sensor(static_cast<SensorNumber>(i), views_[i].mission, views_[i].parts);
  }
}

Status Component::begin(TimeUs boundary_0_us) {
  if (!loaded_) return Status::kMissing;
  if (executive_.begun()) return Status::kBadOrder;
  const MissionParameters& p = mission().parameters;
  invariant(executive_.begin(boundary_0_us, to_us(p.period_s)) == Status::kOk, "slots of a valid period");
  if (p.initial_present < 0.5) return Status::kOk;
  const StartOffer offer = rough_offer(p, initial_pose(p), initial_rates(p), boundary_0_us);
  if (offer_start(StartWay::kApriori, offer) != StartRefusal::kNone) return Status::kBadValue;
  request_start(StartWay::kApriori);
  return Status::kOk;
}

StartRefusal Component::offer_start(StartWay way, const StartOffer& offer) {
  if (!executive_.begun()) return StartRefusal::kNotBegun;
  const auto index = static_cast<std::size_t>(way);
  if (index == 0 || way == StartWay::kSearch || index >= kStartWays) return StartRefusal::kNoSuchWay;
  FilterState tried;
  const StartRefusal refusal = start_from(mission(), offer, executive_.next_boundary_us(), track_.bearing, tried);
  if (refusal != StartRefusal::kNone) {
    refuse_start(way, refusal);
    return refusal;
  }
  desk_.put(way, offer);
  if (way == StartWay::kHandover || way == StartWay::kUplink) request_start(way);
  return StartRefusal::kNone;
}

// A command takes the place of one that no boundary has carried out yet.
void Component::request_start(StartWay way) {
  if (request_ == Request::kStart && requested_way_ != way) static_cast<void>(desk_.take(requested_way_));
  request_ = Request::kStart;
  requested_way_ = way;
}

Status Component::start_tracking(const Pose& T_sensor_target, const Twist& rates, TimeUs t_us) {
  const StartRefusal refusal = offer_start(StartWay::kUplink, rough_offer(mission().parameters, T_sensor_target, rates, t_us));
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
  } else if (track_.mode != mode && !has_transition(track_.mode, event)) {
    refusal = ModeRefusal::kNotFromHere;
  }
  if (refusal != ModeRefusal::kNone) {
    ++counters_.refused_commands;
    return refusal;
  }
  request_ = Request::kCommand;
  requested_event_ = event;
  return refusal;
}

Status Component::stop_tracking() { return command_mode(TrackingMode::kStandby) == ModeRefusal::kNone ? Status::kOk : Status::kBadOrder; }

void Component::run_slot(TimeUs now_us) {
  invariant(executive_.begun(), "slot before begin");
  executive_.note_start(now_us);
  const std::uint32_t slot = executive_.next_slot();
  for (const SlotRow& row : slot_table()) {
    if (is_due(row, slot)) run_task(row.task, now_us);
  }
  executive_.advance();
}

void Component::run_task(TaskId task, TimeUs now_us) {
  if (task == TaskId::kPollSensor) return acquisition_.poll(now_us);
  publish_estimate(now_us);
  pass_link_boundary(now_us);
  apply_request();
  choose_sensor();
  hand_over_scan();
  start_scan();
}

void Component::publish_estimate(TimeUs now_us) {
  TrackStep step;
  const bool in_time = estimation_.collect(step);
  aimed_.clear();
  part_ = kWhole;
  if (estimated_.active) {
    if (!in_time) step = step_without_estimate();
    if (in_time) aimed_ = estimation_.aimed();
    if (in_time) part_ = estimation_.part();
    follow(step);
    send(step, now_us);
  } else if (properties(track_.mode).says_lost || report_overdue()) {
    send(no_track(executive_.frame() - kPipelineFrames, track_), now_us);
  }
}

// Changes of the mode wait for the next packet, if one is on its way.
bool Component::report_overdue() const { return changes_.size() >= kPoseChanges || (!changes_.empty() && !acquired_.active); }

void Component::follow(const TrackStep& step) {
  const bool given_up =
      track_.mode == TrackingMode::kStarting && (step.event == ModeEvent::kExhausted || step.event == ModeEvent::kRecover);
  if (given_up) refuse_start(track_.way, StartRefusal::kNotConfirmed);
  if (step.refusal != StartRefusal::kNone) refuse_start(StartWay::kSearch, step.refusal);
  if (step.after.mode == TrackingMode::kTracking) desk_.put(StartWay::kSearch, StartOffer{});
  if (step.parts.odd != kWhole) ++counters_.odd_parts;
  if (step.after.mode != track_.mode) note_change({track_.mode, step.event, step.after.mode});
  track_ = step.after;
}

void Component::refuse_start(StartWay way, StartRefusal refusal) {
  ++counters_.refused_starts;
  refused_way_ = way;
  refusal_ = refusal;
}

void Component::run_estimation() {
  if (!estimation_.pending()) return;
  const View& view = views_[estimation_.sensor()];
  estimation_.run(view.mission, view.parts);
}

// At most three at a boundary (a scan's, a command's, a start's), and a packet takes four: there is always room.
void Component::note_change(const ModeChange& change) {
  invariant(changes_.push_back(change), "more changes of the mode than can wait for a packet");
}

TrackStep Component::step_without_estimate() {
  ++counters_.overruns;
  TrackStep step = track_without_scan(mission(), PoseReason::kOverrun, estimated_.scan_id, estimated_.t_nominal_us, track_);
  step.parts.scanned = estimated_.part;
  if (properties(track_.mode).searches) count_and_change(mission().parameters, false, step);  // a search that is always late ends, too
  return step;
}

void Component::apply_request() {
  const Request request = request_;
  request_ = Request::kNone;
  track_.held = held_;
  if (request == Request::kStart) try_start(requested_way_);
  if (request == Request::kCommand) apply_command();
  try_ways();
}

void Component::apply_command() {
  if (!has_transition(track_.mode, requested_event_)) return;  // the mode is there already, or has changed since
  note_change({track_.mode, requested_event_, next_mode(track_.mode, requested_event_)});
  change_mode(requested_event_, track_);
  leave_track();
}

void Component::try_start(StartWay way) {
  const TrackingMode before = track_.mode;
  const StartRefusal refusal = start_track(mission(), way, desk_.take(way), executive_.next_slot_us(), track_);
  if (refusal != StartRefusal::kNone) {
    refuse_start(way, refusal);
    return;
  }
  note_change({before, ModeEvent::kStart, track_.mode});
  leave_track();
}

// What was planned by the track that ends here counts no more.
void Component::leave_track() {
  acquired_.active = false;
  aimed_.clear();
  part_ = kWhole;
}

// Loop bound: each try takes an offer, of which there is one a way; a search awaits no other start.
void Component::try_ways() {
  if (track_.held) return;
  StartWay way = next_way();
  while (properties(track_.mode).awaits_start && way != StartWay::kNone) {
    take_way(way);
    way = next_way();
  }
}

StartWay Component::next_way() const {
  return desk_.next(mission().parameters, properties(track_.mode).full_field && track_.bearing.started);
}

void Component::take_way(StartWay way) {
  if (way != StartWay::kSearch) return try_start(way);
  static_cast<void>(desk_.take(way));
  note_change({track_.mode, ModeEvent::kSearch, next_mode(track_.mode, ModeEvent::kSearch)});
  change_mode(ModeEvent::kSearch, track_);
  leave_track();
}

void Component::send(const TrackStep& step, TimeUs now_us) {
  PoseTelemetry report = make_report(mission(), step, estimated_.plan, now_us);
  report.sensor = estimated_.sensor.sensor;
  report.sensor_reason = static_cast<std::uint8_t>(estimated_.sensor.reason);
  report.sensors_failed = chooser_.failed(estimated_.scan_id);
  if (!step.registration.valid()) ++counters_.invalid_frames;
  set_counters(report);
  set_changes(report);
  std::uint8_t packet[kMaxPosePacketBytes];
  enqueue({packet, encode_pose(report, next_header(Message::kHousekeeping, now_us), Bytes(packet))});
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
  report.dropped_packets = queue_.dropped();
}

}  // namespace lasso
