#include "hal_sim/random.hpp"

#include <bit>
#include <cmath>

namespace lasso::sim {
namespace {

constexpr double kLn2 = 0.693147180559945309417;
constexpr double kSqrt2 = 1.41421356237309504880;

struct MantissaExponent {
  double mantissa;  // [1, 2)
  int exponent;
};

MantissaExponent split(double x) {
  constexpr std::uint64_t kMantissaBits = (1ULL << 52) - 1;
  constexpr std::uint64_t kExponentOfOne = 1023ULL << 52;
  const auto word = std::bit_cast<std::uint64_t>(x);
  return {std::bit_cast<double>((word & kMantissaBits) | kExponentOfOne), static_cast<int>((word >> 52) & 0x7FF) - 1023};
}

}  // namespace

std::uint64_t split_mix64(std::uint64_t& state) {
  state += 0x9E3779B97F4A7C15ULL;
  std::uint64_t z = state;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

double natural_logarithm(double x) {
  auto [m, e] = split(x);
  if (m > kSqrt2) {
    m *= 0.5;
    e += 1;
  }
  const double s = (m - 1.0) / (m + 1.0);  // |s| <= 0.1716: the term after s^21/21 is below 1e-19
  const double s2 = s * s;
  double series = 0;
  for (int k = 21; k >= 3; k -= 2) series = (series + 1.0 / k) * s2;
  return 2.0 * (s + s * series) + e * kLn2;
}

Random::Random(std::uint64_t seed) {
  for (auto& word : state_) word = split_mix64(seed);
}

std::uint64_t Random::bits() {
  const std::uint64_t result = std::rotl(state_[1] * 5, 7) * 9;
  const std::uint64_t t = state_[1] << 17;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= t;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

double Random::uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

double Random::uniform(double low, double high) { return low + (high - low) * uniform(); }

double Random::gaussian() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  double x = 0;
  double y = 0;
  double r2 = 0;
  do {  // a point within the unit circle: accepted with probability pi/4
    x = 2.0 * uniform() - 1.0;
    y = 2.0 * uniform() - 1.0;
    r2 = x * x + y * y;
  } while (r2 >= 1.0 || r2 == 0.0);
  const double scale = std::sqrt(-2.0 * natural_logarithm(r2) / r2);
  spare_ = y * scale;
  has_spare_ = true;
  return x * scale;
}

Random ray_stream(std::uint64_t seed, std::uint32_t scan_id, std::uint32_t ray) {
  std::uint64_t of_run = seed;
  std::uint64_t of_ray = split_mix64(of_run) ^ ((std::uint64_t{scan_id} << 32) | ray);
  return Random(split_mix64(of_ray));
}

}  // namespace lasso::sim
