#include "mdat/stereo/error_field.hpp"

#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "hal_sim/random.hpp"

namespace lasso::mdat {
namespace {

constexpr int kReach = 3;  // lattice points, on either side

// Mean 0, variance 1: the sum of four even numbers of 16 bits, whose blurred sums are normal.
double lattice_noise(std::uint64_t seed, std::int64_t column, std::int64_t row) {
  std::uint64_t state = seed;
  state = sim::split_mix64(state) ^ static_cast<std::uint64_t>(column);
  state = sim::split_mix64(state) ^ static_cast<std::uint64_t>(row);
  const std::uint64_t bits = sim::split_mix64(state);
  const auto sum = static_cast<double>((bits & 0xFFFFU) + ((bits >> 16) & 0xFFFFU) + ((bits >> 32) & 0xFFFFU) + (bits >> 48));
  return (sum / 65536 - 2 + 4 * 0.5 / 65536) * std::sqrt(3.0);
}

}  // namespace

double error_field(std::uint64_t seed, double column, double row, double blur_px) {
  const double x = column / blur_px, y = row / blur_px;
  const auto near_x = static_cast<std::int64_t>(std::floor(x + 0.5)), near_y = static_cast<std::int64_t>(std::floor(y + 0.5));
  double along_x[2 * kReach + 1], sum = 0, squares = 0;
  for (int i = -kReach; i <= kReach; ++i) {
    const double off = x - static_cast<double>(near_x + i);
    along_x[i + kReach] = std::exp(-0.5 * off * off);
  }
  for (int j = -kReach; j <= kReach; ++j) {
    const double off = y - static_cast<double>(near_y + j), along_y = std::exp(-0.5 * off * off);
    for (int i = -kReach; i <= kReach; ++i) {
      const double weight = along_x[i + kReach] * along_y;
      sum += weight * lattice_noise(seed, near_x + i, near_y + j);
      squares += weight * weight;
    }
  }
  return sum / std::sqrt(squares);
}

double normal_share(double x) {
  const double t = 1 / (1 + 0.2316419 * std::fabs(x));
  const double poly = t * (0.319381530 + t * (-0.356563782 + t * (1.781477937 + t * (-1.821255978 + t * 1.330274429))));
  const double tail = std::exp(-0.5 * x * x) / std::sqrt(2 * kPi) * poly;
  return x >= 0 ? 1 - tail : tail;
}

}  // namespace lasso::mdat
