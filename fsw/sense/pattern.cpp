#include "fsw/sense/pattern.hpp"

#include "cfg/capacities.hpp"
#include "fsw/core/invariant.hpp"

namespace lasso {
namespace {

struct SquarePoint {
  double x, y;
};

double absolute(double x) { return x < 0 ? -x : x; }

bool coprime(std::uint32_t a, std::uint32_t b) {
  while (b != 0) {
    const std::uint32_t rest = a % b;
    a = b;
    b = rest;
  }
  return a == 1;
}

bool is_aimed(const ScanPlan& plan, std::uint16_t index) {
  return index >= first_aimed(plan) && index < first_aimed(plan) + plan.aimed.size();
}

// Of a ray that is not aimed, among those of the pattern.
std::uint16_t index_in_pattern(const ScanPlan& plan, std::uint16_t index) {
  return static_cast<std::uint16_t>(index < first_aimed(plan) ? index : index - plan.aimed.size());
}

// Whole turns are dropped in integers, so that the angle is small and exact for every index.
SinCos turn(std::uint16_t cycles, std::uint16_t index, std::uint16_t points, double phase_turns) {
  const std::uint32_t part = std::uint32_t{cycles} * index % points;
  return sin_cos(2 * kPi * (static_cast<double>(part) / static_cast<double>(points) + phase_turns));
}

SinCos add_angles(const SinCos& u, const SinCos& v) { return {u.sin * v.cos + u.cos * v.sin, u.cos * v.cos - u.sin * v.sin}; }

SquarePoint curve_point(PatternKind kind, const SinCos& a, const SinCos& b) {
  if (kind == PatternKind::kRosette) return {0.5 * (a.cos + b.cos), 0.5 * (a.sin - b.sin)};
  return {a.sin, b.sin};
}

SquarePoint raster_point(const ScanPlan& plan, std::uint16_t index) {
  const double path_lines = (index + plan.phase_turns) * plan.cycles_a / pattern_points(plan);  // [0, lines)
  std::int32_t line = static_cast<std::int32_t>(path_lines);
  if (line == plan.cycles_a) --line;  // a phase just below 1 can round up to the path's end
  const double forward = 2 * (path_lines - line) - 1;
  return {line % 2 == 0 ? forward : -forward, (2.0 * line + 1) / plan.cycles_a - 1};
}

Vec3 through(double x, double y) {
  const double scale = 1 / square_root(x * x + y * y + 1);
  return {x * scale, y * scale, scale};
}

Vec3 direction(const ScanPlan& plan, const SquarePoint& point) {
  return through(plan.center_x + plan.half_x * point.x, plan.center_y + plan.half_y * point.y);
}

Vec3 aimed_direction(const ScanPlan& plan, std::uint16_t index) {
  const AimedRay& ray = plan.aimed[static_cast<std::size_t>(index - first_aimed(plan))];
  return through(static_cast<double>(ray.x), static_cast<double>(ray.y));
}

bool cycles_valid(const ScanPlan& plan) {
  const std::uint16_t most = static_cast<std::uint16_t>(pattern_points(plan) / 2);
  if (plan.cycles_a < 1 || plan.cycles_a > most) return false;
  if (plan.kind == PatternKind::kRaster) return true;
  if (plan.cycles_b < 1 || plan.cycles_b > most || plan.cycles_a == plan.cycles_b) return false;
  return coprime(plan.cycles_a, plan.cycles_b);
}

bool within(double tangent) { return absolute(tangent) <= kMaxTangent; }

bool extent_valid(double center, double half) { return half > 0 && absolute(center) + half <= kMaxTangent; }

// Also false for what is not a number.
bool aim_valid(const ScanPlan& plan) {
  bool ok = plan.aimed.size() <= kMaxAimedRays && plan.aimed.size() + kMinPatternPoints <= plan.points;
  for (const AimedRay& ray : plan.aimed) ok = ok && within(static_cast<double>(ray.x)) && within(static_cast<double>(ray.y));
  return ok;
}

bool finite(const ScanPlan& plan) {
  return is_finite(plan.phase_turns) && is_finite(plan.center_x) && is_finite(plan.center_y) && is_finite(plan.half_x) &&
         is_finite(plan.half_y);
}

}  // namespace

Status validate(const ScanPlan& plan) {
  if (!finite(plan)) return Status::kNotFinite;
  const bool known = plan.kind == PatternKind::kRosette || plan.kind == PatternKind::kLissajous || plan.kind == PatternKind::kRaster;
  const bool sized = plan.points >= kMinPatternPoints && plan.points <= kMaxRays;
  const bool timed = plan.duration_us >= 1 && plan.duration_us <= kMaxScanDurationUs;
  const bool turned = plan.phase_turns >= 0 && plan.phase_turns < 1;
  const bool placed = extent_valid(plan.center_x, plan.half_x) && extent_valid(plan.center_y, plan.half_y);
  return known && sized && timed && turned && placed && aim_valid(plan) && cycles_valid(plan) ? Status::kOk : Status::kBadValue;
}

std::uint16_t pattern_points(const ScanPlan& plan) { return static_cast<std::uint16_t>(plan.points - plan.aimed.size()); }

std::uint16_t first_aimed(const ScanPlan& plan) { return static_cast<std::uint16_t>(pattern_points(plan) / 2); }

Vec3 pattern_direction(const ScanPlan& plan, std::uint16_t ray) {
  invariant(ray < plan.points, "pattern index");
  if (is_aimed(plan, ray)) return aimed_direction(plan, ray);
  const std::uint16_t index = index_in_pattern(plan, ray);
  if (plan.kind == PatternKind::kRaster) return direction(plan, raster_point(plan, index));
  const SinCos a = turn(plan.cycles_a, index, pattern_points(plan), plan.phase_turns);
  const SinCos b = turn(plan.cycles_b, index, pattern_points(plan), 0);
  return direction(plan, curve_point(plan.kind, a, b));
}

// duration_us * index / steps, rounded down, in parts that 32 bits hold: the 603e divides those by one instruction.
DurationUs pattern_time_us(const ScanPlan& plan, std::uint16_t index) {
  invariant(index < plan.points, "pattern index");
  const auto duration_us = static_cast<std::uint32_t>(plan.duration_us);
  const std::uint32_t steps = plan.points - 1U;
  return duration_us / steps * index + duration_us % steps * index / steps;
}
static_assert(kMaxScanDurationUs <= 0xFFFFFFFF, "a valid scan's duration fits 32 bits");

PatternGenerator::PatternGenerator(const ScanPlan& plan)
    : plan_(plan),
      a_(turn(plan.cycles_a, 0, pattern_points(plan), plan.phase_turns)),
      b_(turn(plan.cycles_b, 0, pattern_points(plan), 0)),
      step_a_(turn(plan.cycles_a, 1, pattern_points(plan), 0)),
      step_b_(turn(plan.cycles_b, 1, pattern_points(plan), 0)) {}

Vec3 PatternGenerator::next() {
  invariant(!done(), "pattern has no more rays");
  const std::uint16_t ray = index_++;
  if (is_aimed(plan_, ray)) return aimed_direction(plan_, ray);
  const std::uint16_t index = index_in_pattern(plan_, ray);
  if (plan_.kind == PatternKind::kRaster) return direction(plan_, raster_point(plan_, index));
  const SquarePoint point = curve_point(plan_.kind, a_, b_);
  a_ = add_angles(a_, step_a_);
  b_ = add_angles(b_, step_b_);
  return direction(plan_, point);
}

}  // namespace lasso
