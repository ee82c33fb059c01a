#include "hal_lcs/triangulation.hpp"

#include "fsw/geometry/portable_math.hpp"

namespace lasso::lcs {
namespace {

double magnitude(double x) { return x < 0 ? -x : x; }

bool all_finite(const Calibration& c) {
  bool finite = true;
  for (const double term : c.residual) finite = finite && is_finite(term);
  for (const double real :
       {c.focal_length_m, c.baseline_m, c.half_width_m, c.angle_x_offset_rad, c.angle_y_offset_rad, c.focal_length_per_K, c.baseline_per_K,
        c.peak_per_K, c.reference_degC, c.angle_max_rad, c.depth_min_m, c.depth_max_m, c.temperature_min_degC, c.temperature_max_degC}) {
    finite = finite && is_finite(real);
  }
  return finite;
}

// A length that stays above 0 over the calibrated temperatures.
bool stays_positive(double length_m, double per_K, const Calibration& c) {
  const double cold = 1 + per_K * (c.temperature_min_degC - c.reference_degC);
  const double warm = 1 + per_K * (c.temperature_max_degC - c.reference_degC);
  return length_m > 0 && cold > 0 && warm > 0;
}

bool has_content(const Calibration& c) {
  return c.angle_max_rad > 0 && c.depth_min_m > 0 && c.depth_min_m < c.depth_max_m && c.temperature_min_degC < c.temperature_max_degC;
}

// The spot tells the peaks apart, over the whole detector: d(spot)/d(peak) > 0.
bool spot_grows_with_peak(const Calibration& c) {
  const double mixed = c.angle_max_rad * (magnitude(c.residual[7]) + magnitude(c.residual[8]));
  return 1 + c.residual[3] - mixed - 2 * magnitude(c.residual[9]) > 0;
}

bool within_wire(const Calibration& c) {
  return c.angle_max_rad + magnitude(c.angle_x_offset_rad) < 1 && c.angle_max_rad + magnitude(c.angle_y_offset_rad) < 1;
}

}  // namespace

Status validate(const Calibration& calibration) {
  if (!all_finite(calibration)) return Status::kNotFinite;
  if (calibration.serial == 0 || !has_content(calibration) || !within_wire(calibration)) return Status::kBadValue;
  const bool lengths = stays_positive(calibration.focal_length_m, calibration.focal_length_per_K, calibration) &&
                       stays_positive(calibration.baseline_m, calibration.baseline_per_K, calibration);
  return lengths && calibration.half_width_m > 0 && spot_grows_with_peak(calibration) ? Status::kOk : Status::kSingular;
}

Triangulation::Triangulation(const Calibration& calibration, double temperature_degC)
    : c_(calibration),
      warmer_K_(temperature_degC - calibration.reference_degC),
      focal_length_m_(calibration.focal_length_m * (1 + calibration.focal_length_per_K * warmer_K_)),
      baseline_m_(calibration.baseline_m * (1 + calibration.baseline_per_K * warmer_K_)),
      temperature_known_(temperature_degC >= calibration.temperature_min_degC && temperature_degC <= calibration.temperature_max_degC) {}

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

Fate Triangulation::convert(const RawSample& raw, TimeUs t_us, RangeSample& sample) const {
  const Mirrors mirrors{c_.angle_x_offset_rad, c_.angle_y_offset_rad, c_.angle_max_rad};
  const MirrorRay ray = look(raw, mirrors, SampleKind::kReturn, t_us, sample);
  if (ray.fate != Fate::kPoint) return ray.fate;
  if (!temperature_known_) return Fate::kOutside;
  const double disparity_m = spot_m(ray.x_rad, ray.y_rad, raw.peak) + focal_length_m_ * ray.tan_x;
  if (!(disparity_m > 0)) return Fate::kBadPeak;
  const double depth_m = focal_length_m_ * baseline_m_ / disparity_m;
  if (depth_m < c_.depth_min_m || depth_m > c_.depth_max_m) return Fate::kOutside;
  sample.range_m = static_cast<float>(depth_m * ray.length);
  sample.state = RayState::kHit;
  return Fate::kPoint;
}

}  // namespace lasso::lcs
