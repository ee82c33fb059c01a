// A scan's way from its plan to the estimate: which sensor takes it (fsw/sense/sensor_chooser.hpp), where that looks, and what became of
// it. Two scans are on their way at a time: one is acquired while the one before it is estimated. Used by the acquisition thread.
#pragma once

#include <cstdint>

#include "fsw/core/time.hpp"
#include "fsw/exec/acquisition_task.hpp"
#include "fsw/exec/estimation_task.hpp"
#include "fsw/exec/executive.hpp"
#include "fsw/exec/health_monitor.hpp"
#include "fsw/exec/telemetry.hpp"
#include "fsw/mission/image_keeper.hpp"
#include "fsw/mode/tracker.hpp"
#include "fsw/sense/sensor_chooser.hpp"

namespace lasso {

constexpr std::uint32_t kPipelineFrames = 2;  // from a scan's boundary to its publication

struct ScanInFlight {
  bool active = false;  // it was wanted, and will be reported
  std::uint32_t scan_id = 0;
  TimeUs t_nominal_us = 0;  // planned middle
  ScanPlan plan;
  PartNumber part = kWhole;  // at which it looks
  SensorChoice sensor;       // that takes it
};

class ScanScheduler {
 public:
  // What is given outlives it.
  ScanScheduler(AcquisitionTask& acquisition, const Executive& executive, const ImageKeeper& images, Telemetry& telemetry,
                HealthMonitor& health)
      : acquisition_(acquisition), executive_(executive), images_(images), telemetry_(telemetry), health_(health) {}

  // A boundary, in this order. The next scan looks where the estimate that has just been collected says: at its part and aimed rays. Null
  // where none was in time: at the whole target, by the pattern alone.
  void follow_estimate(const EstimationTask* estimation);
  // Chooses the sensor of the next scan. What was planned for the scans of another sensor counts no more.
  void choose_sensor(const TrackState& track);
  // Ends the scan that was acquired, and returns what its sensor gave: from now on it is the estimated one, active where the mode still
  // scans. One that is active and not usable counts as lost.
  ScanVerdict finish(TrackingMode mode);
  // The job of estimating it, from this track. Where it is not `usable` the job has no scan, and the filter predicts.
  EstimationJob job(const TrackState& track, bool usable) const;
  // Plans and starts the next scan, if the mode scans. The sensor is told now_us, as the slot may be late; the plan is for the slot's
  // nominal time.
  void start(const TrackState& track, TimeUs now_us);
  // Sends the structures of the sensors of which there is news; of all, where none is news. Loop bound: kMaxSensors.
  void send_sensors(TimeUs now_us);

  // The track ends, or is another one: what it planned counts no more, and its scan in flight is not reported.
  void drop_plans();
  // The next scan looks at the whole target.
  void look_at_whole() { part_ = kWhole; }
  // The clock has jumped: what is on its way is of another time.
  void drop_scans();
  // The target is another one: what was learnt of the sensors is of no use.
  void forget_sensors();

  // The step of the estimated scan, whose estimate is late: a prediction (kOverrun), and a frame of the mode used up. Counted, with an
  // event.
  TrackStep step_without_estimate(const TrackState& track);

  const ScanInFlight& acquired() const { return acquired_; }    // in this frame
  const ScanInFlight& estimated() const { return estimated_; }  // in this frame
  const SensorChooser& chooser() const { return chooser_; }
  std::uint32_t lost_scans() const { return lost_scans_; }
  std::uint32_t overruns() const { return overruns_; }

 private:
  TimeUs next_scan_us() const;
  bool bearing_known(const BearingState& bearing) const;
  Vec3 bearing_place_m(const BearingState& bearing) const;
  Pose predicted_pose(const FilterState& filter) const;
  Aim aim_at_bearing(const BearingState& bearing) const;
  Aim aim_of_scan(const TrackState& track) const;
  const Mission& mission() const { return images_.view(0).mission; }

  AcquisitionTask& acquisition_;
  const Executive& executive_;
  const ImageKeeper& images_;
  Telemetry& telemetry_;
  HealthMonitor& health_;
  SensorChooser chooser_;
  SensorChoice sensor_;       // of the next scan
  AimedRays aimed_;           // where the last estimate would look next; empty when track or sensor are other ones now
  PartNumber part_ = kWhole;  // at which the next scan looks, by that estimate
  ScanInFlight acquired_, estimated_;
  std::uint32_t lost_scans_ = 0, overruns_ = 0;
  std::uint32_t reported_troubles_[kMaxSensors] = {};
};

}  // namespace lasso
