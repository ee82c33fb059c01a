#include "mdat/report/doubtful_view.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

FrameError frame_of(std::uint32_t number, bool valid, bool wrong, PoseReason reason, double error_m) {
  FrameError frame;
  frame.frame = number;
  frame.range_m = 4;
  frame.told = frame.reported = true;
  frame.valid = valid;
  frame.wrong = wrong;
  frame.reason = reason;
  frame.registration.translation_m = Vec3(error_m, 0, 0);
  return frame;
}

VariantResult variant_of(std::vector<FrameError> frames) {
  VariantResult variant;
  variant.variant = {"noisy", "with noise", true, true, false};
  variant.cases.resize(1);
  variant.cases[0].frames = std::move(frames);
  return variant;
}

TableResult table_of(std::vector<FrameError> frames) {
  TableResult table;
  table.scenario.ranges_m = {4};
  table.variants.push_back(variant_of(std::move(frames)));
  return table;
}

std::unique_ptr<sim::RayCaster> triangle() {
  const std::vector<Vec3> vertices = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()};
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}};
  return sim::make_ray_caster(vertices, triangles);
}

TEST(DoubtfulFrames, InARowAreOneLineAndWrongOnesComeFirst) {
  VERIFIES("LASSO-MDT-035~1");
  const TableResult table =
      table_of({frame_of(0, true, false, PoseReason::kValid, 0.001), frame_of(1, false, false, PoseReason::kNoTrack, 0.002),
                frame_of(2, false, false, PoseReason::kNoTrack, 0.0305), frame_of(3, true, true, PoseReason::kValid, 0.04),
                frame_of(5, true, true, PoseReason::kValid, 0.06)});
  Plotter plotter(testing::TempDir());
  const std::string html = doubtful_section(plotter, *triangle(), table);
  const std::string row = "<tr><td>with noise, 4 m</td><td>";
  const std::size_t third = html.find(row + "3</td><td>1</td><td>wrong</td><td>4</td><td>40.0</td><td>0.00</td></tr>");
  const std::size_t fifth = html.find(row + "5</td><td>1</td><td>wrong</td><td>4</td><td>60.0</td><td>0.00</td></tr>");
  const std::size_t first =
      html.find(row + "1–2</td><td>2</td><td>" + plain(to_string(PoseReason::kNoTrack)) + "</td><td>4</td><td>30.5</td>");
  ASSERT_NE(third, std::string::npos) << html;
  ASSERT_NE(fifth, std::string::npos) << html;
  ASSERT_NE(first, std::string::npos) << html;
  EXPECT_LT(third, fifth);
  EXPECT_LT(fifth, first);
}

TEST(DoubtfulFrames, AreNotSpokenOfWhereThereAreNone) {
  VERIFIES("LASSO-MDT-035~1");
  Plotter plotter(testing::TempDir());
  EXPECT_EQ(doubtful_section(plotter, *triangle(), table_of({frame_of(0, true, false, PoseReason::kValid, 0.001)})), "");
}

TEST(DoubtfulFrames, ThatAreManyAreCutOff) {
  VERIFIES("LASSO-MDT-035~1");
  std::vector<FrameError> frames;
  for (std::uint32_t i = 0; i < 100; ++i) frames.push_back(frame_of(2 * i, true, true, PoseReason::kValid, 0.04));
  Plotter plotter(testing::TempDir());
  EXPECT_NE(doubtful_section(plotter, *triangle(), table_of(frames)).find("And 40 more lines"), std::string::npos);
}

TEST(DoubtfulFrames, AreMarkedAtTheEdgesOfAFigure) {
  VERIFIES("LASSO-MDT-035~1");
  const VariantResult variant =
      variant_of({frame_of(0, true, false, PoseReason::kValid, 0), frame_of(1, true, true, PoseReason::kValid, 0.04),
                  frame_of(2, false, false, PoseReason::kNoTrack, 0)});
  const std::vector<Curve> marks = doubtful_marks(variant, 1.5);
  ASSERT_EQ(marks.size(), 2U);
  EXPECT_EQ(marks[0].rows, "1.5 0.975\n");
  EXPECT_EQ(marks[1].rows, "3 0.025\n");
}

}  // namespace
}  // namespace lasso::mdat
