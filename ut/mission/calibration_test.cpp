// Calibrations of laser cameras: what makes one, and how a flight image carries them.
#include "fsw/mission/calibration.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "fsw/mission/image_slot.hpp"
#include "ut/support/box_calibrations.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using C = TriangulationCalibration;

C bent_camera() { return test::bent_calibration(7); }

TEST(Calibration, RefusesCalibrationsThatBendSpace) {
  VERIFIES("LASSO-LCS-015~2");
  EXPECT_EQ(validate(bent_camera()), Status::kOk);
  const auto verdict = [](auto change) {
    C c = bent_camera();
    change(c);
    return validate(c);
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(verdict([](C& c) { c.residual[0] = kNan; }), Status::kNotFinite);
  EXPECT_EQ(verdict([](C& c) { c.residual[9] = kNan; }), Status::kNotFinite);
  EXPECT_EQ(verdict([](C& c) { c.focal_length_m = kNan; }), Status::kNotFinite);
  EXPECT_EQ(verdict([](C& c) { c.temperature_max_degC = std::numeric_limits<double>::infinity(); }), Status::kNotFinite);
  EXPECT_EQ(verdict([](C& c) { c.focal_length_m = 11; }), Status::kBadValue);
  EXPECT_EQ(verdict([](C& c) { c.depth_max_m = 1e300; }), Status::kBadValue);
  EXPECT_EQ(verdict([](C& c) { c.residual[5] = -10.5; }), Status::kBadValue);
  EXPECT_EQ(verdict([](C& c) { c.focal_length_m = 0; }), Status::kSingular);
  EXPECT_EQ(verdict([](C& c) { c.baseline_m = 0; }), Status::kSingular);
  EXPECT_EQ(verdict([](C& c) { c.baseline_m = -0.2; }), Status::kBadValue);
  EXPECT_EQ(verdict([](C& c) { c.half_width_m = 0; }), Status::kSingular);
  for (double C::*const growth : {&C::focal_length_per_K, &C::baseline_per_K}) {  // above 0 within -20 to 50 degrees, not a quarter beyond
    EXPECT_EQ(verdict([&](C& c) { c.*growth = 0.01, c.reference_degC = 70; }), Status::kSingular);
    EXPECT_EQ(verdict([&](C& c) { c.*growth = -0.01, c.reference_degC = -42; }), Status::kSingular);
    EXPECT_EQ(verdict([&](C& c) { c.*growth = 0.011; }), Status::kBadValue);
  }
  EXPECT_EQ(verdict([](C& c) { c.residual[3] = -1; }), Status::kSingular);  // each peak is the same spot
  EXPECT_EQ(verdict([](C& c) { c.residual[9] = 0.6; }), Status::kSingular);
  EXPECT_EQ(verdict([](C& c) { c.serial = 0; }), Status::kBadValue);
  EXPECT_EQ(verdict([](C& c) { c.angle_max_rad = 0; }), Status::kBadValue);
  EXPECT_EQ(verdict([](C& c) { c.depth_min_m = 0; }), Status::kBadValue);
  EXPECT_EQ(verdict([](C& c) { c.depth_max_m = c.depth_min_m; }), Status::kBadValue);
  EXPECT_EQ(verdict([](C& c) { c.temperature_max_degC = c.temperature_min_degC; }), Status::kBadValue);
  EXPECT_EQ(verdict([](C& c) { c.angle_max_rad = 0.7, c.angle_x_offset_rad = -0.31; }), Status::kBadValue) << "beyond the wire's";
  EXPECT_EQ(verdict([](C& c) { c.angle_max_rad = 0.7, c.angle_y_offset_rad = 0.31; }), Status::kBadValue);
  EXPECT_EQ(verdict([](C& c) { c.angle_max_rad = 0.7; }), Status::kOk);
  EXPECT_EQ(verdict([](C& c) { c.angle_y_offset_rad = 0.51; }), Status::kBadValue);
  EXPECT_EQ(verdict([](C& c) { c.outside_sigma_factor = kNan; }), Status::kNotFinite);
  EXPECT_EQ(verdict([](C& c) { c.outside_sigma_factor = 0.9; }), Status::kBadValue);
  EXPECT_EQ(verdict([](C& c) { c.outside_sigma_factor = 10.1; }), Status::kBadValue);
}

constexpr auto kCalibrationsTable = static_cast<std::uint32_t>(TableId::kCalibrations);

class ImageCalibrationsTest : public ::testing::Test {
 protected:
  // With one further sensor.
  static test::BoxTables with(const std::vector<std::pair<std::uint32_t, C>>& calibrations) {
    test::BoxTables tables = test::make_box_tables(test::BoxModel{{0.02, -0.01, 0.03}, {0.30, 0.20, 0.12}, 0.06, 0.06});
    test::append_sensor(preset_parameters(), tables[test::kSensorsTable]);
    for (const auto& [sensor, calibration] : calibrations) test::append_calibration(sensor, calibration, tables[test::kCalibrationsTable]);
    return tables;
  }
  LoadFailure load(const test::BoxTables& tables) {
    image_ = test::make_image(preset_parameters(), tables);
    slot_ = std::make_unique<ImageSlot>();
    slot_->use(Bytes(image_.data(), image_.size));
    slot_->open(static_cast<std::uint32_t>(image_.size));
    slot_->run(kMaxSensors);
    return slot_->result();
  }

  test::TestImage image_;
  std::unique_ptr<ImageSlot> slot_;
};

TEST_F(ImageCalibrationsTest, EachSensorFindsItsOwn) {
  VERIFIES("LASSO-LCS-007~2 LASSO-IMG-001~1");
  C found;
  ASSERT_EQ(load(with({{0, test::bent_calibration(7)}, {1, test::bent_calibration(8)}})).status, Status::kOk);
  for (const SensorNumber sensor : {SensorNumber{0}, SensorNumber{1}}) {
    const C put = test::bent_calibration(7U + sensor);
    ASSERT_TRUE(slot_->find_calibration(sensor, 0, found));
    EXPECT_EQ(found.serial, put.serial);
    for (const CalibrationReal& real : kCalibrationReals) EXPECT_EQ(found.*real.member, put.*real.member);
    for (std::size_t k = 0; k < kResidualTerms; ++k) EXPECT_EQ(found.residual[k], put.residual[k]);
  }
  ASSERT_EQ(load(with({{1, test::bent_calibration(8)}})).status, Status::kOk);
  EXPECT_FALSE(slot_->find_calibration(0, 0, found));
  EXPECT_TRUE(slot_->find_calibration(1, 0, found));
  ASSERT_EQ(load(with({})).status, Status::kOk);
  EXPECT_FALSE(slot_->find_calibration(0, 0, found));
}

TEST_F(ImageCalibrationsTest, ASensorMayHaveSeveral) {
  VERIFIES("LASSO-LCS-020~1");
  static_assert(kMaxCalibrations == 4, "as many as sensor 1 has here");
  const auto camera = [](std::uint32_t serial) { return test::bent_calibration(serial); };
  ASSERT_EQ(load(with({{0, camera(7)}, {0, camera(8)}, {1, camera(9)}, {1, camera(10)}, {1, camera(11)}, {1, camera(12)}})).status,
            Status::kOk);
  C found;
  for (std::uint8_t i = 0; i < 2; ++i) {
    ASSERT_TRUE(slot_->find_calibration(0, i, found));
    EXPECT_EQ(found.serial, 7U + i);
  }
  EXPECT_FALSE(slot_->find_calibration(0, 2, found)) << "that is the next sensor's";
  for (std::uint8_t i = 0; i < 4; ++i) {
    ASSERT_TRUE(slot_->find_calibration(1, i, found));
    EXPECT_EQ(found.serial, 9U + i);
  }
  EXPECT_FALSE(slot_->find_calibration(1, 4, found));
  EXPECT_FALSE(slot_->find_calibration(2, 0, found));
}

TEST_F(ImageCalibrationsTest, WhatIsWrongIsRefusedWithItsPlace) {
  VERIFIES("LASSO-LCS-015~2 LASSO-IMG-004~1 LASSO-IMG-005~1");
  const auto refused = [&](const std::vector<std::pair<std::uint32_t, C>>& calibrations, Status status, std::uint32_t record) {
    const LoadFailure failure = load(with(calibrations));
    EXPECT_EQ(failure.status, status);
    EXPECT_EQ(failure.table, kCalibrationsTable);
    EXPECT_EQ(failure.record, record);
  };
  const C good = bent_camera();
  refused({{2, good}}, Status::kBadIndex, 0);                                                         // there are sensors 0 and 1
  refused({{1, good}, {0, good}}, Status::kBadIndex, 1);                                              // out of order
  refused({{0, good}, {1, good}, {1, good}, {1, good}, {1, good}, {1, good}}, Status::kBadIndex, 5);  // one more than fit
  C bad = good;
  bad.baseline_m = 0;
  refused({{0, good}, {1, bad}}, Status::kSingular, 1);
  bad = good;
  bad.residual[4] = std::numeric_limits<double>::quiet_NaN();
  refused({{0, bad}}, Status::kNotFinite, 0);
  refused(std::vector<std::pair<std::uint32_t, C>>(kMaxSensors * kMaxCalibrations + 1, {0, good}), Status::kOverCapacity, 0);
}

}  // namespace
}  // namespace lasso
