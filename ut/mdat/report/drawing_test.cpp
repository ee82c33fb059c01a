#include "mdat/report/drawing.hpp"

#include <gtest/gtest.h>

#include "mdat/common/errors.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(Points, AreRowsThatTheAxisCanShow) {
  VERIFIES("LASSO-MDT-030~1");
  EXPECT_TRUE(has_point("1 2\n", 2, Axis::kLinear));
  EXPECT_TRUE(has_point("\n1 nan 0\n2 nan -3\n", 3, Axis::kLinear));
  EXPECT_TRUE(has_point("1 0\n2 1e-30\n", 2, Axis::kLogarithmic));
  for (const char* rows : {"", "\n\n", "1\n2\n", "1 nan\n", "nan 1\n", "1 inf\n", "1 -inf\n", "# 1 2\n"})
    EXPECT_FALSE(has_point(rows, 2, Axis::kLinear)) << rows;
  for (const char* rows : {"1 0\n", "1 -2\n", "1 -nan\n"}) EXPECT_FALSE(has_point(rows, 2, Axis::kLogarithmic)) << rows;
}

constexpr char kStyle[] = " with lines title 'seen'";

TEST(Figure, LeavesOutCurvesAndPanelsWithoutAPoint) {
  VERIFIES("LASSO-MDT-030~1");
  Plotter plotter(testing::TempDir());
  Drawing drawing(plotter);
  drawing.set("set multiplot layout 1,3\n");
  drawing.plot({{"1 nan\n", 2, " with lines title 'unseen'"}, {"1 1\n2 3\n", 2, kStyle}}, "no point");
  drawing.plot({{"1 0\n", 2, kStyle}}, "nothing here", Axis::kLogarithmic);
  drawing.plot({{"", 2, kStyle}}, "nor here");
  const std::string svg = drawing.svg(600, 200);
  EXPECT_EQ(plotter.missing(), "");
  EXPECT_EQ(svg.find("<svg"), 0U) << svg;
  EXPECT_NE(svg.find("seen"), std::string::npos);
  EXPECT_EQ(svg.find("unseen"), std::string::npos);
  EXPECT_NE(svg.find("nothing here"), std::string::npos);
  EXPECT_NE(svg.find("nor here"), std::string::npos);
}

TEST(Figure, WithoutAnyPointIsALineThatSaysWhy) {
  VERIFIES("LASSO-MDT-030~1");
  Plotter plotter(testing::TempDir());
  Drawing drawing(plotter);
  drawing.plot({{"", 2, kStyle}}, "every frame is <lost>");
  EXPECT_EQ(drawing.svg(600, 200), "<p class='missing'>Nothing to draw: every frame is &lt;lost&gt;.</p>");
  EXPECT_EQ(plotter.missing(), "");
}

TEST(Figure, ThatGnuplotRefusesIsALineWithItsReason) {
  VERIFIES("LASSO-MDT-030~1");
  Plotter plotter(testing::TempDir());
  Drawing drawing(plotter);
  drawing.set("set no_such_thing\n");
  drawing.plot({{"1 1\n2 3\n", 2, kStyle}}, "no point");
  const std::string html = drawing.svg(600, 200);
  EXPECT_EQ(html.find("<p class='missing'>This figure is missing: gnuplot failed (code 1): "), 0U) << html;
  EXPECT_NE(plotter.missing().find("nrecognized option"), std::string::npos) << plotter.missing();
  EXPECT_EQ(plotter.missing().find('\n'), std::string::npos);
}

TEST(Figure, WithoutAFolderIsMissing) {
  VERIFIES("LASSO-MDT-030~1");
  Plotter plotter("/no such folder");
  Drawing drawing(plotter);
  drawing.plot({{"1 1\n2 3\n", 2, kStyle}}, "no point");
  EXPECT_NE(drawing.svg(600, 200).find("No such file or directory"), std::string::npos);
  EXPECT_THROW(plotter.png(10, 10, 1, "plot x\n"), PictureError);
}

TEST(Label, HasNothingThatGnuplotReads) { EXPECT_EQ(plain("a_b{c}'d\"\\e^2"), "a b c  d  e 2"); }

}  // namespace
}  // namespace lasso::mdat
