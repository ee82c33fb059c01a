#include "hal_lcs/optics.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso::lcs {
namespace {

Calibration near() {
  Calibration c;
  c.serial = 9;
  c.angle_x_offset_rad = 0.001;
  c.angle_y_offset_rad = -0.002;
  c.focal_length_per_K = 1e-3;
  return c;
}

EchoCalibration far() {
  EchoCalibration c;
  c.serial = 9;
  c.angle_x_offset_rad = 0.001;
  c.angle_y_offset_rad = -0.002;
  c.delay_us_per_K = 1e-3;
  return c;
}

RawSample spot() {
  RawSample raw;
  raw.peak = 0.05;
  raw.kind = SampleKind::kReturn;
  return raw;
}

RawSample echo() {
  RawSample raw;
  raw.flight_us = 0.5;
  raw.kind = SampleKind::kEcho;
  return raw;
}

TEST(Optics, EachHeadMeasuresInItsWay) {
  VERIFIES("LASSO-LCS-016~2");
  RangeSample sample, straight;
  Optics camera{near()}, lidar{far()}, tridar{near(), far()};
  EXPECT_EQ(camera.device(), Device::kLaserCamera);
  EXPECT_EQ(lidar.device(), Device::kLidar);
  EXPECT_EQ(tridar.device(), Device::kTridar);
  EXPECT_EQ(camera.convert(echo(), 0, sample), Fate::kNoStatement);
  EXPECT_EQ(lidar.convert(spot(), 0, sample), Fate::kNoStatement);
  for (Optics* const head : {&camera, &lidar, &tridar}) head->set_temperature(30);
  ASSERT_EQ(Triangulation(near(), 30).convert(spot(), 0, straight), Fate::kPoint);
  for (const Optics* const head : {&camera, &tridar}) {
    EXPECT_EQ(head->convert(spot(), 0, sample), Fate::kPoint);
    EXPECT_EQ(sample.range_m, straight.range_m);
  }
  ASSERT_EQ(TimeOfFlight(far(), 30).convert(echo(), 0, straight), Fate::kPoint);
  for (const Optics* const head : {&lidar, &tridar}) {
    EXPECT_EQ(head->convert(echo(), 0, sample), Fate::kPoint);
    EXPECT_EQ(sample.range_m, straight.range_m);
  }
}

TEST(Optics, KnowTheirHeadAndItsMirrors) {
  Calibration of_a_camera = near();
  EchoCalibration of_a_lidar = far();
  of_a_camera.serial = 4;
  of_a_lidar.serial = 5;
  of_a_lidar.angle_x_offset_rad = 0.003;
  EXPECT_EQ(Optics(of_a_camera).serial(), 4U);
  EXPECT_EQ(Optics(of_a_lidar).serial(), 5U);
  EXPECT_EQ(Optics(of_a_camera).mirrors().x_offset_rad, 0.001);
  EXPECT_EQ(Optics(of_a_lidar).mirrors().x_offset_rad, 0.003);
  EXPECT_EQ(Optics(of_a_lidar).mirrors().y_offset_rad, -0.002);
  EXPECT_EQ(Optics(of_a_camera).mirrors().max_rad, 0.3);
}

// Its triangulation is another, behind the same mirrors; a LIDAR has none, and is then no head that the driver knows.
TEST(Optics, AreCalibratedAnew) {
  VERIFIES("LASSO-LCS-007~2 LASSO-LCS-015~2");
  Calibration other = near();
  other.serial = 11;
  other.angle_x_offset_rad = 0.004;
  other.baseline_m = 0.3;
  const Optics tridar = Optics(near(), far()).calibrated(other);
  EXPECT_EQ(tridar.validate(), Status::kOk);
  EXPECT_EQ(tridar.device(), Device::kTridar);
  EXPECT_EQ(tridar.serial(), 11U);
  RangeSample sample, straight;
  ASSERT_EQ(Triangulation(other, 20).convert(spot(), 0, straight), Fate::kPoint);
  EXPECT_EQ(tridar.convert(spot(), 0, sample), Fate::kPoint);
  EXPECT_EQ(sample.range_m, straight.range_m);
  EXPECT_EQ(tridar.convert(echo(), 0, sample), Fate::kPoint);
  EXPECT_EQ(Optics(near()).calibrated(other).device(), Device::kLaserCamera);
  EXPECT_EQ(Optics(far()).calibrated(other).device(), Device::kLaserCamera) << "the LIDAR on the line is not one";
}

TEST(Optics, AreRefusedForTheReasonOfTheirCalibration) {
  VERIFIES("LASSO-LCS-015~2");
  EXPECT_EQ(Optics(near()).validate(), Status::kOk);
  EXPECT_EQ(Optics(far()).validate(), Status::kOk);
  EXPECT_EQ(Optics(near(), far()).validate(), Status::kOk);
  Calibration flat = near();
  flat.baseline_m = 0;
  EXPECT_EQ(Optics(flat).validate(), Status::kSingular);
  EXPECT_EQ(Optics(flat, far()).validate(), Status::kSingular);
  EchoCalibration still = far();
  still.clock_error = -2;
  EXPECT_EQ(Optics(still).validate(), Status::kSingular);
  EXPECT_EQ(Optics(near(), still).validate(), Status::kSingular);
}

TEST(Optics, OfATridarAreOfOneHead) {
  VERIFIES("LASSO-LCS-015~2 LASSO-LCS-016~2");
  const auto verdict = [](auto change) {
    EchoCalibration other = far();
    change(other);
    return Optics(near(), other).validate();
  };
  EXPECT_EQ(verdict([](EchoCalibration& c) { c.serial = 10; }), Status::kBadValue);
  EXPECT_EQ(verdict([](EchoCalibration& c) { c.angle_x_offset_rad = 0; }), Status::kBadValue);
  EXPECT_EQ(verdict([](EchoCalibration& c) { c.angle_y_offset_rad = 0; }), Status::kBadValue);
  EXPECT_EQ(verdict([](EchoCalibration& c) { c.angle_max_rad = 0.2; }), Status::kBadValue);
}

}  // namespace
}  // namespace lasso::lcs
