// Pictures never cost a run: what is written where figures have no point, or gnuplot has settings, fails, or is not there.
#include <gtest/gtest.h>

#include <algorithm>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

constexpr char kReported[] = "run missions/test.toml --scenario spin --frames 3 --out out";

void expect_results(const WorkFolder& work) {
  EXPECT_EQ(Json::parse(work.read("out/results.json")).at("noisy").at("frames"), 3);
  EXPECT_GT(work.read("out/telemetry.ccsds").size(), 1000U);
}

TEST(Report, OfARunThatSeesNothing) {
  VERIFIES("LASSO-MDT-030~1 LASSO-MDT-004~1");
  const WorkFolder work;
  const Answer answer = work.mdat(std::string(kReported) + " --set scenario.spin.drift_mps=[50,0,0]");  // it is gone before the first scan
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  expect_results(work);
  EXPECT_NE(work.read("out/report.html").find("Nothing to draw: no scan was registered"), std::string::npos);
}

// What a user wrote for his own plots.
TEST(Report, DoesNotReadTheUsersSettings) {
  VERIFIES("LASSO-MDT-030~1");
  const WorkFolder work;
  work.write("home/.gnuplot", "set datafile separator \",\"\n");
  const Answer answer = work.mdat(kReported, "HOME=home GNUTERM=unknown TMPDIR='no\" such'\\''folder' LC_ALL=de_DE.UTF-8");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  expect_results(work);
  EXPECT_EQ(work.read("out/report.html").find("is missing"), std::string::npos);
  EXPECT_EQ(work.contents("out"), (std::vector<std::string>{"frames.csv", "report.html", "results.json", "telemetry.ccsds"}));
}

TEST(Report, WithoutGnuplotSaysSoAndTheResultsStand) {
  VERIFIES("LASSO-MDT-030~1");
  const WorkFolder work;
  const Answer answer = work.mdat(std::string(kReported) + " --picture scan.png", "PATH=/none");
  EXPECT_EQ(answer.exit_code, 3) << answer.err;
  EXPECT_EQ(answer.err.find("warning: pictures will be missing"), 0U) << "before the flight: " << answer.err;
  EXPECT_NE(lines_of(answer.err).back().find("gnuplot-nox"), std::string::npos) << answer.err;
  expect_results(work);
  EXPECT_NE(work.read("out/report.html").find("This figure is missing: gnuplot cannot be run"), std::string::npos);
  EXPECT_NE(work.read("out/report.html").find("<table>"), std::string::npos) << "the tables are there";
}

TEST(Report, GnuplotThatFailsIsToldInItsOwnWords) {
  VERIFIES("LASSO-MDT-030~1");
  const WorkFolder work;
  work.write("bin/gnuplot", "#!/bin/sh\n[ \"$2\" = --version ] && exit 0\necho 'out of paper'\nexit 4\n");
  std::filesystem::permissions(work / "bin/gnuplot", std::filesystem::perms::owner_all);
  const Answer answer = work.mdat(kReported, "PATH=\"$PWD/bin:$PATH\"");
  EXPECT_EQ(answer.exit_code, 3);
  EXPECT_EQ(lines_of(answer.err).back(),
            "mdat: out/report.html: figures are missing: gnuplot failed (code 4): out of paper; all results are written");
  expect_results(work);
}

// A wide start that is half a turn off: no pose is valid, and the report shows which frames and why.
TEST(Report, NamesWhatWasFlownAndTheFramesWithoutAPose) {
  VERIFIES("LASSO-MDT-035~1 LASSO-MDT-034~1 LASSO-MDT-031~1");
  const WorkFolder work;
  const Answer answer =
      work.mdat("run missions/test.toml --scenario half_turn --frames 3 --set scenario.half_turn.ranges_m=[3.0] --out out");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const std::string report = work.read("out/report.html");
  const std::string crc = Json::parse(work.read("out/results.json")).at("noisy").at("image_crc");
  for (const std::string& text :
       {std::string("<dt>Mission</dt><dd>Hubble, tenth scale, number 1, version 1, test.toml</dd>"),
        "<dt>Flight image, CRC-32C</dt><dd>" + crc + "</dd>", std::string("<code>scenario.half_turn.ranges_m=[3.0]</code>"),
        std::string("<td>scenario.half_turn.prior_turn_deg</td>"), std::string(", commit "), std::string("with noise, flight 1, 3 m"),
        std::string("without a valid pose"), std::string("The first of these scans")})
    EXPECT_NE(report.find(text), std::string::npos) << text;
  EXPECT_EQ(report.find("<td>estimation.kernel_width</td>"), std::string::npos) << "a preset";
  const std::vector<std::string> rows = lines_of(work.read("out/frames.csv"));
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[1].find(",noisy,1,0,"), 0U) << rows[1];
}

// Of both sensors, no inhibit among it, which is as where nothing is stated.
TEST(Report, ShowsWhatIsStatedOfEachLaserOfWhichTheImageKnowsNothing) {
  VERIFIES("LASSO-LCS-021~2");
  const WorkFolder work;
  const std::string further = "[further_sensor.far]\nrange_max_m = 15.0\n";
  work.write_mission({{"\n[scan]\n", "\n" + further + "\n[scan]\n"}});
  ASSERT_EQ(work.mdat("mission compile missions/test.toml --out silent.3dli").exit_code, 0);
  const std::string of_first = "laser_class = \"3B\"\nlaser_hazard_distance_m = 42.5\nlaser_inhibits = 0\n";
  const std::string of_further = "laser_class = \"1M\"\nlaser_hazard_distance_m = 0.5\nlaser_inhibits = 2\n";
  work.write_mission({{"\n[scan]\n", of_first + "\n" + further + of_further + "\n[scan]\n"}});
  ASSERT_EQ(work.mdat("mission compile missions/test.toml --out stated.3dli").exit_code, 0);
  EXPECT_EQ(work.read("stated.3dli"), work.read("silent.3dli"));
  const Answer answer = work.mdat(kReported);
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const std::string report = work.read("out/report.html");
  const std::vector<std::string> info = lines_of(work.mdat("mission info missions/test.toml").out);
  const std::pair<std::string, std::string> stated[] = {{"sensor.laser_class", "\"3B\""},
                                                        {"sensor.laser_hazard_distance_m", "42.5"},
                                                        {"sensor.laser_inhibits", "0"},
                                                        {"further_sensor.far.laser_class", "\"1M\""},
                                                        {"further_sensor.far.laser_hazard_distance_m", "0.5"},
                                                        {"further_sensor.far.laser_inhibits", "2"}};
  for (const auto& [key, value] : stated) {
    const std::string cell = value[0] == '"' ? "&quot;" + value.substr(1, 2) + "&quot;" : value;
    const std::size_t row = report.find("<td>" + key + "</td><td>" + cell + "</td>");
    ASSERT_NE(row, std::string::npos) << key;
    EXPECT_LT(report.find("<td>test.toml:", row), report.find("</tr>", row)) << key;
    const auto line = std::find_if(info.begin(), info.end(), [&](const std::string& text) { return text.find(key + ' ') == 0; });
    ASSERT_NE(line, info.end()) << key;
    EXPECT_NE(line->find(' ' + value + ' '), std::string::npos) << *line;
    EXPECT_NE(line->find("test.toml:"), std::string::npos) << *line;
  }
}

TEST(Gallery, ShowsEveryRunBelowAFolder) {
  VERIFIES("LASSO-MDT-036~1");
  const WorkFolder work;
  ASSERT_EQ(work.mdat("run missions/test.toml --scenario spin --frames 3 --out \"all/a b&c\"").exit_code, 0);
  work.write("all/bad/results.json", R"({"mission": "<m>", "scenario": "s", "noisy": {"frames": 9, "lost": 1, "invalid": 2, "wrong": 4}})");
  work.write("all/other/results.json", "[]");
  const Answer answer = work.mdat("gallery all");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_EQ(answer.out, "2 runs: all/index.html\n");
  EXPECT_EQ(answer.err, "warning: all/other/results.json: not the results of mdat run; left out\n");
  const std::string page = work.read("all/index.html");
  EXPECT_NE(page.find("<a href='a%20b%26c/report.html'>a b&amp;c</a>"), std::string::npos);
  EXPECT_NE(page.find("<p class='good'>3 frames, all right</p>"), std::string::npos);
  EXPECT_NE(page.find("<img alt='scans on the target' src='data:image/png;base64,"), std::string::npos);
  EXPECT_NE(page.find("<a href='bad/results.json'>bad</a>"), std::string::npos) << "it has no report";
  EXPECT_NE(page.find("<p>&lt;m&gt;, s, seed 0</p>"), std::string::npos);
  EXPECT_NE(page.find("<p class='bad'>9 frames, 4 wrong, 1 lost, 2 without a valid pose</p>"), std::string::npos);
  EXPECT_NE(page.find("rms – mm, –°; NEES –"), std::string::npos);
  EXPECT_EQ(work.mdat("gallery all").exit_code, 0) << "an earlier gallery is replaced";
  work.write("all/index.html", "<title>mine</title>");
  EXPECT_EQ(work.mdat("gallery all").err.find("mdat: all/index.html: is there since "), 0U);
}

TEST(Gallery, RefusesAFolderWithoutRuns) {
  VERIFIES("LASSO-MDT-036~1 LASSO-MDT-007~1");
  const WorkFolder work;
  const std::vector<std::string> before = work.contents();
  EXPECT_EQ(work.mdat("gallery missions").err, "mdat: missions: no run below it: mdat run leaves a results.json\n");
  EXPECT_EQ(work.mdat("gallery none").err, "mdat: none: no such folder\n");
  EXPECT_EQ(work.mdat("gallery missions").exit_code, 2);
  EXPECT_EQ(work.contents(), before);
}

}  // namespace
}  // namespace lasso::ft
