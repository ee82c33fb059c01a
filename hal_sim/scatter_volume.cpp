#include "hal_sim/scatter_volume.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fsw/geometry/portable_math.hpp"

namespace lasso::sim {
namespace {

constexpr double kEndless_m = std::numeric_limits<double>::infinity();

struct Interval {
  double from_m = 0, to_m = kEndless_m;
  bool is_empty() const { return !(from_m < to_m); }
  Interval with(double from, double to) const { return {std::max(from_m, from), std::min(to_m, to)}; }
};
constexpr Interval kNowhere{0, 0};

// Where a ray is within `radius_m` of the origin.
Interval within_sphere(const Vec3& origin, const Vec3& direction, double radius_m) {
  const double middle_m = -origin.dot(direction);
  const double half2 = radius_m * radius_m - (origin + middle_m * direction).squaredNorm();
  if (half2 <= 0) return kNowhere;
  const double half_m = std::sqrt(half2);
  return Interval{}.with(middle_m - half_m, middle_m + half_m);
}

// Where it is in the endless cone along z: z^2 >= cos^2 r^2, z > 0.
Interval within_cone(const Vec3& origin, const Vec3& direction, double half_angle_rad) {
  const double c = sin_cos(half_angle_rad).cos, c2 = c * c;
  const double a = direction.z() * direction.z() - c2, b = origin.z() * direction.z() - c2 * origin.dot(direction);
  const double q = origin.z() * origin.z() - c2 * origin.squaredNorm();
  const double root2 = b * b - a * q;
  if (a == 0 || root2 <= 0) return a > 0 && direction.z() > 0 ? Interval{}.with(-b / a, kEndless_m) : kNowhere;
  const double root = std::sqrt(root2), low = std::min((-b - root) / a, (-b + root) / a), high = std::max((-b - root) / a, (-b + root) / a);
  if (a > 0) return direction.z() > 0 ? Interval{}.with(high, kEndless_m) : Interval{}.with(-kEndless_m, low);
  const bool ahead = origin.z() + (low + high) / 2 * direction.z() > 0;  // not in the cone's other half
  return ahead ? Interval{}.with(low, high) : kNowhere;
}

Interval within(const ScatterVolume& volume, const Vec3& origin, const Vec3& direction) {
  if (volume.shape == ScatterShape::kSphere) return within_sphere(origin, direction, volume.radius_m);
  const Interval reach = within_sphere(origin, direction, volume.length_m), cone = within_cone(origin, direction, volume.half_angle_rad);
  return reach.with(cone.from_m, cone.to_m);
}

// A stretch of the ray in the core, or in the thinner part, where the extinction is E core^2 / (p^2 + u^2): p the ray's distance from the
// origin, u the way from the place nearest to it.
struct Stretch {
  Interval interval;
  bool core = false;
};

class Path {
 public:
  Path(const ScatterVolume& volume, const Vec3& origin, const Vec3& direction)
      : volume_(volume), middle_m_(-origin.dot(direction)), pass_m_(std::max(1e-9, (origin + middle_m_ * direction).norm())) {
    const Interval all = within(volume, origin, direction);
    Interval core = within_sphere(origin, direction, volume.core_m);
    if (core.is_empty()) core = {all.to_m, all.to_m};
    stretches_ = {
        {{all.with(-kEndless_m, core.from_m), false}, {all.with(core.from_m, core.to_m), true}, {all.with(core.to_m, kEndless_m), false}}};
  }
  double depth_to(double range_m) const {
    double depth = 0;
    for (const Stretch& stretch : stretches_) depth += depth_of(stretch, range_m);
    return depth;
  }
  double range_at(double depth) const {
    for (const Stretch& stretch : stretches_) {
      const double own = depth_of(stretch, kEndless_m);
      if (own > 0 && depth <= own) return range_in(stretch, depth);
      depth -= own;
    }
    return -1;
  }

 private:
  double angle_rad(double range_m) const { return arc_tangent2(range_m - middle_m_, pass_m_); }
  double strength() const { return volume_.extinction_per_m * volume_.core_m * volume_.core_m / pass_m_; }
  double depth_of(const Stretch& stretch, double range_m) const {
    const double to_m = std::min(stretch.interval.to_m, range_m);
    if (!(stretch.interval.from_m < to_m)) return 0;
    if (stretch.core) return volume_.extinction_per_m * (to_m - stretch.interval.from_m);
    return strength() * (angle_rad(to_m) - angle_rad(stretch.interval.from_m));
  }
  double range_in(const Stretch& stretch, double depth) const {
    if (stretch.core) return stretch.interval.from_m + depth / volume_.extinction_per_m;
    const SinCos angle = sin_cos(angle_rad(stretch.interval.from_m) + depth / strength());
    return std::clamp(middle_m_ + pass_m_ * angle.sin / angle.cos, stretch.interval.from_m, stretch.interval.to_m);
  }

  const ScatterVolume& volume_;
  double middle_m_, pass_m_;
  std::array<Stretch, 3> stretches_;
};

bool is_inside(const ScatterVolume& volume, const Vec3& place_m) {
  const double r = place_m.norm();
  if (volume.shape == ScatterShape::kSphere) return r <= volume.radius_m;
  return r <= volume.length_m && place_m.z() >= r * sin_cos(volume.half_angle_rad).cos;
}

double density(const ScatterVolume& volume, const Vec3& place_m) {
  const double r = place_m.norm(), thinner = r <= volume.core_m ? 1 : volume.core_m / r;
  return volume.extinction_per_m * thinner * thinner;
}

}  // namespace

double extinction_per_m(const ScatterVolume& volume, const Vec3& place_m) {
  return is_inside(volume, place_m) ? density(volume, place_m) : 0;
}

double optical_depth(const ScatterVolume& volume, const Vec3& origin_m, const Vec3& direction, double range_m) {
  return Path(volume, origin_m, direction).depth_to(range_m);
}

double range_of_depth(const ScatterVolume& volume, const Vec3& origin_m, const Vec3& direction, double depth) {
  return Path(volume, origin_m, direction).range_at(depth);
}

double volume_backscatter(const ScatterVolume& volume, const Vec3& place_m, double width_m) {
  return kPi * density(volume, place_m) / volume.lidar_ratio_sr * 2 * std::sqrt(kPi) * width_m;
}

}  // namespace lasso::sim
