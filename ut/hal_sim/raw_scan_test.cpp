#include "hal_sim/raw_scan.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hal_sim/scan_file.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

Vec3 place_of(const RangeSample& sample) {
  return static_cast<double>(sample.range_m) * Eigen::Map<const Eigen::Vector3f>(sample.direction).cast<double>();
}

TEST(RawScan, IsTurnedAndMovedToTheSensor) {
  VERIFIES("LASSO-SIM-037~1");
  RawScan scan;
  scan.misses_known = true;
  scan.add_point(Vec3(5, 1, -0.5), 1000, 1);
  scan.add_miss(Vec3(0.8, 0, 0.6), 2000, 2);
  ScanFrame frame;
  frame.R_sensor_file = axes_of("forward-right-down");
  frame.sensor_m = Vec3(1, 0, 0.5);  // one metre in front of the file's origin, and below it
  frame.unit_s = 1e-3;
  const RangeImage image = to_image(scan, frame);
  ASSERT_EQ(image.samples.size(), 2u);
  EXPECT_LT((place_of(image.samples[0]) - Vec3(1, -1, 4)).norm(), 1e-6);
  EXPECT_EQ(image.samples[0].t_us, 1000000);
  EXPECT_EQ(image.samples[1].state, RayState::kMiss);
  EXPECT_FLOAT_EQ(image.samples[1].direction[1], 0.6F) << "down";
  EXPECT_FLOAT_EQ(image.samples[1].direction[2], 0.8F) << "forward";
  EXPECT_TRUE(image.misses_known);
}

// 20,000 returns of a disc of 1 m, and 40,000 misses around it and far aside.
TEST(RawScan, IsScaledToMetres) {
  VERIFIES("LASSO-SIM-037~1");
  RawScan scan;
  scan.add_point(Vec3(300, -400, 1200), 0, 1);
  ScanFrame frame;
  frame.scale = 1e-3;
  EXPECT_LT((place_of(to_image(scan, frame).samples[0]) - Vec3(0.3, -0.4, 1.2)).norm(), 1e-6);
}

TEST(RawScan, OfTooManyRaysReturnsAndTheMissesAroundThemAreTaken) {
  VERIFIES("LASSO-SIM-040~1");
  RawScan scan;
  scan.misses_known = true;
  for (int i = 0; i < 20000; ++i) {
    const double r = std::sqrt(i / 20000.0), a = 2.4 * i;
    scan.add_point(Vec3(r * std::cos(a), r * std::sin(a), 5), i, static_cast<std::size_t>(i));
  }
  for (int i = 0; i < 40000; ++i) {
    const double r = 1 + 2 * std::sqrt(i / 40000.0), a = 2.4 * i;
    scan.add_miss(Vec3(r * std::cos(a), r * std::sin(a), 5).normalized(), 20000 + i, static_cast<std::size_t>(20000 + i));
  }
  const RangeImage image = to_image(scan, {});
  EXPECT_EQ(image.samples.size(), kMaxRays);
  std::size_t hits = 0;
  TimeUs last_us = 0;
  for (const RangeSample& sample : image.samples) {
    hits += sample.state == RayState::kHit ? 1 : 0;
    EXPECT_GE(sample.t_us, last_us) << "in the file's order";
    last_us = sample.t_us;
    const float aside = std::hypot(sample.direction[0], sample.direction[1]) / sample.direction[2];
    EXPECT_LT(aside, 0.32F) << "1.5 times the disc's";
  }
  EXPECT_EQ(hits, kMaxRays - kMaxRays / 4);
}

TEST(RawScan, WhatFitsIsTakenWhole) {
  VERIFIES("LASSO-SIM-040~1");
  RawScan scan;
  for (std::size_t i = 0; i < kMaxRays; ++i) i % 2 == 0 ? scan.add_point(Vec3(0, 0, 1), 0, i) : scan.add_miss(Vec3(0, 0, -1), 0, i);
  EXPECT_EQ(to_image(scan, {}).samples.size(), kMaxRays);
}

// A disc of 20,000 points at 5 m, and one more point.
RawScan disc_and_one(const Vec3& outlier) {
  RawScan scan;
  scan.file = "a.pcd";
  for (int i = 0; i < 20000; ++i) {
    const double r = std::sqrt(i / 20000.0), a = 2.4 * i;
    scan.add_point(Vec3(r * std::cos(a), r * std::sin(a), 5), 0, static_cast<std::size_t>(i) + 1);
  }
  scan.add_point(outlier, 0, 20001);
  return scan;
}

TEST(RawScan, AReturnFarOffTakesNoPlaceOfOthers) {
  VERIFIES("LASSO-SIM-040~1");
  const RangeImage image = to_image(disc_and_one(Vec3(0, 1e5, 9e5)), {});
  EXPECT_EQ(image.samples.size(), kMaxRays);
  std::size_t beyond_half = 0;  // of the disc's area
  for (const RangeSample& sample : image.samples) beyond_half += std::hypot(sample.direction[0], sample.direction[1]) > 0.14F ? 1U : 0U;
  EXPECT_GT(beyond_half, kMaxRays / 3);
  EXPECT_LT(beyond_half, 2 * kMaxRays / 3);
}

TEST(RawScan, EachRangeIsCheckedBeforeSomeRaysAreTaken) {
  VERIFIES("LASSO-SIM-021~1");
  for (const double far : {2e6, 1e308}) {
    try {
      static_cast<void>(to_image(disc_and_one(Vec3(-far, far, far)), {}));
      ADD_FAILURE() << far;
    } catch (const ScanFileError& error) {
      EXPECT_EQ(std::string(error.what()).find("a.pcd: point 20001: the point is "), 0u) << error.what();
    }
  }
}

TEST(RawScan, APointWhereTheSensorStandsIsRefused) {
  VERIFIES("LASSO-SIM-021~1");
  RawScan scan;
  scan.file = "a.pcd";
  scan.add_point(Vec3(1, 2, 3), 0, 7);
  ScanFrame frame;
  frame.sensor_m = Vec3(1, 2, 3);
  try {
    static_cast<void>(to_image(scan, frame));
    ADD_FAILURE();
  } catch (const ScanFileError& error) {
    EXPECT_EQ(std::string(error.what()).find("a.pcd: point 7: the point lies in the sensor's origin"), 0u) << error.what();
  }
}

}  // namespace
}  // namespace lasso::sim
