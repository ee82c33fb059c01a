// A camera's calibration from raw points of known planes: maximum likelihood for a detector whose spot has the same noise everywhere.
#pragma once

#include <string>
#include <vector>

#include "mdat/calibrate/raw_points.hpp"

namespace lasso::mdat {

// Where the data lie, and what the calibration leaves there.
struct ResidualCell {
  double depth_m = 0, angle_x_rad = 0;  // the middle
  std::size_t points = 0;
  double rms_over_noise = 0, mean_over_noise = 0;
};

struct CalibrationReport {
  std::size_t points = 0;  // that the calibration makes points of; the others are in no figure
  int iterations = 0;
  double rms_mm = 0;          // along the rays
  double rms_over_noise = 0;  // normalised by sigma_k z^2; 1 is what a perfect calibration leaves
  double worst_cell = 0;      // largest rms_over_noise of a cell with enough points
  std::vector<ResidualCell> cells;
};

struct CalibrationFit {
  lcs::Calibration calibration;
  CalibrationReport report;
};

// Levenberg-Marquardt (Eigen's) over focal length, baseline, offsets of both angles, their three growths with temperature and the residual
// polynomial. What the points do not tell, as focal length and peak's scale together, stays near `start`; half width and reference
// temperature are start's. The calibrated volume is that of the points. Throws InputError: too few points, no convergence within
// `max_evaluations` of all errors, a fit that is no calibration, or one that makes no points of more than 5 % of them.
CalibrationFit fit_calibration(const lcs::Calibration& start, const std::vector<RawPoint>& points, double sigma_k_per_m,
                               int max_evaluations = 2000);

// What a calibration leaves of the points.
CalibrationReport residuals_of(const lcs::Calibration& calibration, const std::vector<RawPoint>& points, double sigma_k_per_m);

}  // namespace lasso::mdat
