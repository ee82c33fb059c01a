#include "fsw/pose/scan/point_maker.hpp"

namespace lasso {
namespace {

using N = FlightNumber;
using Length = N::Length;
using Unit = N::Unit;
using Sigma = N::Sigma;
using Scale = N::Tangent;
using Settings = PointSettings<N>;

void set_noise(const Settings& s, Length range, N::Factor factor, MatchPoint<N>& point) {
  const auto constant = bounded<Sigma>(factor * s.sigma0);
  const auto rate = bounded<Sigma>(s.k * range);  // of no unit
  const auto grown = bounded<Sigma>(factor * bounded<Sigma>(rate * range));
  const auto across = bounded<Sigma>(range * s.angle);
  point.range_variance = bounded<N::Variance>(constant * constant + grown * grown);
  point.across_variance = bounded<N::Variance>(across * across);
  // A bound of k sigma without a square root; 4 = tan 76 deg: what lies farther off for pointing noise at grazing incidence is left out.
  point.reach = bounded<Length>(s.width * (constant + grown + 4 * across + s.surface));
}

template <class V>
void cross(const Unit* a, const V* b, V* c) {
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

// v + 2/(1+h.h) (h x v + h x (h x v))
template <class V>
void turn(const Unit* h, Scale scale, V* v) {
  V first[3];
  V second[3];
  cross(h, v, first);
  cross(h, first, second);
  for (int i = 0; i < 3; ++i) {
    const V change = scale * (first[i] + second[i]);
    v[i] += change;
  }
}

// The target's motion, undone: a ray taken tau after the reference time met the target as a ray turned by -omega tau about the target's
// origin and moved by -v tau meets it at the reference time. Cayley's map: the angle's error is its cube over 12.
void deskew(const Settings& s, Unit tau_s, ScanRay<N>& ray) {
  constexpr auto kOne = N::to<Scale>(1);
  constexpr auto kTwo = N::to<Scale>(2);
  Unit h[3];
  Length lever[3];
  for (int i = 0; i < 3; ++i) {
    h[i] = bounded<Unit>(s.minus_half_rate[i] * tau_s);
    lever[i] = -s.origin[i] - bounded<Length>(s.velocity[i] * tau_s);
  }
  const Scale h2 = dot3<N>(h, h);
  const Scale scale = quotient<Scale>(kTwo, kOne + h2);
  turn(h, scale, ray.u);
  turn(h, scale, lever);
  for (int i = 0; i < 3; ++i) ray.o[i] = bounded<Length>(s.origin[i] + lever[i]);
}

ScanRay<N> make_ray(const RangeSample& sample) {
  ScanRay<N> ray{};
  for (int i = 0; i < 3; ++i) ray.u[i] = N::from_float<Unit>(sample.direction[i]);
  ray.state = sample.state;
  ray.range = sample.state == RayState::kHit ? N::from_float<Length>(sample.range_m) : Length{0};
  return ray;
}

// A return from where the sensor does not measure says nothing.
bool is_credible(const Settings& s, const ScanRay<N>& ray) {
  return ray.state != RayState::kHit || (ray.range >= s.range_min && ray.range <= s.range_max);
}

MatchPoint<N> make_point(const Settings& s, const ScanRay<N>& ray, N::Factor factor, bool aimed) {
  MatchPoint<N> point{};
  for (int i = 0; i < 3; ++i) {
    point.p[i] = bounded<Length>(ray.o[i] + ray.range * ray.u[i]);
    point.u[i] = ray.u[i];
  }
  point.element = kNoElement;
  point.aimed = aimed;
  set_noise(s, ray.range, factor, point);
  return point;
}

}  // namespace

void make_points(const PointSettings<FlightNumber>& s, const RangeImage& scan, bool partial, Workspace& workspace) {
  workspace.rays.clear();
  workspace.points.clear();
  workspace.sigma_factor = N::Factor{1};
  for (std::size_t i = 0; i < scan.samples.size(); ++i) {
    const RangeSample& sample = scan.samples[i];
    if (sample.state == RayState::kInvalid) continue;
    ScanRay<N> ray = make_ray(sample);
    if (!is_credible(s, ray)) continue;
    if (s.moving) deskew(s, N::seconds(sample.t_us - s.reference_us), ray);
    invariant(workspace.rays.push_back(ray), "as many rays as a scan can have");
    if (ray.state != RayState::kHit) continue;
    const auto factor = N::from_float<N::Factor>(sample.sigma_factor);
    invariant(workspace.points.push_back(make_point(s, ray, factor, partial || scan.is_aimed(i))), "as many points as rays");
    if (factor > workspace.sigma_factor) workspace.sigma_factor = factor;
  }
}

}  // namespace lasso
