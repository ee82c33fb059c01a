// A run that viewers watch while it flies. What they hear, make live asks the client of others (ft/live).
#include <gtest/gtest.h>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

TEST(LiveRun, IsTheSameRunToTheByte) {
  VERIFIES("LASSO-REC-040~1");
  const WorkFolder work;
  work.write_mission();
  const std::string run = "run missions/test.toml --scenario spin --frames 6 --no-report ";
  ASSERT_EQ(work.mdat(run + "--out alone").exit_code, 0);
  const Answer answer = work.mdat(run + "--out watched --live 127.0.0.1:0 --pace 0");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_EQ(answer.out.rfind("live: ws://127.0.0.1:", 0), 0U) << answer.out;
  EXPECT_EQ(answer.out.find("the recording:"), std::string::npos) << answer.out;
  EXPECT_EQ(work.read("alone/telemetry.ccsds"), work.read("watched/telemetry.ccsds"));
}

TEST(LiveRun, IsRecordedAsWell) {
  VERIFIES("LASSO-REC-040~1");
  const WorkFolder work;
  work.write_mission();
  const Answer answer =
      work.mdat("run missions/test.toml --scenario spin --frames 4 --no-report --out run --live 0 --pace 0 --record run.mcap");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_EQ(work.mdat("replay run.mcap").exit_code, 0);
}

TEST(LiveReplay, IsTheRecordedRun) {
  VERIFIES("LASSO-REC-043~1");
  const WorkFolder work;
  work.write_mission();
  ASSERT_EQ(work.mdat("run missions/test.toml --scenario spin --frames 4 --no-report --out run --record run.mcap").exit_code, 0);
  const Answer answer = work.mdat("replay run.mcap --live 127.0.0.1:0 --pace 0 --set estimation.silhouettes=false --record changed.mcap");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_EQ(answer.out.rfind("live: ws://127.0.0.1:", 0), 0U) << answer.out;
  const Answer same = work.mdat("replay changed.mcap --live 0 --pace 0");
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_NE(same.out.find("telemetry: the same as recorded"), std::string::npos) << same.out;
  const Answer scans = work.mdat("replay missions/test.toml --scans . --live 0");
  EXPECT_EQ(scans.exit_code, 2);
  EXPECT_NE(scans.err.find("--live: is for a recording of a run (.mcap) alone"), std::string::npos) << scans.err;
}

TEST(LiveRun, RefusesWhatItCannotTell) {
  VERIFIES("LASSO-REC-041~1");
  const WorkFolder work;
  work.write_mission();
  const Answer several = work.mdat("run missions/test.toml --frames 4 --no-report --out run --live 0");
  EXPECT_EQ(several.exit_code, 2);
  EXPECT_NE(several.err.find("--live: tells one run, and the scenario paper has several"), std::string::npos) << several.err;
  const Answer address = work.mdat("run missions/test.toml --scenario spin --frames 4 --no-report --out run --live here:there");
  EXPECT_EQ(address.exit_code, 2);
  EXPECT_NE(address.err.find("--live here:there: expected HOST:PORT"), std::string::npos) << address.err;
  EXPECT_FALSE(std::filesystem::exists(work / "run")) << "nothing is left behind";
}

}  // namespace
}  // namespace lasso::ft
