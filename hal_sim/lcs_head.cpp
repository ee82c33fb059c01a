#include "hal_sim/lcs_head.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace lasso::sim {
namespace {

constexpr int kPeakIterations = 30;
constexpr double kNowhereM = 1e9;  // a range for rays that met nothing

double corrected(const lcs::Calibration& c, double x, double y, double peak) {
  const double phi[kResidualTerms] = {1, x, y, peak, x * x, x * y, y * y, x * peak, y * peak, peak * peak};
  double sum = 0;
  for (std::size_t k = 0; k < kResidualTerms; ++k) sum += c.residual[k] * phi[k];
  return sum;
}

lcs::Optics of_its_kind(const LcsCamera& camera) {
  if (camera.device == lcs::Device::kLaserCamera) return lcs::Optics(camera.truth);
  if (camera.device == lcs::Device::kLidar) return lcs::Optics(camera.clock);
  return {camera.truth, camera.clock};
}

}  // namespace

lcs::RawSample raw_sample(const lcs::Calibration& truth, double temperature_degC, const Vec3& direction, double range_m) {
  const double warmer_K = temperature_degC - truth.reference_degC;
  const double f_m = truth.focal_length_m * (1 + truth.focal_length_per_K * warmer_K);
  const double d_m = truth.baseline_m * (1 + truth.baseline_per_K * warmer_K);
  const double x = std::atan2(direction.x(), direction.z()), y = std::atan2(direction.y(), direction.z());
  const double spot = (f_m * d_m / (range_m * direction.z()) - f_m * direction.x() / direction.z()) / truth.half_width_m;
  double peak = spot;
  for (int i = 0; i < kPeakIterations; ++i) peak = spot - truth.peak_per_K * warmer_K - corrected(truth, x, y, peak);
  lcs::RawSample raw;
  raw.angle_x_rad = x - truth.angle_x_offset_rad;
  raw.angle_y_rad = y - truth.angle_y_offset_rad;
  raw.peak = peak;
  raw.kind = lcs::SampleKind::kReturn;
  return raw;
}

lcs::RawSample raw_echo(const lcs::EchoCalibration& truth, double temperature_degC, const Vec3& direction, double range_m) {
  lcs::RawSample raw;
  raw.angle_x_rad = std::atan2(direction.x(), direction.z()) - truth.angle_x_offset_rad;
  raw.angle_y_rad = std::atan2(direction.y(), direction.z()) - truth.angle_y_offset_rad;
  const double delay_us = truth.delay_us + truth.delay_us_per_K * (temperature_degC - truth.reference_degC);
  raw.flight_us = range_m / lcs::kHalfLightMPerUs / (1 + truth.clock_error) + delay_us;
  raw.kind = lcs::SampleKind::kEcho;
  return raw;
}

lcs::Optics optics_of(const LcsCamera& camera) {
  const lcs::Optics optics = of_its_kind(camera);
  const Status status = optics.validate();
  if (status != Status::kOk) throw std::invalid_argument(std::string("the camera's optics: ") + to_string(status));
  return optics;
}

bool within_mirrors(const LcsCamera& camera, const ScanPlan& plan) {
  constexpr double kRounded = 1 + 1.0 / (1 << 22);  // the plan's numbers have 24 bits
  const double limit = kRounded * std::tan(optics_of(camera).mirrors().max_rad);
  return std::abs(plan.center_x) + plan.half_x <= limit && std::abs(plan.center_y) + plan.half_y <= limit;
}

lcs::RawSample raw_of(const LcsCamera& camera, const Vec3& direction, const RangeSample& seen) {
  const auto temperature_degC = static_cast<double>(camera.temperature_degC), range_m = static_cast<double>(seen.range_m);
  const bool spot = seen.state == RayState::kHit;
  const bool far = camera.device == lcs::Device::kTridar && range_m > camera.hand_over_m;
  lcs::RawSample raw = far || camera.device == lcs::Device::kLidar
                           ? raw_echo(camera.clock, temperature_degC, direction, range_m)
                           : raw_sample(camera.truth, temperature_degC, direction, spot ? range_m : kNowhereM);
  raw.intensity = spot ? 8 : 0;
  if (!spot) raw.kind = seen.state == RayState::kMiss ? lcs::SampleKind::kNothing : lcs::SampleKind::kSaturated;
  return raw;
}

}  // namespace lasso::sim
