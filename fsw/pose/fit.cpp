#include "fsw/pose/fit.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/pose/model_ray.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

constexpr N::Ratio kOnSurface = 0.02F;  // of the model's size: farther off is bad
constexpr N::Ratio kInFront = 0.03F;    // of the model's size: a surface this far in front would have been measured itself
constexpr N::Ratio kNoiseReach = 3;     // sigmas that widen both where the noise is larger
constexpr double kMissWeight = 0.3;     // returns are lost for many reasons
constexpr double kDistanceWeight = 0.5;

N::Length larger(N::Length a, N::Length b) { return a < b ? b : a; }
N::Length smaller(N::Length a, N::Length b) { return a < b ? a : b; }

// What the ray meets from where it enters the grid up to `behind` its measured point.
FieldHit<N> first_met(const Mission& mission, FieldRay<N>& ray, N::Length sensor, N::Length behind) {
  set_cells(mission.field, ray);
  if (!near_grid(ray)) return {};
  const N::Length enter = clip_to_grid(mission.field, ray).enter;
  return walk_field(mission.field, ray, larger(enter, sensor), behind);
}

bool is_bad(const FieldHit<N>& met, N::Length distance, N::Length on_surface, N::Length in_front) {
  if (!met.found) return distance > on_surface;
  if (met.t < -in_front) return true;
  return met.t < -on_surface && distance > on_surface;
}

void add_hit(const Mission& mission, const PathPose<N>& pose, const MatchPoint<N>& point, Fit& fit) {
  FieldRay<N> ray{};
  transform(pose, point.p, ray.m);
  rotate(pose, point.u, ray.u);
  const N::Length distance = surface_distance(mission.search, ray.m).distance;
  const N::Length noise = kNoiseReach * N::to_length(square_root(N::to_double(point.range_variance)));
  const N::Length on_surface = larger(kOnSurface * mission.search.size, noise);
  const N::Length in_front = larger(kInFront * mission.search.size, noise);
  const N::Length range = N::to_length(square_root(N::to_double(dot3<N>(point.p, point.p))));
  fit.hits += 1;
  const FieldHit<N> met = first_met(mission, ray, -range, on_surface);
  fit.distance += N::to_double(smaller(distance, met.found ? larger(met.t, -met.t) : distance) / mission.search.truncation);
  if (is_bad(met, distance, on_surface, in_front)) fit.bad += 1;
}

}  // namespace

double Fit::disagreement() const { return hits > 0 ? (bad + violated) / (hits + violated) : 1; }

double Fit::score() const { return disagreement() + kDistanceWeight * (hits > 0 ? distance / hits : 1); }

Fit operator+(const Fit& a, const Fit& b) { return {a.hits + b.hits, a.bad + b.bad, a.violated + b.violated, a.distance + b.distance}; }

Fit measure_fit(const Mission& mission, const Pose& T_target_sensor, const Evidence& evidence) {
  const PathPose<N> pose = to_path<N>(T_target_sensor);
  Fit fit;
  for (const MatchPoint<N>& point : evidence.hits) add_hit(mission, pose, point, fit);
  std::uint32_t violated = 0;
  for (const ScanRay<N>& miss : evidence.misses) violated += meets_model(mission, pose, miss) ? 1u : 0u;
  fit.violated = kMissWeight * evidence.misses_per_hit * violated;
  return fit;
}

}  // namespace lasso
