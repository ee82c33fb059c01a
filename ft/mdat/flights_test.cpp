// The report of a scenario whose motion is drawn: flights, and how well their rates are known.
#include <gtest/gtest.h>

#include <cstdio>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

// The scenario `rates` with the ranges of a few flights.
void write_flights(const WorkFolder& work, const std::string& ranges_m) {
  work.write_mission({{"ranges_m = [4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0]\nframes = 60",
                       "ranges_m = " + ranges_m + "\nframes = 60"}});
}

// Cells of a row as the report writes them.
std::string settled_cells(const Json& settled) {
  char text[256];
  std::snprintf(text, sizeof text, "<td>%d</td><td>%d</td><td>%d</td><td>%.3f</td><td>%.3f</td><td>%.2f</td><td>%.2f</td>",
                settled.at("frames").get<int>(), settled.at("lost").get<int>(), settled.at("invalid").get<int>(),
                settled.at("rms_degps").get<double>(), settled.at("worst_degps").get<double>(), settled.at("rms_mmps").get<double>(),
                settled.at("worst_mmps").get<double>());
  return text;
}

void expect_shown(const std::string& report, const std::vector<std::string>& texts) {
  for (const std::string& text : texts) EXPECT_NE(report.find(text), std::string::npos) << text;
}

TEST(FlightsReport, ShowsTheRatesOfAllFlightsAndOfEach) {
  VERIFIES("LASSO-MDT-011~1");
  const WorkFolder work;
  write_flights(work, "[4.0, 4.0, 4.0]");
  const Answer answer = work.mdat("run missions/test.toml --scenario rates --frames 24 --out out");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_NE(answer.out.find("3 flights at 4 m x 24 frames, attitudes drawn"), std::string::npos) << answer.out;
  const std::string report = work.read("out/report.html");
  const Json noisy = Json::parse(work.read("out/results.json")).at("noisy");
  expect_shown(report, {"3 flights at 4 m, 24 frames each", "after 20 frames of each flight",
                        "with noise</td>" + settled_cells(noisy.at("settled"))});
  for (std::size_t i = 0; i < 3; ++i) {
    expect_shown(report,
                 {"with noise, flight " + std::to_string(i + 1) + ", 4 m</td>" + settled_cells(noisy.at("by_range").at(i).at("settled"))});
  }
  expect_shown(report, {"The same by flight", "rotation, deg/s", "settled rates, mm/s", "Root mean square errors of each flight"});
  EXPECT_EQ(report.find("range from"), std::string::npos);
  EXPECT_EQ(report.find("ranges from"), std::string::npos);
  EXPECT_EQ(report.find("against range"), std::string::npos) << "all are at one";
}

TEST(FlightsReport, SaysThatSettledRatesAreNotKnown) {
  VERIFIES("LASSO-MDT-011~1");
  const WorkFolder work;
  write_flights(work, "[4.0, 5.0]");
  const Answer answer = work.mdat("run missions/test.toml --scenario rates --frames 4 --out out");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  const std::string report = work.read("out/report.html");
  expect_shown(report,
               {"2 flights from 4 to 5 m", "with noise</td><td>0</td><td>0</td><td>0</td><td>–</td>", "flight 2, 5 m", "not known"});
}

// Rates that are exactly zero, as of a target at rest before the filter has learned any, have no place on a logarithmic axis.
TEST(FlightsReport, SaysThatNoRateIsKnown) {
  VERIFIES("LASSO-MDT-011~1");
  const WorkFolder work;
  work.write_mission({{"spin_degps = [2.0, 0.0, 0.0]        # in any direction\ndrift_mps = [0.01, 0.0, 0.0]",
                       "spin_degps = [0.0, 0.0, 0.0]\ndrift_mps = [0.0, 0.0, 0.0]"},
                      {"ranges_m = [4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0, 4.0]\nframes = 60",
                       "ranges_m = [4.0, 7.0, 5.0]\nframes = 60"}});
  const Answer answer = work.mdat("run missions/test.toml --scenario rates --frames 1 --out out");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  expect_shown(answer.out, {"3 flights from 4 to 7 m"});
  expect_shown(work.read("out/report.html"), {"no rate is known"});
}

// A start half a turn off is never on the target's pose: there is no error to tell, neither as nan nor as 0.
TEST(FlightsReport, SaysInWordsThatEveryFrameIsLost) {
  VERIFIES("LASSO-MDT-011~1");
  const WorkFolder work;
  work.write_mission();
  const Answer answer = work.mdat("run missions/test.toml --scenario half_turn --frames 2 --out out");
  ASSERT_EQ(answer.exit_code, 0) << answer.err;
  expect_shown(answer.out, {"with noise               every frame lost       -      -       -    40/40", "X      mm          - /       -",
                            "tracked in the last frame 0 of 20 runs; the filter's pose rms - mm, - deg",
                            "after 20 frames of each run, with noise: no run is so long"});
  const std::string report = work.read("out/report.html");
  expect_shown(report, {"<td>40</td><td>40</td><td>40</td><td>0</td><td>–</td><td>–</td>", "<td>– <small>±</small> –</td>"});
  for (const std::string& text : {answer.out, report}) EXPECT_EQ(text.find("nan<"), std::string::npos);
  EXPECT_EQ(answer.out.find("nan"), std::string::npos);
  EXPECT_TRUE(Json::parse(work.read("out/results.json")).at("noisy").at("nees").is_null());
}

}  // namespace
}  // namespace lasso::ft
