// The whole component with two sensors, of which one takes each scan.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "ut/exec/component_operator.hpp"
#include "ut/support/box_sensors.hpp"

namespace lasso {
namespace {

using test::Report;
using M = TrackingMode;
using S = SensorReason;

constexpr double kFarSigma_m = 4e-3;
constexpr double kNearSigma_m = 1e-3;

// Moving away from 2.4 m at 0.1 m/s, or as the test says.
test::BoxScene scene_at(double range_m, double away_mps) {
  test::BoxScene scene = test::default_scene();
  scene.at_zero.p.z() = range_m;
  scene.rates.v_mps = Vec3(0.004, -0.003, away_mps);
  return scene;
}

// The first sensor is for far: rough, used from 2.6 m. The second one is fine, has a narrow field, and is used up to 3 m.
class ScanSchedulerTest : public ::testing::Test {
 protected:
  static MissionParameters parameters(const test::BoxScene& scene) {
    MissionParameters p = test::box_parameters(scene);
    p.points = 400;
    p.sigma0_m = kFarSigma_m;
    p.use_from_m = 2.6;
    p.range_min_m = 1;
    p.range_max_m = 50;
    p.fault_scans = 2;
    p.coast_frames = 40;
    return p;
  }
  static SensorParameters near_sensor(const MissionParameters& p) {
    SensorParameters near = test::sensor_of(p, 0, 3);
    near.sigma0_m = kNearSigma_m;
    near.fov_half_x_rad = near.fov_half_y_rad = 0.1;
    near.range_max_m = 4;
    return near;
  }
  void begin(const test::BoxScene& scene, MissionParameters p) {
    static const test::BoxTables whole = test::make_box_tables(test::BoxModel{});
    test::BoxTables tables = p.short_range_enter_m > 0 ? test::with_parts(whole, test::two_halves(), p) : whole;
    test::append_sensor(near_sensor(p), tables[test::kSensorsTable]);
    image_ = test::make_image(p, tables);
    test::BoxScene rough = scene;
    rough.sigma_m = kFarSigma_m;
    far_ = std::make_unique<test::BoxSensor>(rough);
    near_ = std::make_unique<test::BoxSensor>(scene);
    SensorBank bank = only(*far_);
    ASSERT_TRUE(bank.push_back(near_.get()));
    component_ = std::make_unique<Component>(bank);
    ASSERT_EQ(component_->load_image(Bytes(image_.data(), image_.size)).status, Status::kOk);
    ASSERT_EQ(component_->begin(0), Status::kOk);
  }
  void begin(const test::BoxScene& scene) { begin(scene, parameters(scene)); }

  std::vector<PoseTelemetry> run(int frames) {
    std::vector<PoseTelemetry> reports;
    for (int i = 0; i < frames; ++i) {
      const test::Stream bytes = test::run_frame(*component_);
      for (const Report& report : test::decode_all(test::view(bytes))) reports.push_back(report.pose);
    }
    return reports;
  }

  // The sensors that the packets of these frames state.
  std::vector<std::uint8_t> sensors_told(int frames) {
    std::vector<std::uint8_t> told;
    for (int i = 0; i < frames; ++i) {
      for (const test::Packet& packet : test::packets_of(test::run_frame(*component_))) {
        if (packet.is(3, 25) && packet.data[1] == kSensorStructureId) told.push_back(packet.data[2]);
      }
    }
    return told;
  }

  // What is reported of sensors' failing, in order: the event, and the sensor.
  std::vector<std::pair<EventId, int>> failures_told(int frames) {
    std::vector<std::pair<EventId, int>> failures;
    for (int i = 0; i < frames; ++i) {
      const test::Stream bytes = test::run_frame(*component_);
      for (const test::Stream& event : test::events_of(test::packets_of(bytes))) {
        const auto id = static_cast<EventId>(event[1]);
        if (id == EventId::kSensorFailed || id == EventId::kSensorBack) failures.emplace_back(id, event.back());
      }
    }
    return failures;
  }

  test::TestImage image_;
  std::unique_ptr<test::BoxSensor> far_, near_;
  std::unique_ptr<Component> component_;
};

TEST_F(ScanSchedulerTest, TheTargetsRangeSaysWhichSensorTakesAScan) {
  VERIFIES("LASSO-SNS-041~1 LASSO-SNS-042~1 LASSO-SNS-046~1 LASSO-SNS-048~1");
  constexpr std::uint32_t kSettled = 10;
  begin(scene_at(2.4, 0.1));
  std::vector<int> sensors;
  for (const PoseTelemetry& t : run(45)) {
    if (t.scan_id >= kSettled) {  // before, the box is seen face-on, and its rates are hardly known
      EXPECT_EQ(t.valid, 1) << t.scan_id;
      EXPECT_EQ(static_cast<M>(t.mode), M::kTracking);
    }
    EXPECT_EQ(static_cast<S>(t.sensor_reason), S::kInBand);
    EXPECT_GE(t.sensor_changes, t.sensor == 1 ? 1U : 2U) << "of scans that were planned since, too";
    if (sensors.empty() || sensors.back() != t.sensor) sensors.push_back(t.sensor);
  }
  EXPECT_EQ(sensors, (std::vector<int>{1, 0})) << "from 2.4 m to 3.3 m";
  EXPECT_EQ(far_->starts + near_->starts, 45);
}

// What a scan is worth is what its own sensor's noise says: the covariance is that of 4 mm, and of 1 mm.
TEST_F(ScanSchedulerTest, EachScanIsPlannedAndEstimatedByItsOwnSensorsParameters) {
  VERIFIES("LASSO-SNS-046~1");
  MissionParameters p = parameters(scene_at(2.4, 0.1));
  p.noise_estimated = 0;
  begin(scene_at(2.4, 0.1), p);
  double sigma[2] = {};
  double widest[2] = {};
  for (const PoseTelemetry& t : run(45)) {
    if (t.scan_id < 3) continue;  // its rates are not known yet, and its motion smears the first scans
    sigma[t.sensor] = std::sqrt(static_cast<double>(t.covariance[20]));
    widest[t.sensor] = std::max(widest[t.sensor], t.plan_half_extents[0]);
    EXPECT_NEAR(t.normalized_residual, 1, 0.25) << t.scan_id << " by sensor " << int{t.sensor} << ": its residuals are those of its sensor";
  }
  EXPECT_NEAR(sigma[0] / sigma[1], kFarSigma_m / kNearSigma_m, 1.5);
  EXPECT_LE(widest[1], std::tan(0.1) * 1.0001);
  EXPECT_GT(widest[0], std::tan(0.1));
}

// Once, however long it lasts; so is the end of it.
TEST_F(ScanSchedulerTest, AFailureIsToldOnceAndSoIsItsEnd) {
  VERIFIES("LASSO-SNS-044~2");
  begin(scene_at(2.4, 0));
  EXPECT_TRUE(failures_told(6).empty());
  for (std::uint32_t scan = 6; scan < 9; ++scan) near_->lost.insert(scan);
  const std::vector<std::pair<EventId, int>> expected{{EventId::kSensorFailed, 1}, {EventId::kSensorBack, 1}};
  EXPECT_EQ(failures_told(60), expected);
}

// In frames without a scan, too, the packet says who rests at present.
TEST_F(ScanSchedulerTest, ASensorThatHasRestedIsNotToldAsFailedInModeSafe) {
  VERIFIES("LASSO-SNS-044~2 LASSO-SNS-048~1");
  begin(scene_at(2.4, 0));
  run(6);
  for (std::uint32_t scan = 6; scan < 9; ++scan) near_->lost.insert(scan);
  run(5);
  ASSERT_EQ(component_->command_mode(M::kSafe), ModeRefusal::kNone);
  EXPECT_EQ(run(5).back().sensors_failed, 2) << "it rests";
  run(60);
  const std::vector<PoseTelemetry> later = run(2);
  ASSERT_EQ(later.size(), 2U);
  EXPECT_EQ(static_cast<M>(later.back().mode), M::kSafe);
  EXPECT_EQ(later.back().sensors_failed, 0) << "it may take scans again";
}

TEST_F(ScanSchedulerTest, ASensorThatFailsIsReplacedAndTold) {
  VERIFIES("LASSO-SNS-044~2 LASSO-SNS-048~1");
  begin(scene_at(2.4, 0));
  run(6);
  for (std::uint32_t scan = 6; scan < 30; ++scan) near_->lost.insert(scan);
  bool substituted = false;
  for (const PoseTelemetry& t : run(12)) {
    if (t.sensor == 1) continue;
    substituted = true;
    EXPECT_EQ(static_cast<S>(t.sensor_reason), S::kSubstitute);
    EXPECT_EQ(t.sensors_failed, 2);
    EXPECT_EQ(t.valid, 1) << t.scan_id;
    EXPECT_EQ(t.sensor_changes, 2U) << "to the one for near, and back";
  }
  EXPECT_TRUE(substituted);
}

TEST_F(ScanSchedulerTest, TheSensorWithTroubleIsToldAndAllWhenAskedFor) {
  VERIFIES("LASSO-LCS-012~1 LASSO-LNK-014~1");
  for (const std::uint8_t troubled : {std::uint8_t{0}, std::uint8_t{1}}) {
    begin(scene_at(troubled == 0 ? 4 : 2.4, 0));
    test::BoxSensor& sensor = troubled == 0 ? *far_ : *near_;
    for (std::uint32_t scan = 0; scan < 20; ++scan) sensor.lost.insert(scan);
    const std::vector<std::uint8_t> told = sensors_told(24);
    ASSERT_FALSE(told.empty());
    for (const std::uint8_t each : told) EXPECT_EQ(each, troubled);
    const test::Stream ask = test::of_structure(CommandKind::kReportStructure, kSensorStructureId, 0);
    component_->receive(test::view(ask), component_->next_slot_us());
    EXPECT_EQ(sensors_told(1), (std::vector<std::uint8_t>{0, 1})) << "no news: all";
  }
}

TEST_F(ScanSchedulerTest, AScanThatCannotBePlannedIsNoFaultOfTheSensor) {
  VERIFIES("LASSO-SNS-044~2");
  test::BoxScene scene = scene_at(1.5, 0);
  scene.at_zero.p.x() = 2;  // beside both fields
  begin(scene);
  const std::vector<PoseTelemetry> reports = run(12);
  ASSERT_EQ(reports.size(), 10U);
  for (const PoseTelemetry& t : reports) {
    EXPECT_EQ(t.sensors_failed, 0);
    EXPECT_EQ(t.sensor, 1);
    EXPECT_EQ(t.valid, 0);
  }
  EXPECT_EQ(near_->starts, 0);
}

TEST_F(ScanSchedulerTest, WithoutABearingTheSensorsLookInTurn) {
  VERIFIES("LASSO-SNS-045~2");
  begin(scene_at(2.4, 0));
  run(3);
  far_->hidden = near_->hidden = true;
  ASSERT_EQ(component_->command_mode(M::kBearing), ModeRefusal::kNone);
  std::vector<int> sensors;
  for (const PoseTelemetry& t : run(28)) {
    if (static_cast<S>(t.sensor_reason) == S::kRangeUnknown) sensors.push_back(t.sensor);
  }
  ASSERT_GE(sensors.size(), 21U);
  for (std::size_t i = 0; i < 21; ++i) EXPECT_EQ(sensors[i], i / 10 == 1 ? 0 : 1) << i;
  near_->hidden = far_->hidden = false;
  const std::vector<PoseTelemetry> found = run(8);
  EXPECT_EQ(found.back().sensor, 1);
  EXPECT_EQ(static_cast<S>(found.back().sensor_reason), S::kInBand) << "the bearing's range says whose turn it is";
  EXPECT_EQ(static_cast<BearingReason>(found.back().bearing_reason), BearingReason::kValid);
}

TEST_F(ScanSchedulerTest, ASearchKeepsItsSensor) {
  VERIFIES("LASSO-SNS-042~1");
  begin(scene_at(2.4, 0));
  run(3);
  ASSERT_EQ(component_->command_mode(M::kSearching), ModeRefusal::kNone);
  run(3);
  const std::vector<PoseTelemetry> reports = run(6);
  ASSERT_EQ(reports.size(), 6U);
  for (const PoseTelemetry& t : reports) {
    EXPECT_EQ(static_cast<S>(t.sensor_reason), S::kBusy);
    EXPECT_EQ(t.sensor, 1);
  }
}

// A part that was chosen for the scans of one sensor is not scanned by another one: its first scans are of the whole.
TEST_F(ScanSchedulerTest, WhatWasPlannedForAnotherSensorCountsNoMore) {
  VERIFIES("LASSO-SNS-046~1 LASSO-MOD-164~2");
  const test::BoxScene scene = scene_at(2.5, 0.1);
  MissionParameters p = parameters(scene);
  p.short_range_enter_m = 5;
  p.short_range_leave_m = 6;
  begin(scene, p);
  int before = -1;
  bool switched = false;
  for (const PoseTelemetry& t : run(45)) {
    if (before >= 0 && t.sensor != before) {
      switched = true;
      EXPECT_EQ(t.part, 0);
    }
    EXPECT_TRUE(t.frames <= 10 || switched || t.part != 0) << t.scan_id;
    before = t.sensor;
  }
  EXPECT_TRUE(switched);
}

TEST_F(ScanSchedulerTest, AMissionWithMoreSensorsThanThereAreIsRefused) {
  VERIFIES("LASSO-SNS-047~1");
  const test::BoxScene scene = scene_at(2.4, 0);
  test::BoxSensor sensor(scene);
  const auto one = std::make_unique<Component>(sensor);
  test::BoxTables tables = test::make_box_tables(test::BoxModel{});
  test::append_sensor(near_sensor(parameters(scene)), tables[test::kSensorsTable]);
  test::TestImage image = test::make_image(parameters(scene), tables);
  const LoadFailure refused = one->load_image(Bytes(image.data(), image.size));
  EXPECT_EQ(refused.status, Status::kBadValue);
  EXPECT_STREQ(refused.what, "the mission has more sensors than are connected");
  EXPECT_EQ(one->begin(0), Status::kMissing);
}

TEST_F(ScanSchedulerTest, ASensorWithoutARangeOrATurnIsRefused) {
  VERIFIES("LASSO-SNS-047~1");
  const test::BoxScene scene = scene_at(2.4, 0);
  test::BoxSensor sensor(scene);
  const auto component = std::make_unique<Component>(sensor);
  MissionParameters p = parameters(scene);
  p.range_min_m = p.range_max_m;
  test::TestImage no_range = test::make_box_image(p);
  EXPECT_STREQ(component->load_image(Bytes(no_range.data(), no_range.size)).what, "sensor.range_min_m is not below sensor.range_max_m");
  p = parameters(scene);
  p.use_to_m = p.use_from_m;
  test::TestImage no_turn = test::make_box_image(p);
  EXPECT_STREQ(component->load_image(Bytes(no_turn.data(), no_turn.size)).what, "sensor.use_from_m is not below sensor.use_to_m");
}

}  // namespace
}  // namespace lasso
