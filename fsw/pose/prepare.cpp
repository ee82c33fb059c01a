#include "fsw/pose/prepare.hpp"

namespace lasso {
namespace {

using N = FlightNumber;
using Length = N::Length;
using Unit = N::Unit;

// Noise of a return at its range: sigma_r^2 = sigma0^2 + (k z^2)^2 along the ray, z sigma_angle across it; the former times the sample's
// own factor.
struct NoiseModel {
  Length sigma0, k, angle, surface, width;

  explicit NoiseModel(const MissionParameters& p)
      : sigma0(N::to_length(p.sigma0_m)),
        k(N::to_ratio(p.sigma_k_per_m)),
        angle(N::to_ratio(p.sigma_angle_rad)),
        surface(N::to_length(p.surface_sigma_m)),
        width(N::to_ratio(p.kernel_width)) {}

  void apply(Length range, N::Ratio factor, MatchPoint<N>& point) const {
    const Length constant = factor * sigma0;
    const Length grown = factor * (k * range * range);
    const Length across = range * angle;
    point.range_variance = constant * constant + grown * grown;
    point.across_variance = across * across;
    // A bound of k sigma without a square root; 4 = tan 76 deg: what lies farther off for pointing noise at grazing incidence is let go.
    point.reach = width * (constant + grown + 4 * across + surface);
  }
};

// The target's motion, undone: a ray taken tau after the reference time met the target as a ray turned by -omega tau about the target's
// origin and moved by -v tau meets it at the reference time. Cayley's map: the angle's error is its cube over 12.
class Deskew {
 public:
  Deskew(const StartPoint& start, bool on) : on_(on) {
    for (int i = 0; i < 3; ++i) {
      half_rate_[i] = N::to_ratio(-0.5 * start.rates.omega_radps[i]);
      origin_[i] = N::to_length(start.T_sensor_target.p[i]);
      velocity_[i] = N::to_length(start.rates.v_mps[i]);
    }
  }

  void apply(N::Ratio tau_s, ScanRay<N>& ray) const {
    if (!on_) return;
    N::Ratio h[3];
    Length lever[3];
    for (int i = 0; i < 3; ++i) {
      h[i] = half_rate_[i] * tau_s;
      lever[i] = -origin_[i] - velocity_[i] * tau_s;
    }
    const N::Ratio scale = 2 / (1 + dot3<N>(h, h));
    turn(h, scale, ray.u);
    turn(h, scale, lever);
    for (int i = 0; i < 3; ++i) ray.o[i] = origin_[i] + lever[i];
  }

 private:
  static void cross(const N::Ratio* a, const N::Ratio* b, N::Ratio* c) {
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
  }
  // v + 2/(1+h.h) (h x v + h x (h x v))
  static void turn(const N::Ratio* h, N::Ratio scale, N::Ratio* v) {
    N::Ratio first[3];
    N::Ratio second[3];
    cross(h, v, first);
    cross(h, first, second);
    for (int i = 0; i < 3; ++i) v[i] += scale * (first[i] + second[i]);
  }

  N::Ratio half_rate_[3] = {};
  Length origin_[3] = {};
  Length velocity_[3] = {};
  bool on_;
};

ScanRay<N> make_ray(const RangeSample& sample) {
  ScanRay<N> ray{};
  for (int i = 0; i < 3; ++i) ray.u[i] = sample.direction[i];
  ray.state = sample.state;
  ray.range = sample.state == RayState::kHit ? sample.range_m : 0;
  return ray;
}

// A return from where the sensor does not measure says nothing.
bool is_credible(const RangeSample& sample, const MissionParameters& p) {
  const double range = static_cast<double>(sample.range_m);
  return sample.state != RayState::kHit || (range >= p.range_min_m && range <= p.range_max_m);
}

MatchPoint<N> make_point(const ScanRay<N>& ray, N::Ratio factor, const NoiseModel& noise, bool aimed) {
  MatchPoint<N> point{};
  for (int i = 0; i < 3; ++i) {
    point.p[i] = ray.o[i] + ray.range * ray.u[i];
    point.u[i] = ray.u[i];
  }
  point.element = kNoElement;
  point.aimed = aimed;
  noise.apply(ray.range, factor, point);
  return point;
}

}  // namespace

void prepare_rays(const Mission& mission, const RangeImage& scan, const StartPoint& start, Workspace& workspace) {
  const NoiseModel noise(mission.parameters);
  const bool moving = !start.rates.omega_radps.isZero(0.0) || !start.rates.v_mps.isZero(0.0);
  const Deskew deskew(start, mission.parameters.deskew > 0.5 && moving);
  const TimeUs reference_us = scan.reference_time_us();
  workspace.rays.clear();
  workspace.points.clear();
  workspace.sigma_factor = 1;
  for (std::size_t i = 0; i < scan.samples.size(); ++i) {
    const RangeSample& sample = scan.samples[i];
    if (sample.state == RayState::kInvalid || !is_credible(sample, mission.parameters)) continue;
    ScanRay<N> ray = make_ray(sample);
    deskew.apply(N::to_ratio(to_seconds(sample.t_us - reference_us)), ray);
    invariant(workspace.rays.push_back(ray), "as many rays as a scan can have");
    if (ray.state != RayState::kHit) continue;
    invariant(workspace.points.push_back(make_point(ray, sample.sigma_factor, noise, start.partial || scan.is_aimed(i))),
              "as many points as rays");
    if (sample.sigma_factor > workspace.sigma_factor) workspace.sigma_factor = sample.sigma_factor;
  }
}

}  // namespace lasso
