// Recordings of runs: written, looked into, flown again, cut.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

class Recording : public ::testing::Test {
 protected:
  void record(const std::string& more) {
    work_.write_mission();
    const Answer answer = work_.mdat("run missions/test.toml --no-report --frames 12 --out out/run --record out/run.mcap " + more);
    ASSERT_EQ(answer.exit_code, 0) << answer.err;
    EXPECT_NE(answer.out.find("the recording: out/run.mcap"), std::string::npos) << answer.out;
  }
  WorkFolder work_;
};

// Nothing but the recording is left of the run.
TEST_F(Recording, IsFlownAgainFromItselfAlone) {
  VERIFIES("LASSO-REC-002~1 LASSO-REC-003~1");
  record("--scenario spin --set scan.points=512");
  std::filesystem::remove_all(work_ / "missions");
  std::filesystem::remove_all(work_ / "models");
  const Answer same = work_.mdat("replay out/run.mcap");
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_NE(same.out.find("telemetry: the same as recorded"), std::string::npos) << same.out;
  const Answer changed = work_.mdat("replay out/run.mcap --set estimation.silhouettes=false");
  EXPECT_EQ(changed.exit_code, 0) << changed.err;
  EXPECT_NE(changed.out.find("the first pose that differs: "), std::string::npos) << changed.out;
}

TEST_F(Recording, ChangesNothingOfTheRun) {
  VERIFIES("LASSO-REC-001~1");
  record("--scenario spin");
  const Answer plain = work_.mdat("run missions/test.toml --no-report --frames 12 --out out/plain --scenario spin");
  ASSERT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_EQ(work_.read("out/plain/telemetry.ccsds"), work_.read("out/run/telemetry.ccsds"));
}

TEST_F(Recording, TellsWhatIsInIt) {
  VERIFIES("LASSO-REC-007~1");
  record("--scenario spin");
  const Answer info = work_.mdat("recording info out/run.mcap");
  EXPECT_EQ(info.exit_code, 0) << info.err;
  for (const char* text :
       {"profile ros2", "scenario    spin", "/scan                                12", "mission/test.toml", "image.3dli"})
    EXPECT_NE(info.out.find(text), std::string::npos) << text << "\n" << info.out;
  EXPECT_EQ(info.out.find("damaged"), std::string::npos) << info.out;
}

TEST_F(Recording, ThatIsCutSaysWhere) {
  VERIFIES("LASSO-REC-006~1");
  record("--scenario spin");
  std::filesystem::resize_file(work_ / "out/run.mcap", std::filesystem::file_size(work_ / "out/run.mcap") / 2);
  const Answer info = work_.mdat("recording info out/run.mcap");
  EXPECT_EQ(info.exit_code, 0) << info.err;
  EXPECT_NE(info.out.find("damaged at byte "), std::string::npos) << info.out;
  const Answer replay = work_.mdat("replay out/run.mcap");
  EXPECT_EQ(replay.exit_code, 0) << replay.err;
  EXPECT_NE(replay.err.find("damaged at byte "), std::string::npos) << replay.err;
}

// From its begin on a cut is flown again; from later on nobody knows what the component knew.
TEST_F(Recording, CutFromItsBeginIsFlownAgain) {
  VERIFIES("LASSO-REC-011~1 LASSO-REC-015~1");
  record("--scenario spin");
  ASSERT_EQ(work_.mdat("recording cut out/run.mcap --to 2.5 -o out/cut.mcap").exit_code, 0);
  const Answer replay = work_.mdat("replay out/cut.mcap");
  EXPECT_EQ(replay.exit_code, 0) << replay.err;
  EXPECT_NE(replay.out.find("telemetry: the same as recorded, "), std::string::npos) << replay.out;
  EXPECT_EQ(replay.out.find("as recorded, 0 bytes"), std::string::npos) << replay.out;
  ASSERT_EQ(work_.mdat("recording cut out/run.mcap --from 1.5 -o out/late.mcap").exit_code, 0);
  const Answer late = work_.mdat("replay out/late.mcap");
  EXPECT_EQ(late.exit_code, 2);
  EXPECT_NE(late.err.find("out/late.mcap: begins at 1.5 s of its run"), std::string::npos) << late.err;
}

TEST_F(Recording, ThatIsCutIsRecoveredMergedAndExported) {
  VERIFIES("LASSO-REC-012~1 LASSO-REC-013~1 LASSO-REC-014~1 LASSO-REC-015~1");
  record("--scenario spin");
  EXPECT_EQ(work_.mdat("recording export out/run.mcap --format packets -o out/packets").exit_code, 0);
  EXPECT_EQ(work_.read("out/packets"), work_.read("out/run/telemetry.ccsds"));
  std::filesystem::copy_file(work_ / "out/run.mcap", work_ / "out/part.mcap");
  std::filesystem::resize_file(work_ / "out/part.mcap", std::filesystem::file_size(work_ / "out/part.mcap") - 1000000);
  const Answer recovered = work_.mdat("recording recover out/part.mcap -o out/whole.mcap");
  EXPECT_EQ(recovered.exit_code, 0) << recovered.err;
  EXPECT_NE(recovered.err.find("warning: out/part.mcap: lost at byte "), std::string::npos) << recovered.err;
  const Answer replay = work_.mdat("replay out/whole.mcap");
  EXPECT_EQ(replay.exit_code, 0) << replay.err;
  const Answer merged = work_.mdat("recording merge out/run.mcap out/whole.mcap --prefix all,part -o out/both.mcap");
  EXPECT_EQ(merged.exit_code, 0) << merged.err;
  EXPECT_NE(work_.mdat("recording info out/both.mcap").out.find("/part/"), std::string::npos);
  const Answer again = work_.mdat("replay out/both.mcap");
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.err.find("is two runs in one file"), std::string::npos) << again.err;
  EXPECT_EQ(work_.mdat("recording cut out/run.mcap --to 2 -o out/run.mcap --force").exit_code, 2) << "its own input";
}

// Each is flown again as it flew among the others: with its own noise and its own telemetry.
TEST_F(Recording, OfSeveralRangesIsAFileEach) {
  VERIFIES("LASSO-REC-019~1");
  const std::string twelve = "ranges_m = [4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0]";
  work_.write_mission({{twelve + "\nframes = 60", "ranges_m = [4.0, 3.0, 4.0]\nframes = 60"}});
  const Answer run = work_.mdat("run missions/test.toml --scenario rates --no-report --frames 6 --out out --record run.mcap");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::string telemetry;
  for (const char* name : {"run-4m", "run-3m", "run-4m_2"}) {
    const Answer replay = work_.mdat("replay " + std::string(name) + ".mcap");
    EXPECT_EQ(replay.exit_code, 0) << name << replay.err << replay.out;
    ASSERT_EQ(work_.mdat("recording export " + std::string(name) + ".mcap --format packets -o packets --force").exit_code, 0);
    telemetry += work_.read("packets");
  }
  EXPECT_TRUE(telemetry == work_.read("out/telemetry.ccsds"));
}

TEST_F(Recording, ForReplayIsSmallAndIsFlownAgain) {
  VERIFIES("LASSO-REC-020~1");
  record("--scenario spin");
  const std::size_t all = std::filesystem::file_size(work_ / "out/run.mcap");
  record("--scenario spin --record-for replay --force");
  const std::size_t little = std::filesystem::file_size(work_ / "out/run.mcap");
  EXPECT_LT(little + 12 * 20000, all);
  const Answer replay = work_.mdat("replay out/run.mcap");
  EXPECT_EQ(replay.exit_code, 0) << replay.err;
  EXPECT_NE(replay.out.find("telemetry: the same as recorded"), std::string::npos) << replay.out;
}

// What nobody can mend where it lies: its place in the recording, and what flies it.
TEST_F(Recording, WhoseMissionIsOfAnEarlierVersionSaysWhatFliesIt) {
  VERIFIES("LASSO-REC-002~1 LASSO-GND-003~1");
  record("--scenario spin");
  const std::string mission = work_.read("missions/test.toml");
  std::string older = mission;
  older.replace(older.find("check = false "), 14, "gate = 36.0  #");
  std::string bytes = work_.read("out/run.mcap");
  const std::size_t at = bytes.find(mission);
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, mission.size() + 4, older + std::string(4, '\0'));  // a checksum of 0 is none
  work_.write("older.mcap", bytes);
  for (const char* more : {"", " --mission missions/test.toml"}) {
    const Answer answer = work_.mdat(std::string("replay older.mcap") + more);
    EXPECT_EQ(answer.exit_code, 2) << answer.out;
    EXPECT_NE(answer.err.find("older.mcap: this mdat refuses its mission; that of commit "), std::string::npos) << answer.err;
    EXPECT_NE(answer.err.find("\nolder.mcap: mission/test.toml:40:1: start.gate: is 25 in every mission"), std::string::npos) << answer.err;
  }
}

// The disk takes 600 kB of a file, some ten frames. With the signal ignored, a write beyond them fails as on a full disk.
TEST_F(Recording, ThatTheDiskRefusesEndsTheRun) {
  VERIFIES("LASSO-REC-046~1");
  work_.write_mission();
  const Answer answer = work_.mdat("run missions/test.toml --scenario spin --no-report --frames 40 --out out/run --record out/run.mcap",
                                   "trap '' XFSZ; ulimit -f 1200;");
  EXPECT_EQ(answer.exit_code, 2) << answer.out;
  const std::size_t line = answer.err.find("mdat: out/run.mcap: cannot be written: ");
  ASSERT_NE(line, std::string::npos) << answer.err;
  EXPECT_EQ(answer.err.find('\n', line) + 1, answer.err.size()) << "the last line: " << answer.err;
}

TEST_F(Recording, OfNoRunIsRefused) {
  VERIFIES("LASSO-REC-008~2");
  work_.write_mission();
  const std::vector<std::string> before = work_.contents();
  const Answer text = work_.mdat("replay missions/run.mcap");
  EXPECT_EQ(text.exit_code, 2);
  EXPECT_NE(text.err.find("missions/run.mcap: cannot be read"), std::string::npos) << text.err;
  EXPECT_EQ(work_.contents(), before);
}

TEST_F(Recording, OfAnotherProfileIsRefusedByAllThatReadsOne) {
  VERIFIES("LASSO-REC-008~2");
  record("--scenario spin --record-for replay");
  std::string bytes = work_.read("out/run.mcap");
  ASSERT_NE(bytes.find("ros2"), std::string::npos);
  work_.write("out/other.mcap", bytes.replace(bytes.find("ros2"), 4, "ros1"));
  const std::vector<std::string> before = work_.contents();
  for (const char* command :
       {"replay out/other.mcap", "recording info out/other.mcap", "recording cut out/other.mcap --to 2 -o out/part.mcap",
        "recording recover out/other.mcap -o out/part.mcap", "recording export out/other.mcap --format csv -o out/part",
        "recording merge out/run.mcap out/other.mcap --prefix a,b -o out/part.mcap",
        "replay missions/test.toml --scans out/other.mcap --initial search --out out/part.csv", "serve out/other.mcap"}) {
    const Answer answer = work_.mdat(command);
    EXPECT_EQ(answer.exit_code, 2) << command;
    EXPECT_NE(answer.err.find("out/other.mcap: is an MCAP file of profile 'ros1': expected 'ros2', or none"), std::string::npos)
        << command << answer.err;
    EXPECT_EQ(std::count(answer.err.begin(), answer.err.end(), '\n'), 1) << command << answer.err;
  }
  EXPECT_EQ(work_.contents(), before);
}

}  // namespace
}  // namespace lasso::ft
