#include "hal_sim/camera_model.hpp"

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace lasso::sim {
namespace {

struct Limit {
  const char* name;
  double CameraModel::*member;
  double minimum, maximum;  // inclusive
};

constexpr double kUnbounded = std::numeric_limits<double>::max();
constexpr double kPositive = std::numeric_limits<double>::min();
constexpr double kBelowRightAngle = 1.57;

constexpr Limit kLimits[] = {
    {"sigma0_m", &CameraModel::sigma0_m, 0, kUnbounded},
    {"sigma_k_per_m", &CameraModel::sigma_k_per_m, 0, kUnbounded},
    {"sigma_angle_rad", &CameraModel::sigma_angle_rad, 0, 0.1},
    {"fov_half_x_rad", &CameraModel::fov_half_x_rad, kPositive, kBelowRightAngle},
    {"fov_half_y_rad", &CameraModel::fov_half_y_rad, kPositive, kBelowRightAngle},
    {"range_min_m", &CameraModel::range_min_m, 0, kUnbounded},
    {"range_max_m", &CameraModel::range_max_m, kPositive, kUnbounded},
    {"dropout_probability", &CameraModel::dropout_probability, 0, 1},
    {"dropout_incidence_rad", &CameraModel::dropout_incidence_rad, kPositive, kPi / 2},
    {"outlier_probability", &CameraModel::outlier_probability, 0, 1},
    {"edge_mixing_m", &CameraModel::edge_mixing_m, 0, kUnbounded},
    {"edge_mixing_probability", &CameraModel::edge_mixing_probability, 0, 1},
    {"range_step_m", &CameraModel::range_step_m, 0, kUnbounded},
};

void check(const CameraModel& model, const Limit& limit) {
  const double value = model.*limit.member;
  if (value >= limit.minimum && value <= limit.maximum) return;  // false for NaN
  std::ostringstream message;
  message << "camera model: " << limit.name << " is " << value << ", expected " << limit.minimum << " to " << limit.maximum;
  throw std::invalid_argument(message.str());
}

}  // namespace

void validate(const CameraModel& model) {
  for (const Limit& limit : kLimits) check(model, limit);
  if (model.range_min_m < model.range_max_m) return;
  std::ostringstream message;
  message << "camera model: range_min_m is " << model.range_min_m << ", expected less than range_max_m (" << model.range_max_m << ")";
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

double range_sigma_m(const CameraModel& model, double z_m) {
  const double far_m = model.sigma_k_per_m * z_m * z_m;
  return std::sqrt(model.sigma0_m * model.sigma0_m + far_m * far_m);
}

}  // namespace lasso::sim
