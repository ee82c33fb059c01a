#include "bsp/posix/reset_note.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <system_error>
#include <thread>

#include "bsp/posix/watchdog.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::posix {
namespace {

class ResetNoteTest : public ::testing::Test {
 protected:
  ResetNoteTest()
      : folder_(std::filesystem::temp_directory_path() /
                ("lasso_reset_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directory(folder_);
  }
  ~ResetNoteTest() override { std::filesystem::remove_all(folder_); }

  // A program that keeps a note and ends by `end`.
  template <class End>
  void run(const End& end) const {
    const pid_t child = fork();
    if (child == 0) {
      const ResetNote note(folder_.string());
      end();
      _exit(0);
    }
    ASSERT_EQ(waitpid(child, nullptr, 0), child);
  }
  ResetCause cause() const { return ResetNote(folder_.string()).cause(); }

  std::filesystem::path folder_;
};

TEST_F(ResetNoteTest, SaysWhatEndedTheProgramBefore) {
  VERIFIES("LASSO-HLT-005~2");
  EXPECT_EQ(cause(), ResetCause::kPowerOn);
  run([] { std::abort(); });
  EXPECT_EQ(cause(), ResetCause::kInvariant);
  EXPECT_EQ(cause(), ResetCause::kPowerOn);
  run([] { (void)raise(SIGFPE); });
  EXPECT_EQ(cause(), ResetCause::kException);
  run([] { (void)raise(SIGKILL); });
  EXPECT_EQ(cause(), ResetCause::kPowerOn);
  run([] {
    TimerWatchdog watchdog(50'000);
    watchdog.feed();
    while (true) std::this_thread::sleep_for(std::chrono::seconds(1));
  });
  EXPECT_EQ(cause(), ResetCause::kWatchdog);
}

TEST_F(ResetNoteTest, AFileThatCannotBeMadeIsAnError) {
  VERIFIES("LASSO-HLT-005~2");
  EXPECT_THROW(ResetNote((folder_ / "none").string()), std::system_error);
}

}  // namespace
}  // namespace lasso::posix
