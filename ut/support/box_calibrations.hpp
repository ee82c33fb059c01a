// Flight images with calibrations of laser cameras.
#pragma once

#include "ut/support/box_sensors.hpp"
#include "ut/support/generator.hpp"

namespace lasso::test {

// A camera that differs from its design in everything.
inline TriangulationCalibration bent_calibration(std::uint32_t serial) {
  TriangulationCalibration c;
  c.serial = serial;
  c.focal_length_m = 0.081;
  c.baseline_m = 0.1985;
  c.angle_x_offset_rad = 0.0007;
  c.angle_y_offset_rad = -0.0004;
  c.focal_length_per_K = 2e-5;
  c.baseline_per_K = -1e-5;
  c.peak_per_K = 3e-6;
  Generator chance(5 + serial);
  for (double& term : c.residual) term = chance.uniform(-1e-3, 1e-3);
  return c;
}

constexpr std::size_t kCalibrationsTable = 18;  // in BoxTables

inline void append_calibration(std::uint32_t sensor, const TriangulationCalibration& calibration, Words& words) {
  words.push_back(sensor);
  words.push_back(calibration.serial);
  for (const CalibrationReal& real : kCalibrationReals) append_value(calibration.*real.member, words);
  for (const double term : calibration.residual) append_value(term, words);
}

}  // namespace lasso::test
