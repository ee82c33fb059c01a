// Scans that the simulator wrote, registered again from their files.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

constexpr char kHeader[] =
    "scan,qx,qy,qz,qw,x_m,y_m,z_m,t_s,valid,reason,iterations,inliers,rms_m,sigma_x_m,sigma_y_m,sigma_z_m,sigma_rx_rad,sigma_ry_rad,"
    "sigma_rz_rad,estimate_us";
constexpr std::size_t kReplayed = 8;

using Row = std::map<std::string, std::string>;

// Rows of a CSV file by the names in its header.
std::vector<Row> table(const std::string& text) {
  const std::vector<std::string> lines = lines_of(text);
  const std::vector<std::string> names = fields_of(lines.at(0));
  std::vector<Row> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> fields = fields_of(lines[i]);
    Row row;
    for (std::size_t k = 0; k < names.size(); ++k) row[names[k]] = fields.at(k);
    rows.push_back(row);
  }
  return rows;
}

double value(const Row& row, const std::string& name) { return std::stod(row.at(name)); }

double distance_m(const Row& a, const Row& b) {
  return std::hypot(value(a, "x_m") - value(b, "x_m"), value(a, "y_m") - value(b, "y_m"), value(a, "z_m") - value(b, "z_m"));
}

// Angle between two attitudes.
double angle_rad(const Row& a, const Row& b) {
  double dot = 0;
  for (const char* name : {"qx", "qy", "qz", "qw"}) dot += value(a, name) * value(b, name);
  return 2 * std::acos(std::min(1.0, std::fabs(dot)));
}

class Replay : public ::testing::Test {
 protected:
  // Recorded once, and copied for each test.
  static void SetUpTestSuite() {
    original = std::make_unique<WorkFolder>();
    const Answer recorded = original->mdat("run missions/test.toml --scenario dropouts --frames 8 --record rec");
    ASSERT_EQ(recorded.exit_code, 0) << recorded.err;
    const Answer compiled = original->mdat("mission compile missions/test.toml --scenario dropouts -o image.3dli");
    ASSERT_EQ(compiled.exit_code, 0) << compiled.err;
  }
  static void TearDownTestSuite() { original.reset(); }

  void SetUp() override {
    std::filesystem::copy(*original / "rec", work / "rec", std::filesystem::copy_options::recursive);
    std::filesystem::copy(*original / "image.3dli", work / "image.3dli");
  }

  std::vector<Row> replay(const std::string& mission, const std::string& scans, const std::string& options) const {
    const Answer answer =
        work.mdat("replay " + mission + " --scans " + scans + " --initial rec/4m/poses.csv --force --out out.csv " + options);
    EXPECT_EQ(answer.exit_code, 0) << answer.err;
    const std::string text = work.read("out.csv");
    EXPECT_EQ(lines_of(text).at(0), kHeader);
    return table(text);
  }

  void expect_near_truth(const std::vector<Row>& rows, double limit_m, double limit_rad) const {
    const std::vector<Row> truth = table(work.read("rec/4m/truth.csv"));
    ASSERT_EQ(rows.size(), kReplayed);
    ASSERT_EQ(truth.size(), kReplayed);
    for (std::size_t i = 0; i < kReplayed; ++i) {
      EXPECT_EQ(rows[i].at("scan"), truth[i].at("scan"));
      EXPECT_EQ(rows[i].at("valid"), "1") << rows[i].at("reason");
      EXPECT_LT(distance_m(rows[i], truth[i]), limit_m);
      EXPECT_LT(angle_rad(rows[i], truth[i]), limit_rad);
      const double sigma_m = std::hypot(value(rows[i], "sigma_x_m"), value(rows[i], "sigma_y_m"), value(rows[i], "sigma_z_m"));
      EXPECT_LT(distance_m(rows[i], truth[i]), 6 * sigma_m) << "the covariance is honest";
      EXPECT_GT(value(rows[i], "inliers"), 300);
      EXPECT_NEAR(value(rows[i], "rms_m"), 16.0 / 9000, 0.3 * 16.0 / 9000) << "the noise of the camera at 4 m";
      EXPECT_GT(value(rows[i], "estimate_us"), 10);
    }
  }
  WorkFolder work;
  static inline std::unique_ptr<WorkFolder> original;
};

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
  VERIFIES("LASSO-MDT-006~1");
  const std::vector<std::string> lines = lines_of(work.read("rec/4m/poses.csv"));
  std::string other = lines.at(1);
  other.replace(0, other.find(','), "start");  // not the name of a scan
  work.write("rec/4m/poses.csv", lines.at(0) + "\n" + other + "\n");
  expect_near_truth(replay("image.3dli", "rec/4m/scans", "--closed-loop"), 1e-3, 0.002);
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

// The same scans, named 1 to 12 without zeros before them: s10 comes after s9.
TEST_F(Replay, TakesFilesInNaturalOrder) {
  VERIFIES("LASSO-SIM-019~2");
  const std::vector<Row> truth = table(work.read("rec/4m/truth.csv"));
  for (std::size_t i = 0; i < kReplayed; ++i) {
    work.write("named/s" + std::to_string(i + 5) + ".csv", work.read("rec/4m/scans/" + truth[i].at("scan") + ".csv"));
  }
  const Answer answer = work.mdat("replay image.3dli --scans named --initial rec/4m/poses.csv --closed-loop --force -o out.csv");
  EXPECT_EQ(answer.err.find("step back"), std::string::npos) << answer.err;
  const std::vector<Row> rows = table(work.read("out.csv"));
  ASSERT_EQ(rows.size(), kReplayed);
  for (std::size_t i = 0; i < kReplayed; ++i) {
    EXPECT_EQ(rows[i].at("scan"), "s" + std::to_string(i + 5));
    EXPECT_EQ(rows[i].at("valid"), "1") << rows[i].at("reason");
    EXPECT_LT(distance_m(rows[i], truth[i]), 1e-3);
  }
}

TEST_F(Replay, WarnsOfTimesThatStepBack) {
  VERIFIES("LASSO-MDT-070~1");
  std::filesystem::rename(work / "rec/4m/scans/f00002.csv", work / "rec/4m/scans/z.csv");
  std::string poses = work.read("rec/4m/poses.csv");
  poses.replace(poses.find("f00002"), 6, "z");
  work.write("rec/4m/poses.csv", poses);
  const Answer answer = work.mdat("replay image.3dli --scans rec/4m/scans --initial rec/4m/poses.csv --force -o out.csv");
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_NE(answer.err.find("warning: times step back at 1 of 8 scans, first at z,"), std::string::npos) << answer.err;
  EXPECT_NE(answer.out.find("8 of 8 scans gave a valid pose"), std::string::npos) << answer.out;
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

TEST_F(Replay, KnowsUnitsOfTimeByAScansSpan) {
  VERIFIES("LASSO-MDT-070~1");
  const std::vector<Row> seconds = replay("image.3dli", "rec/4m/scans", "--closed-loop");
  for (const auto& [per_second, name] : {std::pair(1e6, "microseconds"), std::pair(1e9, "nanoseconds")}) {
    for (const Row& row : seconds)
      work.write("other/" + row.at("scan") + ".csv", with_times(work.read("rec/4m/scans/" + row.at("scan") + ".csv"), per_second));
    const Answer answer = work.mdat("replay image.3dli --scans other --initial rec/4m/poses.csv --closed-loop --force -o other.csv");
    EXPECT_NE(answer.err.find(std::string("taken as ") + name), std::string::npos) << answer.err;
    const std::vector<Row> rows = table(work.read("other.csv"));
    ASSERT_EQ(rows.size(), seconds.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_EQ(rows[i].at("t_s"), seconds[i].at("t_s"));
      EXPECT_LT(distance_m(rows[i], seconds[i]), 1e-8);
    }
  }
}

TEST_F(Replay, TakesTheUnitOfTimeThatIsAskedFor) {
  VERIFIES("LASSO-MDT-070~1");
  const Answer answer = work.mdat("replay image.3dli --scans rec/4m/scans --initial rec/4m/poses.csv --time-unit ms --force -o out.csv");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  const double given_s = value(table(work.read("out.csv")).at(3), "t_s");
  EXPECT_NEAR(given_s, 1e-3 * value(replay("image.3dli", "rec/4m/scans", "").at(3), "t_s"), 1e-6);
}

// What replay wrote is what it starts from, and gives the same poses again.
TEST_F(Replay, StartsFromItsOwnOutput) {
  VERIFIES("LASSO-MDT-071~1");
  const std::vector<Row> first = replay("image.3dli", "rec/4m/scans", "");
  std::filesystem::copy(work / "out.csv", work / "rec/4m/poses.csv", std::filesystem::copy_options::overwrite_existing);
  const std::vector<Row> again = replay("image.3dli", "rec/4m/scans", "");
  ASSERT_EQ(again.size(), first.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_LT(distance_m(again[i], first[i]), 1e-4);
}

TEST_F(Replay, StartsFromWhatASearchWroteAndTellsWhichPosesAreNone) {
  VERIFIES("LASSO-MDT-071~1");
  const std::string text = work.read("rec/4m/poses.csv");
  std::string rows = "\xEF\xBB\xBFscan;outcome;" + lines_of(text)[0].substr(5) + "\r\n\r\n";
  for (std::size_t i = 1; i <= kReplayed; ++i) {
    const std::string line = lines_of(text)[i];
    const std::size_t comma = line.find(',');
    rows += line.substr(0, comma) + ".csv; " + (i == 3 ? "rejected" : "accepted") + line.substr(comma) + "\r\n";
  }
  std::replace(rows.begin(), rows.end(), ',', ';');
  work.write("rec/4m/poses.csv", rows + "\r\n\r\n");
  const Answer answer = work.mdat("replay image.3dli --scans rec/4m/scans --initial rec/4m/poses.csv --force -o out.csv");
  EXPECT_NE(answer.err.find("1 of 8 poses are not valid there"), std::string::npos) << answer.err;
  expect_near_truth(table(work.read("out.csv")), 1e-3, 0.002);
}

// The points of a scan as an organised cloud: a row for each ray, NaN or zeros where it missed.
std::string to_pcd(const std::string& csv, const std::string& nothing) {
  std::string points;
  const std::vector<Row> rays = table(csv);
  for (const Row& ray : rays)
    points += (ray.at("valid") == "1" ? ray.at("x_m") + " " + ray.at("y_m") + " " + ray.at("z_m") : nothing) + "\n";
  const std::string count = std::to_string(rays.size());
  return "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + count +
         "\nHEIGHT 1\nVIEWPOINT 0 0 0 -1 0 0 0\nPOINTS " + count + "\nDATA ascii\n" + points;
}

TEST_F(Replay, LeavesOutRowsWithoutAMeasurement) {
  VERIFIES("LASSO-SIM-036~1 LASSO-MDT-070~1");
  const std::vector<Row> truth = table(work.read("rec/4m/truth.csv"));
  for (const Row& row : truth) {
    work.write("clouds/" + row.at("scan") + ".pcd",
               to_pcd(work.read("rec/4m/scans/" + row.at("scan") + ".csv"), row.at("scan") == "f00001" ? "0 0 0" : "nan nan nan"));
  }
  expect_near_truth(replay("image.3dli", "clouds", ""), 1.5e-3, 0.003);
  const Answer answer = work.mdat("replay image.3dli --scans clouds --initial rec/4m/poses.csv --force -o out.csv");
  EXPECT_NE(answer.err.find("rows have no measurement (NaN or zeros; in all 8 scans)"), std::string::npos) << answer.err;
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
  VERIFIES("LASSO-MOD-111~1 LASSO-MOD-122~1");
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

// A mission's own start.check: the first scan's pose is valid once a search of that scan has found no better one.
TEST_F(Replay, ChecksTheStartOfAClosedLoopWithinOneScan) {
  VERIFIES("LASSO-MDT-073~1");
  work.write_mission({{"check = false", "check = true"}});
  const Answer answer =
      work.mdat("replay missions/test.toml --scans rec/4m/scans --initial rec/4m/poses.csv --closed-loop --force -o out.csv");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  expect_near_truth(table(work.read("out.csv")), 1e-3, 0.002);
}

using Change = std::function<void(Row&)>;

// A table with each row changed.
std::string changed(const std::string& text, const Change& change) {
  const std::vector<std::string> names = fields_of(lines_of(text)[0]);
  std::string result = lines_of(text)[0] + "\n";
  for (Row row : table(text)) {
    change(row);
    for (std::size_t i = 0; i < names.size(); ++i) result += row[names[i]] + (i + 1 < names.size() ? "," : "\n");
  }
  return result;
}

std::string text_of(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.12g", value);
  return text;
}

TEST_F(Replay, SaysThatScansAreInMillimetres) {
  VERIFIES("LASSO-MDT-074~1");
  for (const Row& scan : table(work.read("rec/4m/truth.csv"))) {
    const std::string name = scan.at("scan") + ".csv";
    work.write("mm/" + name, changed(work.read("rec/4m/scans/" + name), [](Row& row) {
                 if (row["valid"] == "0") return;
                 for (const char* axis : {"x_m", "y_m", "z_m"}) row[axis] = text_of(1000 * std::stod(row[axis]));
               }));
  }
  const Answer answer = work.mdat("replay image.3dli --scans mm --initial rec/4m/poses.csv --force -o out.csv");
  EXPECT_NE(answer.err.find("the returns of all 8 scans lie beyond sensor.range_max_m 12"), std::string::npos) << answer.err;
  EXPECT_NE(answer.err.find("in millimetres? --scale 0.001"), std::string::npos) << answer.err;
  expect_near_truth(replay("image.3dli", "mm", "--scale 0.001"), 1e-3, 0.002);
}

// Quaternions of both directions and orders by their definition: the inverse of (q, p) is (conjugate q, -R(q)^T p).
TEST_F(Replay, SaysHowPosesThatDoNotFitWould) {
  VERIFIES("LASSO-MDT-074~1");
  const std::string poses = work.read("rec/4m/poses.csv");
  const Change first = [](Row& row) {
    const Row old = row;
    row["qx"] = old.at("qw");
    row["qy"] = old.at("qx");
    row["qz"] = old.at("qy");
    row["qw"] = old.at("qz");
  };
  const Change inverse = [](Row& row) {
    const double x = -value(row, "qx"), y = -value(row, "qy"), z = -value(row, "qz"), w = value(row, "qw");
    const double px = value(row, "x_m"), py = value(row, "y_m"), pz = value(row, "z_m");
    row["x_m"] = text_of(-((1 - 2 * (y * y + z * z)) * px + 2 * (x * y - w * z) * py + 2 * (x * z + w * y) * pz));
    row["y_m"] = text_of(-(2 * (x * y + w * z) * px + (1 - 2 * (x * x + z * z)) * py + 2 * (y * z - w * x) * pz));
    row["z_m"] = text_of(-(2 * (x * z - w * y) * px + 2 * (y * z + w * x) * py + (1 - 2 * (x * x + y * y)) * pz));
    row["qx"] = text_of(x);
    row["qy"] = text_of(y);
    row["qz"] = text_of(z);
  };
  const std::pair<Change, const char*> cases[] = {{first, "quaternions scalar first: the columns"},
                                                  {inverse, "the inverse of each pose: the file"}};
  for (const auto& [change, said] : cases) {
    work.write("rec/4m/other.csv", changed(poses, change));
    const Answer answer = work.mdat("replay image.3dli --scans rec/4m/scans --initial rec/4m/other.csv --force -o out.csv");
    EXPECT_NE(answer.err.find(said), std::string::npos) << answer.err;
    EXPECT_NE(answer.err.find("of 5 scans that were tried 0 fit as given, and 5 with"), std::string::npos) << answer.err;
    EXPECT_EQ(answer.err.find("warning: no return") != std::string::npos, said[4] == 'i') << answer.err;
  }
}

TEST_F(Replay, SaysInWhichAxesScansWouldFit) {
  VERIFIES("LASSO-MDT-074~1");
  for (const Row& scan : table(work.read("rec/4m/truth.csv"))) {
    const std::string name = scan.at("scan") + ".csv";
    work.write("other/" + name, changed(work.read("rec/4m/scans/" + name), [](Row& row) {
                 const Row old = row;  // forward, left, up of right, down, forward
                 row["x_m"] = old.at("z_m");
                 row["y_m"] = text_of(-std::stod(old.at("x_m")));
                 row["z_m"] = text_of(-std::stod(old.at("y_m")));
               }));
  }
  const Answer answer = work.mdat("replay image.3dli --scans other --initial rec/4m/poses.csv --force -o out.csv");
  EXPECT_NE(answer.err.find("and 5 with scans in other axes: --axes forward-left-up"), std::string::npos) << answer.err;
}

TEST_F(Replay, TellsOfNoiseThatIsLargerThanStated) {
  VERIFIES("LASSO-MDT-075~1");
  const Answer same = work.mdat("replay image.3dli --scans rec/4m/scans --initial rec/4m/poses.csv --force -o out.csv");
  EXPECT_EQ(same.err.find("residuals are"), std::string::npos) << same.err;
  work.write_mission({{"sigma_k_per_m = 1.1111111111111112e-4", "sigma_k_per_m = 2.5e-5"}});
  const Answer answer =
      work.mdat("replay missions/test.toml --scenario dropouts --scans rec/4m/scans --initial rec/4m/poses.csv --force -o out.csv");
  const std::size_t at = answer.err.find("warning: residuals are ");
  ASSERT_NE(at, std::string::npos) << answer.err;
  EXPECT_NEAR(std::stod(answer.err.substr(at + 23)), 4.4, 0.4) << "1/9000 over 2.5e-5";
  EXPECT_NE(answer.err.find("they show 1."), std::string::npos) << "1.78 mm at 4 m: " << answer.err;
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
