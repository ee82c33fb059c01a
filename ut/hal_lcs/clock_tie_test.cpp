#include "hal_lcs/clock_tie.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso::lcs {
namespace {

constexpr TimeUs kTied_us = 100'000'000;
constexpr std::uint32_t kShown_us = 0xFFFF'FF00;  // the camera's clock is about to wrap

class ClockTieTest : public ::testing::Test {
 protected:
  void SetUp() override { tie.tie(kShown_us, kTied_us); }
  ClockTie tie;
};

TEST_F(ClockTieTest, StampsBecomeTimesAcrossTheWrapOfTheCamerasClock) {
  VERIFIES("LASSO-LCS-011~1");
  EXPECT_EQ(tie.time_of(kShown_us), kTied_us);
  EXPECT_EQ(tie.time_of(0), kTied_us + 0x100);
  EXPECT_EQ(tie.time_of(kShown_us - 5), kTied_us - 5);
}

TEST_F(ClockTieTest, AScanIsTimedByATieFromShortlyBeforeIt) {
  VERIFIES("LASSO-LCS-011~1");
  EXPECT_FALSE(ClockTie{}.serves(kTied_us)) << "never tied";
  EXPECT_TRUE(tie.serves(kTied_us));
  EXPECT_TRUE(tie.serves(kTied_us + kTieUs - 1));
  EXPECT_FALSE(tie.serves(kTied_us + kTieUs));
  EXPECT_TRUE(tie.serves(kTied_us - kClockToleranceUs));
  EXPECT_FALSE(tie.serves(kTied_us - kClockToleranceUs - 1)) << "the component's clock was set back since";
  tie.forget();
  EXPECT_FALSE(tie.serves(kTied_us));
}

TEST_F(ClockTieTest, AJumpIsMoreThanToleranceAndDrift) {
  VERIFIES("LASSO-LCS-011~1");
  constexpr DurationUs kLater_us = 2'000'000;
  constexpr auto kOff_us = static_cast<std::uint32_t>(kClockToleranceUs + kLater_us / 1000);
  const std::uint32_t as_ours = kShown_us + static_cast<std::uint32_t>(kLater_us);
  EXPECT_FALSE(tie.jumped(as_ours + kOff_us, kTied_us + kLater_us));
  EXPECT_FALSE(tie.jumped(as_ours - kOff_us, kTied_us + kLater_us));
  EXPECT_TRUE(tie.jumped(as_ours + kOff_us + 1, kTied_us + kLater_us));
  EXPECT_TRUE(tie.jumped(as_ours - kOff_us - 1, kTied_us + kLater_us));
  EXPECT_FALSE(ClockTie{}.jumped(as_ours + kOff_us + 1, kTied_us + kLater_us)) << "there is nothing to compare with";
}

}  // namespace
}  // namespace lasso::lcs
