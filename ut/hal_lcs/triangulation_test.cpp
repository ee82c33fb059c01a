#include "hal_lcs/triangulation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::lcs {
namespace {

Calibration bent_camera() {
  Calibration c;
  c.serial = 7;
  c.focal_length_m = 0.081;
  c.baseline_m = 0.1985;
  c.angle_x_offset_rad = 0.0007;
  c.angle_y_offset_rad = -0.0004;
  c.focal_length_per_K = 2e-5;
  c.baseline_per_K = -1e-5;
  c.peak_per_K = 3e-6;
  test::Generator chance(12);
  for (double& term : c.residual) term = chance.uniform(-1e-3, 1e-3);
  return c;
}

// What the camera measures of a point at angles x, y and depth z, by the definition of each quantity: the offsets are taken off the angles,
// and the peak is the one that the residual's equation asks for, by bisection.
RawSample measured(const Calibration& c, double temperature_degC, double x, double y, double depth_m) {
  const double warmer_K = temperature_degC - c.reference_degC;
  const double f_m = c.focal_length_m * (1 + c.focal_length_per_K * warmer_K), d_m = c.baseline_m * (1 + c.baseline_per_K * warmer_K);
  const double spot_m = f_m * d_m / depth_m - f_m * std::tan(x);
  double low = -2, high = 2;
  for (int i = 0; i < 60; ++i) {
    const double q = (low + high) / 2;
    const double phi[] = {1, x, y, q, x * x, x * y, y * y, x * q, y * q, q * q};
    double sum = q + c.peak_per_K * warmer_K;
    for (std::size_t k = 0; k < kResidualTerms; ++k) sum += c.residual[k] * phi[k];
    (c.half_width_m * sum < spot_m ? low : high) = q;
  }
  RawSample raw;
  raw.angle_x_rad = x - c.angle_x_offset_rad;
  raw.angle_y_rad = y - c.angle_y_offset_rad;
  raw.peak = low;
  raw.kind = SampleKind::kReturn;
  return raw;
}

TEST(Triangulation, FindsThePointThatWasMeasured) {
  VERIFIES("LASSO-LCS-007~1");
  const Calibration c = bent_camera();
  test::Generator chance(3);
  for (int round = 0; round < 300; ++round) {
    const double temperature_degC = chance.uniform(-15, 45);
    const double x = chance.uniform(-0.29, 0.29), y = chance.uniform(-0.29, 0.29), depth_m = chance.uniform(0.6, 11);
    const Triangulation triangulation(c, temperature_degC);
    EXPECT_TRUE(triangulation.temperature_known());
    RangeSample sample;
    ASSERT_EQ(triangulation.convert(measured(c, temperature_degC, x, y, depth_m), 123, sample), Fate::kPoint);
    EXPECT_EQ(sample.state, RayState::kHit);
    EXPECT_EQ(sample.t_us, 123);
    const double point[3] = {depth_m * std::tan(x), depth_m * std::tan(y), depth_m};
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(static_cast<double>(sample.direction[k]) * static_cast<double>(sample.range_m), point[k], 2e-6 * depth_m);
  }
}

TEST(Triangulation, WhatIsNoPointSaysWhy) {
  VERIFIES("LASSO-LCS-014~2");
  const Calibration c = bent_camera();
  const Triangulation triangulation(c, 20);
  const RawSample good = measured(c, 20, 0.1, -0.2, 3);
  RangeSample sample;
  const auto fate = [&](auto change) {
    RawSample raw = good;
    change(raw);
    return triangulation.convert(raw, 0, sample);
  };
  EXPECT_EQ(fate([](RawSample& r) { r.angle_x_rad = 0.31; }), Fate::kBadAngle);
  EXPECT_EQ(fate([](RawSample& r) { r.angle_y_rad = -0.31; }), Fate::kBadAngle);
  EXPECT_EQ(sample.state, RayState::kInvalid);
  EXPECT_EQ(fate([](RawSample& r) { r.kind = SampleKind::kSaturated; }), Fate::kNoStatement);
  EXPECT_EQ(fate([](RawSample& r) { r.kind = SampleKind::kNotAimed; }), Fate::kNoStatement);
  EXPECT_EQ(sample.state, RayState::kInvalid);
  EXPECT_EQ(fate([](RawSample& r) { r.peak = -0.9; }), Fate::kBadPeak);
  EXPECT_EQ(fate([](RawSample& r) { r.peak = std::nan(""); }), Fate::kBadPeak);
  EXPECT_EQ(sample.state, RayState::kInvalid);
  EXPECT_EQ(fate([&](RawSample& r) { r = measured(c, 20, 0.1, -0.2, 12.5); }), Fate::kOutside);
  EXPECT_EQ(fate([&](RawSample& r) { r = measured(c, 20, 0.1, -0.2, 0.45); }), Fate::kOutside);
  EXPECT_EQ(sample.state, RayState::kInvalid);
  EXPECT_EQ(fate([](RawSample& r) { r.kind = SampleKind::kNothing; }), Fate::kNothing);
  EXPECT_EQ(sample.state, RayState::kMiss);
  EXPECT_EQ(sample.range_m, 0);
  EXPECT_NEAR(static_cast<double>(sample.direction[0] / sample.direction[2]), std::tan(0.1), 1e-6);
}

TEST(Triangulation, KnowsWhereItWasCalibrated) {
  EXPECT_TRUE(Triangulation(bent_camera(), -20).temperature_known());
  EXPECT_FALSE(Triangulation(bent_camera(), -20.5).temperature_known());
  EXPECT_FALSE(Triangulation(bent_camera(), 50.5).temperature_known());
  RangeSample sample;
  EXPECT_EQ(Triangulation(bent_camera(), 50.5).convert(measured(bent_camera(), 20, 0.1, -0.2, 3), 0, sample), Fate::kOutside);
}

TEST(Triangulation, RefusesCalibrationsThatBendSpace) {
  VERIFIES("LASSO-LCS-015~1");
  EXPECT_EQ(validate(bent_camera()), Status::kOk);
  const auto verdict = [](auto change) {
    Calibration c = bent_camera();
    change(c);
    return validate(c);
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(verdict([](Calibration& c) { c.residual[0] = kNan; }), Status::kNotFinite);
  EXPECT_EQ(verdict([](Calibration& c) { c.residual[9] = kNan; }), Status::kNotFinite);
  EXPECT_EQ(verdict([](Calibration& c) { c.focal_length_m = kNan; }), Status::kNotFinite);
  EXPECT_EQ(verdict([](Calibration& c) { c.temperature_max_degC = std::numeric_limits<double>::infinity(); }), Status::kNotFinite);
  EXPECT_EQ(verdict([](Calibration& c) { c.focal_length_m = 0; }), Status::kSingular);
  EXPECT_EQ(verdict([](Calibration& c) { c.baseline_m = -0.2; }), Status::kSingular);
  EXPECT_EQ(verdict([](Calibration& c) { c.half_width_m = 0; }), Status::kSingular);
  EXPECT_EQ(verdict([](Calibration& c) { c.focal_length_per_K = 0.03; }), Status::kSingular);   // 0 at -13 degrees
  EXPECT_EQ(verdict([](Calibration& c) { c.focal_length_per_K = -0.04; }), Status::kSingular);  // 0 at 45 degrees
  EXPECT_EQ(verdict([](Calibration& c) { c.residual[3] = -1; }), Status::kSingular);            // each peak is the same spot
  EXPECT_EQ(verdict([](Calibration& c) { c.residual[9] = 0.6; }), Status::kSingular);
  EXPECT_EQ(verdict([](Calibration& c) { c.serial = 0; }), Status::kBadValue);
  EXPECT_EQ(verdict([](Calibration& c) { c.angle_max_rad = 0; }), Status::kBadValue);
  EXPECT_EQ(verdict([](Calibration& c) { c.depth_min_m = 0; }), Status::kBadValue);
  EXPECT_EQ(verdict([](Calibration& c) { c.depth_max_m = c.depth_min_m; }), Status::kBadValue);
  EXPECT_EQ(verdict([](Calibration& c) { c.temperature_max_degC = c.temperature_min_degC; }), Status::kBadValue);
  EXPECT_EQ(verdict([](Calibration& c) { c.angle_x_offset_rad = -0.71; }), Status::kBadValue);
  EXPECT_EQ(verdict([](Calibration& c) { c.angle_y_offset_rad = 0.71; }), Status::kBadValue);
}

}  // namespace
}  // namespace lasso::lcs
