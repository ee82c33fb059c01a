#include "fsw/geometry/fixed_number.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using N = FixedNumber;
constexpr std::int32_t kMostRaw = std::numeric_limits<std::int32_t>::max();

TEST(FixedNumber, LengthIsTheWordToTheNearest) {
  VERIFIES("LASSO-GEO-008~1 LASSO-GEO-023~2");
  test::Generator random(51);
  for (int i = 0; i < 100000; ++i) {
    const auto word = static_cast<std::int32_t>(static_cast<std::uint32_t>(random.bits() >> (32 + i % 31)));
    const int bits = i % 96;
    const double exact = std::ldexp(static_cast<double>(word), 22 - bits);
    const double truth = std::fmax(std::fmin(std::floor(exact + 0.5), kMostRaw), -static_cast<double>(kMostRaw));
    ASSERT_EQ(N::length(word, bits).raw, truth) << word << ' ' << bits;
  }
  EXPECT_EQ(N::unit(-(1 << 29)), N::Unit(-0.5));
  EXPECT_EQ(N::gradient(3 << 16, 16), N::Gradient(3));
}

TEST(FixedNumber, FloatsAreTakenByTheirBits) {
  VERIFIES("LASSO-GEO-023~2");
  test::Generator random(52);
  for (int i = 0; i < 100000; ++i) {
    const auto x = static_cast<float>(random.uniform(-1, 1) * std::ldexp(1.0, 6 - static_cast<int>(random.below(34))));
    ASSERT_NEAR(static_cast<double>(N::from_float<N::Length>(x)), static_cast<double>(x), 0x1p-23) << x;
  }
  EXPECT_EQ(N::from_float<N::Length>(0.0F).raw, 0);
  EXPECT_EQ(N::from_float<N::Length>(-1.5F), N::Length(-1.5));
  EXPECT_EQ(N::from_float<N::Length>(1e30F).raw, kMostRaw);
  EXPECT_EQ(N::from_float<N::Length>(-std::numeric_limits<float>::infinity()).raw, -kMostRaw);
  EXPECT_EQ(N::from_float<N::Length>(std::numeric_limits<float>::quiet_NaN()).raw, 0);
  EXPECT_EQ(N::from_float<N::Length>(std::numeric_limits<float>::denorm_min()).raw, 0);
}

TEST(FixedNumber, PlacesAreCutToWhatThePathHolds) {
  VERIFIES("LASSO-GEO-023~2");
  EXPECT_EQ(N::to_length(3.25), N::Length(3.25));
  EXPECT_EQ(N::to_length(1e6), N::Length(N::kFarthest_m));
  EXPECT_EQ(N::to_length(-1e6), N::Length(-N::kFarthest_m));
  EXPECT_EQ(N::to<N::Unit>(0.5), N::Unit(0.5));
  EXPECT_EQ(N::to_float(N::Unit(0.5)), 0.5F);
  EXPECT_EQ(N::to_double(N::Unit(0.25)), 0.25);
}

TEST(FixedNumber, SecondsOfAScan) {
  VERIFIES("LASSO-GEO-023~2");
  test::Generator random(53);
  for (int i = 0; i < 10000; ++i) {
    const auto dt_us = static_cast<TimeUs>(random.uniform(-1.9e6, 1.9e6));
    ASSERT_NEAR(N::to_double(N::seconds(dt_us)), static_cast<double>(dt_us) * 1e-6, 2e-9);
  }
  EXPECT_EQ(N::seconds(5'000'000), N::seconds(1'900'000));
  EXPECT_EQ(N::seconds(-5'000'000), N::seconds(-1'900'000));
}

TEST(FixedNumber, RowsAreScaledByThePowerOfTwoAboveTheModel) {
  VERIFIES("LASSO-GEO-023~2");
  EXPECT_EQ(N::row_scale(0.6).of_one(), 1.0);
  EXPECT_EQ(N::row_scale(0.15).of_one(), 0.25);
  EXPECT_EQ(N::row_scale(7).of_one(), 16.0);
  EXPECT_EQ(N::row_scale(1e3).of_one(), 256.0);
  EXPECT_EQ(N::row_scale(0).of_one(), 0x1p-10);
  const N::RowScale scale = N::row_scale(5);  // 8
  EXPECT_NEAR(N::to_double(scale.length(N::Length(6), false)), 0.75, 0x1p-24);
  EXPECT_NEAR(N::to_double(scale.length(N::Length(6) * N::Unit(-0.5), false)), -0.375, 0x1p-24);
  EXPECT_EQ(scale.length(N::Length(100), false), N::Column(1));
  EXPECT_EQ(scale.length(N::Length(-100), false), N::Column(-1));
}

// Weight times column times column is what it was, heavy or not.
TEST(FixedNumber, HeavyRowsKeepTheirProducts) {
  VERIFIES("LASSO-GEO-023~2");
  test::Generator random(54);
  const N::RowScale scale = N::row_scale(5);
  for (int i = 0; i < 10000; ++i) {
    const N::Weight w(random.uniform(0, 256));
    const bool heavy = N::RowScale::is_heavy(w);
    const N::Unit a(random.uniform(-1, 1));
    const N::Length b(random.uniform(-8, 8));
    const N::Weighted weighted = N::RowScale::weight(w) * N::RowScale::direction(a, heavy);
    const double product = static_cast<double>(weighted * scale.length(b, heavy));
    ASSERT_NEAR(product, N::to_double(w) * N::to_double(a) * N::to_double(b) / 8, 1e-6 * N::to_double(w) + 1e-7);
  }
}

TEST(FixedNumber, SmallOperationsOfThePath) {
  VERIFIES("LASSO-GEO-023~2");
  const auto bins = N::Tangent(0.5) * N::BinRate(20);
  EXPECT_EQ(N::index_below(32, bins), 10);
  EXPECT_EQ(N::index_below(8, bins), 7);
  EXPECT_EQ(N::cells(41), N::Cells(41));
  EXPECT_EQ(N::farthest_walk(N::Length(0.1)), N::Length(255));
  EXPECT_NEAR(N::to_double(N::cells_per_m(1 << 18, 22)), 16, 1e-5);
  EXPECT_NEAR(N::to_double(N::area(N::Kernel(100) * N::Variance(1e-4))), 0.01, 1e-6);
  EXPECT_NEAR(N::to_double(N::area_at(N::Tangent(0.03), N::Tangent(0.04), N::Length(10))), 0.25, 1e-5);
  EXPECT_EQ(N::sum(Wide<48>{7 << 6}).raw, 7);
}

}  // namespace
}  // namespace lasso
