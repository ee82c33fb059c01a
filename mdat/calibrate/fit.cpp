#include "mdat/calibrate/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

#include "mdat/common/errors.hpp"

namespace lasso::mdat {
namespace {

using C = lcs::Calibration;
using Vector = Eigen::VectorXd;

// A parameter, and how far from the start the data have to pull it before the start counts for nothing.
struct Parameter {
  double C::*member;
  double sigma;
};
constexpr Parameter kParameters[] = {{&C::focal_length_m, 0.005},    {&C::baseline_m, 0.01},         {&C::angle_x_offset_rad, 0.02},
                                     {&C::angle_y_offset_rad, 0.02}, {&C::focal_length_per_K, 1e-3}, {&C::baseline_per_K, 1e-3},
                                     {&C::peak_per_K, 1e-3}};
constexpr double kResidualSigma = 0.05;
constexpr int kLengths = static_cast<int>(std::size(kParameters));
constexpr int kUnknowns = kLengths + static_cast<int>(kResidualTerms);
constexpr std::size_t kFewestPoints = 1000;
constexpr double kShareUsed = 0.95;  // of the points, that the fitted table has to make points of
constexpr std::size_t kDepthCells = 8, kAngleCells = 8, kCells = kDepthCells * kAngleCells;
constexpr std::size_t kFewestInCell = 50;

// Unknowns in units of their sigmas, from the start.
C calibration_at(const C& start, const Vector& x) {
  C c = start;
  for (int i = 0; i < kLengths; ++i) c.*kParameters[i].member += kParameters[i].sigma * x[i];
  for (int k = 0; k < static_cast<int>(kResidualTerms); ++k) c.residual[k] += kResidualSigma * x[kLengths + k];
  return c;
}

// Of the inverse depth, 1/m: what the camera measured, less where the plane is. Its noise is the same everywhere (dz = z^2 d(1/z)), and
// does not shrink with a focal length.
double inverse_depth_error(const C& c, const RawPoint& point) {
  const double warmer_K = point.temperature_degC - c.reference_degC;
  const double f_m = c.focal_length_m * (1 + c.focal_length_per_K * warmer_K);
  const double d_m = c.baseline_m * (1 + c.baseline_per_K * warmer_K);
  const double x = point.angle_x_rad + c.angle_x_offset_rad, y = point.angle_y_rad + c.angle_y_offset_rad, q = point.peak;
  const double phi[kResidualTerms] = {1, x, y, q, x * x, x * y, y * y, x * q, y * q, q * q};
  double peak = q + c.peak_per_K * warmer_K;
  for (std::size_t k = 0; k < kResidualTerms; ++k) peak += c.residual[k] * phi[k];
  const Vec3 ray(std::tan(x), std::tan(y), 1);
  const double depth_m = point.distance_m / point.normal.dot(ray);
  return (c.half_width_m * peak + f_m * ray.x()) / (f_m * d_m) - 1 / depth_m;
}

// The points' errors in units of their noise, then how far the unknowns are from the start.
struct Errors {
  using Scalar = double;
  using InputType = Vector;
  using ValueType = Vector;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const C& start;
  const std::vector<RawPoint>& points;
  double sigma_per_m;

  int inputs() const { return kUnknowns; }
  int values() const { return static_cast<int>(points.size()) + kUnknowns; }
  int operator()(const Vector& x, Vector& errors) const {
    const C c = calibration_at(start, x);
    for (std::size_t i = 0; i < points.size(); ++i) errors[static_cast<Eigen::Index>(i)] = inverse_depth_error(c, points[i]) / sigma_per_m;
    errors.tail(kUnknowns) = x;
    return 0;
  }
};

// Of one point by the flight's own triangulation: along the ray, in metres. Not a number where that makes no point.
struct Residual {
  double depth_m, error_m;
};
Residual residual_of(const C& calibration, const RawPoint& point) {
  lcs::RawSample raw;
  raw.kind = lcs::SampleKind::kReturn;
  raw.angle_x_rad = point.angle_x_rad;
  raw.angle_y_rad = point.angle_y_rad;
  raw.peak = point.peak;
  RangeSample sample;
  const lcs::Triangulation triangulation(calibration, point.temperature_degC);
  const bool made = triangulation.convert(raw, 0, sample) == lcs::Fate::kPoint;
  const Vec3 ray = Eigen::Map<const Eigen::Vector3f>(sample.direction).cast<double>().normalized();
  const double range_m = point.distance_m / point.normal.dot(ray);
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  return {range_m * ray.z(), made ? static_cast<double>(sample.range_m) - range_m : nothing};
}

// The cells of a calibration's volume, of equal ratios of depth and equal angles.
class Volume {
 public:
  explicit Volume(const C& c) : low_(std::log(c.depth_min_m)), high_(std::log(c.depth_max_m)), angle_max_rad_(c.angle_max_rad) {}

  std::vector<ResidualCell> cells() const {
    std::vector<ResidualCell> cells(kCells);
    for (std::size_t i = 0; i < kCells; ++i) {
      const std::size_t layer = i / kAngleCells;
      const auto depth = static_cast<double>(layer), angle = static_cast<double>(i % kAngleCells);
      cells[i].depth_m = std::exp(low_ + (high_ - low_) * (depth + 0.5) / kDepthCells);
      cells[i].angle_x_rad = angle_max_rad_ * (2 * (angle + 0.5) / kAngleCells - 1);
    }
    return cells;
  }
  std::size_t index(double depth_m, double angle_x_rad) const {
    const std::size_t depth = place((std::log(depth_m) - low_) / (high_ - low_), kDepthCells);
    return depth * kAngleCells + place((angle_x_rad / angle_max_rad_ + 1) / 2, kAngleCells);
  }

 private:
  static std::size_t place(double share, std::size_t cells) {
    const double last = static_cast<double>(cells) - 1;
    return static_cast<std::size_t>(std::clamp(std::floor(share * static_cast<double>(cells)), 0.0, last));
  }
  double low_, high_, angle_max_rad_;
};

// Sums become means.
void finish(ResidualCell& cell, CalibrationReport& report) {
  const double count = static_cast<double>(std::max<std::size_t>(cell.points, 1));
  cell.rms_over_noise = std::sqrt(cell.rms_over_noise / count);
  cell.mean_over_noise /= count;
  if (cell.points >= kFewestInCell) report.worst_cell = std::max(report.worst_cell, cell.rms_over_noise);
}

// The volume that the points fill, with a margin for the returns' noise.
void set_volume(const std::vector<RawPoint>& points, C& c) {
  constexpr double kMargin = 0.02;
  c.angle_max_rad = c.depth_max_m = 0;
  c.depth_min_m = std::numeric_limits<double>::max();
  c.temperature_min_degC = c.temperature_max_degC = points.front().temperature_degC;
  for (const RawPoint& point : points) {
    const double x = point.angle_x_rad + c.angle_x_offset_rad, y = point.angle_y_rad + c.angle_y_offset_rad;
    const double depth_m = point.distance_m / point.normal.dot(Vec3(std::tan(x), std::tan(y), 1));
    c.angle_max_rad = std::max({c.angle_max_rad, (1 + kMargin) * std::abs(x), (1 + kMargin) * std::abs(y)});
    c.depth_min_m = std::min(c.depth_min_m, (1 - kMargin) * depth_m);
    c.depth_max_m = std::max(c.depth_max_m, (1 + kMargin) * depth_m);
    c.temperature_min_degC = std::min(c.temperature_min_degC, point.temperature_degC);
    c.temperature_max_degC = std::max(c.temperature_max_degC, point.temperature_degC);
  }
}

// Has the search come to its end: by a tolerance, or as far as the arithmetic goes?
bool converged(Eigen::LevenbergMarquardtSpace::Status status) {
  using namespace Eigen::LevenbergMarquardtSpace;
  return (status >= RelativeReductionTooSmall && status <= CosinusTooSmall) || (status >= FtolTooSmall && status <= GtolTooSmall);
}

void require_most_used(const CalibrationReport& report, std::size_t points) {
  if (static_cast<double>(report.points) >= kShareUsed * static_cast<double>(points)) return;
  throw InputError("the fitted calibration makes points of only " + std::to_string(report.points) + " of the " + std::to_string(points) +
                   " raw points: compare the planes with the points, and leave out those of other cameras");
}

}  // namespace

CalibrationFit fit_calibration(const lcs::Calibration& start, const std::vector<RawPoint>& points, double sigma_k_per_m,
                               int max_evaluations) {
  if (points.size() < kFewestPoints) {
    throw InputError("a calibration needs at least " + std::to_string(kFewestPoints) + " raw points, spread over the volume; there are " +
                     std::to_string(points.size()));
  }
  const Errors errors{start, points, sigma_k_per_m};
  Eigen::NumericalDiff<Errors, Eigen::Central> with_slopes(errors);
  Eigen::LevenbergMarquardt<Eigen::NumericalDiff<Errors, Eigen::Central>> solver(with_slopes);
  solver.parameters.maxfev = max_evaluations;
  solver.parameters.xtol = solver.parameters.ftol = 1e-12;
  Vector x = Vector::Zero(kUnknowns);
  if (!converged(solver.minimize(x))) {
    throw InputError("the fit does not converge in " + std::to_string(max_evaluations) +
                     " evaluations: compare the planes with the points, and begin from a better table");
  }
  CalibrationFit fit;
  fit.calibration = calibration_at(start, x);
  set_volume(points, fit.calibration);
  const Status status = lasso::validate(fit.calibration);
  if (status != Status::kOk) {
    throw InputError(std::string("the fit is no calibration (") + to_string(status) +
                     "): compare the planes with the points, and begin from a better table");
  }
  fit.report = residuals_of(fit.calibration, points, sigma_k_per_m);
  fit.report.iterations = static_cast<int>(solver.iter);
  require_most_used(fit.report, points.size());
  return fit;
}

CalibrationReport residuals_of(const lcs::Calibration& calibration, const std::vector<RawPoint>& points, double sigma_k_per_m) {
  const Volume volume(calibration);
  CalibrationReport report;
  report.cells = volume.cells();
  double squares_m2 = 0, squares = 0;
  for (const RawPoint& point : points) {
    const Residual residual = residual_of(calibration, point);
    if (!std::isfinite(residual.error_m)) continue;
    const double normalised = residual.error_m / (sigma_k_per_m * residual.depth_m * residual.depth_m);
    ResidualCell& cell = report.cells[volume.index(residual.depth_m, point.angle_x_rad)];
    ++cell.points;
    cell.rms_over_noise += normalised * normalised;
    cell.mean_over_noise += normalised;
    ++report.points;
    squares_m2 += residual.error_m * residual.error_m;
    squares += normalised * normalised;
  }
  const double n = static_cast<double>(std::max<std::size_t>(report.points, 1));
  report.rms_mm = 1e3 * std::sqrt(squares_m2 / n);
  report.rms_over_noise = std::sqrt(squares / n);
  for (ResidualCell& cell : report.cells) finish(cell, report);
  return report;
}

}  // namespace lasso::mdat
