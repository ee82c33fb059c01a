// The component's scans: which sensor takes one, where it looks, and its way to the estimate.
#include "fsw/exec/component.hpp"
#include "fsw/exec/scan_faults.hpp"
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

TimeUs Component::next_scan_us() const { return executive_.next_slot_us() + to_us(mission().parameters.duration_s) / 2; }

// An old bearing would be carried far off by its rates.
bool Component::bearing_known() const {
  const double age_s = to_seconds(next_scan_us() - track_.bearing.t_us);
  return track_.bearing.started && age_s <= mission().parameters.bearing_memory_s;
}

Vec3 Component::bearing_place_m() const {
  return track_.bearing.p_m + to_seconds(next_scan_us() - track_.bearing.t_us) * track_.bearing.v_mps;
}

// Where the prediction has no meaning: where the target was last.
Pose Component::predicted_pose() const {
  PredictedPose predicted;
  predicted.T_sensor_target = track_.filter.T_sensor_target;
  static_cast<void>(predict_pose(track_.filter, next_scan_us(), predicted));
  return predicted.T_sensor_target;
}

// What was planned for the scans of another sensor counts no more.
void Component::choose_sensor() {
  const ModeProperties& mode = properties(track_.mode);
  if (!mode.scans) return;
  const bool by_bearing = mode.full_field || mode.searches;
  const Vec3 place_m = by_bearing ? bearing_place_m() : predicted_pose().p;
  const SensorNeed need{executive_.frame(), mode.searches, !by_bearing || bearing_known(), square_root(place_m.squaredNorm())};
  const SensorNumber before = sensor_.sensor;
  sensor_ = chooser_.choose(mission(), need);
  if (sensor_.sensor != before) events_.raise<EventId::kSensorChanged>(before, sensor_.sensor, sensor_.reason);
  if (sensor_.sensor == estimated_.sensor.sensor) return;
  aimed_.clear();
  part_ = kWhole;
}

void Component::hand_over_scan() {
  const ScanEnd end = acquisition_.finish(acquired_.plan);
  estimated_ = acquired_;
  acquired_ = ScanInFlight{};
  acquired_.plan = no_plan();
  const bool usable = end.verdict.usable;
  if (end.asked) {
    seen_.add(scan_faults(end.verdict));
    chooser_.note(mission().parameters, estimated_.sensor.sensor, estimated_.scan_id, usable);
  }
  estimated_.active = estimated_.active && properties(track_.mode).scans;
  if (!estimated_.active) return;
  if (!usable) {
    ++counters_.lost_scans;
    events_.raise<EventId::kScanLost>(estimated_.sensor.sensor, estimated_.scan_id, end.verdict.loss);
    if (end.verdict.loss == ScanLoss::kForeign) trial_.note_foreign();
  }
  if (!estimation_.idle()) return;  // an estimate that overran still runs: this scan is dropped with it
  if (track_.sensor != estimated_.sensor.sensor) forget_common_errors(track_.filter);
  track_.sensor = estimated_.sensor.sensor;
  const MissionView& view = images_.view(estimated_.sensor.sensor);
  estimation_.submit({estimated_.scan_id, usable ? &acquisition_.filling() : nullptr, estimated_.t_nominal_us, track_, &view.mission,
                      &view.parts, estimated_.part, part_, estimated_.scan_id + kPipelineFrames,
                      estimated_.t_nominal_us + static_cast<DurationUs>(kPipelineFrames) * to_us(mission().parameters.period_s)});
  if (usable) acquisition_.swap_images();
}

Aim Component::aim_at_bearing() const {
  Aim aim;
  aim.full_field = !bearing_known();
  aim.any_attitude = true;
  aim.T_sensor_target.p = bearing_place_m();
  aim.uncertainty_m = kBearingOffShare * mission().radius_m;
  return aim;
}

Aim Component::aim_of_scan() const {
  const ModeProperties& mode = properties(track_.mode);
  if (mode.searches) return aim_at_bearing();
  Aim aim;
  aim.full_field = mode.full_field;
  aim.T_sensor_target = predicted_pose();
  aim.uncertainty_m = place_sigma(mission(), relative_covariance(track_.filter));
  aim.rays = aimed_.span();
  if (part_ == kWhole) return aim;
  const Part& part = parts()[part_ - 1U];
  aim.T_sensor_target = aim.T_sensor_target * part.T_target_part;
  aim.uncertainty_m = place_sigma(part.mission, part_covariance(part, track_.filter));
  return aim;
}

// As the executive's slot may be late, it is the present time that the sensor is told.
void Component::start_scan(TimeUs now_us) {
  if (!properties(track_.mode).scans) return;
  acquired_.active = true;
  acquired_.scan_id = executive_.frame();
  acquired_.t_nominal_us = next_scan_us();
  acquired_.part = part_;
  acquired_.sensor = sensor_;
  const MissionView& view = images_.view(sensor_.sensor);
  acquisition_.calibrate(sensor_.sensor, images_.active());
  acquisition_.start(sensor_.sensor, part_ != kWhole ? view.parts[part_ - 1U].mission : view.mission, aim_of_scan(), acquired_.scan_id,
                     now_us, acquired_.plan);
}

}  // namespace lasso
