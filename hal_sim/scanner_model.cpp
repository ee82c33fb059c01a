#include "hal_sim/scanner_model.hpp"

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace lasso::sim {
namespace {

struct Limit {
  const char* name;
  double ScannerModel::*member;
  double minimum, maximum;  // inclusive
};

constexpr double kUnbounded = std::numeric_limits<double>::max();
constexpr double kPositive = std::numeric_limits<double>::min();
constexpr double kBelowRightAngle = 1.57;

constexpr Limit kLimits[] = {
    {"sigma0_m", &ScannerModel::sigma0_m, 0, kUnbounded},
    {"sigma_k_per_m", &ScannerModel::sigma_k_per_m, 0, kUnbounded},
    {"sigma_angle_rad", &ScannerModel::sigma_angle_rad, 0, 0.1},
    {"fov_half_x_rad", &ScannerModel::fov_half_x_rad, kPositive, kBelowRightAngle},
    {"fov_half_y_rad", &ScannerModel::fov_half_y_rad, kPositive, kBelowRightAngle},
    {"range_min_m", &ScannerModel::range_min_m, 0, kUnbounded},
    {"range_max_m", &ScannerModel::range_max_m, kPositive, kUnbounded},
    {"dropout_probability", &ScannerModel::dropout_probability, 0, 1},
    {"dropout_incidence_rad", &ScannerModel::dropout_incidence_rad, kPositive, kPi / 2},
    {"outlier_probability", &ScannerModel::outlier_probability, 0, 1},
    {"edge_mixing_m", &ScannerModel::edge_mixing_m, 0, kUnbounded},
    {"beam_divergence_rad", &ScannerModel::beam_divergence_rad, 0, 0.1},
    {"edge_mixing_probability", &ScannerModel::edge_mixing_probability, 0, 1},
    {"range_step_m", &ScannerModel::range_step_m, 0, kUnbounded},
    {"common_sigma_m", &ScannerModel::common_sigma_m, 0, kUnbounded},
    {"common_sigma_k_per_m", &ScannerModel::common_sigma_k_per_m, 0, kUnbounded},
    {"common_sigma_rad", &ScannerModel::common_sigma_rad, 0, 0.2},
    {"common_memory_s", &ScannerModel::common_memory_s, 0, kUnbounded},
};

void check(const ScannerModel& model, const Limit& limit) {
  const double value = model.*limit.member;
  if (value >= limit.minimum && value <= limit.maximum) return;  // false for NaN
  std::ostringstream message;
  message << "scanner model: " << limit.name << " is " << value << ", expected " << limit.minimum << " to " << limit.maximum;
  throw std::invalid_argument(message.str());
}

}  // namespace

bool has_common_errors(const ScannerModel& model) {
  return model.common_sigma_m > 0 || model.common_sigma_k_per_m > 0 || model.common_sigma_rad > 0;
}

void validate(const ScannerModel& model) {
  for (const Limit& limit : kLimits) check(model, limit);
  validate(model.detector);
  if (model.range_min_m < model.range_max_m) return;
  std::ostringstream message;
  message << "scanner model: range_min_m is " << model.range_min_m << ", expected less than range_max_m (" << model.range_max_m << ")";
  throw std::invalid_argument(message.str());
}

RayDraws draw(std::uint64_t seed, std::uint32_t scan_id, std::uint32_t ray) {
  Random random = ray_stream(seed, scan_id, ray);
  RayDraws draws{};
  draws.outlier = random.uniform();
  draws.outlier_place = random.uniform();
  draws.dropout = random.uniform();
  draws.mixing = random.uniform();
  draws.mixing_weight = random.uniform();
  draws.tilt_x = random.gaussian();
  draws.tilt_y = random.gaussian();
  draws.range = random.gaussian();
  return draws;
}

double footprint_m(const ScannerModel& model, double range_m) { return model.edge_mixing_m + model.beam_divergence_rad * range_m; }

double range_sigma_m(const ScannerModel& model, double z_m) {
  const double far_m = model.sigma_k_per_m * z_m * z_m;
  return std::sqrt(model.sigma0_m * model.sigma0_m + far_m * far_m);
}

}  // namespace lasso::sim
