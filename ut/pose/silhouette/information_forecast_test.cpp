#include "fsw/pose/silhouette/information_forecast.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "ut/pose/pose_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

class OutlookTest : public test::PoseFixture {
 protected:
  OutlookTest() { parameters().surface_sigma_m = 1e-9; }

  View<FlightNumber> view() const { return make_view(mission_, truth()); }

  // The truth: how the range along a ray that is fixed in the sensor changes with a step of the target, by differences.
  static Vec6 gradient(const Pose& T_target_sensor, const Vec3& u) {
    constexpr double kStep = 1e-6;
    Vec6 g;
    for (int i = 0; i < 6; ++i) {
      Vec6 step = Vec6::Zero();
      step[i] = kStep;
      const Pose up = step_pose(T_target_sensor, step);
      const Pose down = step_pose(T_target_sensor, -step);
      g[i] = (test::cast_box({}, up.p, rotate(up.q, u)) - test::cast_box({}, down.p, rotate(down.q, u))) / (2 * kStep);
    }
    return g;
  }
};

TEST_F(OutlookTest, TellsWhatTheReturnsOfAScanWould) {
  const ScanRectangle r = outline_of(mission_, view());
  const InformationForecast forecast = forecast_information(mission_, view(), r, 960);
  Mat6 expected = Mat6::Zero();
  int met = 0;
  for (int i = 0; i < kForecastRays; ++i) {
    const int column = i % kForecastColumns;
    const int row = i / kForecastColumns;
    const double x = static_cast<double>(r.low[0]) + (column + 0.5) / kForecastColumns * static_cast<double>(r.high[0] - r.low[0]);
    const double y = static_cast<double>(r.low[1]) + (row + 0.5) / kForecastRows * static_cast<double>(r.high[1] - r.low[1]);
    const Vec3 u = Vec3(x, y, 1).normalized();
    if (test::cast_box({}, truth().p, rotate(truth().q, u)) < 0) continue;
    ++met;
    const Vec6 g = gradient(truth(), u);
    expected += 10 * g * g.transpose() / 1e-6;
  }
  EXPECT_EQ(forecast.met, met);
  EXPECT_GT(met, kForecastRays / 3);
  EXPECT_LT(met, kForecastRays);
  EXPECT_LT((forecast.information - expected).norm(), 1e-3 * expected.norm());
}

TEST_F(OutlookTest, GrazingRaysMeetTheModelAndTellNothing) {
  parameters().incidence_max_rad = 45 * kRadPerDeg;
  const InformationForecast all = forecast_information(mission_, view(), outline_of(mission_, view()), 96);
  parameters().incidence_max_rad = 1e-3;
  const InformationForecast none = forecast_information(mission_, view(), outline_of(mission_, view()), 96);
  EXPECT_EQ(all.met, none.met);
  EXPECT_GT(all.information.norm(), 0);
  EXPECT_EQ(none.information.norm(), 0);
}

TEST_F(OutlookTest, MeetsNothingBesideTheModel) {
  ScanRectangle beside;
  beside.low[0] = beside.low[1] = 0.6F;
  beside.high[0] = beside.high[1] = 0.7F;
  EXPECT_EQ(forecast_information(mission_, view(), beside, 96).met, 0);
  scan_.T_sensor_target.p.z() = 1e6;  // so far that no cell can be named
  EXPECT_EQ(forecast_information(mission_, view(), beside, 96).met, 0);
}

TEST_F(OutlookTest, IsCutAtTheFieldOfView) {
  const ScanRectangle whole = visible_outline(mission_, view());
  EXPECT_EQ(whole.low[0], outline_of(mission_, view()).low[0]);
  EXPECT_EQ(whole.high[1], outline_of(mission_, view()).high[1]);
  parameters().fov_half_x_rad = 0.05;
  parameters().fov_half_y_rad = 0.04;
  const ScanRectangle cut = visible_outline(mission_, view());
  EXPECT_NEAR(static_cast<double>(cut.low[0]), -0.05, 1e-4);
  EXPECT_NEAR(static_cast<double>(cut.high[0]), 0.05, 1e-4);
  EXPECT_NEAR(static_cast<double>(cut.low[1]), -0.04, 1e-4);
  EXPECT_NEAR(static_cast<double>(cut.high[1]), 0.04, 1e-4);
  scan_.T_sensor_target.p.x() = 2;  // outside
  const ScanRectangle outside = visible_outline(mission_, view());
  EXPECT_GT(outside.low[0], outside.high[0]);
}

// The sensor stands within the box's grid, which reaches beyond the box.
TEST_F(OutlookTest, WhatLiesBehindTheSensorIsNotMet) {
  ScanRectangle ahead;
  ahead.low[0] = ahead.low[1] = -0.05F;
  ahead.high[0] = ahead.high[1] = 0.05F;
  scan_.T_sensor_target.q = Quat::Identity();
  scan_.T_sensor_target.p = Vec3(0, 0, -0.25);  // all of it 0.1 m or more behind the sensor
  EXPECT_EQ(forecast_information(mission_, view(), ahead, 96).met, 0);
  scan_.T_sensor_target.p = Vec3(0, 0, 0.25);
  EXPECT_EQ(forecast_information(mission_, view(), ahead, 96).met, kForecastRays);
}

TEST_F(OutlookTest, PointsBehindTheSensorHaveNoPlace) {
  scan_.T_sensor_target.p = Vec3(0, 0, -3);
  const ScanRectangle nowhere = outline_of(mission_, view());
  EXPECT_GT(nowhere.low[0], nowhere.high[0]);
}

}  // namespace
}  // namespace lasso
