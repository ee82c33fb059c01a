// Recordings of commanded runs: what an operator sent comes again, to the slot.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include "ft/mdat/live_run.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

constexpr const char* kRun = "run missions/test.toml --scenario spin --no-report --force --out run --record run.mcap --frames ";

// A run that has not begun refuses at once.
Answer until_it_answers(const WorkFolder& work, const std::string& command) {
  Answer answer = work.mdat(command + " --wait 2");
  for (int i = 0; i < 200 && answer.exit_code != 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    answer = work.mdat(command + " --wait 2");
  }
  return answer;
}

void expect_the_same(const WorkFolder& work, const std::string& more = "") {
  const Answer replay = work.mdat("replay run.mcap " + more);
  EXPECT_EQ(replay.exit_code, 0) << replay.err << replay.out;
  EXPECT_NE(replay.out.find("telemetry: the same as recorded"), std::string::npos) << replay.out;
}

// Commands of each kind at whatever time they come, a reset among them, and an end by Ctrl-C long before the last frame.
TEST(RecordedCommands, ComeAgainToTheSlot) {
  VERIFIES("LASSO-REC-021~1");
  const WorkFolder work;
  for (const std::string scheme : {"udp", "tcp"}) {
    const std::string url = scheme + "://127.0.0.1:" + free_port();
    Program run(work, std::string(kRun) + "100000 --link " + url);
    const Answer pong = until_it_answers(work, "command ping --to " + url);
    ASSERT_EQ(pong.exit_code, 0) << url << '\n' << pong.err << run.printed();
    for (const char* command : {"set_mode mode=standby", "set_structure_period structure=pose period_frames=2", "enable_laser",
                                "reset --arm", "set_mode mode=bearing"})
      (void)work.mdat(std::string("command ") + command + " --wait 30 --to " + url);
    ASSERT_EQ(run.interrupt().exit_code, 0);
    std::filesystem::remove(work / "missions/test.toml");
    expect_the_same(work);
    EXPECT_NE(work.mdat("recording info run.mcap").out.find("/commands"), std::string::npos);
    work.write_mission();
  }
}

TEST(RecordedCommands, NeedTheirKey) {
  VERIFIES("LASSO-REC-021~1");
  const WorkFolder work;
  work.write("key", std::string(64, 'a'));
  ASSERT_EQ(work.mdat("command set_mode mode=standby --key key --out tm.commands").exit_code, 0);
  ASSERT_EQ(work.mdat(std::string(kRun) + "2 --key key --link file://" + (work / "tm").string()).exit_code, 0);
  expect_the_same(work, "--key key");
  EXPECT_EQ(work.read("run.mcap").find(std::string(64, 'a')), std::string::npos) << "the key is nobody's affair";
  const Answer without = work.mdat("replay run.mcap");
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_NE(without.err.find("run.mcap: its component took signed commands alone"), std::string::npos) << without.err;
}

// What a store held before the run is in the recording.
TEST(RecordedCommands, BeginWithTheirStore) {
  VERIFIES("LASSO-REC-021~1");
  const WorkFolder work;
  const std::string run = "2 --store store --link file://" + (work / "tm").string();
  for (const char* command : {"set_parameter parameter=tracking.coast_frames value=20", "save_parameters"})
    ASSERT_EQ(work.mdat(std::string("command ") + command + " --count 1 --out " + std::string(command).substr(0, 3)).exit_code, 0)
        << command;
  work.write("tm.commands", work.read("set") + work.read("sav"));
  ASSERT_EQ(work.mdat(std::string(kRun) + run).exit_code, 0);
  expect_the_same(work);
  work.write("tm.commands", "");
  ASSERT_EQ(work.mdat(std::string(kRun) + run).exit_code, 0) << "it begins with the saved value";
  std::filesystem::remove_all(work / "store");
  expect_the_same(work);
}

}  // namespace
}  // namespace lasso::ft
