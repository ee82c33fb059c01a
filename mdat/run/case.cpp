#include "mdat/run/case.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "bsp/posix/image_memory.hpp"
#include "bsp/posix/reset_note.hpp"
#include "bsp/posix/runner.hpp"
#include "fsw/exec/component.hpp"
#include "fsw/geometry/so3.hpp"
#include "fsw/link/command_rows.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/common/interruption.hpp"
#include "mdat/run/case_sensors.hpp"
#include "mdat/run/navigation.hpp"
#include "mdat/run/verdict.hpp"

namespace lasso::mdat {
namespace {

Pose to_pose(const double (&q)[4], const double (&p_m)[3]) { return {Quat(q[3], q[0], q[1], q[2]), Vec3(p_m[0], p_m[1], p_m[2])}; }

// Everything of one case that lives as long as it runs.
class Case {
 public:
  explicit Case(const CaseSetup& setup)
      : setup_(setup),
        period_us_(mdat::period_us(setup.parameters)),
        noisy_model_(scanner_model(setup.scenario, setup.parameters, true)),
        trajectory_(make_trajectory(setup.scenario, setup.range_m, kEpochUs, period_us_)),
        scanners_(make_scanners(setup, *trajectory_)),
        component_(std::make_unique<Component>(bank_of(scanners_), Identity{setup.apid})),
        link_(setup.link, setup.commands.get(), setup.listener, [this] { return component_->next_slot_us(); }),
        memory_(link_.get() != nullptr ? std::make_unique<posix::ImageMemory>(setup.store) : nullptr),
        image_(memory_ ? std::vector<std::uint64_t>() : aligned_copy(*setup.image)),
        navigation_(setup.scenario, *trajectory_, setup.seed) {
    result_.frames.resize(setup.frames);
    for (std::uint32_t frame = 0; frame < setup.frames; ++frame) {
      result_.frames[frame].frame = frame;
      result_.frames[frame].t_s = frame * setup.parameters.period_s;
      result_.frames[frame].range_m = trajectory_->at(kEpochUs + frame * period_us_).T_sensor_target.p.norm();
    }
    if (!setup.store.empty()) reset_note_ = std::make_unique<posix::ResetNote>(setup.store);
    if (reset_note_) component_->set_reset_cause(reset_note_->cause());
    load();
    expect(component_->begin(kEpochUs), "begin");
    if (setup.wire) enable_laser();
    if (!is_autonomous()) start(kEpochUs - period_us_);
    if (is_autonomous() && component_->command_mode(TrackingMode::kBearing) != ModeRefusal::kNone) {
      throw RunError("the component refused to look for a bearing");
    }
  }

  CaseResult run(std::atomic<std::size_t>& done) {
    CaseResult result = fly(done);
    for (const auto& scanner : scanners_) {
      if (!scanner->replay) continue;
      result.replay_rounds = std::max(result.replay_rounds, scanner->replay->rounds());
      result.replay_unserved += scanner->replay->unserved();
    }
    return result;
  }

 private:
  CaseResult fly(std::atomic<std::size_t>& done) {
    connect();
    const auto interrupted = [&] { return is_by_the_clock() && interruption(); };
    std::uint32_t flown = 0;
    for (std::uint32_t frame = 0; frame < setup_.frames + kPipelineFrames && !interrupted(); ++frame) {
      const posix::FrameRecord record = runner_->run_frame();
      check_sensors();
      pass_pairs();
      result_.telemetry.insert(result_.telemetry.end(), record.telemetry.begin(), record.telemetry.end());
      if (setup_.listener != nullptr) setup_.listener->on_packets(record.boundary_us, record.telemetry);
      read_packets(record);
      if (is_autonomous()) navigation_.offer(record.boundary_us, *component_);
      if (record.reset_due) restart(record.boundary_us + period_us_);
      if (frame < kPipelineFrames) continue;
      ++flown;
      ++done;
    }
    result_.flown = flown;
    result_.frames.resize(flown);
    result_.end_s = to_seconds(static_cast<DurationUs>(flown) * period_us_);
    if (setup_.scenario.prior == 0) {
      const auto found = static_cast<std::ptrdiff_t>(std::min(result_.found_frame.value_or(setup_.frames), flown));
      result_.frames.erase(result_.frames.begin(), result_.frames.begin() + found);
    }
    return std::move(result_);
  }

  void check_sensors() const {
    for (const auto& scanner : scanners_) {
      const std::string failure = scanner->stereo ? scanner->stereo->failure() : "";
      if (!failure.empty()) throw RunError(failure);
    }
  }

  // Without a listener they are let go.
  void pass_pairs() {
    for (const auto& scanner : scanners_) {
      if (!scanner->stereo) continue;
      for (const TakenPair& pair : scanner->stereo->take_pairs()) {
        if (setup_.listener != nullptr) setup_.listener->on_pair(pair);
      }
    }
  }

  // A camera of its own has its own clock; an operator has patience.
  posix::Pace pace() const {
    if (!setup_.camera_line.empty()) return posix::Pace::kRealTime;
    if (setup_.link != nullptr) return posix::Pace::kPaced;
    return setup_.alone ? posix::Pace::kAlone : posix::Pace::kLockstep;
  }

  bool is_by_the_clock() const { return pace() == posix::Pace::kRealTime || pace() == posix::Pace::kPaced; }

  void connect() {
    runner_ = std::make_unique<posix::Runner>(*component_, pace());
    if (link_.get() != nullptr) runner_->connect(*link_.get());
    if (setup_.authenticator != nullptr) component_->use_authenticator(*setup_.authenticator);
  }

  // What a board does on the command reset: everything begins anew but the world, and what the store has.
  void restart(TimeUs boundary_us) {
    runner_.reset();
    for (const auto& scanner : scanners_) scanner->recorded.abort();
    component_ = std::make_unique<Component>(bank_of(scanners_), Identity{setup_.apid});
    component_->set_reset_cause(ResetCause::kCommanded);
    load();
    expect(component_->begin(boundary_us), "begin");
    connect();
  }

  // A commanded run has all that a board has for images in flight; every other one has its image, and that is all.
  void load() {
    if (setup_.authenticator != nullptr) component_->authenticate_images(*setup_.authenticator);
    const LoadFailure failure = memory_ ? memory_->start(*component_, {setup_.image->data(), setup_.image->size()})
                                        : component_->load_image(view(image_, setup_.image->size()));
    if (failure.status != Status::kOk) throw InputError("the component refuses the mission's image: " + to_string(failure));
    if (setup_.store.empty()) return;
    std::printf("image %08x of %s\n", component_->mission().image_crc, memory_->from_store() ? setup_.store.c_str() : "the mission");
    (void)std::fflush(stdout);
  }

  // As an operator does: the command is hazardous, and armed first.
  void enable_laser() {
    const PacketRow& enable = command_rows::row_of(CommandKind::kEnableLaser);
    std::uint16_t count = 0;
    for (const CommandKind kind : {CommandKind::kArm, CommandKind::kEnableLaser}) {
      const PacketRow& row = command_rows::row_of(kind);
      std::uint8_t packet[kMaxCommandBytes];
      ByteWriter writer{Bytes(packet)};
      begin_command({setup_.apid, count++, 0, row.service, row.subservice, 0}, writer);
      writer.u16(row.number);
      if (kind == CommandKind::kArm) codec_of(command_rows::kArm).write({enable.service, enable.subservice, enable.number}, writer);
      const ConstBytes bytes(packet, finish_packet(writer, Bytes(packet)));
      if (!component_->receive_packet(bytes, kEpochUs)) throw RunError("the component took no command");
    }
  }

  static void expect(Status status, const std::string& what) {
    if (status != Status::kOk) throw RunError("the component refused to " + what + ": " + to_string(status));
  }

  bool is_autonomous() const { return setup_.scenario.autonomous != 0; }

  void start(TimeUs truth_us) {
    if (setup_.scenario.prior == 0) {
      if (component_->command_mode(TrackingMode::kBearing) != ModeRefusal::kNone)
        throw RunError("the component refused to seek the bearing");
      return;
    }
    const std::vector<double>& turn = setup_.scenario.prior_turn_rad;
    const Vec3 center_m(setup_.scenario.center_m.data());
    const Quat q = exp_so3(Vec3(turn.at(0), turn.at(1), turn.at(2)));
    const Pose T_target_turned{q, center_m - rotate(q, center_m)};
    Pose T_sensor_start = trajectory_->at(truth_us).T_sensor_target * T_target_turned;
    T_sensor_start.p += Vec3(setup_.scenario.prior_shift_m.data());
    const StartOffer offer = rough_offer(component_->mission().parameters, T_sensor_start, Twist{}, truth_us + period_us_);
    const StartRefusal refusal = component_->offer_start(InitialPoseSource::kUplink, offer);
    if (refusal != StartRefusal::kNone)
      throw InputError("the component refuses the pose to start from (" + std::string(lasso::to_string(refusal)) +
                       "): the scenario's prior_turn_deg and prior_shift_m turn and shift it off the truth");
  }

  void read_packets(const posix::FrameRecord& record) {
    ConstBytes stream = record.telemetry;
    while (const std::size_t size = packet_size(stream)) {
      PacketHeader header;
      PoseTelemetry pose;
      const ConstBytes packet = stream.first(std::min(size, stream.size()));
      const PacketFault fault = decode_pose(packet, header, pose, setup_.apid);
      const bool other = fault == PacketFault::kUnknown;  // an event, an answer
      if (fault != PacketFault::kNone && !other)
        throw RunError("the component's telemetry cannot be decoded: " + std::string(to_string(fault)));
      if (!other) note(pose, record);
      stream = stream.subspan(packet.size(), stream.size() - packet.size());
    }
  }

  void note(const PoseTelemetry& pose, const posix::FrameRecord& record) {
    RecordedScan scan;
    for (const auto& scanner : scanners_) {
      RecordedScan taken = scanner->recorded.take(pose.scan_id);
      if (!taken.samples.empty()) scan = std::move(taken);  // of one of them
    }
    if (setup_.listener != nullptr) setup_.listener->on_frame({pose, trajectory_->at(pose.t_measurement_us), scan.samples});
    if (setup_.scenario.has_timeline()) add_packet(pose, *trajectory_, kEpochUs, result_.timeline);
    const bool restarts = !is_autonomous() && link_.get() == nullptr;
    if (restarts && static_cast<TrackingMode>(pose.mode) == TrackingMode::kLost) start(record.boundary_us);
    const std::int64_t frame = (pose.t_measurement_us - kEpochUs) / period_us_;
    if (pose.t_measurement_us < kEpochUs || frame >= setup_.frames) return;
    tell(pose, result_.frames[static_cast<std::size_t>(frame)]);
    if (static_cast<StopReason>(pose.stop) == StopReason::kNotRun) return;
    if (pose.valid != 0 && !result_.found_frame) result_.found_frame = static_cast<std::uint32_t>(frame);
    FrameError& error = result_.frames[static_cast<std::size_t>(frame)];
    error = judged(pose, scan.samples, record);
    error.frame = static_cast<std::uint32_t>(frame);
    tell(pose, error);
    keep(error, pose, scan);
  }

  static void tell(const PoseTelemetry& pose, FrameError& error) {
    error.told = true;
    error.mode = static_cast<TrackingMode>(pose.mode);
    error.reason = static_cast<PoseReason>(pose.reason);
    error.sensor = pose.sensor;
    error.part = pose.part;
  }

  FrameError judged(const PoseTelemetry& pose, const std::vector<RangeSample>& scan, const posix::FrameRecord& record) const {
    const sim::TruthState truth = trajectory_->at(pose.t_measurement_us);
    FrameError error;
    error.reported = true;
    error.t_s = to_seconds(pose.t_measurement_us - kEpochUs);
    error.range_m = truth.T_sensor_target.p.norm();
    error.returns = pose.returns;
    error.inliers = pose.inliers;
    const Mat6 covariance = registration_covariance(pose);
    error.sigma_rad = std::sqrt(covariance.topLeftCorner<3, 3>().trace());
    error.sigma_m = std::sqrt(covariance.bottomRightCorner<3, 3>().trace());
    error.level = protection_levels(covariance);
    error.valid = pose.valid != 0;
    error.wrong = judge_valid(pose, truth.T_sensor_target) == PoseVerdict::kWrong;
    error.registration = pose_error(registration_pose(pose), truth.T_sensor_target);
    error.filtered = pose_error(filtered_pose(pose), truth.T_sensor_target);
    error.nees = nees(registration_pose(pose), truth.T_sensor_target, covariance);
    error.bound = bound(truth.T_sensor_target, scan);
    error.estimate_us = 1e-3 * static_cast<double>(record.estimate_cpu_ns);
    error.omega_error_radps = (Vec3(pose.filter_omega_radps) - truth.rates.omega_radps).norm();
    error.v_error_mps = (Vec3(pose.filter_v_mps) - truth.rates.v_mps).norm();
    return error;
  }

  // Only for a target that stands still in the scan: the bound knows one pose.
  PoseBound bound(const Pose& truth, const std::vector<RangeSample>& scan) const {
    if (setup_.scenario.variants == 0) return {};
    return pose_bound(*setup_.target, truth, scan, [&](double z_m) { return sim::range_sigma_m(noisy_model_, z_m); });
  }

  void keep(const FrameError& error, const PoseTelemetry& pose, const RecordedScan& scan) {
    const bool first = !setup_.keep_frames.empty() && result_.scans.empty() && error.valid;  // of a search, which has no first frame
    const bool wanted = first || std::binary_search(setup_.keep_frames.begin(), setup_.keep_frames.end(), error.frame);
    std::size_t& count = error.wrong ? wrong_kept_ : invalid_kept_;
    const bool doubtful = (error.wrong || !error.valid) && count < kDoubtfulScans;
    if (!wanted && !doubtful) return;
    const TimeUs t_us = pose.t_measurement_us;
    const KeptScan kept{error.frame, trajectory_->at(t_us).T_sensor_target, pose, scan.samples, scan.aimed};
    if (wanted) result_.scans.push_back(kept);
    if (!doubtful) return;
    result_.doubtful.push_back(kept);
    ++count;
  }

  const CaseSetup& setup_;
  DurationUs period_us_;
  sim::ScannerModel noisy_model_;
  std::unique_ptr<sim::Trajectory> trajectory_;
  std::vector<std::unique_ptr<Scanner>> scanners_;
  std::unique_ptr<Component> component_;
  RunLink link_;
  std::unique_ptr<posix::ImageMemory> memory_;
  std::unique_ptr<posix::ResetNote> reset_note_;
  std::vector<std::uint64_t> image_;
  NavigationSystem navigation_;
  CaseResult result_;
  std::size_t wrong_kept_ = 0, invalid_kept_ = 0;  // scans of result_.doubtful
  std::unique_ptr<posix::Runner> runner_;          // last: it uses the component and the link
};

}  // namespace

CaseResult run_case(const CaseSetup& setup, std::atomic<std::size_t>& done) { return Case(setup).run(done); }

Pose registration_pose(const PoseTelemetry& telemetry) { return to_pose(telemetry.q_sensor_target, telemetry.p_sensor_target_m); }

Pose filtered_pose(const PoseTelemetry& telemetry) { return to_pose(telemetry.filter_q_sensor_target, telemetry.filter_p_sensor_target_m); }

Mat6 registration_covariance(const PoseTelemetry& telemetry) {
  Mat6 covariance;
  std::size_t term = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column, ++term) {
      covariance(row, column) = telemetry.covariance[term];
      covariance(column, row) = covariance(row, column);
    }
  }
  return covariance;
}

}  // namespace lasso::mdat
