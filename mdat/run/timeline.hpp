// How a run went through the modes: what its telemetry says, beside the truth.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fsw/link/pose_telemetry.hpp"
#include "fsw/mode/modes.hpp"
#include "fsw/sense/sensor_chooser.hpp"
#include "hal_sim/trajectory.hpp"
#include "mdat/run/statistics.hpp"
#include "mdat/run/verdict.hpp"

namespace lasso::mdat {

// One packet. Times count from frame 0.
struct TimelinePoint {
  double t_s = 0;  // at which its pose is stated
  TrackingMode mode = TrackingMode::kStandby;
  double range_m = 0;  // the true one, of the target's origin
  SensorNumber sensor = 0;
  SensorReason sensor_reason = SensorReason::kRangeUnknown;
  int part = 0;  // 0: the whole
  bool valid = false;
  PoseVerdict verdict = PoseVerdict::kRight;  // of a valid pose
  PoseError registration, filtered;           // of a valid pose
  double nees = 0;                            // of a valid pose
};

struct TimelineChange {
  double t_s = 0;  // of the packet that reports it
  TrackingMode from = TrackingMode::kStandby, to = TrackingMode::kStandby;
  ModeEvent event = ModeEvent::kStart;
};

// A scan by another sensor than the one before.
struct SensorChange {
  double t_s = 0, range_m = 0;
  SensorNumber from = 0, to = 0;
  SensorReason reason = SensorReason::kRangeUnknown;
};

struct Timeline {
  std::vector<TimelinePoint> points;
  std::vector<TimelineChange> changes;
};

void add_packet(const PoseTelemetry& pose, const sim::Trajectory& truth, TimeUs epoch_us, Timeline& timeline);

std::vector<SensorChange> sensor_changes(const Timeline& timeline);

struct TimelineStatistics {
  std::size_t frames = 0, valid = 0, wrong = 0;
  double rms_mm = 0, rms_deg = 0, worst_mm = 0, worst_deg = 0, nees = 0;  // of all valid poses, wrong ones included
  double filtered_rms_mm = 0, filtered_rms_deg = 0, filtered_worst_mm = 0, filtered_worst_deg = 0;  // of the filter's, at the same scans
};
TimelineStatistics timeline_statistics(const Timeline& timeline);

// The same of the points of one kind.
struct TimelineGroup {
  std::string name;
  TimelineStatistics statistics;
};
std::vector<TimelineGroup> by_mode(const Timeline& timeline);  // those that occur, in the order of their numbers
std::vector<TimelineGroup> by_sensor(const Timeline& timeline, const std::vector<std::string>& names);
std::vector<TimelineGroup> by_part(const Timeline& timeline, const std::vector<std::string>& names);  // 0: the whole

// What the change means, from the component's own table.
const char* meaning(const TimelineChange& change);

}  // namespace lasso::mdat
