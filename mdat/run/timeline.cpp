#include "mdat/run/timeline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mdat/run/case.hpp"

namespace lasso::mdat {
namespace {

TimelinePoint point_of(const PoseTelemetry& pose, const Pose& truth, double t_s) {
  TimelinePoint point;
  point.t_s = t_s;
  point.mode = static_cast<TrackingMode>(pose.mode);
  point.range_m = truth.p.norm();
  point.sensor = pose.sensor;
  point.sensor_reason = static_cast<SensorReason>(pose.sensor_reason);
  point.part = pose.part;
  point.valid = pose.valid != 0;
  if (!point.valid) return point;
  point.verdict = judge_valid(pose, truth);
  point.registration = pose_error(registration_pose(pose), truth);
  point.filtered = pose_error(filtered_pose(pose), truth);
  point.nees = nees(registration_pose(pose), truth, registration_covariance(pose));
  return point;
}

struct ErrorSums {
  double mm2 = 0, deg2 = 0, worst_mm = 0, worst_deg = 0;

  void add(const PoseError& error) {
    const double mm = 1e3 * error.translation_m.norm();
    const double deg = error.rotation_rad / kRadPerDeg;
    mm2 += mm * mm;
    deg2 += deg * deg;
    worst_mm = std::max(worst_mm, mm);
    worst_deg = std::max(worst_deg, deg);
  }
};

// Of no valid pose no error is known: not numbers, null in results.json.
TimelineStatistics nothing_known(TimelineStatistics result) {
  for (double TimelineStatistics::*error :
       {&TimelineStatistics::rms_mm, &TimelineStatistics::rms_deg, &TimelineStatistics::worst_mm, &TimelineStatistics::worst_deg,
        &TimelineStatistics::nees, &TimelineStatistics::filtered_rms_mm, &TimelineStatistics::filtered_rms_deg,
        &TimelineStatistics::filtered_worst_mm, &TimelineStatistics::filtered_worst_deg}) {
    result.*error = std::numeric_limits<double>::quiet_NaN();
  }
  return result;
}

using Predicate = std::function<bool(const TimelinePoint&)>;

TimelineStatistics statistics_of(const Timeline& timeline, const Predicate& belongs) {
  TimelineStatistics result;
  ErrorSums registration, filtered;
  double nees = 0;
  for (const TimelinePoint& point : timeline.points) {
    if (!belongs(point)) continue;
    ++result.frames;
    if (!point.valid) continue;
    ++result.valid;
    result.wrong += point.verdict == PoseVerdict::kWrong ? 1 : 0;
    registration.add(point.registration);
    filtered.add(point.filtered);
    nees += point.nees;
  }
  if (result.valid == 0) return nothing_known(result);
  const auto n = static_cast<double>(result.valid);
  result.rms_mm = std::sqrt(registration.mm2 / n);
  result.rms_deg = std::sqrt(registration.deg2 / n);
  result.worst_mm = registration.worst_mm;
  result.worst_deg = registration.worst_deg;
  result.filtered_rms_mm = std::sqrt(filtered.mm2 / n);
  result.filtered_rms_deg = std::sqrt(filtered.deg2 / n);
  result.filtered_worst_mm = filtered.worst_mm;
  result.filtered_worst_deg = filtered.worst_deg;
  result.nees = nees / n;
  return result;
}

void add_group(const Timeline& timeline, const std::string& name, const Predicate& belongs, std::vector<TimelineGroup>& groups) {
  TimelineGroup group{name, statistics_of(timeline, belongs)};
  if (group.statistics.frames > 0) groups.push_back(std::move(group));
}

}  // namespace

void add_packet(const PoseTelemetry& pose, const sim::Trajectory& truth, TimeUs epoch_us, Timeline& timeline) {
  const auto seconds = [&](TimeUs t_us) { return to_seconds(t_us - epoch_us); };
  timeline.points.push_back(point_of(pose, truth.at(pose.t_measurement_us).T_sensor_target, seconds(pose.t_measurement_us)));
  const std::size_t changes = std::min<std::size_t>(pose.changes, kPoseChanges);
  for (std::size_t i = 0; i < changes; ++i) {
    timeline.changes.push_back({seconds(pose.t_publication_us), static_cast<TrackingMode>(pose.change_from[i]),
                                static_cast<TrackingMode>(pose.change_to[i]), static_cast<ModeEvent>(pose.change_event[i])});
  }
}

std::vector<SensorChange> sensor_changes(const Timeline& timeline) {
  std::vector<SensorChange> changes;
  for (std::size_t i = 1; i < timeline.points.size(); ++i) {
    const TimelinePoint &before = timeline.points[i - 1], &point = timeline.points[i];
    if (point.sensor != before.sensor) changes.push_back({point.t_s, point.range_m, before.sensor, point.sensor, point.sensor_reason});
  }
  return changes;
}

TimelineStatistics timeline_statistics(const Timeline& timeline) {
  return statistics_of(timeline, [](const TimelinePoint&) { return true; });
}

std::vector<TimelineGroup> by_mode(const Timeline& timeline) {
  std::vector<TimelineGroup> groups;
  for (const ModeProperties& mode : mode_properties()) {
    add_group(
        timeline, mode.name, [&](const TimelinePoint& point) { return point.mode == mode.mode; }, groups);
  }
  return groups;
}

std::vector<TimelineGroup> by_sensor(const Timeline& timeline, const std::vector<std::string>& names) {
  std::vector<TimelineGroup> groups;
  for (std::size_t i = 0; i < names.size(); ++i) {
    add_group(
        timeline, names[i], [&](const TimelinePoint& point) { return point.sensor == i; }, groups);
  }
  return groups;
}

std::vector<TimelineGroup> by_part(const Timeline& timeline, const std::vector<std::string>& names) {
  std::vector<TimelineGroup> groups;
  for (std::size_t i = 0; i < names.size(); ++i) {
    add_group(
        timeline, names[i], [&](const TimelinePoint& point) { return point.part == static_cast<int>(i); }, groups);
  }
  return groups;
}

const char* meaning(const TimelineChange& change) {
  for (const ModeTransition& row : mode_transitions()) {
    if (row.from == change.from && row.event == change.event) return row.meaning;
  }
  return "";
}

}  // namespace lasso::mdat
