#include "ut/mdat/missiondb/rules_support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

class ScanRules : public RuleTest {};

TEST_F(ScanRules, RaysThatDropOutAreNoInliers) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_edge("tracking.inliers_min = 341", "tracking.inliers_min = 400", "warning: ", "about 341");
  expect_edge("tracking.inliers_min = 341", "tracking.inliers_min = 1025", "error: ", "at most scan.points, which is 1024");
  expect_said(said("sensor.dropout_probability = 0.2\ntracking.inliers_min = 819"), "warning: ", "about 273");
  expect_said(said("sensor.dropout_probability = 0.2\ntracking.inliers_min = 820"), "error: ", "819 return at most");
}

TEST_F(ScanRules, CyclesFitThePattern) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  const std::string fault = "expected at most half of the pattern's 64 rays";
  const std::string values = "scan.points = 128\nscan.aimed_share = 0.5\nstart.check = false\n";
  EXPECT_EQ(said(values + "scan.cycles_a = 32\nscan.cycles_b = 31").find(fault), std::string::npos);
  expect_said(said(values + "scan.cycles_a = 33\nscan.cycles_b = 32"), "scan.cycles_a: 33", fault);
  expect_said(said(values + "scan.cycles_a = 32\nscan.cycles_b = 33"), "scan.cycles_b: 33", fault);
  expect_said(said("scan.cycles_a = 18"), "scan.cycles_b: 12", "no common divisor");
  expect_said(said("scan.pattern = 'raster'\nscan.points = 64\nscan.cycles_a = 33"), "scan.cycles_a: 33", "at least 2 points a line");
}

TEST_F(ScanRules, AScanFillsItsPeriod) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_edge("scan.duration_s = 0.19", "scan.duration_s = 0.2", "error: ", "less than filter.period_s, which is 0.2 s");
  expect_edge("filter.period_s = 1.79", "filter.period_s = 4",
              "warning: ", "rests 95.5 % of the time; is it meant in Hz? 4 Hz are a period of 0.25 s");
}

// In a scan that takes most of its period deskewing makes its own errors larger; a rosette goes over the target many times.
TEST_F(ScanRules, ARasterIsSweptInLessThanItsPeriod) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  const std::string raster = "scan.pattern = 'raster'\nscan.cycles_a = 32\n";
  expect_edge(raster + "scan.duration_s = 0.12", raster + "scan.duration_s = 0.14", "scan.pattern: \"raster\"", "of at most 0.12 s");
  expect_edge(raster + "estimation.deskew = false", raster, "scan.pattern: \"raster\"", "0.18 s, 90 % of filter.period_s");
}

TEST_F(ScanRules, AimedRaysNeedSilhouettes) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_edge("scan.aimed_share = 0.3", "scan.aimed_share = 0.3\nestimation.silhouettes = false", "scan.aimed_share: 0.3",
              "silhouettes is false");
}

TEST_F(ScanRules, TheMarginHoldsTheTarget) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_edge("scan.margin = 1", "scan.margin = 0.9", "scan.margin: 0.9", "outer 10 %");
  expect_edge("scan.margin = 2", "scan.margin = 2.5", "scan.margin: 2.5", "fills 16 % of such a scan");
}

TEST_F(ScanRules, ThePatternLeavesNoGaps) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_edge("scan.pattern = 'lissajous'\nscan.cycles_a = 32\nscan.cycles_b = 31", "scan.pattern = 'lissajous'",
              "scan.pattern: \"lissajous\"", "m across on the target of 2 m");
  // Two lines at a quarter and three quarters: 0.5 m to either end of the middle.
  expect_said(said("scan.pattern = 'raster'\nscan.cycles_a = 2"), "scan.pattern: \"raster\"", "up to 1 m across");
  expect_said(said("scan.pattern = 'raster'\nscan.cycles_a = 2\nscan.aimed_share = 0.25"), "scan.pattern",
              "those of 768 rays that lie evenly");
}

TEST_F(ScanRules, ASearchHasTheReturnsAndTheWorkThatItAsksFor) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  const std::string half = "sensor.dropout_probability = 0.5\nscan.points = ";
  expect_said(said(half + "158"), "error: ", "scan.points: 158: a search looks at 79 returns of a scan of 158 rays at most, needs 80");
  EXPECT_EQ(said(half + "160").find("error: "), std::string::npos);
  EXPECT_EQ(said("start.check = false\n" + half + "158").find("a search looks at"), std::string::npos) << "none is made";
  expect_edge("scan.points = 267", "scan.points = 266", "scan.points: 266", "some 79 of 266 rays return, and a search needs 80");
  const std::string search = "start.fifth = 'search'\n";
  expect_edge(search + "search.slice = 6000", search + "search.slice = 1000", "search.slice: 1000", "a search does 2e+05 units of work");
}

TEST_F(ScanRules, ABearingHasReturnsAndLasts) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_edge("bearing.returns_min = 1024", "bearing.returns_min = 1025", "error: ", "at most the 1024 returns");
  expect_edge("bearing.memory_s = 0.21", "bearing.memory_s = 0.2", "warning: ", "more than filter.period_s, which is 0.2 s");
}

}  // namespace
}  // namespace lasso::mdat
