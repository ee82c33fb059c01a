// What the driver's tests share: a driver on its line, and the camera's end of the line by hand.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fsw/sense/pattern.hpp"
#include "hal_lcs/driver.hpp"

namespace lasso::lcs {

constexpr std::uint32_t kSerial = 4242;
constexpr TimeUs kStartUs = 5'000'000;
constexpr double kDepthM = 3;

inline Calibration calibration() {
  Calibration c;
  c.serial = kSerial;
  return c;
}

inline ScanPlan small_plan(std::uint32_t scan_id = 0x301, std::uint16_t points = 40) {
  ScanPlan plan;
  plan.scan_id = scan_id;
  plan.points = points;
  plan.cycles_a = 5;
  plan.cycles_b = 3;
  plan.phase_turns = 0.3;
  plan.duration_us = 39'000;
  return plan;
}

// The camera's end of the line, by hand: what it does is what a test says.
class Camera {
 public:
  explicit Camera(Line& line) : line_(line) { heard(); }

  // Frames that have come since the last call.
  std::vector<Frame> heard() {
    std::vector<Frame> frames;
    std::uint8_t byte = 0;
    Frame frame;
    while (line_.to_camera.read(Bytes(&byte, 1)) == 1) {
      if (!decoder_.step(ConstBytes(&byte, 1), frame).found) continue;
      frames.push_back(frame);
      StartCommand start;
      if (frame.type == static_cast<std::uint8_t>(Type::kStart) && decode(frame, start) == Status::kOk) delay_us = start.delay_us;
    }
    return frames;
  }

  template <class Message>
  void say(const Message& message) {
    const FrameBytes bytes = encode(sequence++, message);
    line_.from_camera.write(bytes.span());
  }
  void status(std::uint32_t boots = 1, std::uint32_t serial = kSerial, bool lit = true) {
    CameraStatus status;
    status.serial = serial;
    status.boots = boots;
    status.temperature_degC = 22;
    status.laser_lit = lit;
    say(status);
  }
  // Answers the start among the frames.
  void answer(const std::vector<Frame>& frames, Result result = Result::kDone) {
    for (const Frame& frame : frames) {
      if (frame.type == static_cast<std::uint8_t>(Type::kStart)) say(Answer{Type::kStart, frame.sequence, result, clock_at_start_us});
    }
  }
  // A wall across the boresight, from the plan's ray `first` on.
  Samples wall(const ScanPlan& plan, std::uint16_t first, std::size_t count = kSamplesPerFrame) const {
    const Calibration c = calibration();
    Samples samples;
    samples.tag = tag_of(plan.scan_id);
    samples.first = first;
    samples.count = count;
    for (std::size_t i = 0; i < count; ++i) {
      const auto ray = static_cast<std::uint16_t>(first + i);
      const Vec3 u = pattern_direction(plan, ray);
      RawSample& raw = samples.samples[i];
      raw.kind = SampleKind::kReturn;
      raw.angle_x_rad = std::atan(u.x() / u.z());
      raw.angle_y_rad = std::atan(u.y() / u.z());
      raw.peak = (c.focal_length_m * c.baseline_m / kDepthM - c.focal_length_m * u.x() / u.z()) / c.half_width_m;
      raw.clock_us = clock_at_start_us + delay_us + static_cast<std::uint32_t>(pattern_time_us(plan, ray));
    }
    return samples;
  }

  std::uint8_t sequence = 0;
  std::uint32_t clock_at_start_us = 0xFFFFF000;  // wraps within the scan
  std::uint32_t delay_us = 0;                    // of the last start that was heard

 private:
  Line& line_;
  FrameDecoder decoder_;
};

class LcsDriver : public ::testing::Test {
 protected:
  LcsDriver() { driver.permit_laser(true); }

  // A scan that the camera has taken on.
  void begin(const ScanPlan& plan) {
    ASSERT_EQ(driver.start(plan, kStartUs), Status::kOk);
    camera.status();
    camera.answer(camera.heard());
  }
  SensorPoll poll(TimeUs now_us = kStartUs + 45'000) {
    const SensorPoll result = driver.poll(now_us, Span<RangeSample>(out));
    for (std::size_t i = 0; i < result.count; ++i) samples.push_back(out[i]);
    return result;
  }
  std::uint32_t lost(Loss loss) const { return driver.health().scans_lost[static_cast<std::size_t>(loss)]; }
  std::uint32_t fate(Fate fate) const { return driver.health().fates[static_cast<std::size_t>(fate)]; }

  Line line;
  Driver driver{line, Optics(calibration())};
  Camera camera{line};
  RangeSample out[kMaxSamplesPerPoll];
  std::vector<RangeSample> samples;
};

}  // namespace lasso::lcs
