// A sensor of pixels in memory, and what a selector keeps of it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "fsw/sense/pixel_selector.hpp"

namespace lasso {

constexpr TimeUs kStart_us = 7'000'000;
constexpr TimeUs kExposure_us = kStart_us + 500;

// A frame of pixels, handed over as they stand in pieces of a size.
class FrameSensor final : public PixelSensor {
 public:
  std::vector<RangeSample> pixels;
  PixelPitch distance{0.004, 0.004};
  std::size_t piece = kMaxSamplesPerPoll, next = 0;
  std::size_t other_frame_at = 1u << 30, silent_at = 1u << 30;
  bool overclaims = false, pauses = false, ended = true;
  Status refuse = Status::kOk, lose = Status::kOk;
  int aborts = 0, permissions = 0;

  PixelPitch pitch() const override { return distance; }
  Status start(const ScanPlan&, TimeUs) override {
    next = 0;
    return refuse;
  }
  PixelPoll poll(TimeUs, Span<RangeSample> out) override {
    PixelPoll result;
    if (next >= silent_at) result.status = lose;
    if (overclaims) result.count = out.size() + 1;
    if (overclaims || result.status != Status::kOk) return result;
    paused_ = pauses && !paused_;
    if (paused_) return result;
    result.t_us = next >= other_frame_at ? kExposure_us + 1 : kExposure_us;
    while (result.count < std::min(piece, out.size()) && next < pixels.size()) out[result.count++] = pixels[next++];
    result.complete = ended && next == pixels.size();
    return result;
  }
  void abort() override { ++aborts; }
  SensorCounters counters() const override {
    SensorCounters counters;
    counters.samples_refused = 5;
    return counters;
  }
  void permit_laser(bool permitted) override { permissions += permitted ? 1 : 0; }

 private:
  bool paused_ = false;
};

RangeSample pixel_at(double x, double y, RayState state, float range_m = 0) {
  RangeSample pixel;
  const double scale = 1 / std::sqrt(x * x + y * y + 1);
  pixel.direction[0] = static_cast<float>(x * scale);
  pixel.direction[1] = static_cast<float>(y * scale);
  pixel.direction[2] = static_cast<float>(scale);
  pixel.state = state;
  pixel.range_m = range_m;
  return pixel;
}

// side x side pixels over +-half; a disc of hits about the middle, misses around it, and a band of pixels without a measurement.
std::vector<RangeSample> disc(int side, double half) {
  std::vector<RangeSample> pixels;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const double x = half * ((2.0 * column + 1) / side - 1), y = half * ((2.0 * row + 1) / side - 1);
      const bool hit = x * x + y * y < 0.36 * half * half;
      const RayState state = std::abs(x + 0.7 * half) < 0.05 * half ? RayState::kInvalid : hit ? RayState::kHit : RayState::kMiss;
      pixels.push_back(pixel_at(x, y, state, static_cast<float>(3 + 0.1 * x + 0.01 * row)));
    }
  }
  return pixels;
}

ScanPlan window(double center_x, double center_y, double half_x, double half_y, std::uint16_t points = 1024) {
  ScanPlan plan;
  plan.scan_id = 11;
  plan.points = points;
  plan.center_x = center_x;
  plan.center_y = center_y;
  plan.half_x = half_x;
  plan.half_y = half_y;
  return plan;
}

class PixelSelectorTest : public ::testing::Test {
 protected:
  FrameSensor frame;
  std::unique_ptr<PixelSelector> owned = std::make_unique<PixelSelector>(frame);
  PixelSelector& selector = *owned;

  std::vector<RangeSample> select(const ScanPlan& plan, int polls = 2000) {
    std::vector<RangeSample> kept;
    EXPECT_EQ(selector.start(plan, kStart_us), Status::kOk);
    RangeSample out[kMaxSamplesPerPoll];
    for (int i = 0; i < polls; ++i) {
      const SensorPoll poll = selector.poll(kStart_us + 1000, Span<RangeSample>(out));
      EXPECT_EQ(poll.status, Status::kOk);
      kept.insert(kept.end(), out, out + poll.count);
      if (poll.complete) return kept;
    }
    ADD_FAILURE() << "never complete";
    return kept;
  }
  Status lost_with(const ScanPlan& plan) {
    EXPECT_EQ(selector.start(plan, kStart_us), Status::kOk);
    RangeSample out[kMaxSamplesPerPoll];
    for (int i = 0; i < 2000; ++i) {
      const SensorPoll poll = selector.poll(kStart_us + 1000, Span<RangeSample>(out));
      if (poll.status != Status::kOk) return poll.status;
      EXPECT_EQ(poll.count, 0U) << "a frame that ends lost gives nothing";
    }
    return Status::kOk;
  }
};

// Where a pixel's ray meets the tangent plane.
std::pair<double, double> place_of(const RangeSample& pixel) {
  const double z = static_cast<double>(pixel.direction[2]);
  return {static_cast<double>(pixel.direction[0]) / z, static_cast<double>(pixel.direction[1]) / z};
}

bool same(const RangeSample& a, const RangeSample& b) {
  return std::equal(a.direction, a.direction + 3, b.direction) && a.range_m == b.range_m && a.state == b.state &&
         a.sigma_factor == b.sigma_factor && a.t_us == b.t_us;
}
bool same(const std::vector<RangeSample>& a, const std::vector<RangeSample>& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](const auto& p, const auto& q) { return same(p, q); });
}

}  // namespace lasso
