#include "hal_lcs/triangulation.hpp"

#include "fsw/geometry/portable_math.hpp"

namespace lasso::lcs {
namespace {

double magnitude(double x) { return x < 0 ? -x : x; }

// How far x lies beyond [low, high], as a share of its width; below 0 within.
double share_beyond(double x, double low, double high) {
  const double above = (x - high) / (high - low), below = (low - x) / (high - low);
  return above > below ? above : below;
}

}  // namespace

Triangulation::Triangulation(const Calibration& calibration, double temperature_degC)
    : c_(calibration),
      warmer_K_(temperature_degC - calibration.reference_degC),
      focal_length_m_(calibration.focal_length_m * (1 + calibration.focal_length_per_K * warmer_K_)),
      baseline_m_(calibration.baseline_m * (1 + calibration.baseline_per_K * warmer_K_)),
      temperature_beyond_(share_beyond(temperature_degC, calibration.temperature_min_degC, calibration.temperature_max_degC)) {}

double Triangulation::spot_m(double x, double y, double peak) const {
  const double phi[kResidualTerms] = {1, x, y, peak, x * x, x * y, y * y, x * peak, y * peak, peak * peak};
  double sum = peak + c_.peak_per_K * warmer_K_;
  for (std::size_t k = 0; k < kResidualTerms; ++k) sum += c_.residual[k] * phi[k];
  return c_.half_width_m * sum;
}

MirrorRay look(const RawSample& raw, const Mirrors& mirrors, SampleKind measured, TimeUs t_us, RangeSample& sample) {
  sample = RangeSample{};
  sample.t_us = t_us;
  MirrorRay ray;
  ray.x_rad = raw.angle_x_rad + mirrors.x_offset_rad;
  ray.y_rad = raw.angle_y_rad + mirrors.y_offset_rad;
  ray.fate = Fate::kBadAngle;
  if (magnitude(ray.x_rad) > mirrors.max_rad || magnitude(ray.y_rad) > mirrors.max_rad) return ray;
  ray.fate = Fate::kNoStatement;
  if (raw.kind != measured && raw.kind != SampleKind::kNothing) return ray;
  ray.tan_x = tangent(ray.x_rad);
  const double tan_y = tangent(ray.y_rad);
  ray.length = square_root(ray.tan_x * ray.tan_x + tan_y * tan_y + 1);
  const double unit[3] = {ray.tan_x / ray.length, tan_y / ray.length, 1 / ray.length};
  for (int k = 0; k < 3; ++k) sample.direction[k] = static_cast<float>(unit[k]);
  ray.fate = Fate::kPoint;
  if (raw.kind != SampleKind::kNothing) return ray;
  sample.state = RayState::kMiss;
  ray.fate = Fate::kNothing;
  return ray;
}

Fate Triangulation::fate_at(double depth_m) const {
  const bool near = depth_m * (1 + kOutsideMargin) >= c_.depth_min_m && depth_m <= c_.depth_max_m * (1 + kOutsideMargin);
  if (!near || temperature_beyond_ > kOutsideMargin) return Fate::kOutside;
  return temperature_beyond_ > 0 || depth_m < c_.depth_min_m || depth_m > c_.depth_max_m ? Fate::kBeside : Fate::kPoint;
}

Fate Triangulation::convert(const RawSample& raw, TimeUs t_us, RangeSample& sample) const {
  const Mirrors mirrors{c_.angle_x_offset_rad, c_.angle_y_offset_rad, c_.angle_max_rad};
  const MirrorRay ray = look(raw, mirrors, SampleKind::kReturn, t_us, sample);
  if (ray.fate != Fate::kPoint) return ray.fate;
  const double disparity_m = spot_m(ray.x_rad, ray.y_rad, raw.peak) + focal_length_m_ * ray.tan_x;
  if (!(disparity_m > 0)) return Fate::kBadPeak;
  const double depth_m = focal_length_m_ * baseline_m_ / disparity_m;
  const Fate fate = fate_at(depth_m);
  if (fate == Fate::kOutside) return fate;
  sample.range_m = static_cast<float>(depth_m * ray.length);
  if (fate == Fate::kBeside) sample.sigma_factor = static_cast<float>(c_.outside_sigma_factor);
  sample.state = RayState::kHit;
  return fate;
}

}  // namespace lasso::lcs
