#include "mdat/run/timeline.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TimelinePoint point(double t_s, TrackingMode mode, SensorNumber sensor, int part, double error_m) {
  TimelinePoint result;
  result.t_s = t_s;
  result.mode = mode;
  result.range_m = 10 + t_s;
  result.sensor = sensor;
  result.part = part;
  result.valid = error_m >= 0;
  result.registration.translation_m = Vec3(error_m, 0, 0);
  result.registration.rotation_rad = error_m * kRadPerDeg;
  result.filtered.translation_m = Vec3(0, error_m / 2, 0);
  result.nees = 6;
  return result;
}

Timeline example() {
  Timeline timeline;
  timeline.points = {point(0, TrackingMode::kTracking, 0, 0, 0.003), point(1, TrackingMode::kTracking, 1, 0, 0.004),
                     point(2, TrackingMode::kShortRange, 1, 2, 0.012), point(3, TrackingMode::kShortRange, 1, 2, -1),
                     point(4, TrackingMode::kTracking, 0, 0, 0.001)};
  timeline.points[1].sensor_reason = SensorReason::kSubstitute;
  timeline.points[2].verdict = PoseVerdict::kWrong;
  return timeline;
}

TEST(Timeline, KnowsNoErrorOfNoValidPose) {
  VERIFIES("LASSO-GND-026~1");
  Timeline timeline;
  timeline.points = {point(0, TrackingMode::kTracking, 0, 0, -1)};
  const TimelineStatistics none = timeline_statistics(timeline);
  EXPECT_EQ(none.frames, 1U);
  EXPECT_EQ(none.valid, 0U);
  for (const double error : {none.rms_mm, none.rms_deg, none.worst_mm, none.worst_deg, none.nees, none.filtered_rms_mm,
                             none.filtered_rms_deg, none.filtered_worst_mm, none.filtered_worst_deg}) {
    EXPECT_TRUE(std::isnan(error)) << "0 would be a claim";
  }
}

TEST(Timeline, CountsValidPosesAndTheirErrors) {
  VERIFIES("LASSO-GND-026~1");
  const TimelineStatistics all = timeline_statistics(example());
  EXPECT_EQ(all.frames, 5U);
  EXPECT_EQ(all.valid, 4U);
  EXPECT_EQ(all.wrong, 1U);
  EXPECT_NEAR(all.rms_mm, std::sqrt((9 + 16 + 144 + 1) / 4.0), 1e-9);
  EXPECT_NEAR(all.worst_mm, 12, 1e-9);
  EXPECT_NEAR(all.worst_deg, 0.012, 1e-12);
  EXPECT_NEAR(all.filtered_rms_mm, all.rms_mm / 2, 1e-9);
  EXPECT_NEAR(all.filtered_worst_mm, 6, 1e-9);
  EXPECT_EQ(all.nees, 6);
}

TEST(Timeline, GroupsByModeSensorAndPartThatOccur) {
  VERIFIES("LASSO-GND-026~1");
  const std::vector<TimelineGroup> modes = by_mode(example());
  ASSERT_EQ(modes.size(), 2U);
  EXPECT_EQ(modes[0].name, "tracking");
  EXPECT_EQ(modes[0].statistics.frames, 3U);
  EXPECT_EQ(modes[1].name, "short_range");
  EXPECT_EQ(modes[1].statistics.valid, 1U);
  EXPECT_NEAR(modes[1].statistics.rms_mm, 12, 1e-9);
  const std::vector<TimelineGroup> sensors = by_sensor(example(), {"far", "near", "spare"});
  ASSERT_EQ(sensors.size(), 2U);
  EXPECT_EQ(sensors[1].name, "near");
  EXPECT_EQ(sensors[1].statistics.frames, 3U);
  const std::vector<TimelineGroup> parts = by_part(example(), {"whole", "wing", "bay"});
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[1].name, "bay");
  EXPECT_EQ(parts[1].statistics.frames, 2U);
}

TEST(Timeline, TellsEachChangeOfTheSensor) {
  VERIFIES("LASSO-GND-026~1");
  const std::vector<SensorChange> changes = sensor_changes(example());
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0].t_s, 1);
  EXPECT_EQ(changes[0].range_m, 11);
  EXPECT_EQ(changes[0].from, 0);
  EXPECT_EQ(changes[0].to, 1);
  EXPECT_EQ(changes[0].reason, SensorReason::kSubstitute);
  EXPECT_EQ(changes[1].to, 0);
  EXPECT_TRUE(sensor_changes(Timeline{}).empty());
}

}  // namespace
}  // namespace lasso::mdat
