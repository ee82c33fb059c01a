// A component's telemetry over a link, as mdat monitor gives it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "ft/mdat/live_run.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

// Poses of a recording, a line each: time, position, attitude.
std::vector<std::string> poses_of(const WorkFolder& work, const std::string& recording, const std::string& folder) {
  const Answer answer = work.mdat("recording export " + recording + " --format tum -o " + folder);
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  return lines_of(work.read(folder + "/pose.tum"));
}

TEST(Monitor, RecordsWhatTheComponentTold) {
  VERIFIES("LASSO-GND-163~1");
  const WorkFolder work;
  work.write_mission();
  const std::string link = "udp://127.0.0.1:" + free_port();
  Program monitor(work, "monitor " + link + " --record seen.mcap --mission missions/test.toml");
  for (int i = 0; i < 3000 && monitor.printed().find("telemetry by") == std::string::npos; ++i) ::usleep(20'000);
  LiveRun run(work, "run",
              {"run", "missions/test.toml", "--scenario", "spin", "--frames", "30", "--no-report", "--out", "out", "--link", link,
               "--record", "run.mcap"});
  const Answer flown = run.wait();
  ::usleep(300'000);  // the last packets are on their way
  const Answer seen = monitor.interrupt();
  ASSERT_EQ(flown.exit_code, 0) << flown.err;
  ASSERT_EQ(seen.exit_code, 0) << seen.err;
  EXPECT_NE(seen.out.find("the recording: seen.mcap"), std::string::npos) << seen.out;
  EXPECT_NE(seen.out.find("tracking, "), std::string::npos) << seen.out;
  EXPECT_NE(seen.out.find("packets, 0 missing"), std::string::npos) << seen.out;
  const std::vector<std::string> all = poses_of(work, "run.mcap", "flown"), some = poses_of(work, "seen.mcap", "told");
  ASSERT_GT(some.size(), 6U) << seen.out;
  ASSERT_LE(some.size(), all.size());
  EXPECT_TRUE(std::equal(some.rbegin(), some.rend(), all.rbegin())) << "it came later, and then heard all";
  const Answer info = work.mdat("recording info seen.mcap");
  for (const char* absent : {"/scan", "/truth", "/rays_missed", "/sensor_scans"})
    EXPECT_EQ(info.out.find("  " + std::string(absent) + " "), std::string::npos) << info.out;
  EXPECT_NE(info.out.find("  /pose "), std::string::npos) << info.out;
  const Answer replay = work.mdat("replay seen.mcap");
  EXPECT_EQ(replay.exit_code, 2);
  EXPECT_NE(replay.err.find("seen.mcap: is telemetry of a link, without scans"), std::string::npos) << replay.err;
}

TEST(Monitor, RefusesWhatItCannotWatch) {
  VERIFIES("LASSO-GND-161~2 LASSO-GND-163~1");
  const WorkFolder work;
  const std::string nobody = "tcp://127.0.0.1:" + free_port();
  const Answer gone = work.mdat("monitor " + nobody);
  EXPECT_EQ(gone.exit_code, 2);
  EXPECT_EQ(gone.err, "mdat: " + nobody + ": nobody answers: Connection refused\n");
  work.write("there.mcap", "something");
  const Answer there = work.mdat("monitor udp://127.0.0.1:1 --record there.mcap");
  EXPECT_EQ(there.exit_code, 2);
  EXPECT_NE(there.err.find("--force replaces it"), std::string::npos) << there.err;
  EXPECT_EQ(work.read("there.mcap"), "something");
  const Answer other = work.mdat("monitor udp://127.0.0.1:1 --record there.txt");
  EXPECT_NE(other.err.find("--record there.txt: expected FILE.mcap"), std::string::npos) << other.err;
}

TEST(Monitor, SaysThatNothingComesAndLeavesNoFile) {
  VERIFIES("LASSO-GND-161~2");
  const WorkFolder work;
  const Answer silent = work.mdat("monitor udp://127.0.0.1:" + free_port() + " --seconds 1.2 --record none.mcap --live 127.0.0.1:0");
  EXPECT_EQ(silent.exit_code, 0) << silent.err;
  EXPECT_NE(silent.out.find("nothing has come yet"), std::string::npos) << silent.out;
  EXPECT_NE(silent.out.find("nothing was recorded"), std::string::npos) << silent.out;
  EXPECT_FALSE(std::filesystem::exists(work / "none.mcap"));
}

TEST(Monitor, EndsByCtrlCAndAnAddressInUseIsRefused) {
  VERIFIES("LASSO-GND-161~2");
  const WorkFolder work;
  const std::string address = "udp://127.0.0.1:" + free_port();
  Program first(work, "monitor --listen " + address);
  for (int i = 0; i < 500 && first.printed().empty(); ++i) ::usleep(20'000);
  const Answer second = work.mdat("monitor --listen " + address);
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_NE(second.err.find(address + ": cannot be bound: Address already in use"), std::string::npos) << second.err;
  const Answer ended = first.interrupt();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.out.find("0 packets, 0 missing"), std::string::npos) << ended.out;
}

}  // namespace
}  // namespace lasso::ft
