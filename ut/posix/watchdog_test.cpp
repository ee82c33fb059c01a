#include "bsp/posix/watchdog.hpp"

#include <chrono>
#include <csignal>
#include <thread>

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

void wait_ms(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

[[noreturn]] void starve() {
  posix::TimerWatchdog watchdog(20'000);
  watchdog.feed();
  while (true) wait_ms(1000);
}

TEST(TimerWatchdogDeathTest, BitesWhenNobodyFeedsIt) {
  VERIFIES("LASSO-HLT-003~2");
  EXPECT_EXIT(starve(), ::testing::KilledBySignal(SIGABRT), "");
}

TEST(TimerWatchdog, IsQuietBeforeTheFirstFeedWhileItIsFedAndWhenItIsGone) {
  VERIFIES("LASSO-HLT-003~2");
  {
    posix::TimerWatchdog watchdog(60'000'000);
    wait_ms(5);
    for (int i = 0; i < 5; ++i) watchdog.feed();
  }
  {
    posix::TimerWatchdog watchdog(30'000);
    watchdog.feed();
  }
  wait_ms(60);
  SUCCEED();
}

}  // namespace
}  // namespace lasso
