// Matching of single points: which surface a ray met, its residual, and how much it weighs. The per-point path, written over the number
// type N. See docs/decisions/registration.md for the derivation of residual and weight.
#pragma once

#include "fsw/core/span.hpp"
#include "fsw/mission/field.hpp"
#include "fsw/pose/normal_equations.hpp"
#include "fsw/pose/path_pose.hpp"
#include "fsw/pose/workspace.hpp"

namespace lasso {

enum class Lookup : std::uint8_t {
  kNear,  // plane of the element closest to the point: cheap, wide, inexact
  kWalk,  // the element that the ray hits, looked for along the whole gate
  kLast,  // the element hit last time, if the ray still does; else as kWalk
};

template <class N>
struct MatchSettings {
  typename N::Ratio kernel_squared;    // k^2 of Tukey's kernel, in sigmas^2
  typename N::Ratio surface_variance;  // m^2
  typename N::Ratio cos_incidence_max;
  typename N::Ratio reference_variance;  // m^2: weights are relative to it, so that sums stay of order one
  typename N::Length gate;               // m, added to k sigma while the start is uncertain
};

// Sums over the points of one pass.
template <class N>
struct PassSums {
  NormalEquations<N> equations;
  typename N::Sum chi_squared{};       // sum w (r/sigma)^2, w Tukey's weight
  typename N::Sum squared_residual{};  // m^2, unweighted, of the inliers
  std::uint32_t usable = 0;            // points that hit a surface within the incidence limit, or nothing at all
};

template <class N>
struct SurfaceMatch {
  typename N::Unit n[3];   // normal, target frame
  typename N::Ratio tilt;  // -(n.u) > 0
  typename N::Length t;    // residual along the ray
  bool found = false;
};

// How far from the measured point along its ray the surface may lie.
template <class N>
inline typename N::Length walk_reach(const MatchSettings<N>& s, const MatchPoint<N>& point) {
  return point.reach + s.gate;
}

template <class N>
inline FieldHit<N> find_hit(const Field<N>& field, const MatchSettings<N>& s, const MatchPoint<N>& point, const FieldRay<N>& ray,
                            Lookup lookup) {
  const auto reach = walk_reach(s, point);
  FieldHit<N> hit;
  if (lookup == Lookup::kLast && point.element != kNoElement) {
    hit.found = hit_element(field.elements[point.element], ray, -reach, reach, hit.t);
    hit.element = point.element;
    if (hit.found) return hit;
  }
  return walk_field(field, ray, -reach, reach);
}

template <class N>
inline SurfaceMatch<N> match_ray(const Field<N>& field, const MatchSettings<N>& s, MatchPoint<N>& point, const FieldRay<N>& ray,
                                 Lookup lookup) {
  SurfaceMatch<N> match;
  const FieldHit<N> hit = find_hit(field, s, point, ray, lookup);
  point.element = hit.found ? hit.element : kNoElement;
  if (!hit.found) return match;
  match.t = hit.t;
  const typename N::Length p[3] = {ray.m[0] + hit.t * ray.u[0], ray.m[1] + hit.t * ray.u[1], ray.m[2] + hit.t * ray.u[2]};
  surface_normal(field, field.elements[hit.element], p, match.n);
  const auto tilt = dot3<N>(match.n, ray.u);
  match.tilt = tilt < 0 ? -tilt : tilt;  // two-sided elements are seen from behind too
  match.found = true;
  return match;
}

// The closest plane serves as surface: its residual along the normal is bounded by the gate, and its tilt is not trusted as a lever.
template <class N>
inline SurfaceMatch<N> match_near(const Field<N>& field, const MatchSettings<N>& s, const FieldRay<N>& ray) {
  SurfaceMatch<N> match;
  const std::uint32_t element = near_element(field, place_in_grid(field, ray.cell_m), ray.u);
  if (element == kNoElement) return match;
  const Element<N>& e = field.elements[element];
  const auto distance = e.d - dot3<N>(e.n, ray.m);
  if (distance > s.gate || distance < -s.gate) return match;
  for (int i = 0; i < 3; ++i) match.n[i] = e.n[i];
  match.t = distance;
  match.tilt = 1;
  match.found = true;
  return match;
}

// Adds a ray match. The residual r = n.(q - m) = t (n.u) has variance
//   sigma_n^2 = (n.u)^2 sigma_r^2 + (1 - (n.u)^2) sigma_across^2 + sigma_surface^2,
// Tukey's weight (1 - r^2/(k^2 sigma_n^2 + gate^2 (n.u)^2))^2.
template <class N>
inline void add_ray_match(const MatchSettings<N>& s, const MatchPoint<N>& point, const FieldRay<N>& ray, const SurfaceMatch<N>& match,
                          PassSums<N>& sums) {
  if (match.tilt < s.cos_incidence_max) return;
  ++sums.usable;
  const auto tilt2 = match.tilt * match.tilt;
  const auto variance = tilt2 * point.range_variance + (1 - tilt2) * point.across_variance + s.surface_variance;
  const auto r2 = match.t * match.t * tilt2;
  const auto limit = s.kernel_squared * variance + s.gate * s.gate * tilt2;
  if (!(r2 < limit)) return;
  const auto rest = 1 - r2 / limit;
  const auto tukey = rest * rest;
  const auto w = tukey * s.reference_variance / variance;
  const auto facing = dot3<N>(match.n, ray.u);
  sums.equations.add(ray.m, match.n, match.t * facing, w);
  sums.chi_squared += static_cast<typename N::Sum>(w * r2);
  sums.squared_residual += static_cast<typename N::Sum>(match.t * match.t);
}

template <class N>
inline void add_near_match(const MatchSettings<N>& s, const FieldRay<N>& ray, const SurfaceMatch<N>& match, PassSums<N>& sums) {
  ++sums.usable;
  const auto q = match.t / s.gate;
  const auto rest = 1 - q * q;
  sums.equations.add(ray.m, match.n, match.t, rest * rest);
}

template <class N>
inline bool to_field_ray(const Field<N>& field, const PathPose<N>& T_target_sensor, const MatchPoint<N>& point, FieldRay<N>& ray) {
  transform(T_target_sensor, point.p, ray.m);
  rotate(T_target_sensor, point.u, ray.u);
  set_cells(field, ray);
  return near_grid(ray);
}

// One pass over every stride-th point. Bound: the points, each kMaxWalkSteps cells at most.
template <class N>
void match_points(const Field<N>& field, const PathPose<N>& T_target_sensor, const MatchSettings<N>& s, Span<MatchPoint<N>> points,
                  std::size_t stride, Lookup lookup, PassSums<N>& sums) {
  for (std::size_t i = 0; i < points.size(); i += stride) {
    MatchPoint<N>& point = points.data()[i];
    FieldRay<N> ray;
    if (!to_field_ray(field, T_target_sensor, point, ray)) continue;
    if (lookup == Lookup::kNear) {
      const SurfaceMatch<N> match = match_near(field, s, ray);
      if (match.found) add_near_match(s, ray, match, sums);
      continue;
    }
    const SurfaceMatch<N> match = match_ray(field, s, point, ray, lookup);
    if (match.found) {
      add_ray_match(s, point, ray, match, sums);
    } else {
      ++sums.usable;
    }
  }
  sums.equations.flush();
}

}  // namespace lasso
