// Matching of single points: which surface a ray met, its residual, and how much it weighs. The per-point path, written over the number
// type N. See docs/decisions/registration.md for the derivation of residual and weight.
#pragma once

#include "fsw/core/span.hpp"
#include "fsw/mission/field.hpp"
#include "fsw/pose/registration/scan_sums.hpp"
#include "fsw/pose/scan/path_pose.hpp"
#include "fsw/pose/scan/workspace.hpp"

namespace lasso {

enum class Lookup : std::uint8_t {
  kWalk,  // the first element that the ray hits, looked for along the whole gate
  kLast,  // the element hit last time, if the ray still does; else as kWalk
};

// Which points a pass takes, and how it looks for their surface.
struct PassKind {
  std::size_t stride = 1;
  Lookup lookup = Lookup::kWalk;
};

template <class N>
struct MatchSettings {
  typename N::Kernel kernel_squared;      // k^2 of Tukey's kernel, in sigmas^2
  typename N::Variance surface_variance;  // m^2
  typename N::Unit cos_incidence_max;
  typename N::Variance reference_variance;  // m^2: weights are relative to it, so that sums stay of order one
  typename N::Length gate;                  // m, added to k sigma while the start is uncertain
};

template <class N>
constexpr typename N::Unit kFrontShare = N::template to<typename N::Unit>(0.4);  // of k sigma

template <class N>
struct PassSums {
  explicit PassSums(double size_m) : rows(size_m) {}

  ScanSums<N> rows;
  std::uint32_t usable = 0;  // points that met a surface within the incidence limit, or, if not aimed, none at all
};

// The point's ray in the target frame, from the measured point on; cells are not set.
template <class N>
inline FieldRay<N> to_target(const PathPose<N>& T_target_sensor, const MatchPoint<N>& point) {
  FieldRay<N> ray;  // NOLINT(cppcoreguidelines-pro-type-member-init): cells are set where a walk needs them, which most points do not
  transform(T_target_sensor, point.p, ray.m);
  rotate(T_target_sensor, point.u, ray.u);
  return ray;
}

// How far from the measured point along its ray the surface may lie: gate and k sigma.
template <class N>
inline typename N::Length reach_of(const MatchSettings<N>& s, const MatchPoint<N>& point) {
  return point.reach + 3 * s.gate;
}

// How far in front of the measured point a surface hides what lies behind it. One farther in front would have been measured itself: the ray
// went past its edge, and it is asked only where nothing lies behind.
template <class N>
inline typename N::Length front_of(const MatchSettings<N>& s, const MatchPoint<N>& point) {
  return kFrontShare<N> * point.reach + s.gate;
}

template <class N>
inline FieldHit<N> find_hit(const Field<N>& field, const MatchSettings<N>& s, const MatchPoint<N>& point, Lookup lookup, FieldRay<N>& ray) {
  const typename N::Length reach = reach_of(s, point);
  FieldHit<N> hit;
  if (lookup == Lookup::kLast && point.element != kNoElement) {
    hit.element = point.element;
    hit.found = hit_element(field.elements[hit.element], ray, -reach, reach, hit.t);
    if (hit.found) return hit;
  }
  set_cells(field, ray);
  if (!near_grid(ray)) return {};
  const typename N::Length front = front_of(s, point);
  hit = walk_field(field, ray, -front, reach);
  return hit.found ? hit : walk_field(field, ray, -reach, -front);
}

// The ray of the point and the surface that it meets, which the point remembers.
template <class N>
inline FieldHit<N> meet_surface(const Field<N>& field, const PathPose<N>& T_target_sensor, const MatchSettings<N>& s, Lookup lookup,
                                MatchPoint<N>& point, FieldRay<N>& ray) {
  ray = to_target(T_target_sensor, point);
  const FieldHit<N> hit = find_hit(field, s, point, lookup, ray);
  point.element = hit.found ? hit.element : kNoElement;
  return hit;
}

// The match of a ray with an element at t along the ray. The residual r = n.(q - m) = t (n.u) has variance
//   sigma_n^2 = (n.u)^2 sigma_r^2 + (1 - (n.u)^2) sigma_across^2 + sigma_surface^2
// and Tukey's weight is rest^2, rest = 1 - r^2/(k^2 sigma_n^2 + gate^2 (n.u)^2).
template <class N>
struct HitFit {
  typename N::Length q[3];  // where the ray meets the surface
  typename N::Unit n[3];    // the surface's normal there
  typename N::Length r;
  decltype(typename N::Unit{} * typename N::Variance{} + typename N::Variance{}) variance;
  typename N::Unit rest;
  bool usable, within;  // by its incidence; by the kernel's width, else rest is not set
};

template <class N>
inline HitFit<N> fit_hit(const Field<N>& field, const MatchSettings<N>& s, const MatchPoint<N>& point, const FieldRay<N>& ray,
                         const FieldHit<N>& hit) {
  HitFit<N> fit;  // NOLINT(cppcoreguidelines-pro-type-member-init): set as far as it is asked for, once a point
  for (int i = 0; i < 3; ++i) fit.q[i] = ray.m[i] + hit.t * ray.u[i];
  surface_normal(field, field.elements[hit.element], fit.q, fit.n);
  const auto facing = cut<typename N::Unit>(dot3<N>(fit.n, ray.u));  // positive only for two-sided elements seen from behind
  fit.usable = !(facing > -s.cos_incidence_max && facing < s.cos_incidence_max);
  const auto tilt2 = cut<typename N::Unit>(facing * facing);  // above 1 where the surface is curved, and its normal longer than 1
  fit.variance = tilt2 * point.range_variance + rest_of_one(tilt2) * point.across_variance + s.surface_variance;
  const typename N::Variance rounded = fit.variance;
  fit.r = hit.t * facing;
  const typename N::Area r2 = fit.r * fit.r;
  const typename N::Area limit = N::area(s.kernel_squared * rounded) + s.gate * s.gate;
  fit.within = r2 < limit;
  if (fit.within) fit.rest = 1 - share_of(r2, limit);
  return fit;
}

// Adds the match to a pass. Its lever is that of q, where the ray meets the surface, as the range there changes with the pose; that of m
// would hold the range's noise, and noise squared would pass for information (a tube's roll).
template <class N>
inline void add_hit(const MatchSettings<N>& s, const HitFit<N>& fit, const FieldHit<N>& hit, PassSums<N>& sums) {
  if (!fit.usable) return;
  ++sums.usable;
  if (!fit.within) return;
  const typename N::Unit tukey = fit.rest * fit.rest;
  sums.rows.add(fit.q, fit.n, fit.r, quotient<typename N::Weight>(tukey * s.reference_variance, fit.variance), hit.t);
}

// What a pose explains: Tukey's rho of a return over what it is at most is 1 - rest^3; of one that is left out it is 1.
template <class N>
struct CostSums {
  typename N::Sum explained{};  // sum of rest^3
  std::uint32_t usable = 0;     // as PassSums'
};

template <class N>
inline void add_explained(const HitFit<N>& fit, CostSums<N>& sums) {
  if (!fit.usable) return;
  ++sums.usable;
  if (!fit.within) return;
  const typename N::Unit tukey = fit.rest * fit.rest;
  sums.explained += N::sum(tukey * fit.rest);
}

// One pass over all points without rows. Bound: the points, each kMaxWalkSteps cells at most.
CostSums<FlightNumber> cost_points(const Field<FlightNumber>& field, const PathPose<FlightNumber>& T_target_sensor,
                                   const MatchSettings<FlightNumber>& settings, Lookup lookup, Span<MatchPoint<FlightNumber>> points);

// One pass over the points of its kind. Bound: the points, each kMaxWalkSteps cells at most.
void match_points(const Field<FlightNumber>& field, const PathPose<FlightNumber>& T_target_sensor,
                  const MatchSettings<FlightNumber>& settings, Span<MatchPoint<FlightNumber>> points, const PassKind& kind,
                  PassSums<FlightNumber>& sums);

}  // namespace lasso
