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

#include "fsw/core/identity.hpp"
#include "fsw/core/invariant.hpp"
#include "fsw/core/span.hpp"
#include "fsw/core/status.hpp"
#include "fsw/core/time.hpp"
#include "fsw/exec/acquisition_task.hpp"
#include "fsw/exec/command_dispatcher.hpp"
#include "fsw/exec/command_services.hpp"
#include "fsw/exec/estimation_task.hpp"
#include "fsw/exec/executive.hpp"
#include "fsw/exec/health_monitor.hpp"
#include "fsw/exec/image_service.hpp"
#include "fsw/exec/interlocks.hpp"
#include "fsw/exec/mode_manager.hpp"
#include "fsw/exec/parameter_service.hpp"
#include "fsw/exec/pose_publisher.hpp"
#include "fsw/exec/scan_scheduler.hpp"
#include "fsw/exec/telemetry.hpp"
#include "fsw/geometry/se3.hpp"
#include "fsw/mission/image_keeper.hpp"
#include "fsw/mode/tracker.hpp"
#include "fsw/sense/sensor.hpp"

namespace lasso {

// What a board gives besides sensors; empty, or null, where it does not.
struct BoardMemory {
  Bytes image_buffers[2];  // of one size, aligned to 8 bytes, apart from each other
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
  // kBadOrder afterwards. kBadValue when a scan does not fit into a frame, a sensor of the mission's is not there, or
  // `image` is null, not aligned, or reaches into the buffer that the next image will come into (use_memory).
  LoadFailure load_image(Bytes image);

  // What the board gives for images that are loaded in flight. Before the first image; kBadValue when the buffers are not of one size and
  // aligned to 8 bytes, or share a byte; kOverCapacity when there is more code than can be watched, kBadOrder after begin(). It outlives
  // the component.
  Status use_memory(const BoardMemory& memory);
  // The image of the board's store that was selected last, or the one before where that one is not right. kNoData: neither is.
  LoadFailure load_stored_image();
  const ImageKeeper& images() const { return images_; }

  // An image for the other buffer: begun, loaded in parts in any order, checked. It takes the place of the active one at the next boundary.
  // See ImageKeeper; what is refused changes nothing.
  ImageRefusal open_image(std::uint32_t bytes, std::uint32_t crc) { return images_.open(bytes, crc); }
  ImageRefusal put_image(std::uint32_t offset, ConstBytes part) { return images_.put(offset, part); }
  ImageRefusal check_image() { return images_.begin_check(); }
  ImageRefusal activate_image(std::uint32_t crc) { return image_service_.activate(crc); }
  ImageRefusal roll_back_image() { return image_service_.roll_back(); }

  // Sets the time of boundary 0. Tracking starts from tracking.initial if the mission has one; where that cannot be right it is refused as
  // any other start, and the other sources of the mission's order have their turn in bearing. kMissing without an image, kBadOrder when
  // begun already.
  Status begin(TimeUs boundary_0_us);

  // A pose to start from. By hand-over and uplink the track starts from it at the next boundary; a running track is left, its scan in
  // flight is not reported. From navigation and a priori it is kept, the last one of each, until a mode awaits a start and the mission's
  // order (start.first, ...) comes to it. What is refused changes nothing, and telemetry says so, too.
  StartRefusal offer_start(InitialPoseSource source, const StartOffer& offer);
  // An uplink as uncertain as tracking.start_sigma_* say. kBadOrder before begin(), kNotFinite, kBadValue for every other refusal.
  Status start_tracking(const Pose& T_sensor_target, const Twist& rates, TimeUs t_us);
  // Standby, bearing, searching, reacquiring, tracking (from short_range), short_range (from tracking) or safe, at the next boundary; until
  // then nothing takes the place of safe. What is refused changes nothing. Tracking within short_range.enter_m, or short_range beyond
  // leave_m, is not left for the range before the range has once been the mode's (TrackState::range_awaited), or a start or reacquiring has
  // taken its place.
  ModeRefusal command_mode(TrackingMode mode) { return modes_.command_mode(mode); }
  // Standby. kBadOrder before begin().
  Status stop_tracking();
  // From the next boundary on no mode ends because its frames are used up, and no start is taken but by command. Commands still work.
  void hold_mode(bool held) { modes_.hold_mode(held); }

  // Bytes from the ground, in pieces of any size: their commands are carried out as they come, and answered in telemetry
  // (docs/icd/link.md). Returns how many bytes were taken. kMaxCommandsPerFrame commands are answered in a frame, and kMaxUrgentPerFrame
  // that make safe; kMaxStrangersPerFrame other packets are looked at. The rest waits for the next frame.
  std::size_t receive(ConstBytes bytes, TimeUs now_us);
  // A datagram: one command, whole. False, and it was not looked at, when the frame has no room for it.
  bool receive_packet(ConstBytes packet, TimeUs now_us);
  // Did the last packet that was looked at come from who may command? See CommandReceiver::from_operator().
  bool heard_operator() const { return commands_.heard_operator(); }

  // From now on commands need its trailer and images its signature (fsw/core/authenticator.hpp); others are refused. Before the first
  // image: what was taken before is not judged. It outlives the component.
  void use_authenticator(Authenticator& authenticator);
  // Images alone: of a host whose link authenticates commands.
  void authenticate_images(Authenticator& authenticator) { images_.use_authenticator(authenticator); }
  // Images without a signature are taken, too: of a host that is sure of them by other means.
  void accept_unsigned_images() { images_.accept_unsigned(); }

  // The board's watchdog, which outlives the component: fed at a boundary once every slot of the frame and the estimation thread have
  // checked in.
  void set_watchdog(Watchdog& watchdog) { health_.set_watchdog(watchdog); }
  // Why the component starts, as the board knows it. After its watchdog it begins in mode safe. Before begin().
  void set_reset_cause(ResetCause cause) { health_.set_reset_cause(cause); }

  // A command has asked for it, and its frame is over: the board takes the telemetry and starts the component anew, with
  // ResetCause::kCommanded.
  bool reset_due() const { return command_services_.reset_due(); }

  // The nominal time of the next slot, and whether it is a boundary.
  TimeUs next_slot_us() const { return executive_.next_slot_us(); }
  bool next_slot_is_boundary() const { return executive_.next_slot() == 0; }
  // Is it time for it? It is, too, when the clock has jumped back. Before begin() there is none.
  bool slot_is_due(TimeUs now_us) const { return !executive_.awaits_begin() && (now_us >= next_slot_us() || executive_.jumped(now_us)); }
  // After begin() only (an invariant). Runs the next slot at now_us (when it is due; later is a slip, which is counted). A clock that has
  // jumped is followed. Never waits.
  void run_slot(TimeUs now_us);

  bool estimation_pending() const { return estimation_.pending(); }
  // Runs the pending estimate, if any. The result waits for the boundary.
  void run_estimation();

  // Moves whole packets into `out` and returns their bytes, oldest first.
  std::size_t take_telemetry(Bytes out) {
    const Running running(identity_);
    return telemetry_.downlink().take(out);
  }

  // Of the last boundary.
  const FaultMonitor& faults() const { return health_.faults(); }
  // As the scans of the first sensor see it.
  const Mission& mission() const { return images_.view(0).mission; }
  const Parts& parts() const { return images_.view(0).parts; }

 private:
  void run_task(TaskId task, TimeUs now_us);
  void pass_boundary(TimeUs now_us);
  void check_memory();
  void publish_estimate(TimeUs now_us);
  void update_settings(TimeUs now_us);
  void schedule_scans(TimeUs now_us);
  void hand_over_scan();
  void publish_states(TimeUs now_us);
  void follow_jump(TimeUs now_us);

  const Identity identity_;
  ImageKeeper images_;
  AcquisitionTask acquisition_;
  EstimationTask estimation_;
  Executive executive_;
  Telemetry telemetry_;
  HealthMonitor health_{executive_, telemetry_};
  Interlocks interlocks_{acquisition_, telemetry_};
  ScanScheduler scans_{acquisition_, executive_, images_, telemetry_, health_};
  const ComponentContext context_{executive_, images_, telemetry_, health_, interlocks_, scans_};
  ModeManager modes_{context_};
  PosePublisher publisher_{executive_, images_, telemetry_, modes_, scans_};
  ParameterService parameters_{images_, telemetry_, health_};
  ImageService image_service_{images_, acquisition_, context_, modes_, parameters_};
  CommandServices command_services_{acquisition_, context_, modes_, parameters_, image_service_};
  CommandDispatcher commands_;
};

}  // namespace lasso
