#include "fsw/exec/scan_scheduler.hpp"

#include "fsw/exec/scan_faults.hpp"
#include "fsw/exec/sensor_report.hpp"
#include "fsw/geometry/portable_math.hpp"

namespace lasso {
namespace {

constexpr double kBearingOffShare = 0.25;  // of the model's radius: the middle of what is seen is not the model's

// One sigma of a model's place on the least certain axis; what is less certain than the model's own size is not scanned wider.
double place_sigma(const Mission& mission, const Mat6& covariance) {
  const double sigma = square_root(covariance.diagonal().tail<3>().maxCoeff());
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

void ScanScheduler::follow_estimate(const EstimationTask* estimation) {
  aimed_.clear();
  part_ = kWhole;
  if (!estimated_.active || estimation == nullptr) return;
  aimed_ = estimation->aimed();
  part_ = estimation->part();
}

void ScanScheduler::drop_plans() {
  acquired_.active = false;
  aimed_.clear();
  part_ = kWhole;
}

void ScanScheduler::drop_scans() {
  drop_plans();
  estimated_.active = false;
}

void ScanScheduler::forget_sensors() {
  chooser_ = SensorChooser{};
  sensor_ = SensorChoice{};
}

TimeUs ScanScheduler::next_scan_us() const { return executive_.next_slot_us() + to_us(mission().parameters.duration_s) / 2; }

// An old bearing would be carried far off by its rates.
bool ScanScheduler::bearing_known(const BearingState& bearing) const {
  const double age_s = to_seconds(next_scan_us() - bearing.t_us);
  return bearing.started && age_s <= mission().parameters.bearing_memory_s;
}

Vec3 ScanScheduler::bearing_place_m(const BearingState& bearing) const {
  return bearing.p_m + to_seconds(next_scan_us() - bearing.t_us) * bearing.v_mps;
}

// Where the prediction has no meaning: where the target was last.
Pose ScanScheduler::predicted_pose(const FilterState& filter) const {
  PredictedPose predicted;
  predicted.T_sensor_target = filter.T_sensor_target;
  static_cast<void>(predict_pose(filter, next_scan_us(), predicted));
  return predicted.T_sensor_target;
}

void ScanScheduler::choose_sensor(const TrackState& track) {
  const ModeProperties& mode = properties(track.mode);
  if (!mode.scans) return;
  const bool by_bearing = mode.full_field || mode.searches;
  const Vec3 place_m = by_bearing ? bearing_place_m(track.bearing) : predicted_pose(track.filter).p;
  const bool range_known = !by_bearing || bearing_known(track.bearing);
  const SensorNumber before = sensor_.sensor;
  sensor_ = chooser_.choose(mission(), {executive_.frame(), mode.searches, range_known, square_root(place_m.squaredNorm())});
  if (sensor_.sensor != before) telemetry_.raise<EventId::kSensorChanged>(before, sensor_.sensor, sensor_.reason);
  if (sensor_.sensor == estimated_.sensor.sensor) return;
  aimed_.clear();
  part_ = kWhole;
}

ScanVerdict ScanScheduler::finish(TrackingMode mode) {
  const ScanEnd end = acquisition_.finish(acquired_.plan);
  estimated_ = acquired_;
  acquired_ = ScanInFlight{};
  acquired_.plan = no_plan();
  if (end.asked) {
    health_.see(scan_faults(end.verdict));
    chooser_.note(mission().parameters, estimated_.sensor.sensor, estimated_.scan_id, end.verdict.usable);
  }
  estimated_.active = estimated_.active && properties(mode).scans;
  if (!estimated_.active || end.verdict.usable) return end.verdict;
  ++lost_scans_;
  telemetry_.raise<EventId::kScanLost>(estimated_.sensor.sensor, estimated_.scan_id, end.verdict.loss);
  return end.verdict;
}

EstimationJob ScanScheduler::job(const TrackState& track, bool usable) const {
  const MissionView& view = images_.view(estimated_.sensor.sensor);
  const DurationUs pipeline_us = static_cast<DurationUs>(kPipelineFrames) * to_us(mission().parameters.period_s);
  return {estimated_.scan_id,
          usable ? &acquisition_.filling() : nullptr,
          estimated_.t_nominal_us,
          track,
          &view.mission,
          &view.parts,
          estimated_.part,
          part_,
          estimated_.scan_id + kPipelineFrames,
          estimated_.t_nominal_us + pipeline_us};
}

Aim ScanScheduler::aim_at_bearing(const BearingState& bearing) const {
  Aim aim;
  aim.full_field = !bearing_known(bearing);
  aim.any_attitude = true;
  aim.T_sensor_target.p = bearing_place_m(bearing);
  aim.uncertainty_m = kBearingOffShare * mission().radius_m;
  return aim;
}

Aim ScanScheduler::aim_of_scan(const TrackState& track) const {
  const ModeProperties& mode = properties(track.mode);
  if (mode.searches) return aim_at_bearing(track.bearing);
  Aim aim;
  aim.full_field = mode.full_field;
  aim.T_sensor_target = predicted_pose(track.filter);
  aim.uncertainty_m = place_sigma(mission(), relative_covariance(track.filter));
  aim.rays = aimed_.span();
  if (part_ == kWhole) return aim;
  const Part& part = images_.view(0).parts[part_ - 1U];
  aim.T_sensor_target = aim.T_sensor_target * part.T_target_part;
  aim.uncertainty_m = place_sigma(part.mission, part_covariance(part, track.filter));
  return aim;
}

void ScanScheduler::start(const TrackState& track, TimeUs now_us) {
  if (!properties(track.mode).scans) return;
  acquired_.active = true;
  acquired_.scan_id = executive_.frame();
  acquired_.t_nominal_us = next_scan_us();
  acquired_.part = part_;
  acquired_.sensor = sensor_;
  const MissionView& view = images_.view(sensor_.sensor);
  acquisition_.calibrate(sensor_.sensor, images_.active());
  acquisition_.start(sensor_.sensor, part_ != kWhole ? view.parts[part_ - 1U].mission : view.mission, aim_of_scan(track), acquired_.scan_id,
                     now_us, acquired_.plan);
}

TrackStep ScanScheduler::step_without_estimate(const TrackState& track) {
  ++overruns_;
  telemetry_.raise<EventId::kEstimateLate>(estimated_.scan_id);
  health_.see(Fault::kEstimateOverrun);
  const Mission& mission = images_.view(track.sensor).mission;
  TrackStep step = track_without_scan(mission, PoseReason::kOverrun, estimated_.scan_id, estimated_.t_nominal_us, track);
  step.parts.scanned = estimated_.part;
  if (properties(track.mode).searches) count_and_change(mission.parameters, false, step);  // a search that is always late ends, too
  return step;
}

void ScanScheduler::send_sensors(TimeUs now_us) {
  bool news[kMaxSensors] = {};
  bool any = false;
  SensorTelemetry reports[kMaxSensors];
  const std::size_t sensors = mission().sensors.size();
  for (std::size_t i = 0; i < sensors; ++i) {
    const auto sensor = static_cast<SensorNumber>(i);
    reports[i] = make_sensor_report(sensor, acquisition_.tally(sensor), acquisition_.counters(sensor));
    news[i] = troubles(reports[i]) != reported_troubles_[i];
    any = any || news[i];
  }
  if (!telemetry_.housekeeping().due(kSensorStructureId, any)) return;
  for (std::size_t i = 0; i < sensors; ++i) {
    if (any && !news[i]) continue;
    reported_troubles_[i] = troubles(reports[i]);
    telemetry_.send_structure<kMaxSensorPacketBytes, encode_sensor>(reports[i], now_us);
  }
}

}  // namespace lasso
