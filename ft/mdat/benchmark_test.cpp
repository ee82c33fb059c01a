// A benchmark set from its making to a score, by the command line alone.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "ft/mdat/replay_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

class BenchmarkTest : public ::testing::Test {
 protected:
  // Made and run once; two bodies of few triangles.
  static void SetUpTestSuite() {
    original = std::make_unique<WorkFolder>();
    const Answer made = original->mdat("benchmark make set --seed 52 --bodies 2 --scans 2");
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_NE(made.out.find("4 scans, of which "), std::string::npos) << made.out;
    const Answer run = original->mdat("benchmark run set");
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("poses.csv: written"), std::string::npos) << run.out;
  }
  static void TearDownTestSuite() { original.reset(); }

  void SetUp() override {
    std::filesystem::copy(*original / "set", work / "set", std::filesystem::copy_options::recursive);
    std::filesystem::copy(*original / "poses.csv", work / "poses.csv");
  }

  void expect_refused(const std::string& arguments, const std::string& why) const {
    const auto before = work.contents();
    const Answer answer = work.mdat("benchmark " + arguments);
    EXPECT_EQ(answer.exit_code, 2) << arguments;
    EXPECT_EQ(lines_of(answer.err).size(), 1u) << answer.err;
    EXPECT_NE(answer.err.find(why), std::string::npos) << answer.err;
    EXPECT_EQ(work.contents(), before) << arguments;
  }

  WorkFolder work;
  static inline std::unique_ptr<WorkFolder> original;
};

TEST_F(BenchmarkTest, ASetIsMadeRunAndScored) {
  VERIFIES("LASSO-GND-120~1");
  VERIFIES("LASSO-GND-122~1");
  const Json protocol = Json::parse(work.read("set/protocol.json"));
  ASSERT_EQ(protocol.at("targets").size(), 2u);
  for (const Json& body : protocol.at("targets")) {
    for (const char* file : {"mesh", "mission", "starts", "scans"})
      EXPECT_TRUE(std::filesystem::exists(work / ("set/" + body.at(file).get<std::string>()))) << file;
  }
  const Answer scored = work.mdat("benchmark score set poses.csv --json s.json --csv s.csv");
  ASSERT_EQ(scored.exit_code, 0) << scored.err;
  EXPECT_NE(scored.out.find("benchmark of 2 bodies from seed 52 on, 2 scans each"), std::string::npos) << scored.out;
  const Json mine = Json::parse(work.read("s.json")).at("programs").at(0);
  EXPECT_EQ(mine.at("name"), "poses");
  EXPECT_EQ(mine.at("scans"), 4);
  EXPECT_EQ(mine.at("wrong").at("count"), 0);
  EXPECT_EQ(mine.at("right").at("count"), mine.at("determined")) << scored.out;
  EXPECT_GT(mine.at("determined"), 0);
  EXPECT_GT(mine.at("nees").at("median"), 0);
  EXPECT_GT(mine.at("time").at("median_s"), 0);
  EXPECT_EQ(table(work.read("s.csv")).size(), 4u);
}

TEST_F(BenchmarkTest, RunFindsWhatReplayFinds) {
  VERIFIES("LASSO-GND-124~1");
  const std::vector<Row> run = table(work.read("poses.csv"));
  ASSERT_EQ(run.size(), 4u);
  const Answer answer =
      work.mdat("replay set/body_53/mission.toml --scans set/body_53/scans --initial set/body_53/starts.csv --wide --out replayed.csv");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const std::vector<Row> replayed = table(work.read("replayed.csv"));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(run[2 + i].at("body"), "body_53");
    EXPECT_EQ(run[2 + i].at("scan"), replayed[i].at("scan"));
    EXPECT_EQ(run[2 + i].at("valid"), replayed[i].at("valid"));
    if (replayed[i].at("valid") == "0") continue;
    EXPECT_LT(distance_m(run[2 + i], replayed[i]), 1e-7);
    EXPECT_LT(angle_rad(run[2 + i], replayed[i]), 1e-5);
    EXPECT_NEAR(std::sqrt(value(run[2 + i], "cov_z_z")), value(replayed[i], "sigma_z_m"), 1e-5 * value(replayed[i], "sigma_z_m"));
  }
}

// A program that takes the starts for the poses, in the fewest columns: far off, and each is wrong.
TEST_F(BenchmarkTest, AnyProgramsTableIsScored) {
  VERIFIES("LASSO-GND-122~1");
  std::string text = "body,scan,qx,qy,qz,qw,x,y,z\n";
  for (const std::string body : {"body_52", "body_53"}) {
    const std::vector<std::string> lines = lines_of(work.read("set/" + body + "/starts.csv"));
    for (std::size_t i = 1; i < lines.size(); ++i) text += body + "," + lines[i] + "\n";
  }
  work.write("lazy.csv", text);
  work.write("few.csv", text.substr(0, text.find("body_53")));
  const Answer scored = work.mdat("benchmark score set lazy.csv few.csv poses.csv --json s.json");
  ASSERT_EQ(scored.exit_code, 0) << scored.err;
  EXPECT_NE(scored.out.find("no covariance: lazy, few"), std::string::npos) << scored.out;
  EXPECT_NE(scored.out.find("few: 2 scans without a row: refused"), std::string::npos) << scored.out;
  const Json programs = Json::parse(work.read("s.json")).at("programs");
  EXPECT_EQ(programs.at(0).at("wrong").at("count"), 4);
  EXPECT_EQ(programs.at(1).at("wrong").at("count"), 2);
  EXPECT_TRUE(programs.at(0).at("nees").at("median").is_null());
  EXPECT_EQ(programs.at(2).at("wrong").at("count"), 0);
}

TEST_F(BenchmarkTest, AChangedSetIsRefusedAndTheFileNamed) {
  VERIFIES("LASSO-GND-121~1");
  std::ofstream((work / "set/body_53/scans/s02.csv").string(), std::ios::app) << "9,1,1,5,1\n";
  expect_refused("score set poses.csv", "set/body_53/scans/s02.csv: was changed after the set was made");
  expect_refused("run set --force", "set/body_53/scans/s02.csv: was changed after the set was made");
  std::filesystem::remove(work / "set/body_53/scans/s02.csv");
  expect_refused("score set poses.csv", "set/body_53/scans/s02.csv: ");
  std::filesystem::remove(work / "set/protocol.json");
  expect_refused("score set poses.csv", "set/protocol.json: there is none; mdat benchmark make set makes a set");
}

TEST_F(BenchmarkTest, BadTablesAreRefused) {
  VERIFIES("LASSO-GND-123~1");
  const std::string header = "body,scan,qx,qy,qz,qw,x_m,y_m,z_m\n";
  const std::pair<const char*, const char*> cases[] = {
      {"body_51,s01,0,0,0,1,0,0,3\n", "bad.csv:2:1: body: the set has no 'body_51'; did you mean body_52?"},
      {"body_52,s09,0,0,0,1,0,0,3\n", "bad.csv:2:9: scan: the set has no 's09', it has s01 to s02"},
      {"body_52,s01,0,0,0,1,0,0,3\nbody_52,s01,0,0,0,1,0,0,3\n", "bad.csv:3:9: scan: 's01' of body_52 has a row already"},
      {"body_52,s01,0,0,0,2,0,0,3\n", "bad.csv:2:13: qx,qy,qz,qw: length 2.000000"},
      {"body_52,s01,0,0,0,1,0,nan,3\n", "bad.csv:2:23: y_m"},
      {"", "bad.csv:1: no row follows the header"}};
  for (const auto& [rows, why] : cases) {
    work.write("bad.csv", header + rows);
    expect_refused("score set poses.csv bad.csv --json s.json", why);
  }
}

TEST_F(BenchmarkTest, WrongUseIsRefusedAndNothingIsReplacedUnasked) {
  VERIFIES("LASSO-GND-120~1");
  VERIFIES("LASSO-GND-123~1");
  expect_refused("make set --bodies 1", "set: is there already; a set needs a new folder");
  expect_refused("run set", "poses.csv: is there since");
  expect_refused("score set poses.csv --csv poses.csv", "poses.csv: is there since");
  expect_refused("score set poses.csv set/../poses.csv", "set/../poses.csv: a table of the name poses is given already");
  expect_refused("score set none.csv", "none.csv: no such file");
  expect_refused("run nowhere --force", "nowhere/protocol.json: there is none");
  for (const char* wrong : {"", "make", "make other --sensor sonar", "make other --start 0", "make other --bodies 0", "score set"})
    expect_refused(wrong, "mdat --help");
}

}  // namespace
}  // namespace lasso::ft
