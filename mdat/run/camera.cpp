#include "mdat/run/camera.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include "bsp/posix/urgency.hpp"
#include "mdat/common/errors.hpp"

namespace lasso::mdat {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::microseconds kStep(500);
constexpr double kMaxDepthM = 1000;  // that a calibration can have

// Nothing where nothing is wrong.
void refuse_line(std::optional<lcs::Device> wire, const std::string& wrong) {
  if (!wrong.empty()) throw InputError("--sensor " + std::string(wire_name(wire.value_or(lcs::Device::kLaserCamera))) + ": " + wrong);
}

posix::SerialLine opened(const CaseSetup& setup, double bits_per_s) {
  posix::SerialLine line;
  refuse_line(setup.wire, line.open(setup.camera_line, static_cast<unsigned>(bits_per_s), setup.remote_line));
  return line;
}

// The scenario's motion, which waits for its beginning.
class AwaitedBegin {
 public:
  void note(TimeUs now_us) {
    if (!begin_us_) begin_us_ = now_us;
  }
  TimeUs scenario_time_us(TimeUs t_us) const { return begin_us_ ? t_us - *begin_us_ + kEpochUs : kEpochUs; }

 private:
  std::optional<TimeUs> begin_us_;
};

class AwaitedTrajectory final : public sim::Trajectory {
 public:
  AwaitedTrajectory(std::shared_ptr<const sim::Trajectory> motion, std::shared_ptr<const AwaitedBegin> begin)
      : motion_(std::move(motion)), begin_(std::move(begin)) {}
  sim::TruthState at(TimeUs t_us) const override { return motion_->at(begin_->scenario_time_us(t_us)); }
  Pose pose_at(TimeUs t_us) const override { return motion_->pose_at(begin_->scenario_time_us(t_us)); }

 private:
  std::shared_ptr<const sim::Trajectory> motion_;
  std::shared_ptr<const AwaitedBegin> begin_;
};

sim::OtherBodies awaited(sim::OtherBodies bodies, const std::shared_ptr<const AwaitedBegin>& begin) {
  for (sim::OtherBody& body : bodies) body.motion = std::make_shared<AwaitedTrajectory>(std::move(body.motion), begin);
  return bodies;
}

// The clock of a head is behind the mirrors of its camera.
void share_mirrors(sim::LcsCamera& camera) {
  camera.clock.serial = camera.truth.serial;
  camera.clock.angle_x_offset_rad = camera.truth.angle_x_offset_rad;
  camera.clock.angle_y_offset_rad = camera.truth.angle_y_offset_rad;
  camera.clock.angle_max_rad = camera.truth.angle_max_rad;
}

// A camera that nobody has calibrated sees as far as the mission says.
lcs::Calibration reaching(lcs::Calibration truth, const sim::ScannerModel& model) {
  truth.depth_max_m = std::clamp(model.range_max_m, truth.depth_max_m, kMaxDepthM);
  return truth;
}

// A camera and its client, from the client's first byte until it goes.
class Session {
 public:
  Session(const CaseSetup& setup, posix::SerialLine line)
      : line_(std::move(line)),
        motion_(make_trajectory(setup.scenario, setup.range_m, kEpochUs, period_us(setup.parameters)), begin_),
        device_(*setup.target, motion_, scanner_model(setup.scenario, setup.parameters, setup.noise), setup.seed,
                camera_for(setup, scanner_model(setup.scenario, setup.parameters, setup.noise), 0), awaited(setup.others, begin_)) {}

  void run(const std::atomic<bool>& ending) {
    const posix::Urgency urgency(posix::UrgencyLevel::kLine);  // its samples' time is when it hears the command
    const Clock::time_point begin = Clock::now();
    while (line_.is_open() && !ending) {
      step(kEpochUs + std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - begin).count());
      std::this_thread::sleep_for(kStep);
    }
  }

 private:
  void look_for_a_start(ConstBytes bytes, TimeUs now_us) {
    lcs::Frame frame;
    for (lcs::FrameDecoder::Step step = decoder_.step(bytes, frame); step.found; step = decoder_.step(bytes, frame)) {
      bytes = bytes.subspan(step.taken, bytes.size() - step.taken);
      if (frame.type == static_cast<std::uint8_t>(lcs::Type::kStart)) begin_->note(now_us);
    }
  }

  void step(TimeUs now_us) {
    std::uint8_t bytes[1024];
    const std::size_t room = std::min(rings_.to_camera.room(), sizeof bytes);
    device_.run(now_us, rings_);
    const ConstBytes heard(bytes, line_.read(Bytes(bytes, room)));
    static_cast<void>(rings_.to_camera.write(heard));
    look_for_a_start(heard, now_us);
    device_.listen(now_us, rings_);
    for (std::size_t taken = 1; taken > 0;) {
      if (at_ == size_) {
        at_ = 0;
        size_ = rings_.from_camera.read(Bytes(unsent_));
      }
      taken = line_.write(ConstBytes(unsent_ + at_, size_ - at_));
      at_ += taken;
    }
  }

  posix::SerialLine line_;
  std::shared_ptr<AwaitedBegin> begin_ = std::make_shared<AwaitedBegin>();
  AwaitedTrajectory motion_;
  lcs::FrameDecoder decoder_;
  sim::LcsDevice device_;
  lcs::Line rings_;
  std::uint8_t unsent_[1024] = {};
  std::size_t at_ = 0, size_ = 0;
};

}  // namespace

const char* wire_name(lcs::Device device) {
  if (device == lcs::Device::kLidar) return "lidar-wire";
  return device == lcs::Device::kTridar ? "tridar-wire" : "lcs-wire";
}

bool wired(lcs::Device device, SensorKind kind) {
  if (kind == SensorKind::kFlashLidar || kind == SensorKind::kStereo) return false;  // have no line
  return device == lcs::Device::kTridar || (device == lcs::Device::kLidar) == (kind == SensorKind::kTimeOfFlight);
}

void check_camera_line(std::optional<lcs::Device> wire, const std::string& line, bool remote) {
  if (!line.empty()) refuse_line(wire, posix::SerialLine::check(line, remote));
}

sim::LcsCamera camera_for(const CaseSetup& setup, const sim::ScannerModel& model, std::uint8_t number) {
  sim::LcsCamera camera;
  camera.device = setup.wire.value_or(lcs::Device::kLaserCamera);
  camera.truth = reaching(camera.truth, model);
  camera.truth.serial = 1;
  const auto calibrated = setup.calibrations.find(number);
  if (calibrated != setup.calibrations.end()) camera.truth = calibrated->second.front();
  if (setup.camera_optics) camera.truth = *setup.camera_optics;
  camera.temperature_degC = static_cast<float>(setup.camera_degC);
  camera.truth.angle_max_rad = std::max({camera.truth.angle_max_rad, model.fov_half_x_rad, model.fov_half_y_rad});
  camera.clock.range_min_m = std::min(camera.clock.range_min_m, model.range_min_m);
  share_mirrors(camera);
  camera.faults = setup.camera_faults;
  for (sim::LcsFault& fault : camera.faults) {
    fault.from_us += kEpochUs;
    fault.until_us += kEpochUs;
  }
  return camera;
}

sim::LcsCamera head_for(const CaseSetup& setup, const sim::ScannerModel& model, SensorKind kind, std::uint8_t number) {
  sim::LcsCamera camera = camera_for(setup, model, number);
  camera.device = kind == SensorKind::kTimeOfFlight ? lcs::Device::kLidar : lcs::Device::kLaserCamera;
  return camera;
}

LiveCamera::LiveCamera(const CaseSetup& setup, const sim::ScannerModel& model, std::uint8_t number)
    : driver(rings, sim::optics_of(camera_for(setup, model, number))), line(opened(setup, rings.bits_per_s)), pump(line, rings) {}

LiveCamera::~LiveCamera() { driver.permit_laser(false); }

void serve_camera(const CaseSetup& setup, posix::LineServer& server, const std::atomic<bool>& ending,
                  const std::function<void(const std::string&)>& told) {
  while (!ending) {
    posix::SerialLine line;
    if (!server.accept(line)) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      continue;
    }
    told("a client has come");
    Session session(setup, std::move(line));
    session.run(ending);
    told("the client has gone");
  }
}

}  // namespace lasso::mdat
