// The same scans and poses as others write them, and as others mistake them: each gives the same poses, or is told.
#include <algorithm>
#include <cstdio>
#include <functional>

#include "ft/mdat/replay_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

using ReplayForms = ReplayTest;

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

// What replay wrote is what it starts from, and gives the same poses again.
TEST_F(ReplayForms, StartsFromItsOwnOutput) {
  VERIFIES("LASSO-MDT-071~1");
  const std::vector<Row> first = replay("image.3dli", "rec/4m/scans", "");
  std::filesystem::copy(work / "out.csv", work / "rec/4m/poses.csv", std::filesystem::copy_options::overwrite_existing);
  const std::vector<Row> again = replay("image.3dli", "rec/4m/scans", "");
  ASSERT_EQ(again.size(), first.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_LT(distance_m(again[i], first[i]), 1e-4);
}

TEST_F(ReplayForms, StartsFromWhatASearchWroteAndTellsWhichPosesAreNone) {
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
  const Answer answer = work.mdat("replay --force image.3dli --scans rec/4m/scans --initial rec/4m/poses.csv -o out.csv");
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

TEST_F(ReplayForms, LeavesOutRowsWithoutAMeasurement) {
  VERIFIES("LASSO-SIM-036~1 LASSO-MDT-070~1");
  const std::vector<Row> truth = table(work.read("rec/4m/truth.csv"));
  for (const Row& row : truth) {
    work.write("clouds/" + row.at("scan") + ".pcd",
               to_pcd(work.read("rec/4m/scans/" + row.at("scan") + ".csv"), row.at("scan") == "f00001" ? "0 0 0" : "nan nan nan"));
  }
  expect_near_truth(replay("image.3dli", "clouds", ""), 1.5e-3, 0.003);
  const Answer answer = work.mdat("replay --force image.3dli --scans clouds --initial rec/4m/poses.csv -o out.csv");
  EXPECT_NE(answer.err.find("rows have no measurement (NaN or zeros; in all 8 scans)"), std::string::npos) << answer.err;
}

// A mission's own start.check: the first scan's pose is valid once a search of that scan has found no better one.
TEST_F(ReplayForms, ChecksTheStartOfAClosedLoopWithinOneScan) {
  VERIFIES("LASSO-MDT-073~1");
  work.write_mission({{"check = false", "check = true"}});
  const Answer answer = work.mdat(
      "replay --force missions/test.toml --scans rec/4m/scans --initial rec/4m/poses.csv --closed-loop --set "
      "sensor.dropout_probability=0.2 -o out.csv");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  expect_near_truth(table(work.read("out.csv")), 1e-3, 0.002);
}

TEST_F(ReplayForms, SaysThatScansAreInMillimetres) {
  VERIFIES("LASSO-MDT-074~1");
  for (const Row& scan : table(work.read("rec/4m/truth.csv"))) {
    const std::string name = scan.at("scan") + ".csv";
    work.write("mm/" + name, changed(work.read("rec/4m/scans/" + name), [](Row& row) {
                 if (row["valid"] == "0") return;
                 for (const char* axis : {"x_m", "y_m", "z_m"}) row[axis] = text_of(1000 * std::stod(row[axis]));
               }));
  }
  const Answer answer = work.mdat("replay --force image.3dli --scans mm --initial rec/4m/poses.csv -o out.csv");
  EXPECT_NE(answer.err.find("the returns of all 8 scans lie beyond sensor.range_max_m 12"), std::string::npos) << answer.err;
  EXPECT_NE(answer.err.find("in millimetres? --scale 0.001"), std::string::npos) << answer.err;
  expect_near_truth(replay("image.3dli", "mm", "--scale 0.001"), 1e-3, 0.002);
}

// What is millimetres by its ranges, and does not fit so, is not said to be: the scans are mirrored as well.
TEST_F(ReplayForms, ProposesNoUnitThatItHasNotTried) {
  VERIFIES("LASSO-MDT-074~1");
  for (const Row& scan : table(work.read("rec/4m/truth.csv"))) {
    const std::string name = scan.at("scan") + ".csv";
    work.write("mm/" + name, changed(work.read("rec/4m/scans/" + name), [](Row& row) {
                 const double unit = row["valid"] == "0" ? 1 : 1000;
                 for (const char* axis : {"x_m", "y_m", "z_m"}) row[axis] = text_of(unit * std::stod(row[axis]));
                 row["z_m"] = text_of(-std::stod(row["z_m"]));
               }));
  }
  const Answer answer = work.mdat("replay --force image.3dli --scans mm --initial rec/4m/poses.csv -o out.csv");
  EXPECT_NE(answer.err.find("the returns of all 8 scans lie beyond sensor.range_max_m 12"), std::string::npos) << answer.err;
  EXPECT_EQ(answer.err.find("--scale"), std::string::npos) << answer.err;
}

// Quaternions of both directions and orders by their definition: the inverse of (q, p) is (conjugate q, -R(q)^T p).
TEST_F(ReplayForms, SaysHowPosesThatDoNotFitWould) {
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
    const Answer answer = work.mdat("replay --force image.3dli --scans rec/4m/scans --initial rec/4m/other.csv -o out.csv");
    EXPECT_NE(answer.err.find(said), std::string::npos) << answer.err;
    EXPECT_NE(answer.err.find("of 5 scans tried 0 fit as given, and 5 with"), std::string::npos) << answer.err;
    EXPECT_EQ(answer.err.find("warning: no return") != std::string::npos, said[4] == 'i') << answer.err;
  }
}

TEST_F(ReplayForms, SaysInWhichAxesScansWouldFit) {
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
  const Answer answer = work.mdat("replay --force image.3dli --scans other --initial rec/4m/poses.csv -o out.csv");
  EXPECT_NE(answer.err.find("and 5 with scans in other axes: --axes forward-left-up"), std::string::npos) << answer.err;
}

// The number behind some words; not a number where they do not stand.
double figure_behind(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  return at == std::string::npos ? std::nan("") : std::stod(text.substr(at + words.size()));
}

// The camera's own noise at 4 m is 16/9000 m. The mission states another one, in place of its 1/9000.
TEST_F(ReplayForms, TellsOfNoiseThatIsNotAsStated) {
  VERIFIES("LASSO-MDT-075~2");
  struct Stated {
    const char* sigma_k_per_m;
    const char* told;
    double ratio, made_mm;
  };
  const Stated cases[] = {{"2.5e-5", "warning: residuals are ", 4.4, 0.4},
                          {"6.5e-5", "warning: residuals are ", 1.7, 1.04},
                          {"8.5e-5", nullptr, 1.3, 1.36},
                          {"1.1111111111111112e-4", nullptr, 1, 1.78},
                          {"4e-4", nullptr, 0.28, 6.4},
                          {"6e-4", "note: residuals are ", 0.185, 9.6}};
  for (const Stated& stated : cases) {
    work.write_mission({{"sigma_k_per_m = 1.1111111111111112e-4", std::string("sigma_k_per_m = ") + stated.sigma_k_per_m}});
    const Answer answer =
        work.mdat("replay --force missions/test.toml --scenario dropouts --scans rec/4m/scans --initial rec/4m/poses.csv -o out.csv");
    ASSERT_EQ(answer.exit_code, 0) << answer.err;
    EXPECT_EQ(answer.err.find("residuals are ") != std::string::npos, stated.told != nullptr) << stated.sigma_k_per_m << answer.err;
    if (stated.told == nullptr) continue;
    // Where too little is stated, the fit leaves the largest residuals out: they show less than there is.
    EXPECT_NEAR(figure_behind(answer.err, stated.told), stated.ratio, 0.1 * stated.ratio) << answer.err;
    EXPECT_NEAR(figure_behind(answer.err, "m they show "), 1e3 * 16 / 9000, stated.ratio > 2 ? 0.25 : 0.15) << answer.err;
    EXPECT_NEAR(figure_behind(answer.err, "estimation.surface_sigma_m make "), stated.made_mm, 0.1 * stated.made_mm) << answer.err;
  }
}

// Each scan of the recording, changed row by row, in another folder.
void write_changed(const WorkFolder& work, const std::string& folder, const Change& change) {
  for (const Row& scan : table(work.read("rec/4m/truth.csv"))) {
    const std::string name = scan.at("scan") + ".csv";
    work.write(folder + "/" + name, changed(work.read("rec/4m/scans/" + name), change));
  }
}

// What the sensor at (0.5, -0.3, 0.2) of a frame with axes forward, right, down writes of returns there; of misses their directions.
TEST_F(ReplayForms, TellsHowManyRaysContradict) {
  VERIFIES("LASSO-REG-029~2");
  work.write_mission({});
  const std::string scans = "replay --force missions/test.toml --scans rec/4m/scans --initial rec/4m/poses.csv -o out.csv";
  const Answer answer = work.mdat(scans);  // a fifth of the rays drops out, which the mission does not state
  EXPECT_NE(answer.err.find("warning: of 8 scans rays contradict the pose: as many as 2"), std::string::npos) << answer.err;
  EXPECT_NE(answer.err.find("tracking.agreement_min allows 1 %"), std::string::npos) << answer.err;
  EXPECT_EQ(work.mdat(scans + " --set sensor.dropout_probability=0.2").err.find("contradict"), std::string::npos);
}

// Misses under another name than `valid` would be returns at 1 m, of which wrong poses were made that were called valid.
TEST_F(ReplayForms, RefusesMissesUnderAnotherName) {
  VERIFIES("LASSO-SIM-071~2 LASSO-MDT-124~1");
  for (const Row& scan : table(work.read("rec/4m/truth.csv"))) {
    std::string text = work.read("rec/4m/scans/" + scan.at("scan") + ".csv");
    work.write("ok/" + scan.at("scan") + ".csv", text.replace(text.find("valid"), 5, "ok"));
  }
  const std::string command = "replay image.3dli --initial rec/4m/poses.csv -o other.csv --scans ";
  const Answer answer = work.mdat(command + "ok");
  EXPECT_EQ(answer.exit_code, 2) << answer.out;
  EXPECT_NE(answer.err.find("f00000.csv:1:17: column \"ok\" is not known"), std::string::npos) << answer.err;
  EXPECT_FALSE(std::filesystem::exists(work / "other.csv"));
  const std::string name = "rec/4m/scans/f00003.csv", text = work.read(name);
  std::string more = lines_of(text)[0] + ",foo\n";
  for (std::size_t i = 1; i < lines_of(text).size(); ++i) more += lines_of(text)[i] + ",7\n";
  work.write(name, more);
  const Answer told = work.mdat(command + "rec/4m/scans");
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_NE(told.err.find("f00003.csv:1:23: not known, and not read: column \"foo\""), std::string::npos) << told.err;
  expect_near_truth(table(work.read("other.csv")), 1e-3, 0.002);
}

TEST_F(ReplayForms, ReadsOtherAxesFromASensorThatStandsAside) {
  VERIFIES("LASSO-MDT-077~1");
  write_changed(work, "frd", [](Row& row) {
    const Row old = row;
    const double there = old.at("valid") == "1" ? 1 : 0;
    row["x_m"] = text_of(std::stod(old.at("z_m")) + 0.5 * there);
    row["y_m"] = text_of(std::stod(old.at("x_m")) - 0.3 * there);
    row["z_m"] = text_of(std::stod(old.at("y_m")) + 0.2 * there);
  });
  expect_near_truth(replay("image.3dli", "frd", "--axes forward-right-down --sensor-offset 0.5,-0.3,0.2"), 1e-3, 0.002);
  expect_near_truth(replay("image.3dli", "frd", "--axes y,z,x --sensor-offset=0.5,-0.3,0.2"), 1e-3, 0.002);
  const Answer wrong = work.mdat(
      "replay --force image.3dli --scans frd --initial rec/4m/poses.csv --axes forward-right-down --sensor-offset=-0.5,0.3,-0.2 -o "
      "out.csv");
  EXPECT_NE(wrong.err.find("and 5 with --sensor-offset of the other sign"), std::string::npos) << wrong.err;
  const Answer answer = work.mdat("replay --force image.3dli --scans frd --initial rec/4m/poses.csv --axes front-right-down -o out.csv");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_NE(answer.err.find("--axes: is \"front-right-down\""), std::string::npos) << answer.err;
}

TEST_F(ReplayForms, ReadsPlainTextClouds) {
  VERIFIES("LASSO-SIM-042~1 LASSO-MDT-006~1");
  for (const Row& scan : table(work.read("rec/4m/truth.csv"))) {
    std::string text = "//X;Y;Z;Intensity\n";
    for (const Row& ray : table(work.read("rec/4m/scans/" + scan.at("scan") + ".csv"))) {
      if (ray.at("valid") == "1") text += ray.at("x_m") + ";" + ray.at("y_m") + ";" + ray.at("z_m") + ";7\n";
    }
    std::replace(text.begin(), text.end(), '.', ',');
    work.write("text/" + scan.at("scan") + (scan.at("scan") == "f00003" ? ".asc" : ".xyz"), text);
  }
  expect_near_truth(replay("image.3dli", "text", ""), 1.5e-3, 0.003);
}

// Each point 40 times, up to 0.6 mm aside: 15,000 points a scan.
TEST_F(ReplayForms, ThinsDenseClouds) {
  VERIFIES("LASSO-SIM-040~1 LASSO-MDT-070~1");
  for (const Row& scan : table(work.read("rec/4m/truth.csv"))) {
    std::string text;
    for (const Row& ray : table(work.read("rec/4m/scans/" + scan.at("scan") + ".csv"))) {
      for (int i = 0; ray.at("valid") == "1" && i < 40; ++i) {
        text += text_of(value(ray, "x_m") + 3e-5 * (i - 19.5)) + " " + ray.at("y_m") + " " + ray.at("z_m") + "\n";
      }
    }
    work.write("dense/" + scan.at("scan") + ".xyz", text);
  }
  const Answer answer = work.mdat("replay --force image.3dli --scans dense --initial rec/4m/poses.csv -o out.csv");
  EXPECT_NE(answer.err.find("all 8 scans thinned to 4096 rays: of the largest 4096 of "), std::string::npos) << answer.err;
  const std::vector<Row> rows = table(work.read("out.csv"));
  const std::vector<Row> truth = table(work.read("rec/4m/truth.csv"));
  ASSERT_EQ(rows.size(), kReplayed);
  for (std::size_t i = 0; i < kReplayed; ++i) {
    EXPECT_EQ(rows[i].at("valid"), "1");
    EXPECT_LT(distance_m(rows[i], truth[i]), 2e-3);
  }
}

TEST_F(ReplayForms, PrintsErrorsAgainstTrueOnes) {
  VERIFIES("LASSO-MDT-076~1");
  const Answer answer =
      work.mdat("replay --force image.3dli --scans rec/4m/scans --initial rec/4m/poses.csv --truth rec/4m/truth.csv -o out.csv");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const std::vector<Row> rows = table(work.read("out.csv"));
  const std::vector<Row> truth = table(work.read("rec/4m/truth.csv"));
  double sum_mm2 = 0, largest_mm = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NEAR(value(rows[i], "error_m"), distance_m(rows[i], truth[i]), 1e-8);
    EXPECT_NEAR(value(rows[i], "error_deg"), angle_rad(rows[i], truth[i]) * 180 / 3.14159265358979, 1e-4);
    sum_mm2 += 1e6 * value(rows[i], "error_m") * value(rows[i], "error_m");
    largest_mm = std::max(largest_mm, 1e3 * value(rows[i], "error_m"));
  }
  const std::size_t at = answer.out.find("errors of 8 poses: translation rms ");
  ASSERT_NE(at, std::string::npos) << answer.out;
  EXPECT_NEAR(std::stod(answer.out.substr(at + 35)), std::sqrt(sum_mm2 / 8), 1e-3);
  EXPECT_NEAR(std::stod(answer.out.substr(answer.out.find("largest ", at) + 8)), largest_mm, 1e-3);
  const Answer found = work.mdat("replay --force image.3dli --scans rec/4m/scans --initial search --truth rec/4m/truth.csv -o out.csv");
  EXPECT_NE(found.out.find("translation rms"), std::string::npos) << found.out;
  EXPECT_LT(value(table(work.read("out.csv")).at(0), "error_m"), 0.02);
  EXPECT_EQ(answer.err.find("--truth"), std::string::npos) << answer.err;
  work.write("mm.csv", changed(work.read("rec/4m/truth.csv"), [](Row& row) {
               for (const char* axis : {"x_m", "y_m", "z_m"}) row[axis] = text_of(1000 * std::stod(row[axis]));
             }));
  const Answer mm = work.mdat("replay --force image.3dli --scans rec/4m/scans --initial rec/4m/poses.csv --truth mm.csv -o out.csv");
  const std::size_t told = mm.err.find("warning: --truth: poses are ");
  ASSERT_NE(told, std::string::npos) << mm.err;
  EXPECT_NEAR(std::stod(mm.err.substr(told + 28)), 3996, 10) << "4 m of 4000";
  EXPECT_NE(mm.err.find("if it is read in millimetres"), std::string::npos) << mm.err;
  work.write("other.csv", "scan,qx,qy,qz,qw,x_m,y_m,z_m\nnone,0,0,0,1,0,0,4\n");
  const Answer other = work.mdat("replay --force image.3dli --scans rec/4m/scans --initial rec/4m/poses.csv --truth other.csv -o out.csv");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("other.csv: no row for any scan"), std::string::npos) << other.err;
}

}  // namespace
}  // namespace lasso::ft
