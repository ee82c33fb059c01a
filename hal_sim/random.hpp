// Random numbers with the same bits on every machine, and streams that make a result independent of the order of calls.
// Integer operations, IEEE additions, multiplications, divisions and the (correctly rounded) square root only: no libm logarithm.
#pragma once

#include <array>
#include <cstdint>

namespace lasso::sim {

// One step of splitmix64 (Steele, Lea, Flood 2014): advances `state` and returns the next number.
std::uint64_t split_mix64(std::uint64_t& state);

// ln(x) for a positive normal x: relative error <= 1e-15. x = m 2^e with m in [sqrt(1/2), sqrt(2)); ln m = 2 artanh((m-1)/(m+1)) by its
// series.
double natural_logarithm(double x);

// xoshiro256** (Blackman, Vigna 2018), period 2^256 - 1.
class Random {
 public:
  explicit Random(std::uint64_t seed);
  explicit Random(const std::array<std::uint64_t, 4>& state) : state_(state) {}  // not all zero

  std::uint64_t bits();
  double uniform();                         // [0, 1), 53 bits
  double uniform(double low, double high);  // [low, high), low < high
  double gaussian();                        // mean 0, standard deviation 1; Marsaglia's polar method

 private:
  std::array<std::uint64_t, 4> state_{};
  double spare_ = 0;
  bool has_spare_ = false;
};

// The generator of one ray of one scan of one run: what a ray draws depends on these three numbers alone.
Random ray_stream(std::uint64_t seed, std::uint32_t scan_id, std::uint32_t ray);

}  // namespace lasso::sim
