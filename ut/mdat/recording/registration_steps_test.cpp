#include "mdat/recording/registration_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "ut/mdat/recording/wall.hpp"
#include "ut/support/verifies.hpp"

// Steps of a whole registration: ut/mdat/serve/iterations_test.cpp.
namespace lasso::mdat {
namespace {

float number(const ros::PointCloud& cloud, std::size_t point, std::size_t column) {
  float value = 0;
  std::memcpy(&value, cloud.data.data() + point * cloud.step + 4 * column, sizeof value);
  return value;
}

TEST(RegistrationSteps, TheCloudHasTheReturnsWithAResidualOfEachStep) {
  VERIFIES("LASSO-REC-028~1");
  std::vector<RangeSample> samples(3);
  for (RangeSample& sample : samples) sample.state = RayState::kHit;
  samples[0].range_m = 4.2F;
  samples[1].state = RayState::kMiss;
  samples[2].range_m = 5;
  std::vector<RegistrationStep> steps(2);
  steps[0].T_sensor_target.p = Vec3(0, 0, 4);
  steps[1].T_sensor_target.p = Vec3(0, 0, 4.5);
  const ros::PointCloud cloud = steps_cloud({samples, 0, {}, {}}, steps, 3, test::Wall());
  ASSERT_EQ(cloud.fields.size(), 6U);
  EXPECT_EQ(cloud.fields[5].name, "residual_2");
  EXPECT_EQ(cloud.fields[5].offset + 4, cloud.step);
  ASSERT_EQ(cloud.data.size(), 2U * cloud.step);
  EXPECT_FLOAT_EQ(number(cloud, 0, 2), 4.2F);
  EXPECT_NEAR(number(cloud, 0, 3), 0.2, 1e-6);
  EXPECT_NEAR(number(cloud, 0, 4), -0.3, 1e-6);
  EXPECT_NEAR(number(cloud, 1, 3), 1, 1e-6);
  EXPECT_NEAR(number(cloud, 1, 4), 0.5, 1e-6);
  EXPECT_TRUE(std::isnan(number(cloud, 1, 5)));  // there is no such step
}

TEST(RegistrationSteps, WhatNeverArrivedSaysNothing) {
  VERIFIES("LASSO-REC-028~1");
  std::vector<RangeSample> samples(2);
  samples[0].state = RayState::kHit;
  samples[1].state = RayState::kLost;
  RangeImage scan;
  ASSERT_TRUE(to_range_image(samples, scan));
  ASSERT_EQ(scan.samples.size(), 2U);
  EXPECT_EQ(scan.samples[0].state, RayState::kHit);
  EXPECT_EQ(scan.samples[1].state, RayState::kInvalid);
  RangeImage more;
  EXPECT_FALSE(to_range_image(std::vector<RangeSample>(kMaxRays + 1), more));
}

}  // namespace
}  // namespace lasso::mdat
