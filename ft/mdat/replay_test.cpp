// Scans that the simulator wrote, registered again from their files.
#include <array>

#include "ft/mdat/replay_fixture.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

using Replay = ReplayTest;

TEST_F(Replay, RegistersEachScanFromItsPose) {
  VERIFIES("LASSO-MDT-006~1");
  const std::vector<Row> rows = replay("image.3dli", "rec/4m/scans", "");
  expect_near_truth(rows, 1e-3, 0.002);
  EXPECT_NEAR(value(rows[3], "t_s") - value(rows[2], "t_s"), 0.2, 1e-6) << "the middle of each scan";
}

TEST_F(Replay, AcceptsAMissionAsWellAsItsImage) {
  VERIFIES("LASSO-MDT-006~1");
  const std::vector<Row> image = replay("image.3dli", "rec/4m/scans", "");
  const std::vector<Row> mission = replay("missions/test.toml", "rec/4m/scans", "--scenario dropouts");
  ASSERT_EQ(image.size(), mission.size());
  for (std::size_t i = 0; i < image.size(); ++i) EXPECT_EQ(image[i].at("qx"), mission[i].at("qx"));
}

TEST_F(Replay, TheShippedMissionsImageIsSmallEnoughForAnUpload) {
  VERIFIES("LASSO-MDL-018~1");
  EXPECT_LE(work.read("image.3dli").size(), 8'000'000U);
}

TEST_F(Replay, TracksInClosedLoopFromTheFirstRowAlone) {
  VERIFIES("LASSO-MDT-006~1 LASSO-NEED-012~1");
  const std::vector<std::string> lines = lines_of(work.read("rec/4m/poses.csv"));
  std::string other = lines.at(1);
  other.replace(0, other.find(','), "start");  // not the name of a scan
  work.write("rec/4m/poses.csv", lines.at(0) + "\n" + other + "\n");
  expect_near_truth(replay("image.3dli", "rec/4m/scans", "--closed-loop"), 1e-3, 0.002);
}

// The truth turned about a random axis of the target, and off by up to 80 mm along each of the sensor's.
std::string rough_start(const Row& truth, double turn_rad, test::Generator& random) {
  std::array<double, 3> axis{random.normal(), random.normal(), random.normal()};
  const double length = std::hypot(axis[0], axis[1], axis[2]);
  const double c = std::cos(0.5 * turn_rad), s = std::sin(0.5 * turn_rad) / length;
  const std::array<double, 4> q{value(truth, "qx"), value(truth, "qy"), value(truth, "qz"), value(truth, "qw")};
  const std::array<double, 3> v{s * axis[0], s * axis[1], s * axis[2]};
  std::string row = truth.at("scan");
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    row += "," + std::to_string(q[3] * v[i] + c * q[i] + q[j] * v[k] - q[k] * v[j]);
  }
  row += "," + std::to_string(q[3] * c - q[0] * v[0] - q[1] * v[1] - q[2] * v[2]);
  for (const char* name : {"x_m", "y_m", "z_m"}) row += "," + std::to_string(value(truth, name) + random.uniform(-0.08, 0.08));
  return row + "\n";
}

std::string rough_starts(const std::string& truth, double turn_rad) {
  test::Generator random(34);
  std::string starts = "scan,qx,qy,qz,qw,x_m,y_m,z_m\n";
  for (const Row& row : table(truth)) starts += rough_start(row, turn_rad, random);
  return starts;
}

constexpr const char* kChecked[] = {"--scenario dropouts --set start.check=true", "--scenario dropouts --set start.check=true --wide"};

// Near enough for another minimum to explain the scan nearly as well.
TEST_F(Replay, RoughStartsEndAtTheRightPose) {
  VERIFIES("LASSO-MDT-078~1");
  work.write("rec/4m/poses.csv", rough_starts(work.read("rec/4m/truth.csv"), 0.17));
  for (const char* options : kChecked) expect_near_truth(replay("missions/test.toml", "rec/4m/scans", options), 1e-3, 0.002);
}

// Twice as far off as a rough start may be, and more: whatever explains the scan there is not what the start meant.
TEST_F(Replay, AStartThatIsFartherOffThanARoughOneGivesNoValidPose) {
  VERIFIES("LASSO-MDT-078~1");
  for (const double turn_rad : {0.75, 2.0}) {
    work.write("rec/4m/poses.csv", rough_starts(work.read("rec/4m/truth.csv"), turn_rad));
    for (const char* options : kChecked) {
      for (const Row& row : replay("missions/test.toml", "rec/4m/scans", options)) EXPECT_EQ(row.at("valid"), "0") << row.at("scan");
    }
  }
}

// The points of a scan's hits as a PLY file: no times, no misses.
std::string to_ply(const std::string& csv) {
  std::string points;
  std::size_t count = 0;
  for (const Row& row : table(csv)) {
    if (row.at("valid") != "1") continue;
    points += row.at("x_m") + " " + row.at("y_m") + " " + row.at("z_m") + "\n";
    ++count;
  }
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) +
         "\nproperty float x\nproperty float y\nproperty float z\nend_header\n" + points;
}

TEST_F(Replay, RegistersPointClouds) {
  VERIFIES("LASSO-MDT-006~1");
  for (const Row& row : table(work.read("rec/4m/truth.csv"))) {
    work.write("clouds/" + row.at("scan") + ".ply", to_ply(work.read("rec/4m/scans/" + row.at("scan") + ".csv")));
  }
  expect_near_truth(replay("image.3dli", "clouds", ""), 1.5e-3, 0.003);
}

TEST_F(Replay, FindsEachScansPoseWithoutAnyOrSaysWhyNot) {
  VERIFIES("LASSO-MOD-111~1 LASSO-GND-025~1");
  work.write("rec/4m/scans/f00009.csv", "t_s,x_m,y_m,z_m,valid\n9,0,0,1,0\n9.1,0,0,1,0\n");  // two misses
  const Answer answer = work.mdat("replay image.3dli --scans rec/4m/scans --initial search --out found.csv");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_NE(answer.out.find("9 scans"), std::string::npos) << answer.out;
  const std::vector<Row> rows = table(work.read("found.csv"));
  const std::vector<Row> truth = table(work.read("rec/4m/truth.csv"));
  ASSERT_EQ(rows.size(), kReplayed + 1);
  std::size_t accepted = 0;
  for (std::size_t i = 0; i < kReplayed; ++i) {
    EXPECT_EQ(rows[i].at("scan"), truth[i].at("scan"));
    if (rows[i].at("outcome") != "accepted") continue;
    ++accepted;
    EXPECT_NE(rows[i].at("why").find("scores "), std::string::npos) << rows[i].at("why");
    EXPECT_NEAR(std::stod(rows[i].at("why").substr(rows[i].at("why").find("scores ") + 7)), value(rows[i], "ratio"), 0.006);
    EXPECT_EQ(rows[i].at("reason"), "distinct");
    EXPECT_LT(distance_m(rows[i], truth[i]), 0.02);
    EXPECT_LT(angle_rad(rows[i], truth[i]), 2 * 0.0174533);
    EXPECT_GE(value(rows[i], "ratio"), 1.3);
  }
  EXPECT_GE(accepted, kReplayed - 1);
  EXPECT_EQ(rows[kReplayed].at("outcome"), "rejected");
  EXPECT_EQ(rows[kReplayed].at("reason"), "no data") << "by the name of the status";
  EXPECT_EQ(rows[kReplayed].at("candidates"), "0");
  const std::vector<Row> candidates = table(work.read("found_candidates.csv"));
  std::size_t next = 0;
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < std::stoul(row.at("candidates")); ++i, ++next) {
      ASSERT_LT(next, candidates.size());
      EXPECT_EQ(candidates[next].at("scan"), row.at("scan"));
      EXPECT_EQ(candidates[next].at("candidate"), std::to_string(i + 1));
      EXPECT_LT(value(candidates[next], "disagreement"), 1);
      if (i > 0 || row.at("outcome") != "accepted") continue;
      EXPECT_LT(distance_m(candidates[next], row), 1e-9) << "the best one is the pose";
      EXPECT_LT(angle_rad(candidates[next], row), 1e-5);
    }
  }
  EXPECT_EQ(next, candidates.size());
  EXPECT_GE(next, accepted);
}

TEST_F(Replay, ASearchSaysThatThereWereTooFewReturns) {
  VERIFIES("LASSO-MOD-111~1 LASSO-MOD-122~2");
  std::string scan = "t_s,x_m,y_m,z_m,valid\n";
  for (int i = 0; i < 60; ++i)
    scan += std::to_string(0.003 * i) + (i < 57 ? ",0,0,1,0\n" : ",0.1,0.02," + std::to_string(3.9 + 0.001 * i) + ",1\n");
  work.write("few/f00000.csv", scan);
  const Answer answer = work.mdat("replay image.3dli --scans few --initial search --out found.csv");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const std::vector<Row> rows = table(work.read("found.csv"));
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].at("outcome"), "rejected");
  EXPECT_EQ(rows[0].at("reason"), "too_few_returns");
}

TEST_F(Replay, ASearchIsOfEachScanAlone) {
  VERIFIES("LASSO-MOD-111~1");
  const Answer answer = work.mdat("replay image.3dli --scans rec/4m/scans --initial search --closed-loop --out found.csv");
  EXPECT_NE(answer.exit_code, 0);
  EXPECT_NE(answer.err.find("--closed-loop"), std::string::npos) << answer.err;
}

TEST_F(Replay, SaysWhyAScanHasNoValidPose) {
  VERIFIES("LASSO-MDT-006~1");
  std::string scan = "t_s,x_m,y_m,z_m,valid\n";
  for (int i = 0; i < 200; ++i) scan += std::to_string(0.001 * i) + ",0,0,1,0\n";  // every ray missed
  work.write("dark/f00000.csv", scan);
  const std::vector<Row> rows = replay("image.3dli", "dark", "");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].at("valid"), "0");
  EXPECT_NE(rows[0].at("reason").find("returns"), std::string::npos) << rows[0].at("reason");
}

}  // namespace
}  // namespace lasso::ft
