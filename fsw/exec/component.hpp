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
#include "fsw/core/identity.hpp"
#include "fsw/core/invariant.hpp"
#include "fsw/core/span.hpp"
#include "fsw/core/status.hpp"
#include "fsw/core/time.hpp"
#include "fsw/core/voted.hpp"
#include "fsw/exec/acquisition_task.hpp"
#include "fsw/exec/estimation_task.hpp"
#include "fsw/exec/executive.hpp"
#include "fsw/exec/faults.hpp"
#include "fsw/exec/image_trial.hpp"
#include "fsw/exec/stored_log.hpp"
#include "fsw/exec/watchdog.hpp"
#include "fsw/geometry/se3.hpp"
#include "fsw/link/arming.hpp"
#include "fsw/link/command_receiver.hpp"
#include "fsw/link/downlink.hpp"
#include "fsw/link/event_log.hpp"
#include "fsw/link/frame_room.hpp"
#include "fsw/link/health_report.hpp"
#include "fsw/link/housekeeping.hpp"
#include "fsw/link/key_change.hpp"
#include "fsw/link/link_report.hpp"
#include "fsw/link/pose_telemetry.hpp"
#include "fsw/mission/image_keeper.hpp"
#include "fsw/mission/parameter_area.hpp"
#include "fsw/mode/tracker.hpp"
#include "fsw/sense/sensor.hpp"
#include "fsw/sense/sensor_chooser.hpp"

namespace lasso {

// What the packet image counts; it is sent when one of them changes.
struct MemoryCounts {
  std::uint8_t other_state = 0;
  std::uint32_t activations = 0, roll_backs = 0, confirmed = 1;
  std::uint32_t findings = 0, repairs = 0;
};

// What a board gives besides sensors; empty, or null, where it does not.
struct BoardMemory {
  Bytes image_buffers[2];  // of one size, aligned to 8 bytes
  Store* store = nullptr;
  ConstBytes code;  // that must not change
};

class Component {
 public:
  // The sensors, in the order of the mission's, outlive the component; there is one at least. The identity is valid. Nothing moves before
  // begin().
  explicit Component(const SensorBank& sensors, const Identity& identity = {});
  explicit Component(Sensor& sensor, const Identity& identity = {});
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;

  const Identity& identity() const { return identity_; }

  // Validates and takes over `image`, which stays the component's memory (8-byte aligned, at most kMaxImageBytes). Before begin() only:
  // kBadOrder afterwards. kBadValue when a scan does not fit into a frame, or a sensor of the mission's is not there.
  LoadFailure load_image(Bytes image);

  // What the board gives for images that are loaded in flight. Before the first image; kBadValue when the buffers are not of one size and
  // aligned to 8 bytes, kOverCapacity when there is more code than can be watched, kBadOrder after begin(). It outlives the component.
  Status use_memory(const BoardMemory& memory);
  // The image of the board's store that was selected last, or the one before where that one is not right. kNoData: neither is.
  LoadFailure load_stored_image();
  const ImageKeeper& images() const { return images_; }

  // An image for the other buffer: begun, loaded in parts in any order, checked. It takes the place of the active one at the next boundary.
  // See ImageKeeper; what is refused changes nothing.
  ImageRefusal open_image(std::uint32_t bytes, std::uint32_t crc) { return images_.open(bytes, crc); }
  ImageRefusal put_image(std::uint32_t offset, ConstBytes part) { return images_.put(offset, part); }
  ImageRefusal check_image() { return images_.begin_check(); }
  ImageRefusal activate_image(std::uint32_t crc);
  ImageRefusal roll_back_image();

  // Sets the time of boundary 0. Tracking starts from tracking.initial if the mission has one; where that cannot be right it is refused as
  // any other start, and the other ways of the mission's order have their turn in bearing. kMissing without an image, kBadOrder when begun
  // already.
  Status begin(TimeUs boundary_0_us);

  // A pose to start from. By hand-over and uplink the track starts from it at the next boundary; a running track is left, its scan in
  // flight is not reported. From navigation and a priori it is kept, the last one of each, until a mode awaits a start and the mission's
  // order (start.first, ...) comes to it. What is refused changes nothing, and telemetry says so, too.
  StartRefusal offer_start(InitialPoseSource way, const StartOffer& offer);
  // An uplink as uncertain as tracking.start_sigma_* say. kBadOrder before begin(), kNotFinite, kBadValue for every other refusal.
  Status start_tracking(const Pose& T_sensor_target, const Twist& rates, TimeUs t_us);
  // Standby, bearing, searching, reacquiring, tracking (from short_range), short_range (from tracking) or safe, at the next boundary; until
  // then nothing takes the place of safe. What is refused changes nothing. Tracking within short_range.enter_m, or short_range beyond
  // leave_m, is not left for the range before the range has once been the mode's (TrackState::range_awaited).
  ModeRefusal command_mode(TrackingMode mode);
  // Standby. kBadOrder before begin().
  Status stop_tracking();
  // From the next boundary on no mode ends because its frames are used up, and no start is taken but by command. Commands still work.
  void hold_mode(bool held) { held_ = held; }

  // Bytes from the ground, in pieces of any size: their commands are carried out as they come, and answered in telemetry
  // (docs/icd/link.md). Returns how many bytes were taken. kMaxCommandsPerFrame commands are answered in a frame, and kMaxUrgentPerFrame
  // that make safe; kMaxStrangersPerFrame other packets are looked at. The rest waits for the next frame.
  std::size_t receive(ConstBytes bytes, TimeUs now_us);
  // A datagram: one command, whole. False, and it was not looked at, when the frame has no room for it.
  bool receive_packet(ConstBytes packet, TimeUs now_us);
  // Did the last packet that was looked at come from who may command? See CommandReceiver::from_operator().
  bool heard_operator() const { return receiver_.from_operator(); }

  // From now on commands need its trailer and images its signature (fsw/core/authenticator.hpp); others are refused. Before the first
  // image: what was taken before is not judged. It outlives the component.
  void use_authenticator(Authenticator& authenticator);
  // Images alone: of a host whose link authenticates commands.
  void authenticate_images(Authenticator& authenticator) { images_.use_authenticator(authenticator); }
  // Images without a signature are taken, too: of a host that is sure of them by other means.
  void accept_unsigned_images() { images_.accept_unsigned(); }

  // The board's watchdog, which outlives the component: fed at a boundary once every slot of the frame and the estimation thread have
  // checked in.
  void set_watchdog(Watchdog& watchdog) { watchdog_ = &watchdog; }
  // Why the component starts, as the board knows it. After its watchdog it begins in mode safe. Before begin().
  void set_reset_cause(ResetCause cause) { health_.reset_cause = static_cast<std::uint8_t>(cause); }

  // A command has asked for it, and its frame is over: the board takes the telemetry and starts the component anew, with
  // ResetCause::kCommanded.
  bool reset_due() const { return reset_due_; }

  // The nominal time of the next slot, and whether it is a boundary.
  TimeUs next_slot_us() const { return executive_.next_slot_us(); }
  bool next_slot_is_boundary() const { return executive_.next_slot() == 0; }
  // Is it time for it? It is, too, when the clock has jumped back.
  bool slot_is_due(TimeUs now_us) const { return now_us >= next_slot_us() || executive_.jumped(now_us); }
  // Runs the next slot at now_us (when it is due; later is a slip, which is counted). A clock that has jumped is followed. Never waits.
  void run_slot(TimeUs now_us);

  bool estimation_pending() const { return estimation_.pending(); }
  // Runs the pending estimate, if any. The result waits for the boundary.
  void run_estimation();

  // Moves whole packets into `out` and returns their bytes, oldest first.
  std::size_t take_telemetry(Bytes out) {
    const Running running(identity_);
    return downlink_.take(out);
  }

  // Of the last boundary.
  const FaultMonitor& faults() const { return faults_; }
  // As the scans of the first sensor see it.
  const Mission& mission() const { return images_.view(0).mission; }
  const Parts& parts() const { return images_.view(0).parts; }

 private:
  static constexpr std::uint32_t kPipelineFrames = 2;  // from a scan's boundary to its publication
  enum class Request : std::uint8_t { kNone, kStart, kCommand };
  enum class ImageRequest : std::uint8_t { kNone, kActivate, kRollBack };
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
  // What was last seen of counters whose changes are events.
  struct Watched {
    std::uint32_t dropped_packets = 0;
    std::uint32_t slot_slips = 0;
    std::uint8_t sensors_failed = 0;
  };

  static DurationUs to_us(double seconds) { return static_cast<DurationUs>(seconds * 1e6 + 0.5); }
  void run_task(TaskId task, TimeUs now_us);
  // A boundary, in this order.
  void publish_estimate(TimeUs now_us);
  void apply_request();
  void try_ways();
  void choose_sensor();
  void hand_over_scan();
  void start_scan(TimeUs now_us);
  TimeUs next_scan_us() const;
  bool bearing_known() const;
  Vec3 bearing_place_m() const;
  Pose predicted_pose() const;
  Aim aim_of_scan() const;
  Aim aim_at_bearing() const;
  InitialPoseSource next_way() const;
  void take_way(InitialPoseSource way);

  bool safe_requested() const { return request_ == Request::kCommand && requested_event_ == ModeEvent::kMakeSafe; }
  void drop_request();
  void request_start(InitialPoseSource way);
  void start_from_mission(TimeUs t_us);
  void try_start(InitialPoseSource way);
  void take(ModeEvent event);
  void feed_watchdog();
  void check_mode();
  void follow_jump(TimeUs now_us);
  void watch_filter(const TrackStep& step);
  void see_faults();
  void answer_faults(TimeUs now_us);
  void doubt_track();
  void tell_faults(const FaultChanges& changes, TimeUs now_us);
  void leave_track();
  void take_up_former(TrackStep& step);
  void refuse_in(const TrackStep& step);
  void refuse_start(InitialPoseSource way, StartRefusal refusal);
  void note_change(const ModeChange& change);
  void follow(TrackStep& step);
  bool report_overdue() const;
  TrackStep step_without_estimate();
  void send(const TrackStep& step, TimeUs now_us);
  void send_filter(const CommonErrors& common, TimeUs now_us);
  void send_named_poses(const Registration& registration, TimeUs now_us);
  bool answer_if_room(ConstBytes packet, TimeUs now_us);
  void answer(ConstBytes packet, TimeUs now_us);
  void carry_out(const Command& command, Verification& verification, TimeUs now_us);
  void pass_link_boundary(TimeUs now_us);
  void verify(std::uint8_t subservice, const Verification& verification, TimeUs now_us);
  void refuse(const Verification& verification, bool answered, TimeUs now_us);
  void fail(const Command& command, const Verification& verification, TimeUs now_us);
  ServiceRefusal serve(const Command& command, TimeUs now_us);
  ServiceRefusal serve_structure(CommandKind kind, const StructureCommand& command);
  ServiceRefusal enable_event(std::uint16_t event, bool enabled);
  ServiceRefusal arm(const CommandName& name);
  ServiceRefusal enable_laser();
  void inhibit_laser();
  bool laser_enabled() const;
  void check_laser();
  void correlate_time(const TimeCommand& time);
  ServiceRefusal set_parameter(const ParameterCommand& command);
  ServiceRefusal report_parameter(std::uint16_t parameter, TimeUs now_us);
  void revert_parameters();
  ServiceRefusal save_parameters();
  ServiceRefusal restore_parameters();
  ServiceRefusal select_calibration(const CalibrationCommand& choice);
  ServiceRefusal change_key(std::uint32_t number);
  ServiceRefusal confirm_key(std::uint32_t number);
  ServiceRefusal report_stored(const StoredCommand& command, TimeUs now_us);
  void reset();
  void check_area();
  void apply_parameters();
  bool may_fire(const Command& command);
  void send_pong(TimeUs now_us);
  void send_link(TimeUs now_us);
  void send_events();
  void watch_counters();
  void send_sensors(TimeUs now_us);
  void set_changes(PoseTelemetry& report);
  void set_counters(PoseTelemetry& report) const;

  void tend_memory();
  void pass_memory_boundary();
  ServiceRefusal serve_memory(const Command& command, TimeUs now_us);
  ServiceRefusal load_memory(const LoadCommand& load);
  ServiceRefusal dump_memory(const MemoryCommand& range, TimeUs now_us);
  ServiceRefusal check_memory(const MemoryCommand& range, TimeUs now_us);
  ConstBytes memory_of(std::uint8_t area) const;
  ServiceRefusal find_memory(const MemoryCommand& range, std::size_t most, ConstBytes& bytes) const;
  void send_image(TimeUs now_us);
  bool may_change(ImageRequest request) const;
  void judge_image();
  void change_image(bool back);
  void leave_target();
  void take_up_again();

  const Identity identity_;
  ImageKeeper images_;
  Executive executive_;
  AcquisitionTask acquisition_;
  EstimationTask estimation_;
  Downlink downlink_;
  EventLog events_;
  SensorChooser chooser_;
  SensorChoice sensor_;       // of the next scan
  TrackState track_;          // as of the last boundary
  FilterState former_;        // of the track that the present start interrupted, where it did
  AimedRays aimed_;           // where its estimate would look next; empty when track or sensor are other ones now
  PartNumber part_ = kWhole;  // at which the next scan looks, by that estimate
  ScanInFlight acquired_;     // in this frame
  ScanInFlight estimated_;    // in this frame
  Counters counters_;
  InitialPoseSources sources_;
  Request request_ = Request::kNone;
  InitialPoseSource requested_way_ = InitialPoseSource::kNone;  // kStart
  ModeEvent requested_event_ = ModeEvent::kStop;                // kCommand
  bool held_ = false;
  Voted<TrackingMode> mode_{TrackingMode::kStandby};  // as of the end of the last boundary
  FaultMonitor faults_;
  FaultSet seen_;  // since the last boundary
  Watchdog* watchdog_ = nullptr;
  CheckIn check_in_;
  HealthTelemetry health_;                                    // what only grows is kept in it
  InitialPoseSource refused_way_ = InitialPoseSource::kNone;  // the last one
  StartRefusal refusal_ = StartRefusal::kNone;
  FixedVector<ModeChange, 2 * kPoseChanges> changes_;  // that no packet has told yet

  ImageRequest image_request_ = ImageRequest::kNone;
  std::uint32_t requested_crc_ = 0;  // kActivate: of the image that was named
  ImageTrial trial_;
  MemoryCounts memory_;               // of now,
  MemoryCounts memory_told_;          // and as they were told last
  TrackState before_trial_;           // the track that the active image took over
  std::uint32_t choices_before_ = 0;  // of calibrations, with the image before

  CommandReceiver receiver_;
  bool bytes_came_ = false;    // since the last boundary
  bool link_changed_ = false;  // since the link's counters were told
  bool packet_waits_ = false;  // the receiver's, for the next frame
  FrameRoom room_;
  std::uint32_t skipped_told_ = 0;
  std::uint32_t silent_frames_ = 0;  // since the last valid command
  Housekeeping housekeeping_;
  ParameterArea parameter_area_;
  bool parameters_due_ = false;  // for the next boundary
  Store* store_ = nullptr;       // the board's, if it has one
  StoredLog log_;
  bool reset_asked_ = false, reset_due_ = false;
  Arming arming_;
  KeyChange key_change_;
  Voted<std::uint8_t> laser_{0};  // 1: a command has enabled it, and none has inhibited it since
  Watched watched_;
  std::uint32_t troubles_told_[kMaxSensors] = {};
};

}  // namespace lasso
