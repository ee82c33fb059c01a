// From what a LIDAR measures to a ray and a range: the time that a pulse was under way, and what the calibration found to be different in
// this one head.
//
//   range = c / 2 (flight - delay) (1 + clock_error)
// The delay is that of the electronics; it grows with the temperature. Frame: sensor, metres (fsw/sense/range_image.hpp).
#pragma once

#include <cstdint>

#include "fsw/core/status.hpp"
#include "fsw/sense/range_image.hpp"
#include "hal_lcs/messages.hpp"
#include "hal_lcs/triangulation.hpp"

namespace lasso::lcs {

constexpr double kHalfLightMPerUs = 149.896229;  // half the speed of light in vacuum (exact by definition)

struct EchoCalibration {
  std::uint32_t serial = 0;       // of the head that it is for; not 0
  double angle_x_offset_rad = 0;  // added to what the mirrors say
  double angle_y_offset_rad = 0;
  double delay_us = 0;  // taken off each flight, at the reference temperature
  double delay_us_per_K = 0;
  double clock_error = 0;  // share by which the head's clock runs slow: flights are longer than it says
  double reference_degC = 20;
  // Where it was calibrated.
  double angle_max_rad = 0.3;  // either mirror
  double range_min_m = 0.5;
  double range_max_m = 1000;
  double temperature_min_degC = -20;
  double temperature_max_degC = 50;
};

// kNotFinite; kSingular: a clock that stands still (clock_error not above -1); kBadValue: no serial number, ranges or temperatures without
// content, or angles, or the flight of the farthest range at any of the temperatures, beyond the wire's.
Status validate(const EchoCalibration& calibration);

// What the temperature leaves of a calibration: made once a scan.
class TimeOfFlight {
 public:
  // `calibration` is valid.
  TimeOfFlight(const EchoCalibration& calibration, double temperature_degC);

  // The sample of the ray that the raw one is, at time t_us. Its state is kHit for kPoint, kMiss for kNothing, else kInvalid. A flight
  // at the wire's end is kNoStatement, one of 0 kBadPeak: they stand for all beyond.
  Fate convert(const RawSample& raw, TimeUs t_us, RangeSample& sample) const;

 private:
  EchoCalibration c_;
  double delay_us_;
  bool temperature_known_;
};

}  // namespace lasso::lcs
