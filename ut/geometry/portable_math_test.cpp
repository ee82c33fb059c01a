#include "fsw/geometry/portable_math.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <limits>
#include <vector>

#include "ut/geometry/random_inputs.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kMin = std::numeric_limits<double>::min();
constexpr double kMax = std::numeric_limits<double>::max();
constexpr double kSubnormal = std::numeric_limits<double>::denorm_min();

bool is_nan(double x) { return !(x == x); }
std::uint64_t bits(double x) { return same_bits<std::uint64_t>(x); }

// ---- square root ----

// Numbers where a rounding could go wrong: squares, their neighbours, ends of binades, subnormals.
std::vector<double> square_root_edges() {
  std::vector<double> edges = {0.0, -0.0, kSubnormal, 2 * kSubnormal, 3 * kSubnormal, kMin, kMax, 1.0, 2.0, 4.0, kInf};
  for (int e = -1074; e < 1024; ++e) {
    const double power =
        e < -1022 ? same_bits<double>(std::uint64_t{1} << (e + 1074)) : same_bits<double>(static_cast<std::uint64_t>(e + 1023) << 52);
    for (std::uint64_t step = 0; step < 3; ++step) {
      edges.push_back(same_bits<double>(bits(power) + step));
      edges.push_back(same_bits<double>(bits(power) - step % 2));
    }
  }
  return edges;
}

TEST(SquareRoot, SoftwareHasTheBitsOfTheInstruction) {
  VERIFIES("LASSO-GEO-001~1");
  for (const double x : square_root_edges()) ASSERT_EQ(bits(detail::square_root_in_software(x)), bits(std::sqrt(x))) << x;
  test::Generator generator(31);
  for (int i = 0; i < 2000000; ++i) {
    const double x = same_bits<double>(generator.bits() & 0x7FFFFFFFFFFFFFFF);  // all exponents, subnormal and infinite ones too
    if (is_nan(x)) continue;
    ASSERT_EQ(bits(detail::square_root_in_software(x)), bits(std::sqrt(x))) << x;
    const double subnormal = same_bits<double>(generator.bits() >> (12 + i % 52));
    ASSERT_EQ(bits(detail::square_root_in_software(subnormal)), bits(std::sqrt(subnormal))) << subnormal;
  }
}

TEST(SquareRoot, SquaresAndTheirNeighbours) {
  VERIFIES("LASSO-GEO-001~1");
  test::Generator generator(32);
  for (int i = 0; i < 500000; ++i) {
    const auto root = static_cast<double>(generator.bits() >> (38 + i % 20));
    ASSERT_EQ(detail::square_root_in_software(root * root), root);
    // Just beside the square of a 53-bit number the result is nearest to a tie.
    const double s = same_bits<double>(0x3FF0000000000000U | (generator.bits() >> 12));
    for (std::uint64_t step = 0; step < 3; ++step) {
      const double x = same_bits<double>(bits(s * s) + step - 1);
      ASSERT_EQ(bits(detail::square_root_in_software(x)), bits(std::sqrt(x))) << x;
    }
  }
}

// Where the approximation could leave the binade of the root.
TEST(SquareRoot, EndsOfTheBinades) {
  VERIFIES("LASSO-GEO-001~1");
  for (std::uint64_t step = 0; step < 100000; ++step) {
    for (const double x : {same_bits<double>(bits(1.0) + step), same_bits<double>(bits(4.0) - 1 - step)}) {
      ASSERT_EQ(bits(detail::square_root_in_software(x)), bits(std::sqrt(x))) << x;
    }
  }
}

TEST(SquareRoot, DomainErrorsAreOneQuietNan) {
  VERIFIES("LASSO-GEO-001~1 LASSO-GEO-006~2");
  for (const double x : {-1.0, -kSubnormal, -kInf, kNan, -kNan}) {
    EXPECT_EQ(bits(square_root(x)), bits(kNan)) << x;
    EXPECT_EQ(bits(detail::square_root_in_software(x)), bits(kNan)) << x;
  }
  EXPECT_EQ(square_root(kInf), kInf);
  EXPECT_EQ(square_root(2.25), 1.5);
}

// ---- domain ends and identities (any target) ----

TEST(SinCos, NanBeyondTheDomain) {
  VERIFIES("LASSO-GEO-006~2");
  for (const double x : {1.0000001e6, -1.0000001e6, kInf, -kInf, kNan}) {
    EXPECT_TRUE(is_nan(sin_cos(x).sin)) << x;
    EXPECT_TRUE(is_nan(sin_cos(x).cos)) << x;
  }
  EXPECT_EQ(sin_cos(0).sin, 0.0);
  EXPECT_EQ(sin_cos(0).cos, 1.0);
}

TEST(FractionalPart, IsWhatTruncationLeaves) {
  VERIFIES("LASSO-SNS-011~1");
  test::Generator random(77);
  for (int i = 0; i < 1000; ++i) {
    const double x = random.uniform(-1e6, 1e6);
    ASSERT_EQ(fractional_part(x), x - std::trunc(x));
  }
  EXPECT_EQ(fractional_part(3), 0.0);
  EXPECT_EQ(fractional_part(-2.25), -0.25);
}

TEST(ArcTangent2, QuadrantsAxesAndExtremes) {
  VERIFIES("LASSO-GEO-003~1 LASSO-GEO-006~2");
  EXPECT_EQ(arc_tangent2(0, 0), 0.0);
  EXPECT_EQ(arc_tangent2(-0.0, -0.0), 0.0);
  EXPECT_EQ(arc_tangent2(0, 1), 0.0);
  EXPECT_EQ(arc_tangent2(0, -1), kPi);
  EXPECT_EQ(arc_tangent2(-0.0, -1), kPi);  // never -pi from a zero
  EXPECT_EQ(arc_tangent2(3, 0), kPi / 2);
  EXPECT_EQ(arc_tangent2(-3, 0), -kPi / 2);
  EXPECT_EQ(arc_tangent2(kInf, kInf), kPi / 4);
  EXPECT_EQ(arc_tangent2(-kInf, -kInf), -3 * kPi / 4);
  EXPECT_EQ(arc_tangent2(1, kInf), 0.0);
  EXPECT_EQ(arc_tangent2(1, -kInf), kPi);
  EXPECT_EQ(arc_tangent2(-kInf, 1), -kPi / 2);
  EXPECT_NEAR(arc_tangent2(kMax, kMax), kPi / 4, 2e-15);
  EXPECT_NEAR(arc_tangent2(-kMax, kMax / 3), -1.2490457723982544, 2e-15);
  EXPECT_NEAR(arc_tangent2(kSubnormal, -kSubnormal), 3 * kPi / 4, 2e-15);
  EXPECT_EQ(arc_tangent2(kSubnormal, 1), kSubnormal);
  EXPECT_TRUE(is_nan(arc_tangent2(kNan, 1)));
  EXPECT_TRUE(is_nan(arc_tangent2(1, kNan)));
  EXPECT_TRUE(is_nan(arc_tangent2(-kNan, 0)));
}

TEST(ArcSine, EndsOfTheDomain) {
  VERIFIES("LASSO-GEO-003~1 LASSO-GEO-006~2");
  EXPECT_EQ(arc_sine(1), kPi / 2);
  EXPECT_EQ(arc_sine(-1), -kPi / 2);
  EXPECT_EQ(arc_sine(0), 0.0);
  for (const double x : {1.0000000000000002, -1.0000000000000002, kInf, kNan}) EXPECT_TRUE(is_nan(arc_sine(x))) << x;
}

TEST(Exponential, SaturatesAtBothEnds) {
  VERIFIES("LASSO-GEO-004~1 LASSO-GEO-006~2");
  EXPECT_EQ(exponential(0), 1.0);
  EXPECT_EQ(exponential(-0.0), 1.0);
  EXPECT_EQ(exponential(709.79), kInf);
  EXPECT_EQ(exponential(kInf), kInf);
  EXPECT_LT(exponential(709.78), kInf);
  EXPECT_GT(exponential(709.78), 1.79e308);
  EXPECT_EQ(exponential(-708.4), 0.0);
  EXPECT_EQ(exponential(-kInf), 0.0);
  EXPECT_GE(exponential(-708.396), kMin);
  // ln of the largest number is 709.782712893..., of the smallest normal one -708.396418532...
  EXPECT_LT(exponential(709.782712893), kInf);
  EXPECT_EQ(exponential(709.782712894), kInf);
  EXPECT_GE(exponential(-708.396418532), kMin);
  EXPECT_EQ(exponential(-708.396418533), 0.0);
  EXPECT_TRUE(is_nan(exponential(kNan)));
}

TEST(NormalCumulative, EndsSymmetryAndOrder) {
  VERIFIES("LASSO-GEO-005~1 LASSO-GEO-006~2");
  EXPECT_EQ(normal_cumulative(0), 0.5);
  EXPECT_EQ(normal_cumulative(-0.0), 0.5);
  EXPECT_EQ(normal_cumulative(-kInf), 0.0);
  EXPECT_EQ(normal_cumulative(kInf), 1.0);
  EXPECT_EQ(normal_density(kInf), 0.0);
  EXPECT_TRUE(is_nan(normal_cumulative(kNan)));
  double before = 0;
  for (int i = -4000; i <= 4000; ++i) {
    const double z = 0.01 * i;
    const double phi = normal_cumulative(z);
    ASSERT_EQ(phi + normal_cumulative(-z), 1.0) << z;
    ASSERT_GE(phi, before) << z;
    ASSERT_LE(phi, 1.0) << z;
    before = phi;
  }
}

TEST(PortableMath, WhatHasNoAnswerIsNanAndNothingElse) {
  VERIFIES("LASSO-GEO-006~2");
  errno = 0;
  for (const double x : {kNan, -kNan}) {
    for (const double value : {square_root(x), sin_cos(x).sin, sin_cos(x).cos, tangent(x), arc_tangent2(x, 1), arc_tangent2(1, x),
                               arc_sine(x), exponential(x), normal_density(x), normal_cumulative(x)}) {
      EXPECT_TRUE(is_nan(value));
    }
  }
  for (const double sign : {-1.0, 1.0}) {
    for (const double value : {square_root(-kSubnormal), sin_cos(sign * 1.0000001e6).sin, sin_cos(sign * 1.0000001e6).cos,
                               tangent(sign * 1.0000001e6), arc_sine(sign * 1.0000000000000002)}) {
      EXPECT_TRUE(is_nan(value)) << sign;
    }
    EXPECT_FALSE(is_nan(sin_cos(sign * 1e6).sin) || is_nan(tangent(sign * 1e6)) || is_nan(arc_sine(sign))) << sign;
  }
  EXPECT_EQ(errno, 0);
}

TEST(Clamp, StaysWithinItsEndsAndKeepsNan) {
  VERIFIES("LASSO-GEO-006~2");
  EXPECT_EQ(clamp(-0.1, 0.0, 2.0), 0.0);
  EXPECT_EQ(clamp(0.7, 0.0, 2.0), 0.7);
  EXPECT_EQ(clamp(2.1, 0.0, 2.0), 2.0);
  EXPECT_EQ(clamp(kInf, 0.0, 2.0), 2.0);
  EXPECT_TRUE(is_nan(clamp(kNan, 0.0, 2.0)));
}

TEST(IsFinite, KnowsNanAndInfinity) {
  VERIFIES("LASSO-GEO-006~2");
  for (const double x : {0.0, -0.0, kMax, -kMax, kSubnormal, 1.5}) EXPECT_TRUE(is_finite(x)) << x;
  for (const double x : {kInf, -kInf, kNan, -kNan}) EXPECT_FALSE(is_finite(x)) << x;
}

// ---- same bits on every target ----

void add_elementary(test::Digest& digest, test::Generator& generator) {
  const double x = generator.uniform(-1, 1);
  const double y = generator.uniform(-1, 1);
  const SinCos near = sin_cos(8 * x);
  const SinCos far = sin_cos(1e6 * y);
  for (const double value : {near.sin, near.cos, far.sin, far.cos, square_root(x * x + y), arc_tangent2(x, y), arc_sine(y)})
    digest.add(value);
  for (const double value : {exponential(700 * x), normal_density(10 * y), normal_cumulative(12 * x)}) digest.add(value);
  for (const double value : {tangent(1.5 * x), fractional_part(1e6 * y), clamp(x, y, 0.5)}) digest.add(value);
}

// All exponents, either sign, infinity, and what is outside of the domains.
void add_extremes(test::Digest& digest, test::Generator& generator) {
  const double x = same_bits<double>(generator.bits() & 0xFFEFFFFFFFFFFFFFU);
  const double y = same_bits<double>(generator.bits() & 0xFFEFFFFFFFFFFFFFU);
  const SinCos far = sin_cos(x);
  for (const double value : {far.sin, far.cos, square_root(x), arc_tangent2(x, y), arc_sine(x), exponential(x)}) digest.add(value);
  for (const double value : {normal_density(x), normal_cumulative(x), tangent(x), clamp(x, -1, y), arc_tangent2(x, kInf)})
    digest.add(value);
}

TEST(PortableMath, BitsAreTheRecordedOnes) {
  VERIFIES("LASSO-GEO-007~2");
  test::Generator generator(33);
  test::Digest digest, extremes;
  for (int i = 0; i < 100000; ++i) add_elementary(digest, generator);
  EXPECT_EQ(digest.value(), 0x1D6D0462B1D44217U) << std::hex << digest.value();
  for (int i = 0; i < 100000; ++i) add_extremes(extremes, generator);
  EXPECT_EQ(extremes.value(), 0xAE00E3AE6F54DD50U) << std::hex << extremes.value();
}

// ---- against the C library in extended precision ----
// Only where it is an independent and better truth: glibc's own functions do not run on an emulated 603e. There the digest above, which is
// of the same values, carries the proof over.
#if defined(__x86_64__)

double error(double value, long double truth) { return static_cast<double>(std::fabs(static_cast<long double>(value) - truth)); }
double relative_error(double value, long double truth) { return error(value, truth) / static_cast<double>(std::fabs(truth)); }

double sin_cos_error(double x) {
  const SinCos value = sin_cos(x);
  const auto wide = static_cast<long double>(x);
  return std::max(error(value.sin, std::sin(wide)), error(value.cos, std::cos(wide)));
}

TEST(SinCos, WithinTheBound) {
  VERIFIES("LASSO-GEO-002~1");
  test::Generator generator(34);
  double worst = 0;
  for (int i = -200000; i <= 200000; ++i) {
    worst = std::max(worst, sin_cos_error(i * (kPi / 4 / 1000)));  // dense, with the seams between the quarters
    worst = std::max(worst, sin_cos_error(generator.uniform(-1e6, 1e6)));
    worst = std::max(worst, sin_cos_error(generator.uniform(-7, 7)));
  }
  worst = std::max({worst, sin_cos_error(1e6), sin_cos_error(-1e6)});                                // the domain's ends
  for (int n = -636619; n <= 636619; n += 7) worst = std::max(worst, sin_cos_error(n * (kPi / 2)));  // next to zeros
  EXPECT_LE(worst, 1e-15);
  RecordProperty("worst_error", std::to_string(worst * 1e17) + "e-17");
}

TEST(SinCos, TinyAnglesKeepTheirRelativeAccuracy) {
  VERIFIES("LASSO-GEO-002~1");
  for (double x = 1e-300; x < 0.7; x *= 3) EXPECT_LE(relative_error(sin_cos(x).sin, std::sin(static_cast<long double>(x))), 3e-16) << x;
}

TEST(Tangent, WithinTheBound) {
  VERIFIES("LASSO-GEO-002~1");
  test::Generator random(78);
  for (int i = 0; i < 20000; ++i) {
    const double x = random.uniform(-1.5, 1.5);
    ASSERT_NEAR(tangent(x) / std::tan(x), 1, 2e-14) << x;
  }
  EXPECT_TRUE(is_nan(tangent(1e7)));
}

TEST(ArcTangent2, WithinTheBound) {
  VERIFIES("LASSO-GEO-003~1");
  test::Generator generator(35);
  double worst = 0;
  const auto check = [&worst](double y, double x) {
    worst = std::max(worst, error(arc_tangent2(y, x), std::atan2(static_cast<long double>(y), static_cast<long double>(x))));
  };
  for (int i = 0; i < 400000; ++i) {
    check(generator.uniform(-1, 1), generator.uniform(-1, 1));
    check(std::ldexp(generator.uniform(-1, 1), i % 2000 - 1000), std::ldexp(generator.uniform(-1, 1), 1000 - i % 1999));
    const double a = i * (2 * kPi / 400000) - kPi;
    check(std::sin(a), std::cos(a));
    check(i / 400000.0, 1.0);  // the seams of the reduction
  }
  EXPECT_LE(worst, 2e-15);
  RecordProperty("worst_error", std::to_string(worst * 1e17) + "e-17");
}

TEST(ArcSine, WithinTheBound) {
  VERIFIES("LASSO-GEO-003~1");
  test::Generator generator(36);
  double worst = 0;
  const auto check = [&worst](double x) { worst = std::max(worst, error(arc_sine(x), std::asin(static_cast<long double>(x)))); };
  for (int i = -400000; i <= 400000; ++i) {
    check(i / 400000.0);
    check(generator.uniform(-1, 1));
    check(1 - std::ldexp(generator.uniform(0.5, 1), -std::abs(i % 54)));  // towards 1, where the slope is infinite
  }
  EXPECT_LE(worst, 2e-15);
  RecordProperty("worst_error", std::to_string(worst * 1e17) + "e-17");
}

TEST(Exponential, WithinTheBound) {
  VERIFIES("LASSO-GEO-004~1");
  test::Generator generator(37);
  double worst = 0;
  const auto check = [&worst](double x) { worst = std::max(worst, relative_error(exponential(x), std::exp(static_cast<long double>(x)))); };
  for (int i = -400000; i <= 400000; ++i) {
    check(708.39 / 400000 * i);
    check(generator.uniform(-708.39, 709.78));
    check(generator.uniform(-2, 2));
    check(0.34657359027997264 * (i / 200 | 1));  // the seams of the reduction (|i / 200| <= 2000)
  }
  EXPECT_LE(worst, 1e-14);
  RecordProperty("worst_relative_error", std::to_string(worst * 1e17) + "e-17");
}

TEST(NormalDensity, WithinTheBound) {
  VERIFIES("LASSO-GEO-019~1");
  const long double root_two_pi = std::sqrt(8 * std::atan(1.0L));
  for (int i = -370000; i <= 370000; ++i) {
    const double z = 1e-4 * i;
    const auto wide = static_cast<long double>(z);
    const long double truth = std::exp(-0.5L * wide * wide) / root_two_pi;
    ASSERT_LE(relative_error(normal_density(z), truth), 1e-14 * (1 + z * z / 20)) << z;
  }
}

TEST(NormalCumulative, WithinTheBounds) {
  VERIFIES("LASSO-GEO-005~1");
  test::Generator generator(38);
  double worst = 0;
  double worst_relative = 0;
  const auto check = [&](double z) {
    const long double truth = std::erfc(-static_cast<long double>(z) / std::sqrt(2.0L)) / 2;
    worst = std::max(worst, error(normal_cumulative(z), truth));
    if (z >= -30) worst_relative = std::max(worst_relative, relative_error(normal_cumulative(z), truth));
  };
  for (int i = -400000; i <= 400000; ++i) {
    check(1e-4 * i);
    check(generator.uniform(-8, 8));
  }
  EXPECT_LE(worst, 1e-14);
  EXPECT_LE(worst_relative, 1e-10);
  RecordProperty("worst_error", std::to_string(worst * 1e17) + "e-17");
  RecordProperty("worst_relative_error", std::to_string(worst_relative * 1e14) + "e-14");
}

#endif

}  // namespace
}  // namespace lasso
