#include "hal_lcs/triangulation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "ut/support/box_calibrations.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::lcs {
namespace {

Calibration bent_camera() { return test::bent_calibration(7); }

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
  VERIFIES("LASSO-LCS-007~2");
  const Calibration c = bent_camera();
  test::Generator chance(3);
  for (int round = 0; round < 300; ++round) {
    const double temperature_degC = chance.uniform(-15, 45);
    const double x = chance.uniform(-0.29, 0.29), y = chance.uniform(-0.29, 0.29), depth_m = chance.uniform(0.6, 11);
    const Triangulation triangulation(c, temperature_degC);
    RangeSample sample;
    ASSERT_EQ(triangulation.convert(measured(c, temperature_degC, x, y, depth_m), 123, sample), Fate::kPoint);
    EXPECT_EQ(sample.state, RayState::kHit);
    EXPECT_EQ(sample.sigma_factor, 1);
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
  EXPECT_EQ(fate([&](RawSample& r) { r = measured(c, 20, 0.1, -0.2, 15.1); }), Fate::kOutside);
  EXPECT_EQ(fate([&](RawSample& r) { r = measured(c, 20, 0.1, -0.2, 0.39); }), Fate::kOutside);
  EXPECT_EQ(sample.state, RayState::kInvalid);
  EXPECT_EQ(fate([](RawSample& r) { r.kind = SampleKind::kNothing; }), Fate::kNothing);
  EXPECT_EQ(sample.state, RayState::kMiss);
  EXPECT_EQ(sample.range_m, 0);
  EXPECT_NEAR(static_cast<double>(sample.direction[0] / sample.direction[2]), std::tan(0.1), 1e-6);
}

// Depths 0.5 to 12 m and -20 to 50 degrees: a quarter more on either side is flagged, and the point is where the model says.
TEST(Triangulation, PointsBesideTheCalibratedVolumeAreFlaggedAndWeighted) {
  VERIFIES("LASSO-LCS-008~2");
  Calibration c = bent_camera();
  c.outside_sigma_factor = 7;
  RangeSample sample;
  const auto fate = [&](double temperature_degC, double depth_m) {
    return Triangulation(c, temperature_degC).convert(measured(c, temperature_degC, 0.1, -0.2, depth_m), 0, sample);
  };
  for (const auto& [temperature_degC, depth_m] :
       {std::pair(20.0, 12.1), std::pair(20.0, 14.9), std::pair(20.0, 0.49), std::pair(20.0, 0.41), std::pair(-20.5, 3.0),
        std::pair(-37.0, 3.0), std::pair(50.5, 3.0), std::pair(67.0, 3.0)}) {
    EXPECT_EQ(fate(temperature_degC, depth_m), Fate::kBeside) << temperature_degC << ' ' << depth_m;
    EXPECT_EQ(sample.state, RayState::kHit);
    EXPECT_EQ(sample.sigma_factor, 7);
    EXPECT_NEAR(static_cast<double>(sample.direction[2] * sample.range_m), depth_m, 2e-6 * depth_m);
  }
  for (const auto& [temperature_degC, depth_m] :
       {std::pair(20.0, 15.1), std::pair(20.0, 0.39), std::pair(-38.0, 3.0), std::pair(68.0, 3.0)}) {
    EXPECT_EQ(fate(temperature_degC, depth_m), Fate::kOutside) << temperature_degC << ' ' << depth_m;
    EXPECT_EQ(sample.state, RayState::kInvalid);
    EXPECT_EQ(sample.sigma_factor, 1);
  }
  for (const auto& [temperature_degC, depth_m] : {std::pair(-20.0, 0.51), std::pair(50.0, 11.9)}) {
    EXPECT_EQ(fate(temperature_degC, depth_m), Fate::kPoint) << temperature_degC << ' ' << depth_m;
    EXPECT_EQ(sample.sigma_factor, 1);
  }
}

}  // namespace
}  // namespace lasso::lcs
