#include "fsw/geometry/fixed.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using Metres = Fixed<22>;
using Unit = Fixed<30>;
constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();

double value(Metres x) { return static_cast<double>(x); }
double value(Unit x) { return static_cast<double>(x); }

Metres metres(test::Generator& random, double most) { return Metres(random.uniform(-most, most)); }

TEST(Fixed, HoldsTheNearestToANumber) {
  VERIFIES("LASSO-GEO-023~2");
  test::Generator random(1);
  for (int i = 0; i < 10000; ++i) {
    const double x = random.uniform(-500, 500);
    ASSERT_EQ(Metres(x).raw, std::lround(std::ldexp(x, 22))) << x;
  }
  EXPECT_EQ(Metres(1e9).raw, kMost);
  EXPECT_EQ(Metres(-1e9).raw, -kMost);
  EXPECT_EQ(Metres(std::numeric_limits<double>::quiet_NaN()).raw, 0);
  EXPECT_EQ(Metres(std::numeric_limits<double>::infinity()).raw, kMost);
}

TEST(Fixed, SumsAreExact) {
  VERIFIES("LASSO-GEO-023~2");
  test::Generator random(2);
  for (int i = 0; i < 10000; ++i) {
    const Metres a = metres(random, 200);
    const Metres b = metres(random, 200);
    ASSERT_EQ(value(a + b), value(a) + value(b));
    ASSERT_EQ(value(a - b), value(a) - value(b));
    ASSERT_EQ(value(-a), -value(a));
    ASSERT_EQ(value(2 * a), 2 * value(a));
    ASSERT_EQ(static_cast<double>(times(300, a)), 300 * value(a));
    Metres c = a;
    c += b;
    ASSERT_EQ(c, a + b);
    ASSERT_EQ(a < b, value(a) < value(b));
    ASSERT_EQ(a > b, value(a) > value(b));
    ASSERT_EQ(a <= b, value(a) <= value(b));
    ASSERT_EQ(a >= b, value(a) >= value(b));
  }
  EXPECT_EQ(value(1 - Unit(0.25)), 0.75);
  EXPECT_TRUE(Metres(1) <= Metres(1));
  EXPECT_TRUE(Metres(1) >= Metres(1));
}

TEST(Fixed, ProductsAreExactAndRoundedWhereTheyAreStored) {
  VERIFIES("LASSO-GEO-023~2");
  test::Generator random(3);
  for (int i = 0; i < 10000; ++i) {
    const Metres a = metres(random, 200);
    const Unit b(random.uniform(-1, 1));
    const Wide<52> product = a * b;
    ASSERT_EQ(product.raw, std::int64_t{a.raw} * b.raw);
    const Metres stored = product;
    ASSERT_LE(std::abs(std::ldexp(static_cast<double>(stored.raw), 30) - static_cast<double>(product.raw)), std::ldexp(1.0, 29));
    ASSERT_EQ(static_cast<double>(product), std::ldexp(static_cast<double>(product.raw), -52));
  }
}

TEST(Fixed, StoredNumbersJoinProductsExactly) {
  VERIFIES("LASSO-GEO-023~2");
  test::Generator random(4);
  for (int i = 0; i < 10000; ++i) {
    const Metres a = metres(random, 100);
    const Wide<52> b = metres(random, 100) * Unit(random.uniform(-1, 1));
    const std::int64_t wide = std::int64_t{a.raw} * (std::int64_t{1} << 30);
    ASSERT_EQ((a + b).raw, wide + b.raw);
    ASSERT_EQ((b + a).raw, wide + b.raw);
    ASSERT_EQ((a - b).raw, wide - b.raw);
    ASSERT_EQ((b - a).raw, b.raw - wide);
    ASSERT_EQ(a < b, wide < b.raw);
    const Metres side = metres(random, 40);  // its square has room beside 52 fractional bits
    const Wide<44> area = side * side;
    ASSERT_EQ((b + area).raw, b.raw + (area.raw * 256));
    ASSERT_EQ(area < b, area.raw * 256 < b.raw);
    ASSERT_EQ(b < area, b.raw < area.raw * 256);
    Wide<52> sum = b;
    sum += b;
    ASSERT_EQ(sum.raw, (b + b).raw);
  }
}

TEST(Fixed, ChangesResolution) {
  VERIFIES("LASSO-GEO-023~2");
  test::Generator random(5);
  for (int i = 0; i < 1000; ++i) {
    const Unit a(random.uniform(-1, 1));
    const Metres coarse(a);
    ASSERT_LE(std::abs(value(coarse) - value(a)), 0x1p-23);
    ASSERT_EQ(value(Unit(coarse)), value(coarse));
    ASSERT_LE(std::abs(value(half_of(coarse)) - 0.5 * value(coarse)), 0x1p-23);
    ASSERT_EQ(whole_part(times(300, coarse)), static_cast<std::int32_t>(std::floor(300 * value(coarse))));
    ASSERT_EQ(whole_part(coarse), static_cast<std::int32_t>(std::floor(value(coarse))));
  }
}

TEST(Fixed, BoundedIsCutToAQuarter) {
  VERIFIES("LASSO-GEO-023~2");
  const Wide<52> within = Metres(100) * Unit(1);
  EXPECT_EQ(bounded<Metres>(within).raw, 100 << 22);
  EXPECT_EQ(bounded<Metres>(within + within).raw, kMost / 4);
  EXPECT_EQ(bounded<Metres>(Metres(-200) * Unit(1)).raw, -(kMost / 4));
}

TEST(Fixed, QuotientIsThatOfTheNumbers) {
  VERIFIES("LASSO-GEO-023~2");
  test::Generator random(6);
  for (int i = 0; i < 10000; ++i) {
    const Metres a = metres(random, 10);
    const Unit b(random.uniform(0.05, 1) * (i % 2 == 0 ? 1 : -1));
    ASSERT_NEAR(value(quotient<Metres>(a, b)), value(a) / value(b), 0x1p-22);
    const double scale = std::ldexp(1.0, -static_cast<int>(random.below(30)));
    const Wide<66> num = Unit(scale * random.uniform(0, 1)) * Fixed<36>(random.uniform(0, 0.007));
    const Wide<66> den = Unit(scale * random.uniform(0.1, 1)) * Fixed<36>(random.uniform(0.001, 0.007));
    if (num.raw >> 8 >= den.raw) continue;
    const double truth = static_cast<double>(num.raw) / static_cast<double>(den.raw);
    ASSERT_NEAR(static_cast<double>(quotient<Fixed<22>>(num, den)), truth, 1e-8 * truth + 0x1p-21);
  }
}

TEST(Fixed, QuotientsThatDoNotFitAreCut) {
  VERIFIES("LASSO-GEO-023~2");
  EXPECT_EQ(quotient<Metres>(Metres(100), Unit(1e-6)).raw, kMost);
  EXPECT_EQ(quotient<Metres>(Metres(-100), Unit(1e-6)).raw, -kMost);
  EXPECT_EQ(quotient<Metres>(Metres(1), Unit(0)).raw, kMost);
  EXPECT_EQ(quotient<Metres>(Metres(-1), Unit(0)).raw, -kMost);
  EXPECT_EQ(quotient<Metres>(Metres(0), Unit(0)).raw, 0);
  EXPECT_EQ(quotient<Fixed<22>>(Wide<66>{1}, Wide<66>{0}), Fixed<22>(256));
  EXPECT_EQ(quotient<Fixed<22>>(Wide<66>{25600}, Wide<66>{100}), Fixed<22>(256));
}

TEST(Fixed, SharesAreCutToTheirInterval) {
  VERIFIES("LASSO-GEO-023~2");
  test::Generator random(7);
  for (int i = 0; i < 10000; ++i) {
    const double scale = std::ldexp(1.0, -static_cast<int>(random.below(16)));  // also where the divisor has less than 31 bits
    const Metres a = metres(random, 8 * scale);
    const Metres b = metres(random, 8 * scale);
    const Wide<44> part = a * a;
    const Wide<44> whole = part + b * b;
    const double truth = static_cast<double>(part) / static_cast<double>(whole);
    ASSERT_NEAR(value(share_of(part, whole)), truth, 0x1p-26) << a.raw << ' ' << b.raw;
    ASSERT_NEAR(value(share_of(widened<52>(part), whole)), truth, 0x1p-26);
    ASSERT_NEAR(value(share_along(part, inverse_length2(whole))), truth, 0x1p-26);
  }
  const Wide<44> one = Metres(1) * Metres(1);
  EXPECT_EQ(share_of(Metres(-1) * Metres(1), one), Unit(0));
  EXPECT_EQ(share_of(one + one, one), Unit(1));
  EXPECT_EQ(share_along(Metres(-1) * Metres(1), inverse_length2(one)), Unit(0));
  EXPECT_EQ(share_along(one + one, inverse_length2(one)), Unit(1));
  EXPECT_EQ(share_along(Wide<44>{one.raw + one.raw / 2}, inverse_length2(one)), Unit(1));
}

TEST(Fixed, SharesOfNearlyNothing) {
  VERIFIES("LASSO-GEO-023~2");
  const Wide<44> few{5};
  EXPECT_NEAR(value(share_of(Wide<44>{2}, few)), 0.4, 0x1p-29);
  EXPECT_NEAR(value(share_along(Wide<44>{2}, inverse_length2(few))), 0.4, 0x1p-29);
  EXPECT_EQ(share_along(Wide<44>{std::int64_t{1} << 40}, inverse_length2(few)), Unit(1));
  EXPECT_EQ(share_along(few, inverse_length2(Wide<44>{0})), Unit(0));
}

TEST(Fixed, InverseDividesSeveral) {
  VERIFIES("LASSO-GEO-023~2");
  test::Generator random(8);
  for (int i = 0; i < 10000; ++i) {
    const Metres x(random.uniform(0.2, 100) * (i % 2 == 0 ? 1 : -1));
    const Metres a = metres(random, 100);
    const double truth = value(a) / value(x);
    ASSERT_NEAR(static_cast<double>(over<Fixed<16>>(a, inverse_of(x))), truth, 0x1p-16 + 1e-8 * std::abs(truth));
  }
}

TEST(Fixed, InversesOfSmallNumbersAreCut) {
  VERIFIES("LASSO-GEO-023~2");
  EXPECT_EQ(over<Fixed<30>>(Metres(100), inverse_of(Metres(1e-6))).raw, kMost);
  EXPECT_EQ(over<Fixed<30>>(Metres(-100), inverse_of(Metres(1e-6))).raw, -kMost);
  EXPECT_EQ(over<Fixed<30>>(Metres(100), inverse_of(Metres(0))).raw, kMost);
  EXPECT_EQ(over<Fixed<30>>(Metres(100), inverse_of(Metres(-1e-6))).raw, -kMost);
  EXPECT_EQ(over<Fixed<30>>(Fixed<2>::of_raw(1), inverse_of(Metres::of_raw(1))).raw, kMost);
  EXPECT_EQ(over<Fixed<30>>(Fixed<2>::of_raw(-1), inverse_of(Metres::of_raw(1))).raw, -kMost);
  EXPECT_EQ(over<Fixed<30>>(Fixed<2>::of_raw(0), inverse_of(Metres::of_raw(1))).raw, 0);
  EXPECT_EQ(over<Fixed<30>>(Fixed<2>::of_raw(1 << 30), inverse_of(Metres::of_raw(1))).raw, kMost);
  EXPECT_EQ(over<Fixed<30>>(Fixed<2>::of_raw(-(1 << 30)), inverse_of(Metres::of_raw(1))).raw, -kMost);
  EXPECT_EQ(over<Fixed<2>>(Fixed<30>(1), inverse_of(Fixed<2>(1e8))).raw, 0);
  EXPECT_EQ(inverse_of(Metres::of_raw(kLeast)).significand, inverse_of(Metres::of_raw(-kMost)).significand);
}

TEST(Fixed, StoredIsCutToWhatTheTypeHolds) {
  VERIFIES("LASSO-GEO-023~2");
  const Fixed<30> half(0.5);
  EXPECT_EQ(cut<Fixed<30>>(half * half), Fixed<30>(0.25));
  const Fixed<30> most(1.9);
  EXPECT_EQ(cut<Fixed<30>>(most * most), Fixed<30>(4)) << "the largest number";
  EXPECT_EQ(cut<Fixed<30>>(most * -most), -Fixed<30>(4));
}

TEST(Fixed, NothingIsLeftOfOneWhereMoreIsTaken) {
  VERIFIES("LASSO-GEO-023~2");
  EXPECT_EQ(rest_of_one(Fixed<30>(0.25)), Fixed<30>(0.75));
  EXPECT_EQ(rest_of_one(Fixed<30>(1)), Fixed<30>(0));
  EXPECT_EQ(rest_of_one(Fixed<30>(1.75)), Fixed<30>(0));
}

}  // namespace
}  // namespace lasso
