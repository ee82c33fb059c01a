// How a run went through the modes: what its telemetry says, beside the truth.
#pragma once

#include <string>
#include <vector>

#include "fsw/link/pose_telemetry.hpp"
#include "fsw/mode/modes.hpp"
#include "hal_sim/trajectory.hpp"
#include "mdat/run/statistics.hpp"
#include "mdat/run/verdict.hpp"

namespace lasso::mdat {

// One packet. Times count from frame 0.
struct TimelinePoint {
  double t_s = 0;  // at which its pose is stated
  TrackingMode mode = TrackingMode::kStandby;
  double range_m = 0;  // the true one, of the target's origin
  bool valid = false;
  PoseVerdict verdict = PoseVerdict::kRight;  // of a valid pose
  PoseError registration;                     // of a valid pose
  double nees = 0;                            // of a valid pose
};

struct TimelineChange {
  double t_s = 0;  // of the packet that tells it
  TrackingMode from = TrackingMode::kStandby, to = TrackingMode::kStandby;
  ModeEvent event = ModeEvent::kStart;
};

struct Timeline {
  std::vector<TimelinePoint> points;
  std::vector<TimelineChange> changes;
};

void add_packet(const PoseTelemetry& pose, const sim::Trajectory& truth, TimeUs epoch_us, Timeline& timeline);

struct TimelineStatistics {
  std::size_t frames = 0, valid = 0, wrong = 0;
  double rms_mm = 0, rms_deg = 0, worst_mm = 0, worst_deg = 0, nees = 0;  // of all valid poses, wrong ones included
};
TimelineStatistics timeline_statistics(const Timeline& timeline);

// What the change means, from the component's own table.
const char* meaning(const TimelineChange& change);

}  // namespace lasso::mdat
