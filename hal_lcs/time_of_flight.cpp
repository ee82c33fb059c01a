#include "hal_lcs/time_of_flight.hpp"

#include "fsw/geometry/portable_math.hpp"

namespace lasso::lcs {
namespace {

double magnitude(double x) { return x < 0 ? -x : x; }

bool all_finite(const EchoCalibration& c) {
  bool finite = true;
  for (const double real : {c.angle_x_offset_rad, c.angle_y_offset_rad, c.delay_us, c.delay_us_per_K, c.clock_error, c.reference_degC,
                            c.angle_max_rad, c.range_min_m, c.range_max_m, c.temperature_min_degC, c.temperature_max_degC}) {
    finite = finite && is_finite(real);
  }
  return finite;
}

bool has_content(const EchoCalibration& c) {
  return c.angle_max_rad > 0 && c.range_min_m > 0 && c.range_min_m < c.range_max_m && c.temperature_min_degC < c.temperature_max_degC;
}

bool within_wire(const EchoCalibration& c) {
  return c.angle_max_rad + magnitude(c.angle_x_offset_rad) < 1 && c.angle_max_rad + magnitude(c.angle_y_offset_rad) < 1 &&
         c.range_max_m <= kHalfLightMPerUs * kMaxFlightUs;
}

}  // namespace

Status validate(const EchoCalibration& calibration) {
  if (!all_finite(calibration)) return Status::kNotFinite;
  if (calibration.serial == 0 || !has_content(calibration) || !within_wire(calibration)) return Status::kBadValue;
  return calibration.clock_error > -1 ? Status::kOk : Status::kSingular;
}

TimeOfFlight::TimeOfFlight(const EchoCalibration& calibration, double temperature_degC)
    : c_(calibration),
      delay_us_(calibration.delay_us + calibration.delay_us_per_K * (temperature_degC - calibration.reference_degC)),
      temperature_known_(temperature_degC >= calibration.temperature_min_degC && temperature_degC <= calibration.temperature_max_degC) {}

Fate TimeOfFlight::convert(const RawSample& raw, TimeUs t_us, RangeSample& sample) const {
  const Mirrors mirrors{c_.angle_x_offset_rad, c_.angle_y_offset_rad, c_.angle_max_rad};
  const MirrorRay ray = look(raw, mirrors, SampleKind::kEcho, t_us, sample);
  if (ray.fate != Fate::kPoint) return ray.fate;
  if (!temperature_known_) return Fate::kOutside;
  const double range_m = kHalfLightMPerUs * (raw.flight_us - delay_us_) * (1 + c_.clock_error);
  if (!(range_m > 0)) return Fate::kBadPeak;
  if (range_m < c_.range_min_m || range_m > c_.range_max_m) return Fate::kOutside;
  sample.range_m = static_cast<float>(range_m);
  sample.state = RayState::kHit;
  return Fate::kPoint;
}

}  // namespace lasso::lcs
