// In which order recorded scans are taken, and in which unit their times: found out where it can be, and told where it is odd.
#include <cstdio>

#include "ft/mdat/replay_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

using ReplayOrder = ReplayTest;

// The same scans, named 1 to 12 without zeros before them: s10 comes after s9.
TEST_F(ReplayOrder, TakesFilesInNaturalOrder) {
  VERIFIES("LASSO-SIM-019~2");
  const std::vector<Row> truth = table(work.read("rec/4m/truth.csv"));
  for (std::size_t i = 0; i < kReplayed; ++i) {
    work.write("named/s" + std::to_string(i + 5) + ".csv", work.read("rec/4m/scans/" + truth[i].at("scan") + ".csv"));
  }
  const Answer answer = work.mdat("replay --force image.3dli --scans named --initial rec/4m/poses.csv --closed-loop -o out.csv");
  EXPECT_EQ(answer.err.find("step back"), std::string::npos) << answer.err;
  const std::vector<Row> rows = table(work.read("out.csv"));
  ASSERT_EQ(rows.size(), kReplayed);
  for (std::size_t i = 0; i < kReplayed; ++i) {
    EXPECT_EQ(rows[i].at("scan"), "s" + std::to_string(i + 5));
    EXPECT_EQ(rows[i].at("valid"), "1") << rows[i].at("reason");
    EXPECT_LT(distance_m(rows[i], truth[i]), 1e-3);
  }
}

TEST_F(ReplayOrder, WarnsOfTimesThatStepBack) {
  VERIFIES("LASSO-MDT-070~1");
  std::filesystem::rename(work / "rec/4m/scans/f00002.csv", work / "rec/4m/scans/z.csv");
  std::string poses = work.read("rec/4m/poses.csv");
  poses.replace(poses.find("f00002"), 6, "z");
  work.write("rec/4m/poses.csv", poses);
  const Answer answer = work.mdat("replay --force image.3dli --scans rec/4m/scans --initial rec/4m/poses.csv -o out.csv");
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_NE(answer.err.find("warning: times step back at 1 of 8 scans, first at z,"), std::string::npos) << answer.err;
  EXPECT_NE(answer.out.find("8 of 8 scans gave a valid pose"), std::string::npos) << answer.out;
}

// The names in the order of time reversed: neither a few steps back, nor times that begin anew with each scan.
TEST_F(ReplayOrder, WarnsOfASeriesThatIsReversed) {
  VERIFIES("LASSO-MDT-070~1");
  for (std::size_t i = 0; i < kReplayed; ++i) {
    const std::string number = std::to_string(i), last = std::to_string(kReplayed - 1 - i);
    work.write("back/f0000" + last + ".csv", work.read("rec/4m/scans/f0000" + number + ".csv"));
  }
  const Answer answer = work.mdat("replay image.3dli --scans back --initial rec/4m/poses.csv -o out.csv");
  EXPECT_NE(answer.err.find("warning: each scan ends before the one before it begins (f00001: "), std::string::npos) << answer.err;
  EXPECT_NE(answer.err.find("time reversed"), std::string::npos) << answer.err;
  EXPECT_EQ(answer.err.find("began anew"), std::string::npos) << answer.err;
}

// A scan with its times in another unit; all else as it was.
std::string with_times(const std::string& csv, double units_per_second) {
  const std::vector<std::string> lines = lines_of(csv);
  std::string text = lines[0] + "\n";
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::size_t comma = lines[i].find(',');
    char time[40];
    std::snprintf(time, sizeof time, "%.0f", std::stod(lines[i].substr(0, comma)) * units_per_second);
    text += time + lines[i].substr(comma) + "\n";
  }
  return text;
}

TEST_F(ReplayOrder, KnowsUnitsOfTimeByAScansSpan) {
  VERIFIES("LASSO-MDT-070~1");
  const std::vector<Row> seconds = replay("image.3dli", "rec/4m/scans", "--closed-loop");
  for (const auto& [per_second, name] : {std::pair(1e6, "microseconds"), std::pair(1e9, "nanoseconds")}) {
    for (const Row& row : seconds)
      work.write("other/" + row.at("scan") + ".csv", with_times(work.read("rec/4m/scans/" + row.at("scan") + ".csv"), per_second));
    const Answer answer = work.mdat("replay --force image.3dli --scans other --initial rec/4m/poses.csv --closed-loop -o other.csv");
    EXPECT_NE(answer.err.find(std::string("taken as ") + name), std::string::npos) << answer.err;
    const std::vector<Row> rows = table(work.read("other.csv"));
    ASSERT_EQ(rows.size(), seconds.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_EQ(rows[i].at("t_s"), seconds[i].at("t_s"));
      EXPECT_LT(distance_m(rows[i], seconds[i]), 1e-8);
    }
  }
}

TEST_F(ReplayOrder, WarnsOfAScanWhoseTimesAreInAnotherUnit) {
  VERIFIES("LASSO-MDT-070~1");
  work.write("rec/4m/scans/f00003.csv", with_times(work.read("rec/4m/scans/f00003.csv"), 1e6));
  const Answer answer = work.mdat("replay image.3dli --scans rec/4m/scans --initial rec/4m/poses.csv -o out.csv");
  EXPECT_NE(answer.err.find("warning: the times of 1 of 8 scans seem to be in another unit than the others': f00003 spans "),
            std::string::npos)
      << answer.err;
  EXPECT_NE(answer.err.find("about 1e+06 times their "), std::string::npos) << answer.err;
  EXPECT_EQ(answer.err.find("replay: "), std::string::npos) << "no lines of progress of so short a replay: " << answer.err;
}

TEST_F(ReplayOrder, TakesTheUnitOfTimeThatIsAskedFor) {
  VERIFIES("LASSO-MDT-070~1");
  const Answer answer = work.mdat("replay --force image.3dli --scans rec/4m/scans --initial rec/4m/poses.csv --time-unit ms -o out.csv");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  const double given_s = value(table(work.read("out.csv")).at(3), "t_s");
  EXPECT_NEAR(given_s, 1e-3 * value(replay("image.3dli", "rec/4m/scans", "").at(3), "t_s"), 1e-6);
}

}  // namespace
}  // namespace lasso::ft
