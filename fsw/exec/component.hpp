// The whole flight component, wired: acquisition and estimation as two parallel tasks, a cyclic executive, the telemetry queue.
//
// Frame k lasts from boundary k to boundary k + 1 (filter.period_s). Scan k is acquired in frame k, estimated in frame k + 1, and
// published at boundary k + 2, where it also serves to plan scan k + 2. Between boundaries the two tasks share nothing; results pass at
// boundaries only (logical execution time), so that the timing of threads cannot change a bit of the output. At a period of 0.2 s a
// pose is published 0.31 s after the middle of a scan of 0.18 s.
//
// Two threads use it. The acquisition thread calls everything except run_estimation(); the estimation thread calls run_estimation()
// once after each slot that leaves estimation_pending() true. A single thread may do both in that order and gets the same bytes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"
#include "fsw/core/status.hpp"
#include "fsw/core/time.hpp"
#include "fsw/exec/acquisition_task.hpp"
#include "fsw/exec/estimation_task.hpp"
#include "fsw/exec/executive.hpp"
#include "fsw/geometry/se3.hpp"
#include "fsw/link/pose_telemetry.hpp"
#include "fsw/link/telemetry_queue.hpp"
#include "fsw/mission/mission.hpp"
#include "fsw/mode/tracker.hpp"
#include "fsw/sense/sensor.hpp"

namespace lasso {

class Component {
 public:
  // `sensor` outlives the component. Nothing moves before begin().
  explicit Component(Sensor& sensor);

  // Validates and takes over `image`, which stays the component's memory (8-byte aligned, at most kMaxImageBytes). Before begin() only:
  // kBadOrder afterwards. kBadValue when a scan does not fit into a frame.
  LoadFailure load_image(Bytes image);

  // Sets the time of boundary 0. Tracking starts from tracking.initial if the mission has one. kMissing without an image, kBadOrder when
  // begun already.
  Status begin(TimeUs boundary_0_us);

  // Tracking starts from T_sensor_target and its rates at t_us, at the next boundary; a running track is left, its scan in
  // flight is not reported. kBadOrder before begin(), kNotFinite, kBadValue (quaternion not of unit length, t_us more than
  // kMaxPredictionUs from that boundary): nothing has then changed.
  Status start_tracking(const Pose& T_sensor_target, const Twist& rates, TimeUs t_us);
  // To standby at the next boundary: no scans. kBadOrder before begin().
  Status stop_tracking();

  // The nominal time of the next slot, and whether it is a boundary.
  TimeUs next_slot_us() const { return executive_.next_slot_us(); }
  bool next_slot_is_boundary() const { return executive_.next_slot() == 0; }
  // Runs the next slot at now_us (not before its nominal time; later is a slip, which is counted). Never waits.
  void run_slot(TimeUs now_us);

  bool estimation_pending() const { return estimation_.pending(); }
  // Runs the pending estimate, if any. The result waits for the boundary.
  void run_estimation() { estimation_.run(mission_); }

  // Moves whole packets into `out` and returns their bytes, oldest first.
  std::size_t take_telemetry(Bytes out) { return queue_.take(out); }

  const Mission& mission() const { return mission_; }

 private:
  enum class Request : std::uint8_t { kNone, kStart, kStop };
  // A scan on its way through the pipeline.
  struct ScanInFlight {
    bool active = false;  // it was wanted, and will be reported
    std::uint32_t scan_id = 0;
    TimeUs t_nominal_us = 0;  // planned middle
    ScanPlan plan;
  };
  struct Counters {
    std::uint32_t invalid_frames = 0;
    std::uint32_t lost_scans = 0;
    std::uint32_t overruns = 0;
    std::uint16_t packets = 0;  // PUS message type counter; its lower 14 bits are the sequence count while there is one kind of packet
  };

  void run_task(TaskId task, TimeUs now_us);
  // A boundary, in this order.
  void publish_estimate(TimeUs now_us);
  void apply_request();
  void hand_over_scan();
  void start_scan();

  TrackStep step_without_estimate();
  void send(const TrackStep& step, TimeUs now_us);
  void set_counters(PoseTelemetry& report) const;

  Mission mission_;
  Executive executive_;
  AcquisitionTask acquisition_;
  EstimationTask estimation_;
  TelemetryQueue queue_;
  TrackState track_;        // as of the last boundary
  ScanInFlight acquired_;   // in this frame
  ScanInFlight estimated_;  // in this frame
  Counters counters_;
  Request request_ = Request::kNone;
  TrackState requested_;  // kStart: the state to start from, stated at the time given
  bool loaded_ = false;
};

}  // namespace lasso
