#include "mdat/recording/sensor_sight.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fsw/geometry/so3.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

MissionSource two_sensors() {
  MissionSource mission;
  mission.parameters.fov_half_x_rad = 0.2;
  mission.parameters.fov_half_y_rad = 0.1;
  mission.parameters.sigma0_m = 0.004;
  FurtherSensor wide;
  wide.name = "wide";
  wide.parameters.fov_half_x_rad = wide.parameters.fov_half_y_rad = 0.5;
  wide.parameters.sigma0_m = 0.02;
  wide.T_sensor_own = Pose{exp_so3(Vec3(0, 0.3, 0)), Vec3(1, 2, 3)};
  mission.further_sensors.push_back(wide);
  return mission;
}

// Each edge from the sensor lies on two sides of its field: its angles from the boresight are the half angles.
TEST(SensorSight, FieldsHaveTheirAnglesInTheSensorsOwnAxes) {
  VERIFIES("LASSO-REC-027~1");
  const SensorSight sight(two_sensors(), "");
  const std::vector<ros::Path> fields = sight.fields_of_view(7);
  ASSERT_EQ(fields.size(), 2U);
  const Pose T_own[] = {Pose{}, two_sensors().further_sensors[0].T_sensor_own.value()};
  const double half_rad[2][2] = {{0.2, 0.1}, {0.5, 0.5}};
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_FALSE(fields[k].joined);
    ASSERT_EQ(fields[k].points.size(), 16U);
    for (std::size_t i = 0; i < 16; i += 4) {
      EXPECT_EQ(fields[k].points[i], T_own[k].p);
      const Vec3 corner = T_own[k].q.conjugate() * (fields[k].points[i + 1] - T_own[k].p);
      EXPECT_NEAR(corner.z(), 7, 1e-9);
      EXPECT_NEAR(std::atan2(std::abs(corner.x()), corner.z()), half_rad[k][0], 1e-9);
      EXPECT_NEAR(std::atan2(std::abs(corner.y()), corner.z()), half_rad[k][1], 1e-9);
      EXPECT_EQ(fields[k].points[i + 3], fields[k].points[(i + 5) % 16]);  // to the next corner
    }
  }
}

TEST(SensorSight, KnowsWherePicturesAreTaken) {
  VERIFIES("LASSO-REC-045~1");
  MissionSource mission = two_sensors();
  EXPECT_FALSE(SensorSight(mission, "").camera());
  mission.further_sensors[0].kind = SensorKind::kStereo;
  EXPECT_EQ(SensorSight(mission, "").camera().value().p, Vec3(1, 2, 3));
  mission.further_sensors[0].T_sensor_own.reset();
  EXPECT_EQ(SensorSight(mission, "").camera().value().p, Vec3::Zero());
  mission.stereo.model = 1;
  EXPECT_FALSE(SensorSight(mission, "").camera()) << "errors alone, without pictures";
  mission.stereo.model = 0;
  mission.sensor = SensorKind::kStereo;
  EXPECT_EQ(SensorSight(mission, "").camera().value().p, Vec3::Zero());
}

TEST(SensorSight, KnowsTheNoiseOfEachSensor) {
  VERIFIES("LASSO-REC-026~1");
  const SensorSight sight(two_sensors(), "");
  EXPECT_EQ(sight.parameters(0).sigma0_m, 0.004);
  EXPECT_EQ(sight.parameters(1).sigma0_m, 0.02);
  EXPECT_EQ(sight.parameters(9).sigma0_m, 0.004);
}

TEST(SensorSight, AScansPathGoesFromRayToRay) {
  VERIFIES("LASSO-REC-027~1");
  std::vector<RangeSample> samples(3);
  samples[1].direction[0] = 0.6F;
  samples[1].direction[2] = 0.8F;
  const ros::Path path = scan_path(samples, 5);
  EXPECT_TRUE(path.joined);
  ASSERT_EQ(path.points.size(), 3U);
  EXPECT_NEAR((path.points[1] - Vec3(3, 0, 4)).norm(), 0, 1e-6);
  EXPECT_EQ(path.points[2], Vec3(0, 0, 5));
}

}  // namespace
}  // namespace lasso::mdat
