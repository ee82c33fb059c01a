// The whole flight component, wired: acquisition and estimation as two parallel tasks, a cyclic executive, the telemetry queue. Of several
// sensors the one whose turn it is takes a scan (fsw/sense/sensor_chooser.hpp), and the scan is planned and estimated by that one's
// parameters.
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

#include "fsw/core/fixed_vector.hpp"
#include "fsw/core/span.hpp"
#include "fsw/core/status.hpp"
#include "fsw/core/time.hpp"
#include "fsw/exec/acquisition_task.hpp"
#include "fsw/exec/estimation_task.hpp"
#include "fsw/exec/executive.hpp"
#include "fsw/geometry/se3.hpp"
#include "fsw/link/command_receiver.hpp"
#include "fsw/link/link_report.hpp"
#include "fsw/link/pose_telemetry.hpp"
#include "fsw/link/telemetry_queue.hpp"
#include "fsw/mission/mission.hpp"
#include "fsw/mode/tracker.hpp"
#include "fsw/sense/sensor.hpp"
#include "fsw/sense/sensor_chooser.hpp"

namespace lasso {

class Component {
 public:
  // The sensors, in the order of the mission's, outlive the component; there is one at least. Nothing moves before begin().
  explicit Component(const SensorBank& sensors);
  explicit Component(Sensor& sensor);

  // Validates and takes over `image`, which stays the component's memory (8-byte aligned, at most kMaxImageBytes). Before begin() only:
  // kBadOrder afterwards. kBadValue when a scan does not fit into a frame, or a sensor of the mission's is not there.
  LoadFailure load_image(Bytes image);

  // Sets the time of boundary 0. Tracking starts from tracking.initial if the mission has one. kMissing without an image, kBadOrder when
  // begun already.
  Status begin(TimeUs boundary_0_us);

  // A pose to start from. By hand-over and uplink the track starts from it at the next boundary; a running track is left, its scan in
  // flight is not reported. From navigation and a priori it is kept, the last one of each, until a mode awaits a start and the mission's
  // order (start.first, ...) comes to it. What is refused changes nothing, and telemetry says so, too.
  StartRefusal offer_start(StartWay way, const StartOffer& offer);
  // An uplink as uncertain as tracking.start_sigma_* say. kBadOrder before begin(), kNotFinite, kBadValue for every other refusal.
  Status start_tracking(const Pose& T_sensor_target, const Twist& rates, TimeUs t_us);
  // Standby, bearing, searching or reacquiring, at the next boundary. What is refused changes nothing.
  ModeRefusal command_mode(TrackingMode mode);
  // Standby. kBadOrder before begin().
  Status stop_tracking();
  // From the next boundary on no mode ends because its frames are used up, and no start is taken but by command. Commands still work.
  void hold_mode(bool held) { held_ = held; }

  // Bytes from the ground, in pieces of any size: their commands are carried out as they come, and answered in telemetry
  // (docs/icd/link.md). Returns how many bytes were taken: kMaxCommandsPerFrame commands and refusals are answered in a frame, the rest
  // waits for the next.
  std::size_t receive(ConstBytes bytes, TimeUs now_us);
  // A datagram: one command, whole. False, and it was not looked at, when the frame's commands are used up.
  bool receive_packet(ConstBytes packet, TimeUs now_us);

  // The nominal time of the next slot, and whether it is a boundary.
  TimeUs next_slot_us() const { return executive_.next_slot_us(); }
  bool next_slot_is_boundary() const { return executive_.next_slot() == 0; }
  // Runs the next slot at now_us (not before its nominal time; later is a slip, which is counted). Never waits.
  void run_slot(TimeUs now_us);

  bool estimation_pending() const { return estimation_.pending(); }
  // Runs the pending estimate, if any. The result waits for the boundary.
  void run_estimation();

  // Moves whole packets into `out` and returns their bytes, oldest first.
  std::size_t take_telemetry(Bytes out) { return queue_.take(out); }

  // As the scans of the first sensor see it.
  const Mission& mission() const { return views_[0].mission; }
  const Parts& parts() const { return views_[0].parts; }

 private:
  // The mission as the scans of one sensor see it.
  struct View {
    Mission mission;
    Parts parts;
  };
  static constexpr std::uint32_t kPipelineFrames = 2;  // from a scan's boundary to its publication
  enum class Request : std::uint8_t { kNone, kStart, kCommand };
  // A scan on its way through the pipeline.
  struct ScanInFlight {
    bool active = false;  // it was wanted, and will be reported
    std::uint32_t scan_id = 0;
    TimeUs t_nominal_us = 0;  // planned middle
    ScanPlan plan;
    PartNumber part = kWhole;  // at which it looks
    SensorChoice sensor;       // that takes it
  };
  struct Counters {
    std::uint32_t invalid_frames = 0;
    std::uint32_t lost_scans = 0;
    std::uint32_t overruns = 0;
    std::uint32_t refused_starts = 0;
    std::uint32_t refused_commands = 0;
    std::uint32_t odd_parts = 0;
  };

  static DurationUs to_us(double seconds) { return static_cast<DurationUs>(seconds * 1e6 + 0.5); }
  enum class Message : std::uint8_t { kHousekeeping = 0, kAccepted, kRefused, kCompleted, kFailed, kPong };
  static constexpr std::size_t kMessages = 6;

  void run_task(TaskId task, TimeUs now_us);
  // A boundary, in this order.
  void publish_estimate(TimeUs now_us);
  void apply_request();
  void try_ways();
  void choose_sensor();
  void hand_over_scan();
  void start_scan();
  TimeUs next_scan_us() const;
  bool bearing_known() const;
  Vec3 bearing_place_m() const;
  Pose predicted_pose() const;
  Aim aim_of_scan() const;
  Aim aim_at_bearing() const;
  void make_views();
  StartWay next_way() const;
  void take_way(StartWay way);

  void request_start(StartWay way);
  void try_start(StartWay way);
  void apply_command();
  void leave_track();
  void refuse_start(StartWay way, StartRefusal refusal);
  void note_change(const ModeChange& change);
  void follow(const TrackStep& step);
  bool report_overdue() const;
  TrackStep step_without_estimate();
  void send(const TrackStep& step, TimeUs now_us);
  void answer(ConstBytes packet, TimeUs now_us);
  void carry_out(const Command& command, Verification& verification, TimeUs now_us);
  void pass_link_boundary(TimeUs now_us);
  PacketHeader next_header(Message message, TimeUs now_us);
  void enqueue(ConstBytes packet);
  void verify(Message message, const Verification& verification, TimeUs now_us);
  void send_pong(TimeUs now_us);
  void send_link(TimeUs now_us);
  void set_changes(PoseTelemetry& report);
  void set_counters(PoseTelemetry& report) const;

  View views_[kMaxSensors];  // the first so many as the mission has sensors
  Executive executive_;
  AcquisitionTask acquisition_;
  EstimationTask estimation_;
  TelemetryQueue queue_;
  SensorChooser chooser_;
  SensorChoice sensor_;       // of the next scan
  TrackState track_;          // as of the last boundary
  AimedRays aimed_;           // where its estimate would look next; empty when track or sensor are other ones now
  PartNumber part_ = kWhole;  // at which the next scan looks, by that estimate
  ScanInFlight acquired_;     // in this frame
  ScanInFlight estimated_;    // in this frame
  Counters counters_;
  StartDesk desk_;
  Request request_ = Request::kNone;
  StartWay requested_way_ = StartWay::kNone;      // kStart
  ModeEvent requested_event_ = ModeEvent::kStop;  // kCommand
  bool held_ = false;
  StartWay refused_way_ = StartWay::kNone;  // the last one
  StartRefusal refusal_ = StartRefusal::kNone;
  FixedVector<ModeChange, 2 * kPoseChanges> changes_;  // that no packet has told yet
  bool loaded_ = false;

  CommandReceiver receiver_;
  bool bytes_came_ = false;    // since the last boundary
  bool link_changed_ = false;  // since the link's counters were told
  std::uint32_t commands_left_ = kMaxCommandsPerFrame;
  std::uint32_t skipped_told_ = 0;
  std::uint16_t packets_ = 0;               // sent; the lower 14 bits are the sequence count
  std::uint16_t messages_[kMessages] = {};  // PUS message type counters
};

}  // namespace lasso
