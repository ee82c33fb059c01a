// Errors of a simulated scanner that do not average out over a scan's rays: the same for all of them, slow from scan to scan.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fsw/core/time.hpp"
#include "fsw/geometry/types.hpp"

namespace lasso::sim {

// In sigmas, each normal, of mean 0 and variance 1 over all seeds.
struct CommonErrors {
  double range = 0;
  Vec3 turn = Vec3::Zero();  // about the sensor's x, y and z
};

// Without memory they are drawn anew for each scan. With one they follow a stationary process whose correlation is exp(-|dt| / memory): a
// sum of kWaves cosines, of random phases, whose angular rates have that correlation's spectrum, a Cauchy density of scale 1 / memory
// (Shinozuka & Deodatis 1991). It is a function of the time alone, so that any ray can be asked at any time.
class CommonErrorProcess {
 public:
  static constexpr int kWaves = 64;

  // memory_s >= 0.
  CommonErrorProcess(std::uint64_t seed, double memory_s);
  CommonErrors at(std::uint32_t scan_id, TimeUs t_us) const;

 private:
  struct Wave {
    double rate_radps, phase_rad;
  };
  double value(const std::array<Wave, kWaves>& waves, double t_s) const;

  std::uint64_t seed_;
  std::vector<std::array<Wave, kWaves>> waves_;  // of each error; empty without memory
};

}  // namespace lasso::sim
