// Fixed point for the per-point path: number.hpp has its types' ranges and resolutions.
#pragma once

#include <cstddef>

#include "fsw/core/bits.hpp"
#include "fsw/core/time.hpp"
#include "fsw/geometry/fixed.hpp"
#include "fsw/geometry/number.hpp"

namespace lasso {

struct FixedNumber {
  using Length = Fixed<22>;
  using Unit = Fixed<30>;
  using Tangent = Fixed<26>;
  using Cells = Fixed<14>;
  using CellRate = Fixed<20>;
  using Gradient = Fixed<16>;
  using Sigma = Fixed<26>;
  using SigmaRate = Fixed<36>;
  using Factor = Fixed<20>;
  using Variance = Fixed<36>;
  using Kernel = Fixed<18>;
  using Weight = Fixed<22>;
  using RowWeight = Fixed<26>;
  using Column = Fixed<24>;
  using Weighted = Fixed<24>;
  using Sum = Wide<42>;
  using Area = Wide<44>;
  using Inverse2 = InverseArea;
  using BinRate = Fixed<16>;

  // Image words: value * 2^-fraction_bits, to nearest, cut to what the type holds.
  static Length length(std::int32_t word, int fraction_bits) { return from_word<Length>(word, fraction_bits); }
  static Unit unit(std::int32_t word) { return Unit::of_raw(word); }
  static CellRate cells_per_m(std::int32_t cell, int fraction_bits) {
    return CellRate(static_cast<double>(std::int64_t{1} << fraction_bits) / cell);
  }
  static Gradient gradient(std::int32_t word, int fraction_bits) { return from_word<Gradient>(word, fraction_bits); }

  // Numbers of the arithmetic once a scan to the path's types (to nearest, cut to what they hold; 0 for what is not a number) and back.
  template <class R>
  static constexpr R to(double x) {
    return R(x);
  }
  static constexpr Length to_length(double m) { return Length(m < -kFarthest_m ? -kFarthest_m : m > kFarthest_m ? kFarthest_m : m); }
  template <class T>
  static constexpr double to_double(T x) {
    return static_cast<double>(x);
  }
  template <class T>
  static constexpr float to_float(T x) {
    return static_cast<float>(to_double(x));
  }
  // What sensors measure, in IEEE binary32, by its bits: to nearest, cut to what the type holds; 0 for what is not a number.
  template <class R>
  static R from_float(const float& x) {
    const auto bits = same_bits<std::uint32_t>(x);
    const int exponent = static_cast<int>(bits >> 23 & 0xFF);
    const auto significand = static_cast<std::int32_t>((bits & 0x7FFFFF) | 0x800000);
    if (exponent == 0 || (exponent == 0xFF && significand != 0x800000)) return R{0};
    const R magnitude = from_word<R>(significand, 150 - exponent);
    return (bits >> 31) != 0 ? -magnitude : magnitude;
  }
  static Unit seconds(TimeUs dt_us) {
    const std::int64_t dt = dt_us > kMostUs ? kMostUs : dt_us < -kMostUs ? -kMostUs : dt_us;
    return Wide<50>{dt * 1'125'899'907};  // 2^50 / 10^6
  }

  static constexpr DurationUs kMostUs = 1'900'000;                 // 2 s is the end of the type
  static constexpr double kFarthest_m = 127;                       // bounded() cuts there, too
  static constexpr double kSmallestCell_m = 1.0 / 2000;            // rounded by less than the share by which a cell's list is wider
  static constexpr double kLargestSigma_m = 0.088;                 // of a bounded() Variance
  static constexpr DurationUs kLongestScan_us = 2 * kMostUs;       // from its start to its last sample
  static constexpr Variance kLeastVariance = Variance::of_raw(1);  // so that no variance is 0
  static constexpr Cells kFarthestCell = Cells(32767);
  static constexpr Area area_at(Tangent x, Tangent y, Length z) {
    const auto across = bounded<Length>(x * z);
    const auto along = bounded<Length>(y * z);
    return across * across + along * along;
  }
  // Of 64 rows: of 4096 the products' own resolution would not fit.
  template <int F>
  static constexpr Sum sum(Wide<F> x) {
    return {detail::rescaled<F - Sum::kFraction>(x.raw)};
  }
  template <int F>
  static constexpr Area area(Wide<F> x) {
    return {detail::rescaled<F - 44>(x.raw)};
  }
  template <int F>
  static constexpr int index_below(int count, Wide<F> place) {
    const std::int64_t index = place.raw >> F;
    return index < count ? static_cast<int>(index) : count - 1;
  }
  static constexpr Cells cells(std::int32_t k) { return Cells::of_raw(k * (1 << Cells::kFraction)); }
  static constexpr Length farthest_walk(Length) { return Length(255); }

  // Rows of a pass: levers and residuals in units of the first power of two of at least 1.5 times the model's size, cut to 1 of them. A row
  // of a large weight w is kept as 32 times the row of weight w / 1024, so that both factors of a product keep their bits.
  struct RowScale {
    int bits;
    static constexpr bool is_heavy(Weight w) { return w >= Weight(16); }
    static constexpr RowWeight weight(Weight w) { return RowWeight::of_raw(is_heavy(w) ? w.raw >> 6 : w.raw * 16); }
    template <int F>
    constexpr Column length(Wide<F> x, bool heavy) const {
      const int shift = F - Column::kFraction + bits;
      const std::int64_t column = (x.raw + (std::int64_t{1} << (shift - 1))) >> shift;
      return Column::of_raw(detail::saturated(column, 1 << Column::kFraction) * (heavy ? 32 : 1));
    }
    template <int F>
    constexpr Column length(Fixed<F> x, bool heavy) const {
      return length(widened<52>(x), heavy);
    }
    static constexpr Column direction(Unit x, bool heavy) {
      return Column::of_raw(detail::saturated(static_cast<Column>(x).raw, 1 << Column::kFraction) * (heavy ? 32 : 1));
    }
    constexpr double of_one() const { return bits < 0 ? 1.0 / (1 << -bits) : 1 << bits; }
  };
  static constexpr RowScale row_scale(double size_m) {
    int bits = -10;
    while (bits < 8 && RowScale{bits}.of_one() < 1.5 * size_m) ++bits;
    return {bits};
  }

 private:
  // word * 2^-fraction_bits, to nearest, cut to what R holds.
  template <class R>
  static R from_word(std::int32_t word, int fraction_bits) {
    const int shift = fraction_bits - R::kFraction;
    if (shift > 32) return R{0};
    if (shift > 0) return R::of_raw(static_cast<std::int32_t>((word + (std::int64_t{1} << (shift - 1))) >> shift));
    const int up = -shift > 31 ? 31 : -shift;
    return R::of_raw(detail::saturated(word * (std::int64_t{1} << up), detail::kMost));
  }
};

}  // namespace lasso
