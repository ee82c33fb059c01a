// What the ground gets of a scan's estimate: the structures `pose`, `filter` and `named_pose`. Used by the acquisition thread, at a
// boundary.
#pragma once

#include <cstdint>

#include "fsw/core/time.hpp"
#include "fsw/exec/executive.hpp"
#include "fsw/exec/mode_manager.hpp"
#include "fsw/exec/scan_scheduler.hpp"
#include "fsw/exec/telemetry.hpp"
#include "fsw/mission/image_keeper.hpp"
#include "fsw/mode/tracker.hpp"

namespace lasso {

class PosePublisher {
 public:
  // What is given outlives it.
  PosePublisher(const Executive& executive, const ImageKeeper& images, Telemetry& telemetry, ModeManager& modes, const ScanScheduler& scans)
      : executive_(executive), images_(images), telemetry_(telemetry), modes_(modes), scans_(scans) {}

  // A frame without a scan to report has a pose packet, too, where the mode says that the target is lost, where changes of the mode would
  // wait for too long, and where one was asked for.
  bool report_overdue() const;
  // The step of the estimated scan, which has become the track.
  void send_pose(const TrackStep& step, TimeUs now_us);
  // Those of the structures beside it that are due. Loop bound: kMaxNamedFrames.
  void send_beside(const Registration& registration, TimeUs now_us);

 private:
  void set_counters(PoseTelemetry& report) const;
  void send_named_poses(const Registration& registration, TimeUs now_us);

  const Executive& executive_;
  const ImageKeeper& images_;
  Telemetry& telemetry_;
  ModeManager& modes_;
  const ScanScheduler& scans_;
  std::uint32_t invalid_frames_ = 0;
};

}  // namespace lasso
