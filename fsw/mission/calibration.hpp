// What the calibration of one laser camera found: the numbers of its triangulation. The mission image carries one for each sensor that is
// calibrated, and the sensor gets it as it is (Sensor::use_calibration).
//
// With mirror angles a_x, a_y, the spot at p on the detector, focal length f and baseline d, a point on the ray (tan a_x, tan a_y, 1) lies
// at the depth
//   z = f d / (p + f tan a_x)                                                         (Rioux 1984; docs/icd/lcs.md)
// f and d grow with the temperature; angles have offsets, p has a half width that scales the wire's [-1, 1), an offset with its own
// drift, and a residual that is a polynomial:
//   p = half_width (peak + sum_k c_k phi_k),  phi = 1, x, y, q, x^2, x y, y^2, x q, y q, q^2,  x, y the angles, q the peak
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/status.hpp"

namespace lasso {

constexpr std::size_t kResidualTerms = 10;

struct TriangulationCalibration {
  std::uint32_t serial = 0;  // of the camera that it is for; not 0
  double focal_length_m = 0.08;
  double baseline_m = 0.2;
  double half_width_m = 0.08;     // of the detector
  double angle_x_offset_rad = 0;  // added to what the mirrors say
  double angle_y_offset_rad = 0;
  double focal_length_per_K = 0;  // relative growth
  double baseline_per_K = 0;
  double peak_per_K = 0;  // half widths
  double reference_degC = 20;
  // Where it was calibrated.
  double angle_max_rad = 0.3;  // either mirror
  double depth_min_m = 0.5;
  double depth_max_m = 12;
  double temperature_min_degC = -20;
  double temperature_max_degC = 50;
  // Within kOutsideMargin beyond these depths and temperatures, by how much the noise of a point is taken to be larger.
  double outside_sigma_factor = 5;
  double residual[kResidualTerms] = {};
};

// Of the temperatures' range on either side; depths from depth_min / (1 + margin) to depth_max (1 + margin).
constexpr double kOutsideMargin = 0.25;

// A real number of a calibration, and the range that any camera's lies in, inclusive.
struct CalibrationReal {
  double TriangulationCalibration::*member;
  double minimum, maximum;
};

// All but the residual's terms, in the order of the image.
constexpr double kMaxSigmaFactor = 10;  // more would let a ray reach through the target
constexpr CalibrationReal kCalibrationReals[] = {{&TriangulationCalibration::focal_length_m, 0, 10},
                                                 {&TriangulationCalibration::baseline_m, 0, 10},
                                                 {&TriangulationCalibration::half_width_m, 0, 10},
                                                 {&TriangulationCalibration::angle_x_offset_rad, -0.5, 0.5},
                                                 {&TriangulationCalibration::angle_y_offset_rad, -0.5, 0.5},
                                                 {&TriangulationCalibration::focal_length_per_K, -0.01, 0.01},
                                                 {&TriangulationCalibration::baseline_per_K, -0.01, 0.01},
                                                 {&TriangulationCalibration::peak_per_K, -0.01, 0.01},
                                                 {&TriangulationCalibration::reference_degC, -100, 100},
                                                 {&TriangulationCalibration::angle_max_rad, 0, 1},
                                                 {&TriangulationCalibration::depth_min_m, 0, 1000},
                                                 {&TriangulationCalibration::depth_max_m, 0, 1000},
                                                 {&TriangulationCalibration::temperature_min_degC, -100, 100},
                                                 {&TriangulationCalibration::temperature_max_degC, -100, 100},
                                                 {&TriangulationCalibration::outside_sigma_factor, 1, kMaxSigmaFactor}};
constexpr std::size_t kCalibrationRealCount = sizeof(kCalibrationReals) / sizeof(kCalibrationReals[0]);
constexpr double kMaxResidual = 10;  // either sign

// kNotFinite; kBadValue: a number outside its range, no serial number, a volume without content, or angles beyond the wire's; kSingular:
// focal length, baseline or half width not above 0 (at any temperature that it serves), or a spot that does not grow with the peak.
Status validate(const TriangulationCalibration& calibration);

}  // namespace lasso
