#include "mdat/run/flight_figures.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

constexpr TimeUs kFirstUs = 1'100'000, kStepUs = 200'000;

// Off by (3, 4, 0) mm times `factor`; each covariance is that of 5 mm and 0.01 rad.
PoseTelemetry pose_off(std::size_t frame, double factor) {
  PoseTelemetry pose;
  pose.t_measurement_us = kFirstUs + static_cast<TimeUs>(frame) * kStepUs;
  pose.valid = 1;
  pose.rms_m = 0.002F;
  pose.p_sensor_target_m[0] = 1 + 0.003 * factor;
  pose.p_sensor_target_m[1] = 2 + 0.004 * factor;
  pose.p_sensor_target_m[2] = 3;
  for (int i = 0; i < 3; ++i) pose.filter_p_sensor_target_m[i] = pose.p_sensor_target_m[i];
  constexpr std::size_t kDiagonal[] = {0, 6, 11, 15, 18, 20};
  for (std::size_t i = 0; i < 6; ++i) pose.covariance[kDiagonal[i]] = i < 3 ? 1e-4 : 25e-6;
  for (int i = 0; i < 6; ++i) pose.filter_sigma_pose[i] = i < 3 ? 0.01F : 0.005F;
  return pose;
}

Pose truth_at(TimeUs) { return {Quat::Identity(), Vec3(1, 2, 3)}; }

TEST(FlightFigures, AreThoseOfValidPoses) {
  VERIFIES("LASSO-REC-022~1");
  std::vector<PoseTelemetry> poses = {pose_off(0, 1), pose_off(1, -2), pose_off(2, 500)};
  poses[2].valid = 0;
  poses[1].changes = 2;
  const FlightFigures figures = flight_figures(poses, truth_at);
  EXPECT_EQ(figures.poses, 3U);
  EXPECT_EQ(figures.valid, 2U);
  EXPECT_EQ(figures.wrong, 0U);
  EXPECT_EQ(figures.mode_changes, 2U);
  EXPECT_NEAR(figures.rms_mm.value_or(0), std::sqrt((25.0 + 100.0) / 2), 1e-9);
  EXPECT_NEAR(figures.rms_deg.value_or(1), 0, 1e-12);
  EXPECT_NEAR(figures.nees.value_or(0), (1.0 + 4.0) / 2, 1e-9) << "(5 mm / 5 mm) squared, and twice that off";
  EXPECT_NEAR(figures.residual_mm, 2, 1e-6);
  ASSERT_TRUE(figures.worst);
  EXPECT_NEAR(figures.worst->translation_m.norm(), 0.010, 1e-12);
  poses[2].valid = 1;
  EXPECT_EQ(flight_figures(poses, truth_at).wrong, 1U) << "2.5 m off, by its covariance 5 mm";
}

TEST(FlightFigures, WithoutATruthNothingIsSaidOfErrors) {
  VERIFIES("LASSO-REC-022~1");
  const FlightFigures figures = flight_figures({pose_off(0, 1)}, {});
  EXPECT_EQ(figures.valid, 1U);
  EXPECT_FALSE(figures.wrong || figures.rms_mm || figures.rms_deg || figures.nees || figures.worst);
  EXPECT_FALSE(flight_figures({}, truth_at).rms_mm) << "of no pose";
  const std::string table = side_by_side("before", figures, "after", flight_figures({pose_off(0, 1)}, truth_at));
  EXPECT_NE(table.find("before        after\n"), std::string::npos) << table;
  EXPECT_NE(table.find("rms, mm                           -        5.000\n"), std::string::npos) << table;
}

TEST(FlightFigures, TheFirstDifferenceIsOfAnyBitOfAPose) {
  VERIFIES("LASSO-REC-022~1");
  const std::vector<PoseTelemetry> flown = {pose_off(0, 1), pose_off(1, 1), pose_off(2, 1)};
  EXPECT_FALSE(first_difference(flown, flown));
  const auto differs_by = [&](void (*change)(PoseTelemetry&)) {
    std::vector<PoseTelemetry> other = flown;
    change(other[1]);
    return first_difference(flown, other) == kFirstUs + kStepUs;
  };
  EXPECT_TRUE(differs_by([](PoseTelemetry& pose) { pose.valid = 0; }));
  EXPECT_TRUE(differs_by([](PoseTelemetry& pose) { pose.mode = 3; }));
  EXPECT_TRUE(differs_by([](PoseTelemetry& pose) { pose.covariance[20] = std::nextafter(pose.covariance[20], 1); }));
  EXPECT_TRUE(differs_by([](PoseTelemetry& pose) { pose.filter_v_mps[2] = 1e-300; }));
  EXPECT_FALSE(differs_by([](PoseTelemetry& pose) { pose.image_crc = 5; })) << "which says nothing of the pose";
}

TEST(FlightFigures, AFlightThatEndsEarlierDiffersThere) {
  VERIFIES("LASSO-REC-022~1");
  const std::vector<PoseTelemetry> flown = {pose_off(0, 1), pose_off(1, 1)};
  EXPECT_EQ(first_difference(flown, {flown[0]}), kFirstUs + kStepUs);
  EXPECT_EQ(first_difference({flown[1]}, flown), kFirstUs) << "the first has no pose of it";
}

}  // namespace
}  // namespace lasso::mdat
