#include "mdat/campaign/figures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "mdat/missiondb/figure_names.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

FrameError frame_of(std::uint32_t number, double off_mm, double turned_deg, bool valid) {
  FrameError frame;
  frame.frame = number;
  frame.t_s = 0.2 * number;
  frame.reported = true;
  frame.valid = valid;
  frame.registration.translation_m = Vec3(0, 0.6, -0.8) * off_mm * 1e-3;
  frame.registration.rotation_rad = turned_deg * kRadPerDeg;
  frame.nees = off_mm;
  return frame;
}

std::map<std::string, double> figures_of(const CaseResult& result) {
  std::map<std::string, double> values;
  for (const Figure& figure : case_figures()) values[figure.name] = figure.of(result);
  return values;
}

TEST(CaseFigures, AreOfTheValidPosesAlone) {
  VERIFIES("LASSO-GND-044~1");
  CaseResult result;
  result.frames = {frame_of(0, 40, 2, false), frame_of(1, 3, 0.5, true), frame_of(2, 4, 0.25, true), FrameError{}};
  result.frames[2].wrong = true;
  auto figures = figures_of(result);
  EXPECT_EQ(figures["frames"], 4);
  EXPECT_EQ(figures["valid"], 2);
  EXPECT_EQ(figures["invalid"], 1);
  EXPECT_EQ(figures["lost"], 1);
  EXPECT_EQ(figures["wrong"], 1);
  EXPECT_EQ(figures["first_wrong"], 2);
  EXPECT_DOUBLE_EQ(figures["found_s"], 0.2);
  EXPECT_NEAR(figures["rms_mm"], std::sqrt((9.0 + 16) / 2), 1e-12);
  EXPECT_NEAR(figures["worst_mm"], 4, 1e-12);
  EXPECT_NEAR(figures["worst_deg"], 0.5, 1e-12);
  EXPECT_NEAR(figures["nees"], 3.5, 1e-12);
}

TEST(CaseFigures, SayWhereACaseEnds) {
  VERIFIES("LASSO-GND-044~1");
  CaseResult result;
  result.frames = {frame_of(0, 40, 2, true), frame_of(1, 3, 0.5, true)};
  EXPECT_NEAR(figures_of(result)["last_mm"], 3, 1e-12);
  EXPECT_NEAR(figures_of(result)["last_deg"], 0.5, 1e-12);
  result.frames.push_back(frame_of(2, 3, 0.5, false));
  EXPECT_TRUE(std::isnan(figures_of(result)["last_mm"]));
  EXPECT_TRUE(std::isnan(figures_of(result)["last_deg"]));
}

TEST(CaseFigures, PercentilesAreByNearestRank) {
  VERIFIES("LASSO-GND-044~1");
  CaseResult result;
  for (std::uint32_t i = 0; i < 40; ++i) result.frames.push_back(frame_of(i, 40 - i, 0, true));  // 1 to 40 mm
  EXPECT_NEAR(figures_of(result)["p95_mm"], 38, 1e-12);                                          // the 38th of 40
}

// Nothing was found in it: that none is lost or invalid is no good sign.
TEST(CaseFigures, OfACaseThatNeverBeganNoLossIsKnown) {
  VERIFIES("LASSO-GND-044~1");
  auto figures = figures_of(CaseResult{});
  EXPECT_EQ(figures["valid"], 0);
  EXPECT_EQ(figures["wrong"], 0);
  EXPECT_TRUE(std::isnan(figures["lost"]));
  EXPECT_TRUE(std::isnan(figures["invalid"]));
}

TEST(CaseFigures, WhatACaseDoesNotHaveIsAnEmptyCell) {
  VERIFIES("LASSO-GND-044~1");
  CaseResult result;
  result.frames = {frame_of(0, 40, 2, false)};
  auto figures = figures_of(result);
  for (const char* name : {"first_wrong", "found_s", "rms_mm", "p95_deg", "worst_mm", "nees", "settled_degps"}) {
    EXPECT_TRUE(std::isnan(figures[name])) << name;
    EXPECT_EQ(cell_text(figures[name]), "") << name;
  }
  EXPECT_EQ(cell_text(0.1), "0.1");
}

TEST(CaseFigures, HaveTimesToAlertAndProtectionLevels) {
  VERIFIES("LASSO-GND-130~1 LASSO-GND-131~1");
  CaseResult result;
  result.frames = {frame_of(0, 40, 2, true), frame_of(1, 40, 2, true), frame_of(2, 3, 0.1, true), frame_of(3, 40, 0.1, true)};
  result.frames[0].wrong = result.frames[1].wrong = result.frames[3].wrong = true;
  for (std::size_t i = 0; i < 4; ++i) result.frames[i].level = {0.005 + 0.001 * static_cast<double>(i), 0.5 * kRadPerDeg};
  result.frames[3].level = {0.5, 3 * kRadPerDeg};
  result.end_s = 0.8;
  auto figures = figures_of(result);
  EXPECT_EQ(figures["episodes"], 2);
  EXPECT_EQ(figures["censored"], 1);
  EXPECT_DOUBLE_EQ(figures["time_to_alert_worst_s"], 0.4);
  EXPECT_EQ(figures["misleading"], 2);
  EXPECT_DOUBLE_EQ(figures["misleading_share"], 0.5);
  EXPECT_NEAR(figures["level_median_mm"], 6, 1e-12);
  EXPECT_NEAR(figures["level_worst_mm"], 500, 1e-9);
  EXPECT_NEAR(figures["level_median_deg"], 0.5, 1e-12);
  EXPECT_NEAR(figures["level_worst_deg"], 3, 1e-12);
}

// A criterion asks for at most so long; of no level nothing is known.
TEST(CaseFigures, WithoutAWrongPoseAreOfNoTimeToAlert) {
  VERIFIES("LASSO-GND-130~1 LASSO-GND-131~1");
  CaseResult result;
  result.frames = {frame_of(0, 40, 2, false)};
  auto figures = figures_of(result);
  EXPECT_EQ(figures["episodes"], 0);
  EXPECT_EQ(figures["time_to_alert_worst_s"], 0);
  EXPECT_EQ(figures["misleading"], 0);
  for (const char* name : {"misleading_share", "level_median_mm", "level_worst_deg"}) EXPECT_TRUE(std::isnan(figures[name])) << name;
}

TEST(CaseFigures, AreThoseThatAMissionsCriteriaMayName) {
  VERIFIES("LASSO-GND-045~1");
  std::vector<std::string> names;
  for (const Figure& figure : case_figures()) names.emplace_back(figure.name);
  EXPECT_EQ(names, std::vector<std::string>(std::begin(kFigureNames), std::end(kFigureNames)));
}

}  // namespace
}  // namespace lasso::mdat
