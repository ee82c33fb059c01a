#include "mdat/report/stanford_view.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

FrameError frame_of(double error_m, double level_m, bool valid) {
  FrameError frame;
  frame.reported = true;
  frame.valid = valid;
  frame.registration.translation_m = Vec3(error_m, 0, 0);
  frame.registration.rotation_rad = 0.001;
  frame.level = {level_m, 0.002};
  return frame;
}

// 4,000 poses within their levels, three misleading ones and an invalid one.
VariantResult variant() {
  VariantResult result;
  result.variant = {"noisy", "with noise", true, true, false};
  result.cases.resize(1);
  for (int i = 0; i < 4000; ++i) result.cases[0].frames.push_back(frame_of(0.001, 0.004 + 1e-6 * i, true));
  for (int i = 0; i < 3; ++i) result.cases[0].frames.push_back(frame_of(0.009, 0.004, true));
  result.cases[0].frames.push_back(frame_of(0.9, 0.004, false));
  return result;
}

TEST(LevelPoints, ShowEveryMisleadingPoseAndSomeOfTheOthers) {
  VERIFIES("LASSO-GND-131~1");
  const LevelPoints points = level_points(variant());
  std::size_t misleading = 0;
  for (const LevelPoint& point : points.position_mm) misleading += point.misleading ? 1U : 0U;
  EXPECT_EQ(misleading, 3U);
  EXPECT_GT(points.position_mm.size(), 1000U);
  EXPECT_LE(points.position_mm.size(), kStanfordPoints + 3);
  EXPECT_EQ(points.position_mm.back().error, 9);
  EXPECT_EQ(points.position_mm.back().level, 4);
  for (const LevelPoint& point : points.attitude_deg) EXPECT_FALSE(point.misleading);
}

TEST(StanfordDiagram, HasBothKindsOfPoses) {
  VERIFIES("LASSO-GND-131~1");
  Plotter plotter(testing::TempDir());
  const std::string svg = stanford_diagram(plotter, level_points(variant()));
  EXPECT_EQ(plotter.missing(), "");
  for (const char* part : {"<svg", "within its level", "misleading", "error = level", "position, mm", "attitude, deg"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
}

TEST(StanfordDiagram, IsDarkerWhereAPointStandsForMorePoses) {
  VERIFIES("LASSO-GND-131~1");
  Plotter plotter(testing::TempDir());
  LevelPoints points;
  points.position_mm = {{4, 1, 1, false}, {4, 2, 7, false}};
  points.attitude_deg = points.position_mm;
  const std::string few = stanford_diagram(plotter, points);
  EXPECT_NE(few.find("up to 10 of them"), std::string::npos);
  EXPECT_EQ(few.find("more of them"), std::string::npos);
  points.position_mm.push_back({4, 3, 11, false});
  EXPECT_NE(stanford_diagram(plotter, points).find("more of them"), std::string::npos);
}

TEST(StanfordDiagram, DrawsWhatCannotBeOnItsAxesAtTheirEnds) {
  VERIFIES("LASSO-GND-131~1");
  Plotter plotter(testing::TempDir());
  LevelPoints points;
  points.position_mm = {{4, 0, 1, false}, {std::numeric_limits<double>::infinity(), 3, 1, false}, {0, 1, 1, true}};
  EXPECT_NE(stanford_diagram(plotter, points).find("<svg"), std::string::npos);
  EXPECT_NE(stanford_diagram(plotter, {}).find("Nothing to draw: no valid pose"), std::string::npos);
  EXPECT_EQ(plotter.missing(), "");
}

}  // namespace
}  // namespace lasso::mdat
