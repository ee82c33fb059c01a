// Further sensors in a flight image.
#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "fsw/mission/mission.hpp"
#include "ut/support/box_sensors.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

class LoaderSensorsTest : public ::testing::Test {
 protected:
  static const test::BoxTables& whole() {
    static const test::BoxTables tables = test::make_box_tables(test::BoxModel{{0.02, -0.01, 0.03}, {0.30, 0.20, 0.12}, 0.06, 0.06});
    return tables;
  }
  static SensorParameters near() {
    SensorParameters sensor = preset_parameters();
    double share = 0.1;
    for (const ParameterRow& row : sensor_rows()) {
      sensor.*sensor_member(row) = (row.minimum + share * (row.maximum - row.minimum)) * row.to_si;
      share += 0.01;
    }
    sensor.range_max_m = 90;  // what either number type holds
    sensor.sigma0_m = 0.04;
    sensor.sigma_k_per_m = 7e-6;
    sensor.sigma_angle_rad = 8e-4;
    return sensor;
  }
  LoadFailure load(const test::BoxTables& tables) {
    image_ = test::make_image(preset_parameters(), tables);
    return load_image(Bytes(image_.data(), image_.size), *mission_, *parts_);
  }
  static test::BoxTables with(const std::vector<SensorParameters>& sensors) {
    test::BoxTables tables = whole();
    for (const SensorParameters& sensor : sensors) test::append_sensor(sensor, tables[test::kSensorsTable]);
    return tables;
  }

  test::TestImage image_;
  std::unique_ptr<Mission> mission_ = std::make_unique<Mission>();
  std::unique_ptr<Parts> parts_ = std::make_unique<Parts>();
};

constexpr auto kSensorsTable = static_cast<std::uint32_t>(TableId::kSensors);

TEST_F(LoaderSensorsTest, TheMissionsOwnSensorComesFirst) {
  VERIFIES("LASSO-SNS-047~1 LASSO-IMG-001~1");
  ASSERT_EQ(load(with({near()})).status, Status::kOk);
  ASSERT_EQ(mission_->sensors.size(), 2U);
  for (const ParameterRow& row : sensor_rows()) {
    EXPECT_EQ(mission_->sensors[0].*sensor_member(row), mission_->parameters.*row.member) << row.key;
    EXPECT_EQ(mission_->sensors[1].*sensor_member(row), near().*sensor_member(row)) << row.key;
  }
  ASSERT_EQ(load(whole()).status, Status::kOk);
  EXPECT_EQ(mission_->sensors.size(), 1U) << "those of the image before are forgotten";
}

TEST_F(LoaderSensorsTest, MissionAndPartsAreSeenByTheSensorThatIsUsed) {
  VERIFIES("LASSO-SNS-046~1");
  test::BoxTables tables = test::with_parts(with({near()}), test::two_halves(), preset_parameters());
  ASSERT_EQ(load(tables).status, Status::kOk);
  use_sensor(1, *mission_, *parts_);
  for (const ParameterRow& row : sensor_rows()) {
    EXPECT_EQ(mission_->parameters.*row.member, near().*sensor_member(row)) << row.key;
    for (const Part& part : *parts_) EXPECT_EQ(part.mission.parameters.*row.member, near().*sensor_member(row)) << row.key;
  }
  EXPECT_EQ(mission_->parameters.points, preset_parameters().points);
  EXPECT_EQ((*parts_)[0].mission.parameters.silhouettes, 0);
  use_sensor(0, *mission_, *parts_);
  EXPECT_EQ(mission_->parameters.sigma0_m, preset_parameters().sigma0_m);
}

TEST_F(LoaderSensorsTest, ValuesOutsideOfTheirRangesAreRefusedByName) {
  VERIFIES("LASSO-SNS-047~1 LASSO-IMG-004~1");
  SensorParameters wrong = near();
  wrong.fov_half_y_rad = 2;
  LoadFailure failure = load(with({near(), wrong}));
  EXPECT_EQ(failure.status, Status::kBadValue);
  EXPECT_EQ(failure.table, kSensorsTable);
  EXPECT_EQ(failure.record, 1U);
  EXPECT_STREQ(failure.what, "sensor.fov_half_y_deg");
  wrong = near();
  wrong.sigma0_m = std::numeric_limits<double>::quiet_NaN();
  failure = load(with({wrong}));
  EXPECT_EQ(failure.status, Status::kNotFinite);
  EXPECT_STREQ(failure.what, "sensor.sigma0_m");
}

TEST_F(LoaderSensorsTest, ASensorThatTheNumberTypeDoesNotHoldIsRefused) {
  VERIFIES("LASSO-IMG-021~1");
  SensorParameters far = near();
  far.range_max_m = 127;
  const LoadFailure failure = load(with({near(), far}));
  constexpr bool kHeld = FlightNumber::kFarthest_m > 128;
  EXPECT_EQ(failure.status, kHeld ? Status::kOk : Status::kBadValue);
  EXPECT_EQ(failure.record, kHeld ? 0U : 1U);
  EXPECT_EQ(std::string(failure.what).find("sensor.range_max_m") == 0, !kHeld) << failure.what;
}

TEST_F(LoaderSensorsTest, MoreSensorsThanThereIsRoomForAreRefused) {
  VERIFIES("LASSO-IMG-005~1 LASSO-SNS-047~1");
  EXPECT_EQ(load(with(std::vector<SensorParameters>(kMaxSensors - 1, near()))).status, Status::kOk);
  const LoadFailure failure = load(with(std::vector<SensorParameters>(kMaxSensors, near())));
  EXPECT_EQ(failure.status, Status::kOverCapacity);
  EXPECT_EQ(failure.table, kSensorsTable);
}

}  // namespace
}  // namespace lasso
