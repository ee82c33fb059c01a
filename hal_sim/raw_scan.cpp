#include "hal_sim/raw_scan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hal_sim/scan_text.hpp"
#include "hal_sim/thinning.hpp"

namespace lasso::sim {
namespace {

constexpr double kFarthestPoint_m = 1e6;
constexpr std::size_t kMissShare = 4;  // of the rays that are kept a quarter may be misses, where there are returns enough
constexpr double kMissesAround = 1.5;  // times the largest angle between the returns' middle and one of them
constexpr double kLeastCone_rad = 0.02;
constexpr std::uint32_t kMaxRow = 0xFFFFFFFF;

std::uint32_t row_number(std::size_t row) { return static_cast<std::uint32_t>(std::min<std::size_t>(row, kMaxRow)); }

TimeUs time_us(const RawScan& scan, const RawRay& ray, double unit_s) {
  const double t_s = ray.time * unit_s;
  if (std::abs(t_s) > kLatest_s)
    fail(scan.place(ray), "the time is " + text_of(t_s) + " s, expected at most 1e11; check that its unit is seconds");
  return std::llround(t_s * 1e6);
}

// A ray in the sensor frame: the place of a return, or the unit direction of a miss.
Vec3 in_sensor(const RawRay& ray, const Pose& T_sensor_file, const ScanFrame& frame) {
  if (!ray.hit) return frame.R_sensor_file * rotate(T_sensor_file.q, ray.place);
  return frame.R_sensor_file * (frame.scale * (T_sensor_file * ray.place) - frame.sensor_m);
}

// Of every ray, taken or not: thinning computes with finite differences, and a return of another unit says that all are.
void check_range(const Vec3& place, const RawRay& ray, const RawScan& scan) {
  const double range_m = place.stableNorm();
  if (!(range_m <= kFarthestPoint_m))
    fail(scan.place(ray), "the point is " + text_of(range_m) + " m away, expected at most 1e6; check that its unit is metres");
  if (!(static_cast<float>(range_m) > 0)) fail(scan.place(ray), "the point lies in the sensor's origin; check where the sensor stands");
}

RangeSample sample_of(const Vec3& place, const RawRay& ray) {
  RangeSample sample;
  const double range_m = place.stableNorm();
  for (int axis = 0; axis < 3; ++axis) sample.direction[axis] = static_cast<float>(place[axis] / range_m);
  sample.range_m = ray.hit ? static_cast<float>(range_m) : 0;
  sample.state = ray.hit ? RayState::kHit : RayState::kMiss;
  return sample;
}

struct Cone {
  Vec3 axis = Vec3::UnitZ();
  double cos_half = -1;  // all directions
};

Cone around(const std::vector<Vec3>& directions) {
  Cone cone;
  if (directions.empty()) return cone;
  Vec3 sum = Vec3::Zero();
  for (const Vec3& u : directions) sum += u;
  cone.axis = sum.normalized();
  double least = 1;
  for (const Vec3& u : directions) least = std::min(least, u.dot(cone.axis));
  cone.cos_half = std::cos(std::min(std::numbers::pi, std::max(kLeastCone_rad, kMissesAround * std::acos(std::max(-1.0, least)))));
  return cone;
}

// The directions of some rays, and which they are.
struct Group {
  std::vector<Vec3> directions;
  std::vector<std::uint32_t> rays;
  void keep_in(const Cone& cone) {
    Group inside;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (directions[i].dot(cone.axis) < cone.cos_half) continue;
      inside.directions.push_back(directions[i]);
      inside.rays.push_back(rays[i]);
    }
    *this = std::move(inside);
  }
};

void append_thinned(const Group& group, std::size_t most, std::vector<std::uint32_t>& kept) {
  for (const std::uint32_t i : thinned(group.directions, most)) kept.push_back(group.rays[i]);
}

// Returns spread over their directions, as a scanner's are (in space those that noise throws farthest off would be preferred), and misses
// over the directions around them: those far from the target say nothing of it.
std::vector<std::uint32_t> spread_rays(const RawScan& scan, const std::vector<Vec3>& places) {
  Group hits, misses;
  for (std::size_t i = 0; i < places.size(); ++i) {
    Group& group = scan.rays[i].hit ? hits : misses;
    group.directions.push_back(places[i].normalized());
    group.rays.push_back(static_cast<std::uint32_t>(i));
  }
  if (places.size() > kMaxRays) misses.keep_in(around(hits.directions));
  const std::size_t for_misses = std::min(misses.rays.size(), kMaxRays / kMissShare);
  std::vector<std::uint32_t> kept;
  append_thinned(hits, kMaxRays - for_misses, kept);
  append_thinned(misses, kMaxRays - kept.size(), kept);
  std::sort(kept.begin(), kept.end());
  return kept;
}

}  // namespace

std::string RawScan::place(const RawRay& ray) const { return rows_are_lines ? at_line(file, ray.row) : at_point(file, ray.row); }

void RawScan::add_point(const Vec3& point, double time, std::size_t row) {
  if (rays.empty() && unmeasured == 0) first_time = time;
  if (!point.allFinite() || point.isZero(0)) {
    ++unmeasured;
  } else {
    rays.push_back({point, time, row_number(row), true});
  }
}

void RawScan::add_miss(const Vec3& unit, double time, std::size_t row) {
  if (rays.empty() && unmeasured == 0) first_time = time;
  rays.push_back({unit, time, row_number(row), false});
}

bool is_direction(const RawRay& ray) {
  constexpr double kUnitTolerance = 1e-4;
  return ray.hit && std::abs(ray.place.stableNorm() - 1) <= kUnitTolerance;
}

std::size_t count_directions(const RawScan& scan) {
  return static_cast<std::size_t>(std::count_if(scan.rays.begin(), scan.rays.end(), is_direction));
}

bool has_directions(const RawScan& scan) {
  constexpr std::size_t kLeast = 16, kShare = 10;
  const std::size_t directions = count_directions(scan);
  const auto hits = std::count_if(scan.rays.begin(), scan.rays.end(), [](const RawRay& ray) { return ray.hit; });
  return directions >= kLeast && kShare * directions >= static_cast<std::size_t>(hits);
}

RangeImage to_image(const RawScan& scan, const ScanFrame& frame) {
  RangeImage image;
  image.misses_known = scan.misses_known;
  std::vector<Vec3> places;
  places.reserve(scan.rays.size());
  const Pose T_sensor_file = inverse(scan.T_file_sensor);
  for (const RawRay& ray : scan.rays) {
    places.push_back(in_sensor(ray, T_sensor_file, frame));
    check_range(places.back(), ray, scan);
  }
  for (const std::uint32_t i : spread_rays(scan, places)) {
    RangeSample sample = sample_of(places[i], scan.rays[i]);
    sample.t_us = time_us(scan, scan.rays[i], frame.unit_s);
    static_cast<void>(image.samples.push_back(sample));  // spread_rays gives no more than fit
  }
  if (!image.samples.empty()) return image;
  RangeSample nothing;
  nothing.t_us = time_us(scan, {Vec3::UnitZ(), scan.first_time, 1, false}, frame.unit_s);
  static_cast<void>(image.samples.push_back(nothing));
  return image;
}

}  // namespace lasso::sim
