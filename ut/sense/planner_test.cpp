#include "fsw/sense/planner.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fsw/sense/pattern.hpp"
#include "ut/support/path_numbers.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

HullPoint hull_point(const Vec3& p) {
  HullPoint point{};
  const auto at = test::path_vector<FlightNumber::Length>(p);
  std::copy(at.begin(), at.end(), point.p);
  return point;
}

// A box with sides 1.3 x 0.4 x 0.6 m, its middle off the origin.
struct Box {
  std::vector<HullPoint> hull;
  Vec3 center{0.11, -0.05, 0.23};

  Box() {
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p = center + Vec3(corner & 1 ? 0.65 : -0.65, corner & 2 ? 0.2 : -0.2, corner & 4 ? 0.3 : -0.3);
      hull.push_back(hull_point(p));
    }
  }
  TargetOutline outline() const { return {Span<const HullPoint>(hull.data(), hull.size()), center, 0}; }
};

// The attitude through Eigen's own functions: independent of the flight code's geometry.
Pose generic_pose(const Vec3& p) {
  const Eigen::AngleAxisd turn(1.1, Eigen::Vector3d(0.3, -0.5, 0.8).normalized());
  return {Quat(turn), p};
}

struct Bounds {
  double x_low = 1e9, x_high = -1e9, y_low = 1e9, y_high = -1e9;
};

Bounds brute_force_bounds(const Box& box, const Pose& pose) {
  Bounds bounds;
  for (const HullPoint& h : box.hull) {
    const Eigen::Vector3d seen =
        pose.q.toRotationMatrix() * Eigen::Vector3d(static_cast<double>(h.p[0]), static_cast<double>(h.p[1]), static_cast<double>(h.p[2])) +
        pose.p;
    bounds.x_low = std::min(bounds.x_low, seen.x() / seen.z());
    bounds.x_high = std::max(bounds.x_high, seen.x() / seen.z());
    bounds.y_low = std::min(bounds.y_low, seen.y() / seen.z());
    bounds.y_high = std::max(bounds.y_high, seen.y() / seen.z());
  }
  return bounds;
}

Status plan_box(const MissionParameters& parameters, const Pose& pose, ScanPlan& plan, std::uint32_t scan_id = 1) {
  const Box box;
  return plan_scan(parameters, box.outline(), pose, scan_id, plan);
}

TEST(Planner, FitsTheRectangleAroundTheTarget) {
  VERIFIES("LASSO-SNS-010~2");
  const Box box;
  const Pose pose = generic_pose({0.2, -0.3, 5});
  MissionParameters parameters = preset_parameters();
  for (const double margin : {1.0, 1.2}) {
    parameters.margin = margin;
    ScanPlan plan;
    ASSERT_EQ(plan_box(parameters, pose, plan), Status::kOk);
    const Bounds bounds = brute_force_bounds(box, pose);
    const double half_x = margin * (bounds.x_high - bounds.x_low) / 2, half_y = margin * (bounds.y_high - bounds.y_low) / 2;
    EXPECT_NEAR(plan.center_x, (bounds.x_low + bounds.x_high) / 2, half_x / 64);  // ends at the nearest of a grid
    EXPECT_NEAR(plan.center_y, (bounds.y_low + bounds.y_high) / 2, half_y / 64);
    EXPECT_NEAR(plan.half_x, half_x, half_x / 64);
    EXPECT_NEAR(plan.half_y, half_y, half_y / 64);
  }
}

TEST(Planner, ReachesFartherForAnUncertainTarget) {
  VERIFIES("LASSO-SNS-010~2");
  const Box box;
  const Pose pose = generic_pose({0.1, -0.2, 6});
  ScanPlan sure;
  ASSERT_EQ(plan_box(preset_parameters(), pose, sure), Status::kOk);
  TargetOutline outline = box.outline();
  outline.uncertainty_m = 0.3;
  ScanPlan unsure;
  ASSERT_EQ(plan_scan(preset_parameters(), outline, pose, 1, unsure), Status::kOk);
  const double widening = 0.3 / (pose * box.center).z();
  EXPECT_NEAR(unsure.half_x, sure.half_x + widening, unsure.half_x / 32);
  EXPECT_NEAR(unsure.half_y, sure.half_y + widening, unsure.half_y / 32);
  EXPECT_NEAR(unsure.center_x, sure.center_x, unsure.half_x / 32);
}

// A grid that is a power of two, 1/64 to 1/32 of the extents: the same scan for predictions that differ by a millionth, but for few.
TEST(Planner, PredictionsThatHardlyDifferHaveOneScan) {
  VERIFIES("LASSO-SNS-010~2");
  const Box box;
  int same = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 place(-0.3 + 0.003 * i, 0.2 - 0.0017 * i, 8 + 0.31 * i);
    ScanPlan plan, moved;
    ASSERT_EQ(plan_box(preset_parameters(), generic_pose(place), plan), Status::kOk);
    ASSERT_EQ(plan_box(preset_parameters(), generic_pose(place + Vec3(1e-6, -1e-6, 1e-6)), moved), Status::kOk);
    same +=
        plan.center_x == moved.center_x && plan.half_x == moved.half_x && plan.center_y == moved.center_y && plan.half_y == moved.half_y;
    const double low = plan.center_x - plan.half_x;
    int exponent = 0;
    std::frexp(plan.half_x / 32, &exponent);
    const double step = std::ldexp(1.0, exponent - 2);  // or twice that
    EXPECT_EQ(low / step, std::floor(low / step)) << i;
  }
  EXPECT_GE(same, 195);
}

TEST(Planner, TheFinestGridServesTheFarthestTarget) {
  VERIFIES("LASSO-SNS-010~2");
  const Box box;
  ScanPlan plan;
  ASSERT_EQ(plan_box(preset_parameters(), generic_pose({0, 0, 1e6}), plan), Status::kOk);
  EXPECT_GT(plan.half_x, 0);
}

TEST(Planner, AimsAtTheGeometricCentreUpToPerspective) {
  VERIFIES("LASSO-SNS-010~2");
  const Box box;
  const Pose pose = generic_pose({0.2, -0.3, 60});
  ScanPlan plan;
  ASSERT_EQ(plan_box(preset_parameters(), pose, plan), Status::kOk);
  const Eigen::Vector3d center = pose.q.toRotationMatrix() * box.center + pose.p;
  EXPECT_NEAR(plan.center_x, center.x() / center.z(), 0.01 * plan.half_x);
  EXPECT_NEAR(plan.center_y, center.y() / center.z(), 0.01 * plan.half_y);
}

TEST(Planner, TakesThePatternFromTheMission) {
  VERIFIES("LASSO-SNS-011~1");
  MissionParameters parameters = preset_parameters();
  parameters.pattern = 1;
  parameters.points = 512;
  parameters.cycles_a = 17;
  parameters.cycles_b = 23;
  parameters.duration_s = 0.25;
  ScanPlan plan;
  ASSERT_EQ(plan_box(parameters, generic_pose({0, 0, 5}), plan, 77), Status::kOk);
  EXPECT_EQ(plan.scan_id, 77u);
  EXPECT_EQ(plan.kind, PatternKind::kLissajous);
  EXPECT_EQ(plan.points, 512);
  EXPECT_EQ(plan.cycles_a, 17);
  EXPECT_EQ(plan.cycles_b, 23);
  EXPECT_EQ(plan.duration_us, 250000);
}

TEST(Planner, PhaseMovesByTheGoldenSectionAndNeverLeavesItsRange) {
  VERIFIES("LASSO-SNS-011~1");
  const MissionParameters parameters = preset_parameters();
  for (const std::uint32_t id : {0u, 1u, 2u, 3u, 1000000u, 0xFFFFFFFFu}) {
    ScanPlan plan;
    ASSERT_EQ(plan_box(parameters, generic_pose({0, 0, 5}), plan, id), Status::kOk);
    const double turns = id * parameters.phase_step_turns;
    EXPECT_NEAR(plan.phase_turns, turns - std::floor(turns), 1e-12);
    EXPECT_GE(plan.phase_turns, 0);
    EXPECT_LT(plan.phase_turns, 1);
  }
}

TEST(Planner, CutsATargetLargerThanTheFieldOfViewAlikeOnBothSides) {
  VERIFIES("LASSO-SNS-012~1");
  MissionParameters parameters = preset_parameters();
  parameters.fov_half_x_rad = 0.1;
  parameters.fov_half_y_rad = 0.07;
  ScanPlan plan;
  ASSERT_EQ(plan_box(parameters, generic_pose({0.0, -0.1, 1.2}), plan), Status::kOk);
  EXPECT_NEAR(plan.center_x, 0, 1e-15);
  EXPECT_NEAR(plan.center_y, 0, 1e-15);
  EXPECT_NEAR(plan.half_x, std::tan(0.1), 1e-14);
  EXPECT_NEAR(plan.half_y, std::tan(0.07), 1e-14);
}

TEST(Planner, ScansThePartThatCanBeSeen) {
  VERIFIES("LASSO-SNS-012~1");
  const Box box;
  const MissionParameters parameters = preset_parameters();
  const Pose pose = generic_pose({1.3, 0.2, 5});
  const Bounds bounds = brute_force_bounds(box, pose);
  const double limit = std::tan(parameters.fov_half_x_rad);
  ASSERT_LT(bounds.x_low, limit);
  ASSERT_GT(bounds.x_high, limit);
  ScanPlan plan;
  ASSERT_EQ(plan_box(parameters, pose, plan), Status::kOk);
  EXPECT_NEAR(plan.center_x + plan.half_x, limit, 1e-12);
  EXPECT_NEAR(plan.center_x - plan.half_x, bounds.x_low, plan.half_x / 32);
}

TEST(Planner, HullPointsBehindTheSensorAreLeftOut) {
  VERIFIES("LASSO-SNS-012~1");
  std::vector<HullPoint> hull = {hull_point({0.1, 0.2, 0}), hull_point({-0.1, -0.1, 0}), hull_point({0.5, 0.5, -9})};
  const Pose pose{Quat(1, 0, 0, 0), Vec3(0, 0, 4)};
  ScanPlan plan;
  ASSERT_EQ(plan_scan(preset_parameters(), {Span<const HullPoint>(hull.data(), hull.size()), Vec3::Zero()}, pose, 1, plan), Status::kOk);
  EXPECT_NEAR(plan.half_x, 0.025, 0.025 / 64);
  EXPECT_NEAR(plan.center_y, 0.0125, 0.0375 / 64);
}

TEST(Planner, RefusesWhatCannotBeScannedAndLeavesThePlan) {
  VERIFIES("LASSO-SNS-013~1");
  const MissionParameters parameters = preset_parameters();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ScanPlan plan;
  plan.scan_id = 4711;
  EXPECT_EQ(plan_box(parameters, generic_pose({0, 0, -5}), plan), Status::kBadValue);
  EXPECT_EQ(plan_box(parameters, generic_pose({4, 0, 5}), plan), Status::kBadValue);
  EXPECT_EQ(plan_box(parameters, generic_pose({0, -4, 5}), plan), Status::kBadValue);
  EXPECT_EQ(plan_box(parameters, generic_pose({0, nan, 5}), plan), Status::kNotFinite);
  EXPECT_EQ(plan_box(parameters, Pose{Quat(nan, 0, 0, 0), Vec3(0, 0, 5)}, plan), Status::kNotFinite);
  EXPECT_EQ(plan_box(parameters, Pose{Quat(0, nan, 0, 0), Vec3(0, 0, 5)}, plan), Status::kNotFinite);
  EXPECT_EQ(plan_box(parameters, Pose{Quat(2, 0, 0, 0), Vec3(0, 0, 5)}, plan), Status::kBadValue);
  EXPECT_EQ(plan_scan(parameters, TargetOutline{}, generic_pose({0, 0, 5}), 1, plan), Status::kNoData);
  EXPECT_EQ(plan.scan_id, 4711u);
}

// What lies behind a pose is none of it.
TEST(Planner, APoseIsJudgedByItsOwnNumbers) {
  VERIFIES("LASSO-SNS-013~1");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Pose poses[] = {generic_pose({0, 0, 5}), Pose{Quat(nan, nan, nan, nan), Vec3(0, 0, 5)}};
  ScanPlan plan;
  EXPECT_EQ(plan_box(preset_parameters(), poses[0], plan), Status::kOk);
}

TEST(Planner, RefusesAHullThatHasNoExtentOrLiesBehind) {
  VERIFIES("LASSO-SNS-013~1");
  const Pose pose = generic_pose({0, 0, 5});
  const Pose ahead{Quat(1, 0, 0, 0), Vec3(0, 0, 5)};
  const HullPoint one[] = {hull_point({0.1, 0.1, 0.1})};
  const HullPoint behind[] = {hull_point({0.1, 0.1, -9}), hull_point({-0.1, -0.1, -9})};
  const HullPoint line[] = {hull_point({0.1, 0, 0}), hull_point({-0.1, 0, 0})};
  ScanPlan plan;
  EXPECT_EQ(plan_scan(preset_parameters(), {Span<const HullPoint>(one), Vec3::Zero()}, pose, 1, plan), Status::kBadValue);
  EXPECT_EQ(plan_scan(preset_parameters(), {Span<const HullPoint>(behind), Vec3::Zero()}, ahead, 1, plan), Status::kBadValue);
  EXPECT_EQ(plan_scan(preset_parameters(), {Span<const HullPoint>(line), Vec3::Zero()}, ahead, 1, plan), Status::kBadValue);
}

TEST(Planner, RefusesAMissionWhoseCurveDoesNotClose) {
  VERIFIES("LASSO-SNS-013~1");
  MissionParameters parameters = preset_parameters();
  parameters.cycles_a = 18;
  parameters.cycles_b = 12;
  ScanPlan plan;
  EXPECT_EQ(plan_box(parameters, generic_pose({0, 0, 5}), plan), Status::kBadValue);
}

TEST(Planner, AFullFieldScanFillsTheFieldOfView) {
  VERIFIES("LASSO-MOD-101~3");
  MissionParameters p = preset_parameters();
  p.fov_half_x_rad = 0.3;
  p.fov_half_y_rad = 0.2;
  ScanPlan plan;
  ASSERT_EQ(plan_full_field(p, 5, plan), Status::kOk);
  EXPECT_NEAR(plan.center_x, 0, 1e-15);
  EXPECT_NEAR(plan.center_y, 0, 1e-15);
  EXPECT_NEAR(plan.half_x, std::tan(0.3), 1e-12);
  EXPECT_NEAR(plan.half_y, std::tan(0.2), 1e-12);
  EXPECT_EQ(plan.points, 1024);
  EXPECT_EQ(plan.scan_id, 5u);
  EXPECT_NEAR(plan.phase_turns, std::fmod(5 * p.phase_step_turns, 1), 1e-12);
  p.cycles_a = p.cycles_b;
  EXPECT_EQ(plan_full_field(p, 6, plan), Status::kBadValue);
  EXPECT_EQ(plan.scan_id, 5u);
}

}  // namespace
}  // namespace lasso
