// Models that are compiled once, kept, and used again; and what is refused before anything is compiled.
#include <gtest/gtest.h>
#include <sched.h>

#include <cstdlib>
#include <filesystem>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

// An empty cache for the programs of one test; afterwards it is that of before.
class EmptyCache {
 public:
  explicit EmptyCache(const std::filesystem::path& folder) : folder_(folder) {
    const char* before = std::getenv("MDAT_CACHE");
    if (before != nullptr) before_ = before;
    setenv("MDAT_CACHE", folder.c_str(), 1);
  }
  ~EmptyCache() { before_.empty() ? unsetenv("MDAT_CACHE") : setenv("MDAT_CACHE", before_.c_str(), 1); }
  EmptyCache(const EmptyCache&) = delete;
  EmptyCache& operator=(const EmptyCache&) = delete;

  std::vector<std::filesystem::path> entries() const {
    std::vector<std::filesystem::path> files;
    if (!std::filesystem::exists(folder_)) return files;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) files.push_back(entry.path());
    return files;
  }

 private:
  std::filesystem::path folder_;
  std::string before_;
};

class Cached : public ::testing::Test {
 protected:
  Cached() : cache(work / "cache") { work.write_mission({{"cell_size_m = 0.012", "cell_size_m = 0.05"}}); }
  // What mission compile says.
  std::string compile(const std::string& image, const std::string& options = "") const {
    const Answer answer = work.mdat("mission compile missions/test.toml -o " + image + " " + options);
    EXPECT_EQ(answer.exit_code, 0) << answer.err;
    return answer.out;
  }
  WorkFolder work;
  EmptyCache cache;
};

const std::string kFound = "1 of 1 models came from the cache, ";

TEST_F(Cached, ASecondCompilationGivesTheSameAndSaysWhereFrom) {
  VERIFIES("LASSO-MDT-012~1 LASSO-MDT-013~1");
  const std::string first = compile("image.3dli"), image = work.read("image.3dli");
  ASSERT_FALSE(image.empty());
  EXPECT_EQ(first.find(kFound), std::string::npos) << first;
  const std::string second = compile("image.3dli");
  EXPECT_TRUE(work.read("image.3dli") == image);
  EXPECT_EQ(second, first + "the file that was there is replaced\n" + kFound + (work / "cache").string() +
                        ", with what was said of them then; --no-cache compiles them anew\n");
  ASSERT_EQ(cache.entries().size(), 1U);
  std::filesystem::resize_file(cache.entries().front(), std::filesystem::file_size(cache.entries().front()) / 2);
  EXPECT_EQ(compile("image.3dli").find(kFound), std::string::npos) << "half an entry is none";
  EXPECT_TRUE(work.read("image.3dli") == image);
  EXPECT_NE(compile("image.3dli").find(kFound), std::string::npos);
}

// The first processor on which this process may run, for taskset.
std::string first_processor() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  sched_getaffinity(0, sizeof(allowed), &allowed);
  std::size_t first = 0;
  while (first < CPU_SETSIZE - 1 && !CPU_ISSET(first, &allowed)) ++first;
  return std::to_string(first);
}

// Threads share the work of a compilation; the one on a single processor takes it in another order.
TEST_F(Cached, TwoProcessesGiveTheSameImageOnHoweverManyProcessors) {
  VERIFIES("LASSO-MDL-006~2");
  const std::string compile_to = "mission compile missions/test.toml --no-cache -o ";
  const Answer all = work.mdat(compile_to + "all.3dli");
  ASSERT_EQ(all.exit_code, 0) << all.err;
  const Answer one = work.mdat(compile_to + "one.3dli", "taskset -c " + first_processor());
  ASSERT_EQ(one.exit_code, 0) << one.err;
  EXPECT_TRUE(work.read("one.3dli") == work.read("all.3dli"));
  EXPECT_GT(work.read("all.3dli").size(), 10000U);
  EXPECT_TRUE(cache.entries().empty());
}

TEST_F(Cached, ARunIsThatOfACompilation) {
  VERIFIES("LASSO-MDT-012~1 LASSO-MDT-014~1");
  const std::string run = "run missions/test.toml --scenario spin --frames 5 --no-report --out ";
  ASSERT_EQ(work.mdat(run + "fresh --no-cache").exit_code, 0);
  EXPECT_TRUE(cache.entries().empty()) << "left alone";
  const Answer kept = work.mdat(run + "kept"), again = work.mdat(run + "again");
  ASSERT_EQ(kept.exit_code, 0) << kept.err;
  EXPECT_EQ(cache.entries().size(), 1U);
  EXPECT_EQ(again.err.find("cache"), std::string::npos) << "quiet where nothing is said of compiling";
  EXPECT_TRUE(work.read("kept/telemetry.ccsds") == work.read("fresh/telemetry.ccsds"));
  EXPECT_TRUE(work.read("again/telemetry.ccsds") == work.read("fresh/telemetry.ccsds"));
}

TEST_F(Cached, TwoProcessesAtOnceKeepOneEntry) {
  VERIFIES("LASSO-MDT-013~1");
  const std::string compile_to = "'" + mdat_program() + "' mission compile missions/test.toml -o ";
  const Answer both = work.mdat("--version; " + compile_to + "one.3dli & " + compile_to + "other.3dli; other=$?; wait $! && exit $other");
  ASSERT_EQ(both.exit_code, 0) << both.err;
  EXPECT_FALSE(work.read("one.3dli").empty());
  EXPECT_TRUE(work.read("one.3dli") == work.read("other.3dli"));
  EXPECT_EQ(cache.entries().size(), 1U);
  EXPECT_NE(compile("one.3dli").find(kFound), std::string::npos);
}

TEST_F(Cached, AFolderThatCannotBeWrittenFailsNothing) {
  VERIFIES("LASSO-MDT-014~1");
  const EmptyCache nowhere("/proc/mdat");  // nobody may write there, not even root
  const Answer answer = work.mdat("run missions/test.toml --scenario spin --frames 2 --no-report --out run");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  const std::size_t place = answer.err.find("warning: the compiled model is not kept: /proc/mdat: cannot be written: ");
  ASSERT_NE(place, std::string::npos) << answer.err;
  EXPECT_EQ(answer.err.find("warning", place + 1), std::string::npos) << answer.err;
}

// A command keeps the model that it compiles: that none is kept shows that none was compiled.
TEST_F(Cached, WhatIsWrongIsSaidBeforeAnythingIsCompiled) {
  VERIFIES("LASSO-MDT-015~1");
  const std::string scan = "t_s,x_m,y_m,z_m,valid\n0.0,0.01,0.02,4.0,1\n", poses = "scan,qx,qy,qz,qw,x_m,y_m,z_m\n";
  work.write("scans/a.csv", scan);
  work.write("scans/b.csv", scan + "0.1,0.2\n");
  work.write("good/a.csv", scan);
  work.write("poses.csv", poses + "a,0,0,0,1,0,0,4\nb,0,0,0,1,0,0,4\n");
  work.write("other.csv", poses + "other,0,0,0,1,0,0,4\n");
  const std::string run = "run missions/test.toml --no-report ", spin = run + "--scenario spin ",
                    replay = "replay missions/test.toml --out o.csv ";
  const std::pair<std::string, const char*> cases[] = {
      {run + "--scenario nowhere", "nowhere"},
      {run + "--scenario nowhere --record rec.mcap", "nowhere"},
      {run + "--record rec", "--record rec: expected FILE.mcap"},
      {run + "--sensor lcs-wire:unix:none", "choose a scenario of one range"},
      {spin + "--sensor lidar-wire", "none of the mission's sensors is a LIDAR"},
      {spin + "--sensor lcs-wire:./none", "--sensor lcs-wire: ./none: not there"},
      {spin + "--sensor tridar-wire:unix:none", "--sensor tridar-wire: unix:none: not there"},
      {spin + "--sensor lcs-wire:tcp://192.0.2.1:9", "--remote"},
      {spin + "--link smoke://signals", "--link smoke://signals"},
      {spin + "--link udp://:0 --key none.key", "none.key"},
      {"mission compile missions/test.toml -o i.3dli --scenario nowhere", "nowhere"},
      {replay + "--scans scans --initial none.csv", "none.csv"},
      {replay + "--scans none --initial poses.csv", "none"},
      {replay + "--scans good --initial other.csv", "no row for the scan 'a'"},
      {replay + "--scans scans --initial poses.csv", "b.csv:3"},
      {replay + "--scans scans --initial search", "b.csv:3"},
      {replay + "--scans good --initial poses.csv --scenario nowhere", "nowhere"},
      {"lcs-sim missions/test.toml --scenario nowhere", "nowhere"},
      {"lcs-sim missions/test.toml --camera-optics none.toml", "none.toml"},
      {"upload missions/test.toml --to tcp://127.0.0.1:1", "nobody answers"},
      {"upload missions/test.toml --to udp://127.0.0.1:1 --key none.key", "none.key"},
  };
  for (const auto& [command, why] : cases) {
    const Answer answer = work.mdat(command);
    EXPECT_EQ(answer.exit_code, std::string(why) == "nobody answers" ? 1 : 2) << command << "\n" << answer.err;
    EXPECT_EQ(lines_of(answer.err).size(), 1U) << command << "\n" << answer.err;
    EXPECT_NE(answer.err.find(why), std::string::npos) << command << "\n" << answer.err;
    EXPECT_TRUE(cache.entries().empty()) << command;
  }
}

TEST_F(Cached, EachCommandThatCompilesCanDoWithout) {
  VERIFIES("LASSO-MDT-008~1 LASSO-MDT-014~1");
  for (const char* command : {"mission compile", "run", "replay", "lcs-sim", "upload"}) {
    const Answer answer = work.mdat(std::string(command) + " --help");
    EXPECT_NE(answer.out.find("--no-cache"), std::string::npos) << command;
  }
}

}  // namespace
}  // namespace lasso::ft
