// Polynomial coefficients: interpolation at Chebyshev nodes of the reduced interval, computed with 60 digits; the error of each
// truncation stands beside it. The rest of an error bound is rounding.
#include "fsw/geometry/portable_math.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>

#include "fsw/core/bits.hpp"

namespace lasso {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::uint64_t kMantissaMask = 0x000FFFFFFFFFFFFF;
constexpr std::uint64_t kHiddenBit = 0x0010000000000000;
constexpr int kMantissaBits = 52;
constexpr int kExponentBias = 1023;

std::uint64_t bits_of(double x) { return same_bits<std::uint64_t>(x); }
double of_bits(std::uint64_t bits) { return same_bits<double>(bits); }
double absolute(double x) { return __builtin_fabs(x); }  // one instruction on all targets

// 2^exponent, exponent from -1022 to 1023.
double power_of_two(int exponent) { return of_bits(static_cast<std::uint64_t>(exponent + kExponentBias) << kMantissaBits); }

// Halves away from zero; |x| < 2^31. The instructions that libm's round uses are not on every target.
std::int32_t nearest_integer(double x) { return static_cast<std::int32_t>(x < 0 ? x - 0.5 : x + 0.5); }

// c[0] + c[1] x + c[2] x^2 ...
template <std::size_t N>
double polynomial(const double (&c)[N], double x) {
  double sum = c[N - 1];
  for (std::size_t i = N - 1; i > 0; --i) sum = sum * x + c[i - 1];
  return sum;
}

// ---- square root ----

// sqrt(m) for m in [1, 4) to a few units in the last place, and in [1, 2) itself: Newton for 1/sqrt(m) from a guess by the exponent, then
// one step for the root.
double approximate_root(double m) {
  double y = of_bits(0x5FE6EB50C7B537A9 - (bits_of(m) >> 1));  // within 3.5 %
  for (int i = 0; i < 3; ++i) y = y * (1.5 - 0.5 * m * y * y);
  const double root = m * y;
  return root + 0.5 * y * (m - root * root);
}

// The integer nearest to sqrt(M), M = mantissa * 2^shift in [2^104, 2^106), from a near one. The remainder M - S^2 is small, so that
// 64 bits hold it although M and S^2 wrap around: exact. The guess is within two units.
std::uint64_t nearest_root(std::uint64_t mantissa, int shift, std::uint64_t guess) {
  std::uint64_t S = guess;
  auto remainder = static_cast<std::int64_t>((mantissa << shift) - S * S);
  for (int i = 0; i < 2; ++i) {
    if (remainder > static_cast<std::int64_t>(S)) {
      remainder -= static_cast<std::int64_t>(2 * S + 1);
      ++S;
    } else if (remainder <= -static_cast<std::int64_t>(S)) {
      --S;
      remainder += static_cast<std::int64_t>(2 * S + 1);
    }
  }
  return S;
}

// x positive, finite and normal.
double root_of_normal(double x) {
  const int exponent = static_cast<int>(bits_of(x) >> kMantissaBits) - kExponentBias;
  const int odd = exponent & 1;
  const std::uint64_t mantissa = (bits_of(x) & kMantissaMask) | kHiddenBit;
  const double m = of_bits((bits_of(x) & kMantissaMask) | (static_cast<std::uint64_t>(kExponentBias + odd) << kMantissaBits));
  const std::uint64_t guess = (bits_of(approximate_root(m)) & kMantissaMask) | kHiddenBit;
  const std::uint64_t S = nearest_root(mantissa, kMantissaBits + odd, guess);
  const int half = (exponent - odd) / 2;
  return of_bits((S & kMantissaMask) | (static_cast<std::uint64_t>(half + kExponentBias) << kMantissaBits));
}

// ---- sine and cosine ----

// pi/2 in three parts; the first two have 33 bits, so that their products with an integer of 20 bits are exact.
constexpr double kHalfPi1 = 0x1.921fb54400000p+0;
constexpr double kHalfPi2 = 0x1.0b4611a600000p-34;
constexpr double kHalfPi3 = 0x1.3198a2e037073p-69;
constexpr double kTwoOverPi = 0.63661977236758134308;
constexpr double kAngleMax_rad = 1e6;

// (sin r - r)/r^3 over r^2 in [0, (pi/4)^2]: 1e-17 of sin r.
constexpr double kSine[] = {-0x1.5555555555555p-3, 0x1.1111111110bb2p-7,   -0x1.a01a019e83816p-13,
                            0x1.71de379654304p-19, -0x1.ae600aca92c64p-26, 0x1.5e0b05bff20f2p-33};
// (cos r - 1 + r^2/2)/r^4: 5e-19 of cos r.
constexpr double kCosine[] = {0x1.5555555555555p-5,   -0x1.6c16c16c16967p-10, 0x1.a01a019f4e9b4p-16,
                              -0x1.27e4fa17bf139p-22, 0x1.1eeb68cd22f56p-29,  -0x1.907d8f29fe831p-37};

// r in [-pi/4, pi/4], a little more by rounding.
SinCos sin_cos_reduced(double r) {
  const double u = r * r;
  return {r + r * u * polynomial(kSine, u), 1.0 - 0.5 * u + u * u * polynomial(kCosine, u)};
}

// ---- arc tangent ----

// (atan t - t)/t^3 over t^2 in [0, 1/16]: 5e-18 of atan t.
constexpr double kArcTangent[] = {-0x1.5555555555550p-2, 0x1.999999999431cp-3, -0x1.2492491d761d4p-3, 0x1.c71c6aa3297d2p-4,
                                  -0x1.745b53320a9d0p-4, 0x1.3ad6afae5aa43p-4, -0x1.0c76aab09f597p-4, 0x1.832ab27586d54p-5};
constexpr double kArcTangentOfHalf = 0.46364760900080611621;

double arc_tangent_reduced(double t) {
  const double u = t * t;
  return t + t * u * polynomial(kArcTangent, u);
}

// atan(low/high), 0 <= low <= high, high > 0 and far from under- and overflow:
// atan(low/high) = atan(c) + atan((low - c high)/(high + c low)) with c so near that the second argument is within 1/4.
double arc_tangent_of_quotient(double low, double high) {
  if (low <= 0.25 * high) return arc_tangent_reduced(low / high);
  if (low <= 0.75 * high) return kArcTangentOfHalf + arc_tangent_reduced((low - 0.5 * high) / (high + 0.5 * low));
  return 0.25 * kPi + arc_tangent_reduced((low - high) / (high + low));
}

// The same for any sizes, infinities included.
double first_octant(double low, double high) {
  if (high == kInfinity) return low == kInfinity ? 0.25 * kPi : 0.0;
  if (high > 0x1p+1000) return arc_tangent_of_quotient(low * 0x1p-100, high * 0x1p-100);
  if (high < 0x1p-900) return arc_tangent_of_quotient(low * 0x1p+200, high * 0x1p+200);
  return arc_tangent_of_quotient(low, high);
}

// ---- exponential and normal distribution ----

constexpr double kLn2High = 0x1.62e42fefa2000p-1;  // 40 bits: exact products with an exponent
constexpr double kLn2Low = 0x1.9ef35793c7673p-41;
constexpr double kOneOverLn2 = 1.44269504088896340736;
constexpr double kExponentialMax = 709.78271289338399679;   // ln of the largest number
constexpr double kExponentialMin = -708.39641853226410622;  // ln of the smallest normal number
constexpr double kOneOverRootTwoPi = 0x1.9884533d43651p-2;

// (e^r - 1 - r)/r^2 over |r| <= ln(2)/2: 9e-16 of e^r.
constexpr double kExponential[] = {0x1.0000000000000p-1,  0x1.5555555553b78p-3,  0x1.5555555554cb7p-5,
                                   0x1.1111111c478ebp-7,  0x1.6c16c1738ff55p-10, 0x1.a019ada3609f3p-13,
                                   0x1.a019c9a5652d3p-16, 0x1.72c72ca338df0p-19, 0x1.2880411bad1aap-22};

// Mills' ratio Phi(-t)/density(t) for t in [0, 40] as a quotient, by weighted least squares with Lawson's weights: 6e-16 of Phi for small
// t, 3e-12 relative in the tail, and Phi(0) = 1/2 to the bit. All coefficients are positive: nothing cancels.
constexpr double kMillsNumerator[] = {0x1.40d931ff62705p+0, 0x1.96edf0d8427fdp+0, 0x1.fd3b5d47cf558p-1,  0x1.8943b070da4bep-2,
                                      0x1.9007277540effp-4, 0x1.0b3270e873784p-6, 0x1.b3de464f62330p-10, 0x1.532fe5960d4d9p-14};
constexpr double kMillsDenominator[] = {0x1.0000000000000p+0, 0x1.08787885a8ddep+1,  0x1.f13029683434bp+0,
                                        0x1.16c25a9744754p+0, 0x1.99cce6dca3217p-2,  0x1.96d68c062b364p-4,
                                        0x1.0c85a32518bb8p-6, 0x1.b3de45b2bc62ep-10, 0x1.532fe5a7976cep-14};
constexpr double kMillsMax = 40;

}  // namespace

double detail::square_root_in_software(double x) {
  if (x == 0) return x;
  if (!(x > 0)) return kNotANumber;
  if (x == kInfinity) return x;
  if (x < std::numeric_limits<double>::min()) return root_of_normal(x * 0x1p+108) * 0x1p-54;
  return root_of_normal(x);
}

double square_root(double x) {
#if defined(__SSE2__) || defined(__aarch64__)
  // One instruction. To a compiler all NaNs are alike, and the instruction's own is negative: it may not know that this is one.
  static const volatile double kDomainError = kNotANumber;
  return x >= 0 ? __builtin_sqrt(x) : kDomainError;
#else
  return detail::square_root_in_software(x);
#endif
}

SinCos sin_cos(double angle_rad) {
  if (!(absolute(angle_rad) <= kAngleMax_rad)) return {kNotANumber, kNotANumber};
  const std::int32_t quarters = nearest_integer(angle_rad * kTwoOverPi);
  const auto n = static_cast<double>(quarters);
  const SinCos r = sin_cos_reduced(((angle_rad - n * kHalfPi1) - n * kHalfPi2) - n * kHalfPi3);
  switch (static_cast<std::uint32_t>(quarters) & 3U) {
    case 0:
      return r;
    case 1:
      return {r.cos, -r.sin};
    case 2:
      return {-r.sin, -r.cos};
    default:
      return {-r.cos, r.sin};
  }
}

double arc_tangent2(double y, double x) {
  const double high_x = absolute(x);
  const double high_y = absolute(y);
  if (!(high_x >= 0 && high_y >= 0)) return kNotANumber;
  if (high_x == 0 && high_y == 0) return 0;
  double angle = high_y > high_x ? 0.5 * kPi - first_octant(high_x, high_y) : first_octant(high_y, high_x);
  if (x < 0) angle = kPi - angle;
  return y < 0 ? -angle : angle;
}

double tangent(double angle_rad) {
  const SinCos angle = sin_cos(angle_rad);
  return angle.sin / angle.cos;
}

double fractional_part(double x) { return x - static_cast<double>(static_cast<std::int64_t>(x)); }

double arc_sine(double x) {
  if (!(absolute(x) <= 1.0)) return kNotANumber;
  return arc_tangent2(x, square_root((1.0 - x) * (1.0 + x)));
}

double exponential(double x) {
  if (x > kExponentialMax) return kInfinity;
  if (x < kExponentialMin) return 0;
  if (!(x == x)) return kNotANumber;
  const std::int32_t exponent = nearest_integer(x * kOneOverLn2);
  const auto n = static_cast<double>(exponent);
  const double r = (x - n * kLn2High) - n * kLn2Low;
  const double mantissa = 1.0 + (r + r * r * polynomial(kExponential, r));
  const int half = exponent / 2;  // 2^1024 does not exist
  return mantissa * power_of_two(half) * power_of_two(exponent - half);
}

double normal_density(double z) { return kOneOverRootTwoPi * exponential(-0.5 * z * z); }

double normal_cumulative(double z) {
  const double t = absolute(z);
  const double tail = t < kMillsMax ? normal_density(t) * (polynomial(kMillsNumerator, t) / polynomial(kMillsDenominator, t)) : 0.0;
  if (!(t >= 0)) return kNotANumber;
  return z < 0 ? tail : 1.0 - tail;
}

double clamp(double x, double low, double high) { return x < low ? low : x > high ? high : x; }

}  // namespace lasso
