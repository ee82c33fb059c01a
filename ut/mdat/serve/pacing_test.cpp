#include "mdat/serve/pacing.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

constexpr TimeUs kFrame_us = 200'000;
constexpr double kNoWait = 0;

// A run of boundaries in a thread of its own; the count of those that passed is seen from the test's.
class PacedRun {
 public:
  explicit PacedRun(Pacing& pacing)
      : pacing_(pacing), thread_([this] {
          for (TimeUs at_us = 0; pacing_.pass(at_us); at_us += kFrame_us) ++passed_;
          ended_ = true;
        }) {}
  ~PacedRun() {
    pacing_.stop();
    thread_.join();
  }
  PacedRun(const PacedRun&) = delete;
  PacedRun& operator=(const PacedRun&) = delete;

  std::uint64_t passed() const { return passed_; }
  void wait_for(std::uint64_t passed) const {
    while (passed_ < passed) std::this_thread::yield();
  }
  void wait_for_end() const {
    while (!ended_) std::this_thread::yield();
  }

 private:
  Pacing& pacing_;
  std::atomic<std::uint64_t> passed_{0};
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

TEST(PacingTest, AStepLetsOneBoundaryPass) {
  VERIFIES("LASSO-WEB-019~1");
  Pacing pacing(kNoWait);
  pacing.pause();
  PacedRun run(pacing);
  EXPECT_EQ(run.passed(), 0U);
  for (std::uint64_t steps = 1; steps <= 5; ++steps) {
    pacing.step();
    run.wait_for(steps);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_EQ(run.passed(), steps);
  }
  EXPECT_TRUE(pacing.paused());
}

TEST(PacingTest, WithoutAPaceNothingWaits) {
  VERIFIES("LASSO-WEB-019~1");
  Pacing pacing(kNoWait);
  PacedRun run(pacing);
  run.wait_for(1000);  // 200 s of the run
  EXPECT_FALSE(pacing.paused());
}

TEST(PacingTest, APaceIsNeverExceeded) {
  VERIFIES("LASSO-WEB-019~1");
  constexpr double kPace = 20;
  constexpr int kBoundaries = 6;
  Pacing pacing(kPace);
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < kBoundaries; ++i) ASSERT_TRUE(pacing.pass(i * kFrame_us));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_GE(took.count(), (kBoundaries - 1) * to_seconds(kFrame_us) / kPace);
}

TEST(PacingTest, AnotherPaceHoldsForTheWaitThatIsUnderWay) {
  VERIFIES("LASSO-WEB-019~1");
  Pacing pacing(1e-6);  // a frame takes two days
  PacedRun run(pacing);
  run.wait_for(1);
  pacing.set_pace(kNoWait);
  run.wait_for(100);
  EXPECT_EQ(pacing.pace(), kNoWait);
}

TEST(PacingTest, APaceNearZeroWaits) {
  VERIFIES("LASSO-WEB-019~1");
  Pacing pacing(1e-300);  // a frame takes longer than any clock counts
  PacedRun run(pacing);
  run.wait_for(1);
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(run.passed(), 1U);
}

TEST(PacingTest, StoppingEndsEachKindOfWait) {
  VERIFIES("LASSO-WEB-019~1");
  Pacing slow(1e-6), paused(kNoWait);
  paused.pause();
  PacedRun waiting(slow), standing(paused);
  waiting.wait_for(1);
  slow.stop();
  paused.stop();
  waiting.wait_for_end();
  standing.wait_for_end();
  EXPECT_EQ(standing.passed(), 0U);
  EXPECT_FALSE(slow.pass(0));
}

TEST(PacingTest, AfterAPauseItGoesOnWithoutStepsThatAreLeft) {
  VERIFIES("LASSO-WEB-019~1");
  Pacing pacing(kNoWait);
  pacing.pause();
  PacedRun run(pacing);
  pacing.resume();
  run.wait_for(10);
  pacing.pause();
  EXPECT_TRUE(pacing.paused());
}

TEST(PacingTest, ItHurriesToATimeAndStandsThereAgain) {
  VERIFIES("LASSO-REC-042~1");
  Pacing pacing(kNoWait);
  pacing.pause();
  PacedRun run(pacing);
  pacing.hurry_to(3 * kFrame_us);
  run.wait_for(4);  // boundaries at 0, 1, 2 and 3 frames
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(run.passed(), 4U);
  EXPECT_TRUE(pacing.paused());
}

TEST(PacingTest, HurryingEndsAWaitThatIsUnderWay) {
  VERIFIES("LASSO-REC-042~1");
  Pacing pacing(1e-6);  // a frame takes two days
  PacedRun run(pacing);
  run.wait_for(1);
  pacing.hurry_to(2 * kFrame_us);
  run.wait_for(3);
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(run.passed(), 3U) << "then it keeps its pace again";
}

}  // namespace
}  // namespace lasso::mdat::serve
