// A flight that a port is judged by: the component before a box that stands still, with noise of a millimetre; its image is made in memory,
// no file is read.
#pragma once

#include <cstdint>

#include "fsw/core/time.hpp"
#include "fsw/exec/lasso.hpp"
#include "fsw/sense/pattern.hpp"
#include "ut/support/box_image.hpp"

namespace lasso::port {

class NoisyBox final : public Sensor {
 public:
  Status start(const ScanPlan& plan, TimeUs t_start_us) override;
  SensorPoll poll(TimeUs now_us, Span<RangeSample> out) override;
  void abort() override { next_ = plan_.points; }
  void permit_laser(bool /*permitted*/) override {}  // it has none

 private:
  float noise_m();

  ScanPlan plan_;
  TimeUs t_start_us_ = 0;
  std::uint16_t next_ = plan_.points;
  std::uint32_t random_ = 1;
};

// Times of the longest calls of a flight.
struct Longest {
  DurationUs slot_us = 0, estimate_us = 0;
};

class Flight {
 public:
  Flight();
  bool began() const { return component_ != nullptr; }
  // `frames` in simulated time, as fast as possible. Each call is timed by the board's clock.
  void fly(int frames);
  std::uint32_t digest() const { return digest_; }  // CRC-32C of all telemetry
  int valid_poses() const { return valid_poses_; }
  Longest longest() const { return longest_; }

 private:
  void run_slot();
  void take_telemetry();

  test::TestImage image_;
  NoisyBox box_;
  Component* component_ = nullptr;
  std::uint32_t digest_ = 0;
  int valid_poses_ = 0;
  Longest longest_;
};

}  // namespace lasso::port
