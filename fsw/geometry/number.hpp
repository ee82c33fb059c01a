// The number types of the per-point path. That path (points, normals, residuals, weights, Jacobians, sums; contours and the rays near them)
// is written over a type N that names one arithmetic type for each declared range and resolution, so that a fixed-point build is another N
// and not another path (docs/decisions/fixed-point.md). The build's is FlightNumber.
//
//             what                                              range that is promised     FixedNumber
//   Length    metres                                            128 m (sums to 512)        2^-22
//   Unit      components of unit vectors, shares, small angles  1 (sums to 2)              2^-30
//   Tangent   places on the plane z = 1; half rates, rad/s      8; 30 (sums to 32)         2^-26
//   Cells     places in the grid                                32768                      2^-14
//   CellRate  cells per metre                                   2000                       2^-20
//   Gradient  of a normal along its surface, 1/m                32768                      2^-16
//   Sigma     noise, metres                                     8 m (sums to 32)           2^-26
//   SigmaRate growth of noise: 1/m, rad                         0.01                       2^-36
//   Factor    of noise                                          100                        2^-20
//   Variance  square metres                                     0.007 (sigma 88 mm)        2^-36
//   Kernel    squared widths in sigmas                          2500                       2^-18
//   Weight    of a point beside one of the usual noise          256                        2^-22
//   RowWeight, Column, Weighted  of a row (RowScale)            16, 32, 16                 2^-26, 2^-24, 2^-24
//   Sum       sums of Column times Weighted over 4096 rows      2^20                       2^-42 in 64 bits
//   Area      square metres                                     2^19                       2^-44 in 64 bits
//   BinRate   bins per unit of Tangent                          16000                      2^-16
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/bits.hpp"
#include "fsw/core/time.hpp"

namespace lasso {

struct FloatNumber {
  using Length = float;
  using Unit = float;
  using Tangent = float;
  using Cells = float;
  using CellRate = float;
  using Gradient = float;
  using Sigma = float;
  using SigmaRate = float;
  using Factor = float;
  using Variance = float;
  using Kernel = float;
  using Weight = float;
  using RowWeight = float;
  using Column = float;
  using Weighted = float;
  using Sum = double;  // 603e: same registers as float; sums of 4096 products lose nothing that matters
  using Area = float;
  using Inverse2 = float;
  using BinRate = float;

  // Image words to numbers: value * 2^-fraction_bits, fraction_bits from 0 to 95. Rounded once (24 bits), never scaled inexactly.
  static Length length(std::int32_t word, int fraction_bits) { return static_cast<Length>(word) * power_of_two(-fraction_bits); }
  static Unit unit(std::int32_t word) { return length(word, kUnitFractionBits); }
  static CellRate cells_per_m(std::int32_t cell, int fraction_bits) { return 1 / length(cell, fraction_bits); }
  static Gradient gradient(std::int32_t word, int fraction_bits) { return length(word, fraction_bits); }

  // Numbers of the arithmetic once a scan to the path's types and back.
  template <class R>
  static constexpr R to(double x) {
    return static_cast<R>(x);
  }
  template <class T>
  static constexpr float to_float(T x) {
    return static_cast<float>(x);
  }
  template <class T>
  static constexpr double to_double(T x) {
    return static_cast<double>(x);
  }
  static constexpr Length to_length(double m) { return static_cast<float>(m); }
  // What sensors measure; times between samples.
  template <class R>
  static R from_float(const float& x) {
    return x;
  }
  static Unit seconds(TimeUs dt_us) { return static_cast<float>(to_seconds(dt_us)); }

  static constexpr int kUnitFractionBits = 30;  // Q1.30
  static constexpr double kFarthest_m = 1e6;    // farther than any target is
  static constexpr double kSmallestCell_m = 1e-6;
  static constexpr double kLargestSigma_m = 1e9;
  static constexpr DurationUs kLongestScan_us = 100'000'000;  // longer than any frame
  static constexpr Variance kLeastVariance = 0;               // beside which none is lost
  static constexpr float kFarthestCell = 1e6F;                // rays that start farther out are not looked up
  static constexpr Area area_at(Tangent x, Tangent y, Length z) { return (x * x + y * y) * z * z; }  // of the offset (x, y) at the depth z
  static constexpr double sum(float x) { return static_cast<double>(x); }
  static constexpr Area area(float x) { return x; }
  // Of the bins 0 to count - 1 the one of a place that is not negative.
  static constexpr int index_below(int count, float place) {
    return place < static_cast<float>(count) ? static_cast<int>(place) : count - 1;
  }
  static constexpr Cells cells(std::int32_t k) { return static_cast<float>(k); }
  static constexpr float farthest_walk(float cell) { return kFarthestCell * cell; }

  // Rows need no scale.
  struct RowScale {
    static constexpr bool is_heavy(Weight) { return false; }
    static constexpr RowWeight weight(Weight w) { return w; }
    static constexpr Column length(float x, bool) { return x; }
    static constexpr Column direction(Unit x, bool) { return x; }
    static constexpr double of_one() { return 1; }
  };
  static constexpr RowScale row_scale(double) { return {}; }

 private:
  // 2^exponent by its bits, exponent from -126 to 127.
  static float power_of_two(int exponent) { return same_bits<float>(static_cast<std::uint32_t>(exponent + 127) << 23); }
};

// The operations of fixed.hpp for FloatNumber.
template <class R>
constexpr R quotient(float a, float b) {
  return a / b;
}
template <class R>
constexpr R bounded(float x) {
  return x;
}
template <class R>
constexpr R cut(float x) {
  return x;
}
constexpr float rest_of_one(float x) { return x < 1 ? 1 - x : 0; }
constexpr float share_of(float num, float den) { return num / den; }
constexpr float inverse_of(float x) { return 1 / x; }
template <class R>
constexpr R over(float a, float inverse) {
  return a * inverse;
}
constexpr float inverse_length2(float length2) { return length2 > 0 ? 1 / length2 : 0; }
constexpr float share_along(float part, float inverse) {
  const float t = part * inverse;
  return !(t > 0) ? 0 : t < 1 ? t : 1;
}
constexpr float half_of(float x) { return x / 2; }
constexpr float times(std::int32_t k, float x) { return static_cast<float>(k) * x; }
constexpr std::int32_t whole_part(float x) { return static_cast<std::int32_t>(x); }

// Scalar product, in the type of its products.
template <class N, class A, class B>
inline auto dot3(const A* a, const B* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace lasso
