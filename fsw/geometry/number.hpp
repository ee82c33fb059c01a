// The number type of the per-point path. That path (points, normals, residuals, weights, Jacobians, sums) is written over a type N
// that names one arithmetic type for each declared range and resolution, so that a fixed-point build is another N and not another path.
//
//   Length  metres, |x| <= 64 * the mission's length unit      Unit    components of unit vectors, |x| <= 1 (sums to 2)
//   Ratio   quotients Length/Unit, weights, Tukey terms         Sum     sums of products over all points of a scan
#pragma once

#include <cstdint>

#include "fsw/core/bits.hpp"

namespace lasso {

struct FloatNumber {
  using Length = float;
  using Unit = float;
  using Ratio = float;
  using Sum = double;  // 603e: same registers as float; sums of 4096 products lose nothing that matters

  // Image words to numbers: value * 2^-fraction_bits, fraction_bits from 0 to 95. Rounded once (24 bits), never scaled inexactly.
  static Length length(std::int32_t word, int fraction_bits) { return static_cast<Length>(word) * power_of_two(-fraction_bits); }
  static Unit unit(std::int32_t word) { return length(word, kUnitFractionBits); }

  static Ratio ratio(std::int32_t word, int fraction_bits) { return length(word, fraction_bits); }

  // Numbers of the once-per-scan arithmetic (double) to the path's types and back.
  static Length to_length(double m) { return static_cast<float>(m); }
  static Unit to_unit(double x) { return static_cast<float>(x); }
  static Ratio to_ratio(double x) { return static_cast<float>(x); }
  static double to_double(float x) { return static_cast<double>(x); }

  static constexpr int kUnitFractionBits = 30;  // Q1.30

 private:
  // 2^exponent by its bits, exponent from -126 to 127.
  static float power_of_two(int exponent) { return same_bits<float>(static_cast<std::uint32_t>(exponent + 127) << 23); }
};

// Scalar product in the path's types.
template <class N, class A, class B>
inline auto dot3(const A* a, const B* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace lasso
