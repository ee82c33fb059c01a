#include "fsw/geometry/number.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

TEST(FloatNumber, LengthIsTheWordRoundedOnceAndScaledExactly) {
  VERIFIES("LASSO-GEO-008~1");
  test::Generator generator(41);
  for (int i = 0; i < 200000; ++i) {
    const auto word = static_cast<std::int32_t>(static_cast<std::uint32_t>(generator.bits() >> (32 + i % 31)));
    const int fraction_bits = i % 96;
    // Double holds the exact value; its conversion rounds once.
    const auto truth = static_cast<float>(std::ldexp(static_cast<double>(word), -fraction_bits));
    ASSERT_EQ(FloatNumber::length(word, fraction_bits), truth) << word << ' ' << fraction_bits;
    ASSERT_EQ(FloatNumber::gradient(word, fraction_bits), truth) << word << ' ' << fraction_bits;
  }
}

TEST(FloatNumber, NothingIsCut) {
  VERIFIES("LASSO-GEO-008~1");
  EXPECT_EQ(cut<FloatNumber::Unit>(3.5F), 3.5F);
  EXPECT_EQ(rest_of_one(0.25F), 0.75F);
  EXPECT_EQ(rest_of_one(1.25F), 0.0F);
}

TEST(FloatNumber, EndsOfTheRange) {
  VERIFIES("LASSO-GEO-008~1");
  EXPECT_EQ(FloatNumber::length(0, 20), 0.0F);
  EXPECT_EQ(FloatNumber::length(std::numeric_limits<std::int32_t>::min(), 31), -1.0F);
  EXPECT_EQ(FloatNumber::length(1, 0), 1.0F);
  EXPECT_EQ(FloatNumber::length(3, 1), 1.5F);
  EXPECT_EQ(FloatNumber::unit(1 << 30), 1.0F);
  EXPECT_EQ(FloatNumber::unit(-(1 << 29)), -0.5F);
}

TEST(FloatNumber, UnitIsWithinHalfAnUlp) {
  VERIFIES("LASSO-GEO-008~1");
  test::Generator generator(42);
  for (int i = 0; i < 100000; ++i) {
    const auto word = static_cast<std::int32_t>(generator.bits() >> 33) - (1 << 30);
    const double exact = static_cast<double>(word) / 1073741824.0;
    ASSERT_LE(std::fabs(static_cast<double>(FloatNumber::unit(word)) - exact), std::fabs(exact) * 0x1p-24) << word;
  }
}

TEST(FloatNumber, DoublesRoundToThePathAndReturnExactly) {
  VERIFIES("LASSO-GEO-008~1");
  test::Generator generator(43);
  for (int i = 0; i < 100000; ++i) {
    const double x = generator.uniform(-64, 64);
    ASSERT_LE(std::fabs(FloatNumber::to_double(FloatNumber::to_length(x)) - x), std::fabs(x) * 0x1p-24);
    const float single = FloatNumber::to_length(x);
    ASSERT_EQ(FloatNumber::to<FloatNumber::Unit>(x), single);
    ASSERT_EQ(FloatNumber::to_float(single), single);
    ASSERT_EQ(FloatNumber::from_float<FloatNumber::Sigma>(single), single);
    ASSERT_EQ(FloatNumber::to_length(FloatNumber::to_double(single)), single);
  }
}

TEST(FloatNumber, CellsPerMetreAreTheInverseOfTheCell) {
  VERIFIES("LASSO-GEO-008~1");
  EXPECT_EQ(FloatNumber::cells_per_m(1 << 18, 20), 4.0F);
  EXPECT_FLOAT_EQ(FloatNumber::cells_per_m(3 << 18, 20), 4.0F / 3);
}

TEST(FloatNumber, SecondsAreThoseOfMicroseconds) {
  VERIFIES("LASSO-GEO-008~1");
  EXPECT_EQ(FloatNumber::seconds(-500'000), -0.5F);
  EXPECT_FLOAT_EQ(FloatNumber::seconds(12), 12e-6F);
}

TEST(FloatNumber, PlacesAreCutToTheLastIndex) {
  VERIFIES("LASSO-GEO-008~1");
  EXPECT_EQ(FloatNumber::index_below(32, 0.5F), 0);
  EXPECT_EQ(FloatNumber::index_below(32, 31.5F), 31);
  EXPECT_EQ(FloatNumber::index_below(32, 32.0F), 31);
  EXPECT_EQ(FloatNumber::index_below(32, 1e30F), 31);
}

TEST(FloatNumber, SharesAlongALineAreCutToItsEnds) {
  VERIFIES("LASSO-GEO-008~1");
  const float inverse = inverse_length2(4.0F);
  EXPECT_EQ(share_along(3.0F, inverse), 0.75F);
  EXPECT_EQ(share_along(-1.0F, inverse), 0.0F);
  EXPECT_EQ(share_along(5.0F, inverse), 1.0F);
  EXPECT_EQ(share_along(5.0F, inverse_length2(0.0F)), 0.0F);  // a line without length
}

TEST(FloatNumber, AreasAreOfTheOffsetAtItsDepth) {
  VERIFIES("LASSO-GEO-008~1");
  EXPECT_EQ(FloatNumber::area_at(3.0F, 4.0F, 2.0F), 100.0F);
}

TEST(FloatNumber, OperationsAreThoseOfItsArithmetic) {
  VERIFIES("LASSO-GEO-008~1");
  EXPECT_EQ(quotient<float>(3.0F, 4.0F), 0.75F);
  EXPECT_EQ(over<float>(3.0F, inverse_of(4.0F)), 0.75F);
  EXPECT_EQ(share_of(3.0F, 4.0F), 0.75F);
  EXPECT_EQ(bounded<float>(1e30F), 1e30F);
  EXPECT_EQ(half_of(3.0F), 1.5F);
  EXPECT_EQ(times(-3, 0.5F), -1.5F);
  EXPECT_EQ(whole_part(2.75F), 2);
}

TEST(Dot3, IsTheScalarProduct) {
  VERIFIES("LASSO-GEO-008~1");
  const float a[] = {1.5F, -2.0F, 0.25F};
  const float b[] = {4.0F, 0.5F, -8.0F};
  EXPECT_EQ(dot3<FloatNumber>(a, b), 3.0F);
}

}  // namespace
}  // namespace lasso
