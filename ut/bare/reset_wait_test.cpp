#include "bsp/bare/reset_wait.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso::bare {
namespace {

TEST(ResetWait, EndsWhenTheTelemetryIsOut) {
  VERIFIES("LASSO-PLT-027~2");
  ResetWait wait;
  EXPECT_FALSE(wait.over(true, false));
  EXPECT_FALSE(wait.over(true, false));
  EXPECT_TRUE(wait.over(true, true));
}

TEST(ResetWait, EndsByItselfAfterTenFrames) {
  VERIFIES("LASSO-PLT-027~2");
  ResetWait wait;
  for (std::uint32_t frame = 0; frame < 10; ++frame) EXPECT_FALSE(wait.over(true, false)) << frame;
  EXPECT_TRUE(wait.over(true, false));
}

// A line that was congested for long before does not shorten it.
TEST(ResetWait, CountsFromTheResetOn) {
  VERIFIES("LASSO-PLT-027~2");
  ResetWait wait;
  for (std::uint32_t frame = 0; frame < 100; ++frame) EXPECT_FALSE(wait.over(false, frame % 2 == 0)) << frame;
  EXPECT_FALSE(wait.over(true, false));
}

}  // namespace
}  // namespace lasso::bare
