// A sensor whose samples a test may damage, and an acquisition that scans with it.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "fsw/sense/acquisition.hpp"
#include "fsw/sense/pattern.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::test {

constexpr TimeUs kStart = 5'000'000'000;

// Scans a wall at 3 m whose right half is missing. A test may damage the samples before they are handed over.
class WallSensor final : public Sensor {
 public:
  std::vector<RangeSample> samples;
  std::size_t next = 0;
  Status refuse = Status::kOk;
  Status lose = Status::kOk;
  std::size_t lost_at = 1u << 20;
  bool overclaim = false, ignores_time = false;
  int aborts = 0, polls = 0;

  Status start(const ScanPlan& plan, TimeUs t_start_us) override {
    if (refuse != Status::kOk) return refuse;
    if (samples.empty()) make(plan, t_start_us);
    next = 0;
    return Status::kOk;
  }

  SensorPoll poll(TimeUs now_us, Span<RangeSample> out) override {
    ++polls;
    SensorPoll result;
    if (overclaim) result.count = out.size() + 1;
    if (next >= lost_at) result.status = lose;
    if (overclaim || result.status != Status::kOk) return result;
    while (next < samples.size() && (ignores_time || samples[next].t_us <= now_us) && result.count < out.size()) {
      out[result.count++] = samples[next++];
    }
    result.complete = next == samples.size();
    return result;
  }

  void abort() override { ++aborts; }
  void permit_laser(bool) override {}

  void make(const ScanPlan& plan, TimeUs t_start_us) {
    for (std::uint16_t i = 0; i < plan.points; ++i) {
      const Vec3 ray = pattern_direction(plan, i);
      RangeSample sample;
      for (int k = 0; k < 3; ++k) sample.direction[k] = static_cast<float>(ray[k]);
      sample.state = ray.x() < 0 ? RayState::kHit : RayState::kMiss;
      sample.range_m = ray.x() < 0 ? static_cast<float>(3 / ray.z()) : 0.0F;
      sample.t_us = t_start_us + pattern_time_us(plan, i);
      samples.push_back(sample);
    }
  }
};

class AcquisitionTest : public ::testing::Test {
 protected:
  WallSensor sensor;
  ScanPlan plan;
  std::unique_ptr<RangeImage> image = std::make_unique<RangeImage>();
  Acquisition acquisition;

  void SetUp() override {
    plan.scan_id = 42;
    sensor.make(plan, kStart);
  }
  // All samples become available; as many steps as needed, at most `steps`.
  ScanVerdict run(int steps = 100, TimeUs now = kStart + 200000) {
    EXPECT_EQ(acquisition.start(sensor, plan, kStart, *image), Status::kOk);
    for (int i = 0; i < steps && acquisition.under_way(); ++i) acquisition.step(sensor, now, *image);
    return acquisition.finish(sensor, *image);
  }
};

}  // namespace lasso::test
