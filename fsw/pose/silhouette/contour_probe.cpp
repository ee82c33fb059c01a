#include "fsw/pose/silhouette/contour_probe.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/pose/scan/clip.hpp"

namespace lasso {
namespace {

using N = FlightNumber;
using Length = N::Length;

constexpr double kGapSigmas = 8;        // an inner contour's step is at least this many range sigmas
constexpr double kNearestEdge2 = 1e-6;  // m^2: an edge at the sensor's very place has no contour

struct Probe {
  FieldRay<N> ray{};
  FieldSpan<N> span;  // the part of the ray inside the grid
};

// A ray from the sensor through `through`; t = 0 there.
Probe make_probe(const Field<N>& field, const Vec3& origin, const Vec3& through) {
  Probe probe;
  const Vec3 line = through - origin;
  const Vec3 u = line * (1 / square_root(line.squaredNorm()));
  for (int i = 0; i < 3; ++i) {
    probe.ray.m[i] = N::to_length(through[i]);
    probe.ray.u[i] = N::to<N::Unit>(u[i]);
  }
  set_cells(field, probe.ray);
  probe.span = clip_to_grid(field, probe.ray);
  return probe;
}

bool meets_edge(const Field<N>& field, const Probe& probe, Length depth) { return walk_field(field, probe.ray, -depth, depth).found; }

bool hidden(const Field<N>& field, const Probe& probe, Length depth) {
  return walk_field(field, probe.ray, probe.span.enter, -depth).found;
}

}  // namespace

ProbeSettings probe_settings(const MissionParameters& p, double range_sigma_m) {
  const double noise_m = kGapSigmas * range_sigma_m;
  return {N::to_length(p.edge_depth_m), N::to_length(p.probe_step_m), p.edge_gap_min_m > noise_m ? p.edge_gap_min_m : noise_m};
}

ContourPoint probe_contour(const Field<N>& field, const ProbeSettings& s, const Vec3& origin, const Vec3& edge, const Vec3& across) {
  ContourPoint point;
  if (!((edge - origin).squaredNorm() > kNearestEdge2)) return point;
  const double step = N::to_double(s.step);
  const Probe plus = make_probe(field, origin, edge + step * across);
  const Probe minus = make_probe(field, origin, edge - step * across);
  const bool plus_meets = meets_edge(field, plus, s.depth);
  if (plus_meets == meets_edge(field, minus, s.depth)) return point;
  const Probe& inside = plus_meets ? plus : minus;
  const Probe& outside = plus_meets ? minus : plus;
  if (hidden(field, inside, s.depth) || hidden(field, outside, s.depth)) return point;
  point.outward = plus_meets ? Vec3(-across) : across;
  point.range_m = square_root((edge - origin).squaredNorm());
  const FieldHit<N> beyond = walk_field(field, outside.ray, s.depth, outside.span.leave);
  const double gap = beyond.found ? N::to_double(beyond.t) : 0;
  if (beyond.found && gap < s.gap_min_m) return point;
  point.kind = beyond.found ? ContourKind::kInner : ContourKind::kOuter;
  point.far_range_m = point.range_m + gap;
  return point;
}

double along_in_space(const ContourEdge<N>& edge, double along) {
  const double near_end = along * N::to_double(edge.za);
  return near_end / (near_end + (1 - along) * N::to_double(edge.zb));
}

}  // namespace lasso
