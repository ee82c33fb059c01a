// The head at the other end of the line, laser camera, LIDAR or TriDAR: it understands docs/icd/lcs.md (lidar.md, tridar.md) byte for byte,
// scans the simulated target with mirrors and a detector of its own, and fails as told. Time is what it is given: nothing here waits.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "hal_lcs/driver.hpp"
#include "hal_lcs/frame.hpp"
#include "hal_lcs/messages.hpp"
#include "hal_sim/lcs_head.hpp"
#include "hal_sim/random.hpp"
#include "hal_sim/scanner.hpp"

namespace lasso::sim {

class LcsDevice {
 public:
  // Keeps references: target and trajectory outlive it. Throws std::invalid_argument as validate(model), and for optics that are not valid.
  LcsDevice(const RayCaster& target, const Trajectory& trajectory, const ScannerModel& model, std::uint64_t seed, const LcsCamera& camera,
            OtherBodies others = {});

  // The line has bytes for the camera since t_us, if it had none before, ...
  void listen(TimeUs t_us, const lcs::Line& line);
  // ... which it carries one after the other. The camera lives until now_us: commands are carried out as their last byte arrives, what the
  // camera says arrives as the line lets it.
  void run(TimeUs now_us, lcs::Line& line);

 private:
  struct Byte {
    TimeUs t_us;
    std::uint8_t value;
  };
  struct Scan {
    lcs::StartCommand command;
    TimeUs t_first_us = 0;
    std::vector<AimedRay> aimed;
    std::vector<bool> aimed_there;
    std::uint16_t next = 0;
    bool running = false;
  };

  double byte_us() const { return 1e7 / camera_.bits_per_s; }
  std::uint32_t clock_us(TimeUs t_us) const;
  double fault(LcsFaultKind kind, TimeUs t_us) const;
  bool failing(LcsFaultKind kind, TimeUs t_us) const { return fault(kind, t_us) > 0; }
  std::uint8_t noisy(std::uint8_t byte, TimeUs t_us);
  void take_byte(lcs::Line& line);
  void live_until(TimeUs now_us, lcs::Line& line);
  void pull(TimeUs now_us, lcs::Line& line);
  bool booting(TimeUs t_us) const { return t_us < up_us_; }
  void put_out_laser();
  void carry_out(const lcs::Frame& frame, TimeUs t_us);
  lcs::Result carry_out(lcs::LaserCommand command, TimeUs t_us);
  lcs::Result carry_out(const lcs::StartCommand& command, TimeUs t_us);
  void carry_out(const lcs::AimCommand& command);
  void answer(const lcs::Frame& to, lcs::Result result, TimeUs t_us);
  void send_status(TimeUs t_us);
  void send_table(const lcs::Frame& asked, TimeUs t_us);
  void boot(TimeUs t_us);
  void scan_until(TimeUs now_us);
  void send_frames_until(TimeUs now_us);
  TimeUs sample_time_us(std::uint16_t ray) const;
  Vec3 direction_of(std::uint16_t ray) const;
  bool aimed_in_time(std::uint16_t ray) const;
  lcs::RawSample measure(std::uint16_t ray);
  std::uint16_t frame_end() const;
  void send_samples(std::uint16_t end);
  void send(const lcs::FrameBytes& frame, TimeUs t_us);

  RaySimulator rays_;
  LcsCamera camera_;
  Random chance_;
  lcs::FrameDecoder decoder_;
  std::deque<Byte> inbox_, outbox_;
  double inbox_free_us_ = 0, outbox_free_us_ = 0;  // when the line has carried what it was given
  Scan scan_;
  double stuck_x_ = 0;  // tan of the mirror's last angle
  TimeUs armed_us_ = -1;
  bool laser_lit_ = false;
  TimeUs up_us_ = 0;                 // from then on it hears; before, it boots
  TimeUs heard_us_ = 0;              // the last right frame
  std::vector<TimeUs> reset_at_us_;  // that the script asks for, in order
  std::size_t resets_ = 0;           // of these, carried out
  std::uint32_t boots_ = 1;
  std::uint8_t sent_ = 0;
};

// The head, its line and its driver in one sensor, for what runs in simulated time.
class LcsOverLine final : public Sensor {
 public:
  LcsOverLine(LcsDevice& device, const lcs::Optics& optics, double bits_per_s);

  Status start(const ScanPlan& plan, TimeUs t_start_us) override;
  SensorPoll poll(TimeUs now_us, Span<RangeSample> out) override;
  void abort() override;
  SensorCounters counters() const override { return driver_.counters(); }
  void permit_laser(bool permitted) override { driver_.permit_laser(permitted); }
  void use_calibration(const TriangulationCalibration* calibration) override { driver_.use_calibration(calibration); }

  lcs::Driver& driver() { return driver_; }

 private:
  LcsDevice& device_;
  lcs::Line line_;
  lcs::Driver driver_;
  TimeUs now_us_ = 0;  // as of the last call that said it
};

}  // namespace lasso::sim
