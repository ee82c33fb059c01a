#include "mdat/stereo/stereo_sensor.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "fsw/sense/pattern.hpp"
#include "ut/mdat/stereo/maps.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// A tilted plane in the left half; nothing in the right.
DisparityMap half_plane() {
  DisparityMap map = empty_map(101, 81, 120);
  for (int row = 0; row < 81; ++row) {
    for (int column = 0; column < 50; ++column) map.codes.codes[map.index(column, row)] = static_cast<std::uint16_t>(160 + column + row);
  }
  return map;
}

ScanPlan small_plan() {
  ScanPlan plan;
  plan.points = 64;
  plan.cycles_a = 7;
  plan.cycles_b = 5;
  plan.half_x = plan.half_y = 0.3;
  return plan;
}

TEST(StereoSensor, ARayTakesTheRangeOfThePixelItFallsOn) {
  VERIFIES("LASSO-STE-012~1");
  const DisparityMap map = half_plane();
  for (const auto& [column, row] : {std::pair{12.3, 40.4}, std::pair{0.0, 0.0}, std::pair{49.4, 79.6}}) {
    const Vec3 direction = Vec3((column - 50) / 120, (row - 40) / 120, 1).normalized();
    const RangeSample sample = stereo_sample(map, direction, 77);
    ASSERT_EQ(sample.state, RayState::kHit);
    const double u = std::round(column), v = std::round(row), depth_m = 120 * 0.25 / ((160 + u + v) / 16);
    const Vec3 point(depth_m * (u - 50) / 120, depth_m * (v - 40) / 120, depth_m);
    const Vec3 measured = static_cast<double>(sample.range_m) * to_vec3(sample.direction);
    EXPECT_LT((measured - point).norm(), 1e-6 * depth_m);
    EXPECT_EQ(sample.t_us, 77);
  }
}

TEST(StereoSensor, AHoleIsNoMiss) {
  VERIFIES("LASSO-STE-012~1");
  const DisparityMap map = half_plane();
  for (const Vec3& direction : {Vec3(0.2, 0, 1), Vec3(3, 0, 1), Vec3(-3, 0, 1), Vec3(0, 0, -1)}) {
    const RangeSample sample = stereo_sample(map, direction.normalized(), 1);
    EXPECT_EQ(sample.state, RayState::kInvalid);
    EXPECT_EQ(sample.range_m, 0);
  }
}

TEST(StereoSensor, TakesOnePairAScanAtItsStart) {
  VERIFIES("LASSO-STE-012~1");
  std::vector<TimeUs> asked;
  StereoSensor sensor([&](TimeUs t_us) {
    asked.push_back(t_us);
    return ranges_in(half_plane());
  });
  const ScanPlan plan = small_plan();
  std::vector<RangeSample> samples(100);
  ASSERT_EQ(sensor.start(plan, kEpochUs + 400000), Status::kOk);
  EXPECT_EQ(sensor.start(plan, kEpochUs + 400000), Status::kBusy);
  EXPECT_EQ(sensor.poll(kEpochUs + 399999, {samples.data(), 100}).count, 0U) << "before its time";
  const SensorPoll some = sensor.poll(kEpochUs + 400000, {samples.data(), 10});
  EXPECT_EQ(some.count, 10U);
  EXPECT_FALSE(some.complete);
  const SensorPoll rest = sensor.poll(kEpochUs + 400000, {samples.data() + 10, 90});
  EXPECT_EQ(rest.count, 54U);
  EXPECT_TRUE(rest.complete);
  EXPECT_EQ(asked, std::vector<TimeUs>{400000});
  for (std::uint16_t i = 0; i < 64; ++i) {
    const RangeSample expected = stereo_sample(half_plane(), pattern_direction(plan, i), kEpochUs + 400000);
    EXPECT_EQ(samples[i].state, expected.state);
    EXPECT_EQ(samples[i].range_m, expected.range_m);
    EXPECT_EQ(samples[i].t_us, kEpochUs + 400000);
  }
  EXPECT_EQ(sensor.poll(kEpochUs + 400001, {samples.data(), 10}).status, Status::kNoData);
}

TEST(StereoSensor, RefusesABadPlanAndAnAbortedScanIsGone) {
  VERIFIES("LASSO-STE-012~1");
  StereoSensor sensor([](TimeUs) { return ranges_in(half_plane()); });
  ScanPlan bad = small_plan();
  bad.points = 1;
  EXPECT_EQ(sensor.start(bad, kEpochUs), Status::kBadValue);
  ASSERT_EQ(sensor.start(small_plan(), kEpochUs), Status::kOk);
  sensor.abort();
  std::vector<RangeSample> samples(8);
  EXPECT_EQ(sensor.poll(kEpochUs, {samples.data(), 8}).status, Status::kNoData);
  EXPECT_EQ(sensor.start(small_plan(), kEpochUs), Status::kOk);
}

TEST(StereoSensor, AFailureIsAStatusForTheComponentAndALineForTheUser) {
  VERIFIES("LASSO-STE-011~1");
  StereoSensor sensor([](TimeUs) -> PairRanges { throw std::runtime_error("no matcher"); });
  EXPECT_EQ(sensor.failure(), "");
  EXPECT_EQ(sensor.start(small_plan(), kEpochUs), Status::kTimeout);
  EXPECT_EQ(sensor.failure(), "no matcher");
}

}  // namespace
}  // namespace lasso::mdat
