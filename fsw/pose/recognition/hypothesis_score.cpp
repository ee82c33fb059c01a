#include "fsw/pose/recognition/hypothesis_score.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/pose/scan/clip.hpp"
#include "fsw/pose/scan/model_ray.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

constexpr float kOnSurface = 0.02F;  // of the model's size: farther off is bad
constexpr float kInFront = 0.03F;    // of the model's size: a surface this far in front would have been measured itself
constexpr double kMissWeight = 0.3;  // returns are lost for many reasons
constexpr double kDistanceWeight = 0.5;
constexpr double kHopeless = 2.5;        // times the best score, and
constexpr double kHopelessFloor = 0.05;  // this
constexpr double kPoor = 1.25;           // the same
constexpr double kPoorFloor = 0.02;
constexpr std::size_t kLookedAtOnce = 16;  // rays between two looks at the limit

template <class T>
T larger(T a, T b) {
  return a < b ? b : a;
}
float smaller(float a, float b) { return a < b ? a : b; }

// What the ray meets from where it enters the grid up to `behind` its measured point.
FieldHit<N> first_met(const Mission& mission, FieldRay<N>& ray, N::Length sensor, N::Length behind) {
  set_cells(mission.field, ray);
  if (!near_grid(ray)) return {};
  const N::Length enter = clip_to_grid(mission.field, ray).enter;
  return walk_field(mission.field, ray, larger(enter, sensor), behind);
}

bool is_bad(const FieldHit<N>& met, float distance, float on_surface, float in_front) {
  if (!met.found) return distance > on_surface;
  const float t = N::to_float(met.t);
  if (t < -in_front) return true;
  return t < -on_surface && distance > on_surface;
}

void add_hit(const Mission& mission, const PathPose<N>& pose, const MatchPoint<N>& point, const ReturnReach& reach, HypothesisScore& fit) {
  FieldRay<N> ray{};
  transform(pose, point.p, ray.m);
  rotate(pose, point.u, ray.u);
  const float m[3] = {N::to_float(ray.m[0]), N::to_float(ray.m[1]), N::to_float(ray.m[2])};
  const float distance = surface_distance(mission.search, m).distance_m;
  // Both tolerances are wider where the noise is larger.
  const float on_surface = larger(kOnSurface * mission.search.size_m, reach.noise_m);
  const float in_front = larger(kInFront * mission.search.size_m, reach.noise_m);
  const FieldHit<N> met = first_met(mission, ray, -reach.range, N::to_length(static_cast<double>(on_surface)));
  const float gap = met.found ? N::to_float(larger(met.t, -met.t)) : distance;
  fit.distance += static_cast<double>(smaller(distance, gap) / mission.search.truncation_m);
  if (is_bad(met, distance, on_surface, in_front)) fit.bad += 1;
}

bool exceeds(const HypothesisScore& fit, std::size_t ray, double limit) { return ray % kLookedAtOnce == 0 && fit.score() > limit; }

// Returns are in an order in which any first of them are far apart, a fair sample: what runs ahead of its share of the limit will exceed
// it.
double share_of_limit(std::size_t looked_at, std::size_t hits, std::size_t head_start) {
  const std::size_t ahead = looked_at + head_start;
  return ahead < hits ? static_cast<double>(ahead) / static_cast<double>(hits) : 1;
}

// As if the others were like those that were looked at; beyond the limit, then.
HypothesisScore extrapolated(HypothesisScore fit, std::size_t looked_at) {
  const double factor = fit.hits / static_cast<double>(looked_at);
  fit.bad *= factor;
  fit.distance *= factor;
  return fit;
}

}  // namespace

double HypothesisScore::disagreement() const { return hits > 0 ? (bad + violated) / (hits + violated) : 1; }

double HypothesisScore::score() const { return disagreement() + kDistanceWeight * (hits > 0 ? distance / hits : 1); }

double hopeless_beyond(double score) { return kHopeless * score + kHopelessFloor; }

double poor_beyond(double score) { return kPoor * score + kPoorFloor; }

HypothesisScore operator+(const HypothesisScore& a, const HypothesisScore& b) {
  return {a.hits + b.hits, a.bad + b.bad, a.violated + b.violated, a.distance + b.distance, a.walks + b.walks};
}

HypothesisScore measure_score(const Mission& mission, const Pose& T_target_sensor, const ScanSubset& subset, double limit,
                              std::size_t head_start) {
  const PathPose<N> pose = to_path<N>(T_target_sensor);
  const double per_miss = kMissWeight * subset.misses_per_hit;
  HypothesisScore fit;
  fit.hits = static_cast<double>(subset.hits.size());
  for (std::size_t i = 0; i < subset.hits.size(); ++i, ++fit.walks) {
    if (exceeds(fit, i, limit * share_of_limit(i, subset.hits.size(), head_start))) return extrapolated(fit, i);
    add_hit(mission, pose, subset.hits[i], subset.reaches[i], fit);
  }
  std::uint32_t violated = 0;
  for (std::size_t i = 0; i < subset.misses.size(); ++i, ++fit.walks) {
    fit.violated = per_miss * violated;
    if (exceeds(fit, i, limit)) return fit;
    violated += meets_model(mission, pose, subset.misses[i]) ? 1u : 0u;
  }
  fit.violated = per_miss * violated;
  return fit;
}

}  // namespace lasso
