#include "fsw/core/time.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

TEST(Time, MicrosecondsToSeconds) {
  VERIFIES("LASSO-COR-009~1");
  EXPECT_DOUBLE_EQ(to_seconds(1), 1e-6);
  EXPECT_DOUBLE_EQ(to_seconds(-2500000), -2.5);
  EXPECT_EQ(to_seconds(0), 0.0);
  // A century: microseconds fit, and their conversion is within half a microsecond.
  constexpr DurationUs kCentury = 3155760000LL * 1000000LL;
  EXPECT_NEAR(to_seconds(kCentury + 1) - to_seconds(kCentury), 1e-6, 0.5e-6);
}

}  // namespace
}  // namespace lasso
