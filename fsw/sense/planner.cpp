#include "fsw/sense/planner.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/sense/pattern.hpp"

namespace lasso {
namespace {

constexpr double kNearestDepthM = 1e-3;  // hull points nearer to the sensor's plane than this have no useful projection

struct Interval {
  double low = 1e30, high = -1e30;

  bool empty() const { return !(low < high); }
  double middle() const { return 0.5 * (low + high); }
  double half() const { return 0.5 * (high - low); }
  void include(double value) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
};

struct Rectangle {
  Interval x, y;
};

Rectangle project(Span<const HullPoint> hull, const Pose& T_sensor_target) {
  const Mat3 R = to_matrix(T_sensor_target.q);
  Rectangle rectangle;
  for (const HullPoint& point : hull) {
    const Vec3 target(static_cast<double>(point.p[0]), static_cast<double>(point.p[1]), static_cast<double>(point.p[2]));
    const Vec3 seen = R * target + T_sensor_target.p;
    if (seen.z() < kNearestDepthM) continue;
    rectangle.x.include(seen.x() / seen.z());
    rectangle.y.include(seen.y() / seen.z());
  }
  return rectangle;
}

// Of the grid that an interval's ends are rounded to: the largest power of two that is at most this share of its half.
constexpr double kGridShare = 1.0 / 32;
constexpr double kFinestGrid = 1.0 / (1 << 24);

// Loop bound: the powers of two from 1 to kFinestGrid.
double grid_of(double half) {
  double step = 1;
  while (step > kFinestGrid && step > kGridShare * half) step *= 0.5;
  return step;
}

double rounded(double x, double step) {
  const double steps = (x < 0 ? -x : x) / step + 0.5;
  const double whole = step * (steps - fractional_part(steps));
  return x < 0 ? -whole : whole;
}

Interval on_grid(const Interval& exact) {
  const double step = grid_of(exact.half());
  return {rounded(exact.low, step), rounded(exact.high, step)};
}

Interval fit(const Interval& seen, double margin, double uncertainty, double fov_half_rad) {
  const double limit = tangent(fov_half_rad);
  const double half = margin * seen.half() + uncertainty;
  Interval fitted = on_grid({seen.middle() - half, seen.middle() + half});
  if (fitted.low < -limit) fitted.low = -limit;
  if (fitted.high > limit) fitted.high = limit;
  return fitted;
}

ScanPlan pattern_of_mission(const MissionParameters& parameters, std::uint32_t scan_id) {
  ScanPlan plan;
  plan.scan_id = scan_id;
  plan.kind = static_cast<PatternKind>(static_cast<std::uint8_t>(parameters.pattern));
  plan.points = static_cast<std::uint16_t>(parameters.points);
  plan.cycles_a = static_cast<std::uint16_t>(parameters.cycles_a);
  plan.cycles_b = static_cast<std::uint16_t>(parameters.cycles_b);
  plan.phase_turns = fractional_part(scan_id * parameters.phase_step_turns);
  plan.duration_us = static_cast<DurationUs>(parameters.duration_s * 1e6 + 0.5);
  return plan;
}

void lay(ScanPlan& plan, const Interval& x, const Interval& y) {
  plan.center_x = x.middle();
  plan.center_y = y.middle();
  plan.half_x = x.half();
  plan.half_y = y.half();
}

Status check_pose(const Pose& pose) {
  for (int i = 0; i < 3; ++i) {
    if (!is_finite(pose.p[i]) || !is_finite(pose.q.coeffs()[i])) return Status::kNotFinite;
  }
  if (!is_finite(pose.q.w())) return Status::kNotFinite;
  return is_valid(pose) ? Status::kOk : Status::kBadValue;
}

}  // namespace

Status plan_scan(const MissionParameters& parameters, const TargetOutline& target, const Pose& T_sensor_target, std::uint32_t scan_id,
                 ScanPlan& plan) {
  const Status pose_status = check_pose(T_sensor_target);
  if (pose_status != Status::kOk) return pose_status;
  if (target.hull.empty()) return Status::kNoData;
  const Vec3 center = T_sensor_target * target.center_m;
  if (!(center.z() > kNearestDepthM)) return Status::kBadValue;

  const Rectangle seen = project(target.hull, T_sensor_target);
  if (seen.x.empty() || seen.y.empty()) return Status::kBadValue;
  const double uncertainty = target.uncertainty_m / center.z();
  const Interval x = fit(seen.x, parameters.margin, uncertainty, parameters.fov_half_x_rad);
  const Interval y = fit(seen.y, parameters.margin, uncertainty, parameters.fov_half_y_rad);
  if (x.empty() || y.empty()) return Status::kBadValue;

  ScanPlan candidate = pattern_of_mission(parameters, scan_id);
  lay(candidate, x, y);
  const Status status = validate(candidate);
  if (status == Status::kOk) plan = candidate;
  return status;
}

Status plan_full_field(const MissionParameters& parameters, std::uint32_t scan_id, ScanPlan& plan) {
  const double half_x = tangent(parameters.fov_half_x_rad);
  const double half_y = tangent(parameters.fov_half_y_rad);
  ScanPlan candidate = pattern_of_mission(parameters, scan_id);
  lay(candidate, {-half_x, half_x}, {-half_y, half_y});
  const Status status = validate(candidate);
  if (status == Status::kOk) plan = candidate;
  return status;
}

}  // namespace lasso
