#include "fsw/mission/calibration.hpp"

#include "fsw/geometry/portable_math.hpp"

namespace lasso {
namespace {

using C = TriangulationCalibration;

double magnitude(double x) { return x < 0 ? -x : x; }

bool all_finite(const C& c) {
  bool finite = true;
  for (const double term : c.residual) finite = finite && is_finite(term);
  for (const CalibrationReal& real : kCalibrationReals) finite = finite && is_finite(c.*real.member);
  return finite;
}

// A length that stays above 0 over the temperatures that are served.
bool stays_positive(double length_m, double per_K, const C& c) {
  const double margin_K = kOutsideMargin * (c.temperature_max_degC - c.temperature_min_degC);
  const double cold = 1 + per_K * (c.temperature_min_degC - margin_K - c.reference_degC);
  const double warm = 1 + per_K * (c.temperature_max_degC + margin_K - c.reference_degC);
  return length_m > 0 && cold > 0 && warm > 0;
}

bool has_content(const C& c) {
  return c.angle_max_rad > 0 && c.depth_min_m > 0 && c.depth_min_m < c.depth_max_m && c.temperature_min_degC < c.temperature_max_degC;
}

// The spot tells the peaks apart, over the whole detector: d(spot)/d(peak) > 0.
bool spot_grows_with_peak(const C& c) {
  const double mixed = c.angle_max_rad * (magnitude(c.residual[7]) + magnitude(c.residual[8]));
  return 1 + c.residual[3] - mixed - 2 * magnitude(c.residual[9]) > 0;
}

bool within_wire(const C& c) {
  return c.angle_max_rad + magnitude(c.angle_x_offset_rad) < 1 && c.angle_max_rad + magnitude(c.angle_y_offset_rad) < 1;
}

bool in_range(const C& c) {
  bool in = true;
  for (const double term : c.residual) in = in && magnitude(term) <= kMaxResidual;
  for (const CalibrationReal& real : kCalibrationReals) in = in && c.*real.member >= real.minimum && c.*real.member <= real.maximum;
  return in;
}

}  // namespace

Status validate(const TriangulationCalibration& calibration) {
  if (!all_finite(calibration)) return Status::kNotFinite;
  if (calibration.serial == 0 || !has_content(calibration) || !within_wire(calibration) || !in_range(calibration)) return Status::kBadValue;
  const bool lengths = stays_positive(calibration.focal_length_m, calibration.focal_length_per_K, calibration) &&
                       stays_positive(calibration.baseline_m, calibration.baseline_per_K, calibration);
  return lengths && calibration.half_width_m > 0 && spot_grows_with_peak(calibration) ? Status::kOk : Status::kSingular;
}

}  // namespace lasso
