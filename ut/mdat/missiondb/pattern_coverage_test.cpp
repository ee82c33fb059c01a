#include "mdat/missiondb/pattern_coverage.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

MissionParameters pattern(PatternKind kind, double points, double a, double b) {
  MissionParameters p = preset_parameters();
  p.pattern = static_cast<double>(kind);
  p.points = points;
  p.cycles_a = a;
  p.cycles_b = b;
  return p;
}

TEST(PatternCoverage, LinesLeaveHalfTheirDistance) {
  VERIFIES("LASSO-GND-060~1");
  // Lines of a raster lie in the middle of equal strips; their rays are close here.
  EXPECT_NEAR(largest_gap(pattern(PatternKind::kRaster, 1024, 2, 1)), 0.5, 0.02);
  EXPECT_NEAR(largest_gap(pattern(PatternKind::kRaster, 1024, 5, 1)), 0.2, 0.02);
}

TEST(PatternCoverage, AnEvenRasterLeavesAsMuchAsASquareLattice) {
  VERIFIES("LASSO-GND-060~1");
  EXPECT_NEAR(even_gap(1024), std::sqrt(2.0) / 32, 1e-12);  // half the diagonal of a cell of 2/32
  EXPECT_NEAR(largest_gap(pattern(PatternKind::kRaster, 1024, 32, 1)), even_gap(1024), 0.02);
}

TEST(PatternCoverage, ALissajousFigureLeavesMoreThanARosette) {
  VERIFIES("LASSO-GND-060~1");
  const double rosette = largest_gap(pattern(PatternKind::kRosette, 1024, 19, 12));
  EXPECT_NEAR(rosette, 0.083, 0.01);
  EXPECT_GT(largest_gap(pattern(PatternKind::kLissajous, 1024, 19, 12)), 1.4 * rosette);
}

TEST(PatternCoverage, AimedRaysAreNotOfThePattern) {
  VERIFIES("LASSO-GND-060~1");
  MissionParameters p = pattern(PatternKind::kRaster, 1024, 16, 1);
  p.aimed_share = 0.25;
  EXPECT_EQ(pattern_rays(p), 768);
  EXPECT_EQ(pattern_of(p, 0).points, 768);
}

TEST(PatternCoverage, APlanThatIsRefusedHasNone) {
  VERIFIES("LASSO-GND-060~1");
  EXPECT_EQ(largest_gap(pattern(PatternKind::kRosette, 1024, 18, 12)), 0);
}

}  // namespace
}  // namespace lasso::mdat
