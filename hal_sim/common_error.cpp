#include "hal_sim/common_error.hpp"

#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "hal_sim/random.hpp"

namespace lasso::sim {
namespace {

constexpr int kErrors = 4;
constexpr std::uint64_t kStream = 0x636f6d6d6f6eU;  // "common": not that of the rays

// Strata of the spectrum, one wave each: fewer waves show the correlation as well.
double cauchy(double scale, int stratum, int strata, Random& random) {
  return scale * tangent(kPi * ((stratum + random.uniform()) / strata - 0.5));
}

}  // namespace

CommonErrorProcess::CommonErrorProcess(std::uint64_t seed, double memory_s) : seed_(seed ^ kStream) {
  if (!(memory_s > 0)) return;
  Random random(seed_);
  waves_.resize(kErrors);
  for (auto& waves : waves_) {
    for (int i = 0; i < kWaves; ++i) {
      const double rate_radps = cauchy(1 / memory_s, i, kWaves, random);
      waves[static_cast<std::size_t>(i)] = {rate_radps, random.uniform(-kPi, kPi)};
    }
  }
}

double CommonErrorProcess::value(const std::array<Wave, kWaves>& waves, double t_s) const {
  double sum = 0;
  for (const Wave& wave : waves) sum += sin_cos(std::remainder(wave.rate_radps * t_s + wave.phase_rad, 2 * kPi)).cos;
  return sum * std::sqrt(2.0 / kWaves);
}

CommonErrors CommonErrorProcess::at(std::uint32_t scan_id, TimeUs t_us) const {
  std::array<double, kErrors> errors{};
  Random random = ray_stream(seed_, scan_id, 0);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    errors[i] = waves_.empty() ? random.gaussian() : value(waves_[i], to_seconds(t_us));
  }
  return {errors[0], Vec3(errors[1], errors[2], errors[3])};
}

}  // namespace lasso::sim
