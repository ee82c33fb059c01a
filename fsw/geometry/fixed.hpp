// Fixed point: a number is a 32-bit integer times 2^-F, a product of two is exact in 64 bits, and is rounded where it is stored.
//
//   Fixed<F>  raw * 2^-F in 32 bits: what is stored. The declared range of each use is in number.hpp.
//   Wide<F>   raw * 2^-F in 64 bits: products and their sums, exact as long as they fit.
//
// Sums and what a Wide is stored to have to fit; who cannot promise that uses bounded(). Integer operations only, the same bits everywhere.
// Shifts of negative numbers are arithmetic ones, as by all compilers of this project (and by C++20).
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace lasso {

template <int F>
struct Wide {
  static constexpr int kFraction = F;
  std::int64_t raw;

  constexpr Wide& operator+=(Wide b) {
    raw += b.raw;
    return *this;
  }
  constexpr explicit operator double() const { return static_cast<double>(raw) * (1.0 / static_cast<double>(std::int64_t{1} << F)); }
};

namespace detail {
constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
// a * 2^-Shift, to nearest (ties up); a * 2^-Shift where Shift is negative.
template <int Shift>
constexpr std::int64_t rescaled(std::int64_t a) {
  if constexpr (Shift > 0) {
    return (a + (std::int64_t{1} << (Shift - 1))) >> Shift;
  } else {
    return a * (std::int64_t{1} << -Shift);
  }
}
constexpr std::int32_t saturated(std::int64_t raw, std::int32_t limit) {
  return raw > limit ? limit : raw < -std::int64_t{limit} ? -limit : static_cast<std::int32_t>(raw);
}
constexpr std::int32_t nearest(double x) {
  if (!(x < kMost)) return x >= kMost ? kMost : 0;
  return x < -kMost ? -kMost : static_cast<std::int32_t>(x < 0 ? x - 0.5 : x + 0.5);
}
}  // namespace detail

template <int F>
struct Fixed {
  static constexpr int kFraction = F;
  std::int32_t raw;

  // cppcheck-suppress uninitMemberVar; as of an int: arrays of them are not cleared before they are filled
  Fixed() = default;
  static constexpr Fixed of_raw(std::int32_t raw) {
    Fixed x{0};
    x.raw = raw;
    return x;
  }
  // To nearest, cut to what the type holds; 0 for what is not a number.
  constexpr explicit Fixed(double x) : raw(detail::nearest(x * static_cast<double>(std::int64_t{1} << F))) {}
  template <int G>
  constexpr Fixed(Wide<G> x)
      : raw(static_cast<std::int32_t>(detail::rescaled<G - F>(x.raw))) {}  // NOLINT(google-explicit-constructor): that is storing
  template <int G, class = std::enable_if_t<G != F>>
  constexpr explicit Fixed(Fixed<G> x) : Fixed(Wide<G>{x.raw}) {}
  constexpr explicit operator double() const { return raw * (1.0 / static_cast<double>(std::int64_t{1} << F)); }

  constexpr Fixed& operator+=(Fixed b) { return *this = *this + b; }

  friend constexpr Fixed operator+(Fixed a, Fixed b) { return of_raw(a.raw + b.raw); }
  friend constexpr Fixed operator-(Fixed a, Fixed b) { return of_raw(a.raw - b.raw); }
  friend constexpr Fixed operator-(Fixed a) { return of_raw(-a.raw); }
  friend constexpr Fixed operator-(int a, Fixed b) { return of_raw(static_cast<std::int32_t>(a * (std::int64_t{1} << F)) - b.raw); }
  friend constexpr Fixed operator*(int a, Fixed b) { return of_raw(a * b.raw); }
  friend constexpr bool operator<(Fixed a, Fixed b) { return a.raw < b.raw; }
  friend constexpr bool operator>(Fixed a, Fixed b) { return a.raw > b.raw; }
  friend constexpr bool operator<=(Fixed a, Fixed b) { return a.raw <= b.raw; }
  friend constexpr bool operator>=(Fixed a, Fixed b) { return a.raw >= b.raw; }
  friend constexpr bool operator==(Fixed a, Fixed b) { return a.raw == b.raw; }
};

template <int A, int B>
constexpr Wide<A + B> operator*(Fixed<A> a, Fixed<B> b) {
  return {std::int64_t{a.raw} * b.raw};
}
template <int F>
constexpr Wide<F> operator+(Wide<F> a, Wide<F> b) {
  return {a.raw + b.raw};
}
template <int F>
constexpr Wide<F> operator-(Wide<F> a, Wide<F> b) {
  return {a.raw - b.raw};
}

// A stored number beside products: exact.
template <int F, int A>
constexpr Wide<F> widened(Fixed<A> a) {
  static_assert(F >= A, "exact");
  return {a.raw * (std::int64_t{1} << (F - A))};
}
template <int A, int F>
constexpr Wide<F> operator+(Fixed<A> a, Wide<F> b) {
  return widened<F>(a) + b;
}
template <int A, int F>
constexpr Wide<F> operator+(Wide<F> a, Fixed<A> b) {
  return a + widened<F>(b);
}
template <int A, int F>
constexpr Wide<F> operator-(Fixed<A> a, Wide<F> b) {
  return widened<F>(a) - b;
}
template <int A, int F>
constexpr Wide<F> operator-(Wide<F> a, Fixed<A> b) {
  return a - widened<F>(b);
}

// Products of different resolution: exact in the finer one.
template <int F, int G>
constexpr Wide<F> widened(Wide<G> a) {
  static_assert(F >= G, "exact");
  return {a.raw * (std::int64_t{1} << (F - G))};
}
template <int A, int B, class = std::enable_if_t<(A > B)>>
constexpr Wide<A> operator+(Wide<A> a, Wide<B> b) {
  return a + widened<A>(b);
}

template <int A, int B>
constexpr bool operator<(Wide<A> a, Wide<B> b) {
  constexpr int kFiner = std::max(A, B);
  return widened<kFiner>(a).raw < widened<kFiner>(b).raw;
}
template <int A, int F>
constexpr bool operator<(Fixed<A> a, Wide<F> b) {
  return widened<F>(a) < b;
}

template <int F>
constexpr Fixed<F> half_of(Fixed<F> x) {
  return Fixed<F>::of_raw((x.raw + 1) >> 1);
}
template <int F>
constexpr Wide<F> times(std::int32_t k, Fixed<F> x) {
  return {std::int64_t{k} * x.raw};
}
// The next lower integer.
template <int F>
constexpr std::int32_t whole_part(Fixed<F> x) {
  return x.raw >> F;
}
template <int F>
constexpr std::int32_t whole_part(Wide<F> x) {
  return static_cast<std::int32_t>(x.raw >> F);
}

// Stored, and cut to a quarter of what the type holds: sums of four such numbers fit.
template <class R, int F>
constexpr R bounded(Wide<F> x) {
  return R::of_raw(detail::saturated(detail::rescaled<F - R::kFraction>(x.raw), detail::kMost / 4));
}

template <class R, int F>
constexpr R bounded(Fixed<F> x) {
  return bounded<R>(Wide<F>{x.raw});
}

// Stored, and cut to what the type holds.
template <class R, int F>
constexpr R cut(Wide<F> x) {
  return R::of_raw(detail::saturated(detail::rescaled<F - R::kFraction>(x.raw), detail::kMost));
}

// What is left of 1; nothing where x is more.
template <int F>
constexpr Fixed<F> rest_of_one(Fixed<F> x) {
  const Fixed<F> rest = 1 - x;
  return rest.raw > 0 ? rest : Fixed<F>{0};
}

// a / b towards zero, cut to what R holds; 0 for 0 / 0. |a| * 2^(R - A + B) has to fit 63 bits.
template <class R, int A, int B>
constexpr R quotient(Fixed<A> a, Fixed<B> b) {
  constexpr int kShift = R::kFraction - A + B;
  static_assert(kShift >= 0 && kShift <= 31, "fits");
  const std::int64_t dividend = a.raw * (std::int64_t{1} << kShift);
  if (b.raw == 0) return R::of_raw(a.raw > 0 ? detail::kMost : a.raw < 0 ? -detail::kMost : 0);
  return R::of_raw(detail::saturated(dividend / b.raw, detail::kMost));
}

// num / den, of products that are not negative, to 30 bits of den and cut to what R holds, 2^8 at most.
template <class R, int F>
constexpr R quotient(Wide<F> num, Wide<F> den) {
  static_assert(R::kFraction == 22, "2^39 * 2^22 fits");
  if (num.raw >> 8 >= den.raw) return R{256};
  const int excess = 33 - __builtin_clzll(static_cast<unsigned long long>(den.raw));  // bits beyond 31
  const int dropped = excess > 0 ? excess : 0;
  return R::of_raw(static_cast<std::int32_t>((num.raw >> dropped) * (std::int64_t{1} << R::kFraction) / (den.raw >> dropped)));
}

// num / den in [0, 1] (Q1.30): 0 where num <= 0, 1 where num >= den.
template <int A, int B>
constexpr Fixed<30> share_of(Wide<A> num, Wide<B> den) {
  constexpr int kFiner = std::max(A, B);
  std::int64_t n = widened<kFiner>(num).raw;
  std::int64_t d = widened<kFiner>(den).raw;
  if (n <= 0) return Fixed<30>{0};
  if (n >= d) return Fixed<30>{1};
  const int excess = 33 - __builtin_clzll(static_cast<unsigned long long>(d));  // bits beyond 31
  if (excess > 0) {
    n >>= excess;
    d >>= excess;
  }
  return Fixed<30>::of_raw(static_cast<std::int32_t>(n * (std::int64_t{1} << 30) / d));
}

// 1 / x to 30 bits, for several numbers that are divided by x: significand * 2^(F - 61 + places), of x's sign. That of 0 is the smallest
// x's.
template <int F>
struct Inverse {
  std::int32_t significand;
  int places;
};

template <int F>
constexpr Inverse<F> inverse_of(Fixed<F> x) {
  const std::int64_t size = x.raw < -detail::kMost ? detail::kMost : x.raw < 0 ? -x.raw : x.raw > 0 ? x.raw : 1;
  const int places = __builtin_clzll(static_cast<unsigned long long>(size)) - 33;
  const auto significand = detail::saturated((std::int64_t{1} << 61) / (size << places), detail::kMost);
  return {x.raw < 0 ? -significand : significand, places};
}

// 1 / x of a squared length, for shares of it.
struct InverseArea {
  std::int32_t significand;  // 2^61 / (x * 2^-excess), 0 for an x of 0
  int excess;                // of x over 31 bits
};

template <int F>
constexpr InverseArea inverse_length2(Wide<F> x) {
  if (x.raw <= 0) return {0, 0};
  const int excess = 33 - __builtin_clzll(static_cast<unsigned long long>(x.raw));
  const std::int64_t size = excess > 0 ? x.raw >> excess : x.raw << -excess;
  return {detail::saturated((std::int64_t{1} << 61) / size, detail::kMost), excess};
}

// part / x, cut to [0, 1].
template <int F>
constexpr Fixed<30> share_along(Wide<F> part, InverseArea x) {
  if (part.raw <= 0) return Fixed<30>{0};
  const std::int64_t size = x.excess > 0 ? part.raw >> x.excess : part.raw > detail::kMost ? part.raw : part.raw << -x.excess;
  if (size > detail::kMost) return Fixed<30>{1};
  const std::int64_t share = size * x.significand >> 31;
  return Fixed<30>::of_raw(share < (1 << 30) ? static_cast<std::int32_t>(share) : 1 << 30);
}

// a / x, to nearest, cut to what R holds.
template <class R, int A, int F>
constexpr R over(Fixed<A> a, Inverse<F> x) {
  const std::int64_t product = std::int64_t{a.raw} * x.significand;
  const int shift = 61 + A - R::kFraction - F - x.places;
  if (shift > 62) return R{0};
  if (shift > 0) return R::of_raw(detail::saturated((product + (std::int64_t{1} << (shift - 1))) >> shift, detail::kMost));
  const std::int64_t most = (std::int64_t{1} << 62) >> -shift;
  return R::of_raw(product > most    ? detail::kMost
                   : product < -most ? -detail::kMost
                                     : detail::saturated(product * (std::int64_t{1} << -shift), detail::kMost));
}

}  // namespace lasso
