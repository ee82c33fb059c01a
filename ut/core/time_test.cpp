#include "fsw/core/time.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>

#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

TEST(Time, MicrosecondsToSeconds) {
  VERIFIES("LASSO-COR-009~1");
  EXPECT_DOUBLE_EQ(to_seconds(1), 1e-6);
  EXPECT_DOUBLE_EQ(to_seconds(-2500000), -2.5);
  EXPECT_EQ(to_seconds(0), 0.0);
}

// Against whole seconds and what is left of them, each of which a double holds: their difference is exact.
TEST(Time, IsConvertedToWithinHalfAMicrosecondOverACentury) {
  VERIFIES("LASSO-COR-009~1");
  static_assert(std::is_same_v<TimeUs, std::int64_t> && std::is_same_v<DurationUs, std::int64_t>, "whole microseconds in 64 bits");
  constexpr DurationUs kSecond = 1000000;
  constexpr DurationUs kCentury = 3155760000LL * kSecond;
  test::Generator random(22);
  const auto error_s = [](DurationUs t_us) {
    return std::abs(to_seconds(t_us) - static_cast<double>(t_us / kSecond) - static_cast<double>(t_us % kSecond) / 1e6);
  };
  for (const DurationUs ends : {kCentury, kCentury - 1, kCentury / 2 + 1, DurationUs{1}}) {
    EXPECT_LE(error_s(ends), 0.5e-6) << ends;
    EXPECT_LE(error_s(-ends), 0.5e-6) << ends;
  }
  for (int i = 0; i < 100000; ++i) {
    const auto t_us = static_cast<DurationUs>(random.below(static_cast<std::uint64_t>(kCentury)));
    ASSERT_LE(error_s(t_us), 0.5e-6) << t_us;
  }
}

}  // namespace
}  // namespace lasso
