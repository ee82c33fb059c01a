#include "fsw/exec/component.hpp"

#include "fsw/exec/report.hpp"
#include "fsw/geometry/portable_math.hpp"

namespace lasso {
namespace {

constexpr std::uint32_t kPipelineFrames = 2;  // from a scan's boundary to its publication

DurationUs to_us(double seconds) { return static_cast<DurationUs>(seconds * 1e6 + 0.5); }

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

// One sigma of the target's place on the least certain axis; what is less certain than the model's own size is not scanned wider.
double place_sigma(const Mission& mission, const FilterState& filter) {
  const double sigma = square_root(filter.covariance.diagonal().segment<3>(3).maxCoeff());
  return sigma < mission.radius_m ? sigma : mission.radius_m;
}

ScanPlan no_plan() {
  ScanPlan plan;
  plan.points = 0;
  plan.half_x = 0;
  plan.half_y = 0;
  plan.duration_us = 0;
  return plan;
}

}  // namespace

Component::Component(Sensor& sensor) : acquisition_(sensor) {}

LoadFailure Component::load_image(Bytes image) {
  LoadFailure failure;
  if (executive_.begun()) {
    failure.status = Status::kBadOrder;
    failure.what = "the component has begun";
    return failure;
  }
  loaded_ = false;  // whatever follows, the image that was loaded before may have been overwritten
  failure = lasso::load_image(image, mission_);
  if (failure.status != Status::kOk) return failure;
  loaded_ = mission_.parameters.duration_s <= mission_.parameters.period_s;
  if (!loaded_) {
    failure.status = Status::kBadValue;
    failure.what = "scan.duration_s exceeds filter.period_s";
  }
  return failure;
}

Status Component::begin(TimeUs boundary_0_us) {
  if (!loaded_) return Status::kMissing;
  if (executive_.begun()) return Status::kBadOrder;
  const MissionParameters& p = mission_.parameters;
  invariant(executive_.begin(boundary_0_us, to_us(p.period_s)) == Status::kOk, "slots of a valid period");
  if (p.initial_present < 0.5) return Status::kOk;
  return start_tracking(initial_pose(p), initial_rates(p), boundary_0_us);
}

Status Component::start_tracking(const Pose& T_sensor_target, const Twist& rates, TimeUs t_us) {
  if (!executive_.begun()) return Status::kBadOrder;
  const Status status = start_track(mission_, T_sensor_target, rates, t_us, executive_.next_boundary_us(), requested_);
  if (status == Status::kOk) request_ = Request::kStart;
  return status;
}

Status Component::stop_tracking() {
  if (!executive_.begun()) return Status::kBadOrder;
  request_ = Request::kStop;
  return Status::kOk;
}

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
  apply_request();
  hand_over_scan();
  start_scan();
}

void Component::publish_estimate(TimeUs now_us) {
  TrackStep step;
  const bool in_time = estimation_.collect(step);
  if (estimated_.active) {
    if (!in_time) step = step_without_estimate();
    track_ = step.after;
    send(step, now_us);
  } else if (properties(track_.mode).says_lost) {
    send(no_track(executive_.frame() - kPipelineFrames, track_), now_us);
  }
}

TrackStep Component::step_without_estimate() {
  ++counters_.overruns;
  return track_without_scan(mission_, PoseReason::kOverrun, estimated_.scan_id, estimated_.t_nominal_us, track_);
}

void Component::apply_request() {
  if (request_ == Request::kNone) return;
  track_.mode = next_mode(track_.mode, request_ == Request::kStart ? ModeEvent::kStart : ModeEvent::kStop);
  if (request_ == Request::kStart) {
    track_.missed = 0;
    track_.filter = requested_.filter;
  }
  acquired_.active = false;  // it was aimed by the track that ends here
  request_ = Request::kNone;
}

void Component::hand_over_scan() {
  const bool usable = acquisition_.finish();
  estimated_ = acquired_;
  acquired_ = ScanInFlight{};
  acquired_.plan = no_plan();
  estimated_.active = estimated_.active && properties(track_.mode).scans;
  if (!estimated_.active) return;
  if (!usable) ++counters_.lost_scans;
  if (!estimation_.idle()) return;  // an estimate that overran still runs: this scan is dropped with it
  estimation_.submit({estimated_.scan_id, usable ? &acquisition_.filling() : nullptr, estimated_.t_nominal_us, track_});
  if (usable) acquisition_.swap_images();
}

void Component::start_scan() {
  if (!properties(track_.mode).scans) return;
  const TimeUs boundary_us = executive_.next_slot_us();  // of this frame: its slot 0 is running
  acquired_.active = true;
  acquired_.scan_id = executive_.frame();
  acquired_.t_nominal_us = boundary_us + to_us(mission_.parameters.duration_s) / 2;
  PredictedPose predicted;
  predicted.T_sensor_target = track_.filter.T_sensor_target;
  // Where the prediction has no meaning the scan is aimed where the target was last.
  static_cast<void>(predict_pose(track_.filter, acquired_.t_nominal_us, predicted));
  acquisition_.start(mission_, {predicted.T_sensor_target, place_sigma(mission_, track_.filter)}, acquired_.scan_id, boundary_us,
                     acquired_.plan);
}

void Component::send(const TrackStep& step, TimeUs now_us) {
  PoseTelemetry report = make_report(mission_, step, estimated_.plan, now_us);
  if (!step.registration.valid()) ++counters_.invalid_frames;
  set_counters(report);
  PacketHeader header;
  header.sequence_count = counters_.packets & kSequenceCountMask;
  header.message_count = counters_.packets;
  header.t_us = now_us;
  ++counters_.packets;
  std::uint8_t packet[kMaxPosePacketBytes];
  const std::size_t size = encode_pose(report, header, Bytes(packet));
  invariant(size > 0, "pose packet larger than its buffer");
  static_cast<void>(queue_.push(ConstBytes(packet, size)));  // a full queue counts what it drops
}

void Component::set_counters(PoseTelemetry& report) const {
  report.frames = executive_.frame() + 1;
  report.invalid_frames = counters_.invalid_frames;
  report.lost_scans = counters_.lost_scans;
  report.overruns = counters_.overruns;
  report.slot_slips = executive_.slips();
  report.dropped_packets = queue_.dropped();
}

}  // namespace lasso
