// Pictures never cost a run: what is written where figures have no point, or gnuplot has settings, fails, or is not there.
#include <gtest/gtest.h>

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
  const std::vector<std::pair<std::string, std::string>> none = {{"ranges_m = [2.0, 3.0, 4.0, 5.0, 6.0, 7.0]", "ranges_m = [3.0]"},
                                                                 {"offset_m = [0.02, -0.01]", "offset_m = [1.35, 0.0]"}};
  const WorkFolder work;
  work.write_mission(none);
  const Answer answer = work.mdat("run missions/test.toml --scenario paper --frames 3 --out out");
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
  EXPECT_EQ(work.contents("out"), (std::vector<std::string>{"report.html", "results.json", "telemetry.ccsds"}));
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

}  // namespace
}  // namespace lasso::ft
