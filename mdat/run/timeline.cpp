#include "mdat/run/timeline.hpp"

#include <algorithm>
#include <cmath>

#include "mdat/run/case.hpp"

namespace lasso::mdat {
namespace {

TimelinePoint point_of(const PoseTelemetry& pose, const Pose& truth, double t_s) {
  TimelinePoint point;
  point.t_s = t_s;
  point.mode = static_cast<TrackingMode>(pose.mode);
  point.range_m = truth.p.norm();
  point.valid = pose.valid != 0;
  if (!point.valid) return point;
  point.verdict = judge_valid(pose, truth);
  point.registration = pose_error(registration_pose(pose), truth);
  point.nees = nees(registration_pose(pose), truth, registration_covariance(pose));
  return point;
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

TimelineStatistics timeline_statistics(const Timeline& timeline) {
  TimelineStatistics result;
  double squared_mm = 0, squared_deg = 0, nees = 0;
  result.frames = timeline.points.size();
  for (const TimelinePoint& point : timeline.points) {
    if (!point.valid) continue;
    const double mm = 1e3 * point.registration.translation_m.norm();
    const double deg = point.registration.rotation_rad / kRadPerDeg;
    ++result.valid;
    result.wrong += point.verdict == PoseVerdict::kWrong ? 1 : 0;
    result.worst_mm = std::max(result.worst_mm, mm);
    result.worst_deg = std::max(result.worst_deg, deg);
    squared_mm += mm * mm;
    squared_deg += deg * deg;
    nees += point.nees;
  }
  const double n = std::max<double>(1, static_cast<double>(result.valid));
  result.rms_mm = std::sqrt(squared_mm / n);
  result.rms_deg = std::sqrt(squared_deg / n);
  result.nees = nees / n;
  return result;
}

const char* meaning(const TimelineChange& change) {
  for (const ModeTransition& row : mode_transitions()) {
    if (row.from == change.from && row.event == change.event) return row.meaning;
  }
  return "";
}

}  // namespace lasso::mdat
