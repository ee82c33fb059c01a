#include "hal_lcs/time_of_flight.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::lcs {
namespace {

EchoCalibration slow_lidar() {
  EchoCalibration c;
  c.serial = 7;
  c.angle_x_offset_rad = 0.0007;
  c.angle_y_offset_rad = -0.0004;
  c.delay_us = 0.0123;
  c.delay_us_per_K = 2e-5;
  c.clock_error = 3e-5;
  return c;
}

// What the head measures of a point at angles x, y and that range, by the definition of each quantity.
RawSample measured(const EchoCalibration& c, double temperature_degC, double x, double y, double range_m) {
  RawSample raw;
  raw.angle_x_rad = x - c.angle_x_offset_rad;
  raw.angle_y_rad = y - c.angle_y_offset_rad;
  const double true_flight_us = 2 * range_m / 299.792458;
  raw.flight_us = true_flight_us / (1 + c.clock_error) + c.delay_us + c.delay_us_per_K * (temperature_degC - c.reference_degC);
  raw.kind = SampleKind::kEcho;
  return raw;
}

TEST(TimeOfFlight, FindsThePointThatWasMeasured) {
  VERIFIES("LASSO-LCS-016~2");
  const EchoCalibration c = slow_lidar();
  test::Generator chance(3);
  for (int round = 0; round < 300; ++round) {
    const double temperature_degC = chance.uniform(-15, 45);
    const double x = chance.uniform(-0.29, 0.29), y = chance.uniform(-0.29, 0.29), range_m = chance.uniform(0.6, 990);
    RangeSample sample;
    ASSERT_EQ(TimeOfFlight(c, temperature_degC).convert(measured(c, temperature_degC, x, y, range_m), 123, sample), Fate::kPoint);
    EXPECT_EQ(sample.state, RayState::kHit);
    EXPECT_EQ(sample.t_us, 123);
    EXPECT_NEAR(static_cast<double>(sample.range_m), range_m, 1e-7 * range_m);
    EXPECT_NEAR(static_cast<double>(sample.direction[0] / sample.direction[2]), std::tan(x), 1e-6);
    EXPECT_NEAR(static_cast<double>(sample.direction[1] / sample.direction[2]), std::tan(y), 1e-6);
  }
}

TEST(TimeOfFlight, WhatIsNoPointSaysWhy) {
  VERIFIES("LASSO-LCS-014~2");
  const EchoCalibration c = slow_lidar();
  const RawSample good = measured(c, 20, 0.1, -0.2, 300);
  RangeSample sample;
  const auto fate = [&](auto change) {
    RawSample raw = good;
    change(raw);
    return TimeOfFlight(c, 20).convert(raw, 0, sample);
  };
  EXPECT_EQ(fate([](RawSample& r) { r.angle_x_rad = 0.31; }), Fate::kBadAngle);
  EXPECT_EQ(fate([](RawSample& r) { r.angle_y_rad = -0.31; }), Fate::kBadAngle);
  EXPECT_EQ(fate([](RawSample& r) { r.kind = SampleKind::kSaturated; }), Fate::kNoStatement);
  EXPECT_EQ(fate([](RawSample& r) { r.kind = SampleKind::kReturn; }), Fate::kNoStatement);  // a LIDAR does not triangulate
  EXPECT_EQ(fate([](RawSample& r) { r.flight_us = 0; }), Fate::kBadPeak);                   // before the electronics can have told it
  EXPECT_EQ(fate([](RawSample& r) { r.flight_us = 0.01; }), Fate::kBadPeak);
  EXPECT_EQ(fate([](RawSample& r) { r.flight_us = std::nan(""); }), Fate::kBadPeak);
  EXPECT_EQ(fate([](RawSample& r) { r.flight_us = kMaxFlightUs; }), Fate::kNoStatement);  // that, or any time beyond it
  EXPECT_EQ(fate([](RawSample& r) { r.flight_us = kMaxFlightUs - kFlightStepUs; }), Fate::kOutside);
  EXPECT_EQ(fate([&](RawSample& r) { r = measured(c, 20, 0.1, -0.2, 0.4); }), Fate::kOutside);
  EXPECT_EQ(fate([&](RawSample& r) { r = measured(c, 20, 0.1, -0.2, 1001); }), Fate::kOutside);
  EXPECT_EQ(sample.state, RayState::kInvalid);
  EXPECT_EQ(fate([](RawSample& r) { r.kind = SampleKind::kNothing; }), Fate::kNothing);
  EXPECT_EQ(sample.state, RayState::kMiss);
  EXPECT_EQ(sample.range_m, 0);
  EXPECT_EQ(TimeOfFlight(c, -20.5).convert(good, 0, sample), Fate::kOutside);
  EXPECT_EQ(TimeOfFlight(c, 50.5).convert(good, 0, sample), Fate::kOutside);
  EXPECT_EQ(sample.state, RayState::kInvalid);
  EchoCalibration early = c;  // the clock begins after the pulse: 0 is all that is before it
  early.delay_us = -0.1;
  RawSample at_once = good;
  at_once.flight_us = 0;
  EXPECT_EQ(TimeOfFlight(early, 20).convert(at_once, 0, sample), Fate::kBadPeak);
}

TEST(TimeOfFlight, RefusesCalibrationsThatBendSpace) {
  VERIFIES("LASSO-LCS-015~2");
  EXPECT_EQ(validate(slow_lidar()), Status::kOk);
  const auto verdict = [](auto change) {
    EchoCalibration c = slow_lidar();
    change(c);
    return validate(c);
  };
  EXPECT_EQ(verdict([](EchoCalibration& c) { c.angle_x_offset_rad = std::nan(""); }), Status::kNotFinite);
  EXPECT_EQ(verdict([](EchoCalibration& c) { c.temperature_max_degC = std::numeric_limits<double>::infinity(); }), Status::kNotFinite);
  EXPECT_EQ(verdict([](EchoCalibration& c) { c.clock_error = -1; }), Status::kSingular);
  EXPECT_EQ(verdict([](EchoCalibration& c) { c.serial = 0; }), Status::kBadValue);
  EXPECT_EQ(verdict([](EchoCalibration& c) { c.angle_max_rad = 0; }), Status::kBadValue);
  EXPECT_EQ(verdict([](EchoCalibration& c) { c.range_min_m = 0; }), Status::kBadValue);
  EXPECT_EQ(verdict([](EchoCalibration& c) { c.range_max_m = c.range_min_m; }), Status::kBadValue);
  EXPECT_EQ(verdict([](EchoCalibration& c) { c.range_max_m = 1200; }), Status::kBadValue);  // the wire ends at 1199 m
  EXPECT_EQ(verdict([](EchoCalibration& c) { c.temperature_max_degC = c.temperature_min_degC; }), Status::kBadValue);
  EXPECT_EQ(verdict([](EchoCalibration& c) { c.angle_x_offset_rad = -0.71; }), Status::kBadValue);
  EXPECT_EQ(verdict([](EchoCalibration& c) { c.angle_y_offset_rad = 0.71; }), Status::kBadValue);
}

// The flight that a calibration's farthest range takes, with the delay and by the head's clock, is one that the wire can say.
TEST(TimeOfFlight, RefusesRangesWhoseFlightIsBeyondTheWiresEnd) {
  VERIFIES("LASSO-LCS-015~2");
  EchoCalibration c;
  c.serial = 7;
  c.range_max_m = 1190;  // 7.94 us
  const auto with = [&](double delay_us, double delay_us_per_K, double clock_error) {
    EchoCalibration changed = c;
    changed.delay_us = delay_us;
    changed.delay_us_per_K = delay_us_per_K;
    changed.clock_error = clock_error;
    return validate(changed);
  };
  EXPECT_EQ(with(0, 0, 0), Status::kOk);
  EXPECT_EQ(with(0.05, 0, 0), Status::kOk);
  EXPECT_EQ(with(0.07, 0, 0), Status::kBadValue);
  EXPECT_EQ(with(0, 0.003, 0), Status::kBadValue);   // warm
  EXPECT_EQ(with(0, -0.003, 0), Status::kBadValue);  // cold
  EXPECT_EQ(with(0, 0, -0.01), Status::kBadValue);   // a clock that runs fast says more
  EXPECT_EQ(with(0.07, 0, 0.01), Status::kOk);
}

}  // namespace
}  // namespace lasso::lcs
