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

double delay_us(const EchoCalibration& c, double temperature_degC) {
  return c.delay_us + c.delay_us_per_K * (temperature_degC - c.reference_degC);
}

// What the head says of the farthest range is less than the wire's end, which stands for all that is beyond it.
bool tells_range(const EchoCalibration& c, double temperature_degC) {
  return c.range_max_m / (kHalfLightMPerUs * (1 + c.clock_error)) + delay_us(c, temperature_degC) < kMaxFlightUs;
}

bool within_wire(const EchoCalibration& c) {
  return c.angle_max_rad + magnitude(c.angle_x_offset_rad) < 1 && c.angle_max_rad + magnitude(c.angle_y_offset_rad) < 1 &&
         tells_range(c, c.temperature_min_degC) && tells_range(c, c.temperature_max_degC);
}

}  // namespace

Status validate(const EchoCalibration& calibration) {
  if (!all_finite(calibration)) return Status::kNotFinite;
  if (!(calibration.clock_error > -1)) return Status::kSingular;
  return calibration.serial != 0 && has_content(calibration) && within_wire(calibration) ? Status::kOk : Status::kBadValue;
}

TimeOfFlight::TimeOfFlight(const EchoCalibration& calibration, double temperature_degC)
    : c_(calibration),
      delay_us_(delay_us(calibration, temperature_degC)),
      temperature_known_(temperature_degC >= calibration.temperature_min_degC && temperature_degC <= calibration.temperature_max_degC) {}

Fate TimeOfFlight::convert(const RawSample& raw, TimeUs t_us, RangeSample& sample) const {
  const Mirrors mirrors{c_.angle_x_offset_rad, c_.angle_y_offset_rad, c_.angle_max_rad};
  const MirrorRay ray = look(raw, mirrors, SampleKind::kEcho, t_us, sample);
  if (ray.fate != Fate::kPoint) return ray.fate;
  if (!temperature_known_) return Fate::kOutside;
  if (raw.flight_us >= kMaxFlightUs) return Fate::kNoStatement;  // that long, or longer
  const double range_m = kHalfLightMPerUs * (raw.flight_us - delay_us_) * (1 + c_.clock_error);
  if (!(raw.flight_us > 0) || !(range_m > 0)) return Fate::kBadPeak;
  if (range_m < c_.range_min_m || range_m > c_.range_max_m) return Fate::kOutside;
  sample.range_m = static_cast<float>(range_m);
  sample.state = RayState::kHit;
  return Fate::kPoint;
}

}  // namespace lasso::lcs
