#include "fsw/sense/sensor_chooser.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using R = SensorReason;

// A LIDAR used from 15 m, measuring 1 m to 100 m; a camera used up to 17 m, measuring 0.5 m to 20 m; a third one up to 40 m.
class SensorChooserTest : public ::testing::Test {
 protected:
  SensorChooserTest() {
    mission_.parameters = preset_parameters();
    mission_.parameters.fault_scans = 3;
    add(1, 100, 15, 100);
    add(0.5, 20, 0, 17);
  }
  void add(double range_min_m, double range_max_m, double use_from_m, double use_to_m) {
    SensorParameters sensor = mission_.parameters;
    sensor.range_min_m = range_min_m;
    sensor.range_max_m = range_max_m;
    sensor.use_from_m = use_from_m;
    sensor.use_to_m = use_to_m;
    ASSERT_TRUE(mission_.sensors.push_back(sensor));
  }
  SensorChoice at(double range_m) { return chooser_.choose(mission_, {++scan_id_, false, true, range_m}); }
  SensorChoice anywhere() { return chooser_.choose(mission_, {++scan_id_, false, false, 0}); }
  void expect(const SensorChoice& choice, int sensor, R reason) const {
    EXPECT_EQ(choice.sensor, sensor) << "scan " << scan_id_;
    EXPECT_EQ(choice.reason, reason) << "scan " << scan_id_;
  }
  void lose(SensorNumber sensor, int scans) {
    for (int i = 0; i < scans; ++i) chooser_.note(mission_.parameters, sensor, scan_id_, false);
  }

  Mission mission_;
  SensorChooser chooser_;
  std::uint32_t scan_id_ = 0;
};

TEST_F(SensorChooserTest, TheOneInWhoseBandTheTargetIsTakesTheScanAndStaysWithinTheOverlap) {
  VERIFIES("LASSO-SNS-041~1 LASSO-SNS-042~1");
  const struct {
    double range_m;
    int sensor;
  } path[] = {{60, 0}, {17.5, 0}, {15.5, 0}, {15, 0}, {14.9, 1}, {15.5, 1}, {17, 1}, {17.1, 0}, {15.5, 0}, {3, 1}, {99, 0}};
  for (const auto& point : path) expect(at(point.range_m), point.sensor, R::kInBand);
  EXPECT_EQ(chooser_.changes(), 4U);
  EXPECT_EQ(chooser_.failed(scan_id_), 0);
}

TEST_F(SensorChooserTest, OutsideOfAllBandsOneThatMeasuresTheRangeIsTaken) {
  VERIFIES("LASSO-SNS-043~1");
  mission_.sensors[0].use_from_m = 30;
  expect(at(60), 0, R::kInBand);
  expect(at(25), 0, R::kOutsideBands);  // it measures there, the other one does not
  expect(at(19), 0, R::kOutsideBands);  // both do: the one in use stays
  expect(at(16), 1, R::kInBand);
  expect(at(19), 1, R::kOutsideBands);
  expect(at(25), 0, R::kOutsideBands);
}

TEST_F(SensorChooserTest, BeyondAllMeasuringTheOneInUseGoesOnAndSaysSo) {
  VERIFIES("LASSO-SNS-043~1");
  mission_.sensors[0].use_to_m = 90;
  mission_.sensors[1].use_from_m = 1;
  expect(at(150), 0, R::kOutOfRange);
  expect(at(3), 1, R::kInBand);
  expect(at(0.2), 1, R::kOutOfRange);
  expect(at(150), 1, R::kOutOfRange);
}

TEST_F(SensorChooserTest, ASensorThatFailsIsReplacedByOneThatMeasuresTheRangeAndTriedAgainAfterItsRest) {
  VERIFIES("LASSO-SNS-044~2");
  expect(at(16), 0, R::kInBand);
  lose(0, 2);
  expect(at(16), 0, R::kInBand);
  EXPECT_EQ(chooser_.failed(scan_id_), 0);
  lose(0, 1);
  EXPECT_EQ(chooser_.failed(scan_id_), 1);
  expect(at(16), 1, R::kInBand);
  expect(at(19), 1, R::kSubstitute);
  expect(at(50), 1, R::kOutOfRange);
  scan_id_ = 51;  // it failed in scan 2, and rests for 50
  expect(at(50), 1, R::kOutOfRange);
  expect(at(50), 0, R::kInBand);
  EXPECT_EQ(chooser_.failed(scan_id_), 0);
  lose(0, 1);  // it is as before: one scan tells
  expect(at(19), 1, R::kSubstitute);
  scan_id_ += 50;
  expect(at(50), 0, R::kInBand);
  chooser_.note(mission_.parameters, 0, scan_id_, true);
  lose(0, 2);
  expect(at(50), 0, R::kInBand);
}

TEST_F(SensorChooserTest, WhereAllHaveFailedTheOneInUseGoesOnAndSaysSo) {
  VERIFIES("LASSO-SNS-044~2");
  expect(at(50), 0, R::kInBand);
  lose(0, 3);
  lose(1, 3);
  EXPECT_EQ(chooser_.failed(scan_id_), 3);
  expect(at(50), 0, R::kAllFailed);
  expect(at(3), 0, R::kAllFailed);
  expect(anywhere(), 0, R::kAllFailed);
}

TEST_F(SensorChooserTest, ForATargetOfUnknownRangeTheSensorsLookInTurn) {
  VERIFIES("LASSO-SNS-045~2");
  add(1, 50, 20, 40);
  std::vector<int> taken;
  for (int i = 0; i < 31; ++i) {
    const SensorChoice choice = anywhere();
    EXPECT_EQ(choice.reason, R::kRangeUnknown);
    taken.push_back(choice.sensor);
  }
  for (int i = 0; i < 31; ++i) EXPECT_EQ(taken[static_cast<std::size_t>(i)], i / 10 % 3) << i;
  expect(at(3), 1, R::kInBand);
  for (int i = 0; i < 10; ++i) expect(anywhere(), 1, R::kRangeUnknown);
  expect(anywhere(), 2, R::kRangeUnknown);
}

TEST_F(SensorChooserTest, WhoHasFailedDoesNotLook) {
  VERIFIES("LASSO-SNS-045~2");
  add(1, 50, 20, 40);
  expect(anywhere(), 0, R::kRangeUnknown);
  lose(0, 3);
  lose(1, 3);
  expect(anywhere(), 2, R::kRangeUnknown);
}

TEST_F(SensorChooserTest, ABusySensorStays) {
  VERIFIES("LASSO-SNS-042~1");
  expect(at(50), 0, R::kInBand);
  expect(chooser_.choose(mission_, {++scan_id_, true, true, 3}), 0, R::kBusy);
  lose(0, 3);
  expect(chooser_.choose(mission_, {++scan_id_, true, true, 3}), 0, R::kBusy);
  EXPECT_EQ(chooser_.changes(), 0U);
}

TEST(SensorReasons, HaveNames) {
  VERIFIES("LASSO-SNS-048~1");
  EXPECT_STREQ(to_string(R::kInBand), "in_band");
  EXPECT_STREQ(to_string(R::kBusy), "busy");
  EXPECT_STREQ(to_string(static_cast<R>(7)), "unknown");
}

TEST_F(SensorChooserTest, TheOnlySensorTakesAllScans) {
  VERIFIES("LASSO-SNS-041~1");
  mission_.sensors.shrink(1);
  expect(at(50), 0, R::kInBand);
  expect(at(3), 0, R::kOutsideBands);
  for (int i = 0; i < 9; ++i) expect(anywhere(), 0, R::kRangeUnknown);
  lose(0, 3);
  expect(at(50), 0, R::kAllFailed);
}

}  // namespace
}  // namespace lasso
