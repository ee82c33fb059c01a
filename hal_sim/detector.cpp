#include "hal_sim/detector.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "fsw/geometry/portable_math.hpp"
#include "hal_sim/random.hpp"

namespace lasso::sim {
namespace {

struct DetectorLimit {
  const char* name;
  double DetectorModel::*member;
  double minimum, maximum;  // inclusive
};

constexpr double kAnyAmount = std::numeric_limits<double>::max();
constexpr double kMoreThanNone = std::numeric_limits<double>::min();

constexpr DetectorLimit kDetectorLimits[] = {
    {"reference_electrons", &DetectorModel::reference_electrons, 0, kAnyAmount},
    {"reference_range_m", &DetectorModel::reference_range_m, kMoreThanNone, kAnyAmount},
    {"reference_reflectance", &DetectorModel::reference_reflectance, kMoreThanNone, 1},
    {"noise_electrons", &DetectorModel::noise_electrons, 0, kAnyAmount},
    {"threshold_electrons", &DetectorModel::threshold_electrons, 0, kAnyAmount},
    {"saturation_electrons", &DetectorModel::saturation_electrons, 0, kAnyAmount},
    {"width_m", &DetectorModel::width_m, 0, kAnyAmount},
    {"width_k_per_m", &DetectorModel::width_k_per_m, 0, kAnyAmount},
    {"bandpass_m", &DetectorModel::bandpass_m, 0, kAnyAmount},
    {"energy_J", &DetectorModel::energy_J, 0, kAnyAmount},
    {"field_rad", &DetectorModel::field_rad, 0, kPi / 2},
    {"gate_s", &DetectorModel::gate_s, 0, kAnyAmount},
    {"glare_per_sr", &DetectorModel::glare_per_sr, 0, kAnyAmount},
};

// Angular radius of the Sun at 1 AU, rad, and the solid angle of its disc.
constexpr double kSunHalfAngle_rad = 4.6505e-3;
constexpr double kSunDisc_sr = kPi * kSunHalfAngle_rad * kSunHalfAngle_rad;

constexpr double kHalfHeightWidths = 2.354820045;  // 2 sqrt(2 ln 2)
constexpr std::size_t kAlarmSteps = 256;

constexpr std::uint64_t kDetectorStream = 0x6465746563746fU;  // not that of the other draws

Echo joined(const Echo& a, const Echo& b) {
  const double electrons = a.electrons + b.electrons;
  const double share = electrons > 0 ? b.electrons / electrons : 0;
  return {a.range_m + share * (b.range_m - a.range_m), a.z_m + share * (b.z_m - a.z_m), electrons, a.scattered && b.scattered};
}

bool are_one(const DetectorModel& model, const Echo& a, const Echo& b) {
  if (model.returns == Returns::kMixed && !a.scattered && !b.scattered) return true;
  return std::abs(a.range_m - b.range_m) < kHalfHeightWidths * width_m(model, (a.z_m + b.z_m) / 2);
}

// Each with those before it that it cannot be told from.
Echoes resolved(const DetectorModel& model, const Echoes& echoes) {
  Echoes apart;
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    bool is_new = true;
    for (std::size_t k = 0; k < apart.size() && is_new; ++k) {
      is_new = !are_one(model, apart[k], echoes[i]);
      if (!is_new) apart[k] = joined(apart[k], echoes[i]);
    }
    if (is_new) apart.add(echoes[i]);
  }
  return apart;
}

bool is_preferred(Returns returns, const Echo& a, const Echo& b) {
  if (returns == Returns::kStrongest) return a.electrons > b.electrons;
  return returns == Returns::kLast ? a.range_m > b.range_m : a.range_m < b.range_m;
}

}  // namespace

void validate(const DetectorModel& model) {
  for (const DetectorLimit& limit : kDetectorLimits) {
    const double value = model.*limit.member;
    if (value >= limit.minimum && value <= limit.maximum) continue;  // false for NaN
    std::ostringstream message;
    message << "detector: " << limit.name << " is " << value << ", expected " << limit.minimum << " to " << limit.maximum;
    throw std::invalid_argument(message.str());
  }
  if (model.bandpass_m > 0 && !(model.energy_J > 0)) throw std::invalid_argument("detector: energy_J is 0, expected more with a bandpass");
}

double signal_electrons(const DetectorModel& model, double backscatter, double range_m) {
  const double nearer = model.reference_range_m / range_m;
  return model.reference_electrons * (backscatter / model.reference_reflectance) * nearer * nearer;
}

double noise_electrons(const DetectorModel& model, double signal, double background) {
  return std::sqrt(signal + background + model.noise_electrons * model.noise_electrons);
}

double width_m(const DetectorModel& model, double z_m) {
  const double far_m = model.width_k_per_m * z_m * z_m;
  return std::sqrt(model.width_m * model.width_m + far_m * far_m);
}

double return_probability(const DetectorModel& model, double signal, double background) {
  const double noise = noise_electrons(model, signal, background);
  if (noise == 0) return signal > model.threshold_electrons ? 1 : 0;
  return normal_cumulative((signal - model.threshold_electrons) / noise);
}

double sun_electrons(const DetectorModel& model, double radiance_per_sr) {
  const double wavelengths_nm = 1e9 * model.bandpass_m, R0_m = model.reference_range_m;
  const double light_J_m2 =
      radiance_per_sr * kSunIrradiance_Wpm2nm * wavelengths_nm * kPi * model.field_rad * model.field_rad * model.gate_s;
  return light_J_m2 * model.reference_electrons * kPi * R0_m * R0_m / (model.energy_J * model.reference_reflectance);
}

double glare_radiance_per_sr(const DetectorModel& model, double cos_sun) {
  if (cos_sun <= 0) return 0;
  const double rim_rad = model.field_rad + kSunHalfAngle_rad;
  const double sin2 = std::max(1 - cos_sun * cos_sun, rim_rad * rim_rad);  // no nearer than where the disc itself is seen
  const double scattered = model.glare_per_sr / sin2;
  if (1 - cos_sun * cos_sun > rim_rad * rim_rad) return scattered;
  return scattered + 1 / std::max(kSunDisc_sr, kPi * model.field_rad * model.field_rad);
}

DetectorDraws draw_detector(std::uint64_t seed, std::uint32_t scan_id, std::uint32_t ray) {
  Random random = ray_stream(seed ^ kDetectorStream, scan_id, ray);
  DetectorDraws draws;
  for (double& count : draws.counts) count = random.gaussian();
  draws.alarm = 1 - random.uniform();
  return draws;
}

FalseAlarms::FalseAlarms(const DetectorModel& model, double range_min_m, double range_max_m) : model_(model) {
  if (!is_simulated(model) || (model.width_m == 0 && model.width_k_per_m == 0)) return;
  // Steps of one ratio: the width may grow with the square of the range.
  double range_m = std::max(range_min_m, 1e-4 * range_max_m), widths = 0;
  const double ratio = exponential(natural_logarithm(range_max_m / range_m) / kAlarmSteps);
  for (std::size_t i = 0; i < kAlarmSteps; ++i) {
    ranges_m_.push_back(range_m);
    widths_.push_back(widths);
    const double next_m = range_m * ratio, middle_m = (range_m + next_m) / 2;
    const double inverse = 1 / width_m(model, range_m) + 4 / width_m(model, middle_m) + 1 / width_m(model, next_m);  // Simpson's rule
    widths += (next_m - range_m) / 6 * inverse;
    range_m = next_m;
  }
  ranges_m_.push_back(range_m);
  widths_.push_back(widths);
}

double FalseAlarms::mean(double background) const {
  const double noise = noise_electrons(model_, 0, background);
  if (ranges_m_.empty() || noise == 0) return 0;
  const double t = model_.threshold_electrons / noise;
  return widths_.back() * exponential(-t * t / 2) / (2 * std::sqrt(2.0) * kPi);
}

double FalseAlarms::range_m(double background, const DetectorDraws& draws) const {
  const double expected = mean(background);
  const double place = -natural_logarithm(draws.alarm);
  if (place >= expected) return -1;
  const double widths = place / expected * widths_.back();
  const auto after = std::upper_bound(widths_.begin(), widths_.end(), widths);
  const auto i = static_cast<std::size_t>(std::min(after, widths_.end() - 1) - widths_.begin());
  const double share = (widths - widths_[i - 1]) / (widths_[i] - widths_[i - 1]);
  return ranges_m_[i - 1] + share * (ranges_m_[i] - ranges_m_[i - 1]);
}

Detection detect(const DetectorModel& model, Echoes echoes, double background, const DetectorDraws& draws) {
  Detection found;
  if (model.saturation_electrons > 0 && background > model.saturation_electrons) return {RayState::kInvalid, {}};
  echoes = resolved(model, echoes);
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    const Echo& echo = echoes[i];
    const double count = is_simulated(model) ? echo.electrons + draws.counts[i] * noise_electrons(model, echo.electrons, background) : 0;
    if (is_simulated(model) && (count <= model.threshold_electrons || echo.electrons <= 0)) continue;
    if (model.saturation_electrons > 0 && count + background > model.saturation_electrons) return {RayState::kInvalid, echo};
    if (found.state == RayState::kHit && !is_preferred(model.returns, echo, found.echo)) continue;
    found = {RayState::kHit, echo};
  }
  return found;
}

double detector_sigma_m(const DetectorModel& model, const Echo& echo, double background) {
  if (!is_simulated(model)) return 0;
  return width_m(model, echo.z_m) * noise_electrons(model, echo.electrons, background) / echo.electrons;
}

}  // namespace lasso::sim
