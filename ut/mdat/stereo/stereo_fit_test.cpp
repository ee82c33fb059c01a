#include "mdat/stereo/stereo_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// 200 pixels of one level: every fourth without a disparity, errors evenly from -1 to 1.
FitCounts some_counts(PixelRegion region, double level) {
  FitCounts counts;
  for (int i = 0; i < 200; ++i) {
    const double error_px = -1 + 2.0 * i / 199;
    counts.add({region, 20, 30, level}, i % 4 == 0 ? 0 : 20 + error_px);
  }
  return counts;
}

TEST(StereoFit, HasTheSharesAndTheDistributionOfWhatWasCounted) {
  VERIFIES("LASSO-STE-015~1");
  const StereoFit fit = some_counts(PixelRegion::kInside, 0.5).fit();
  const RegionFit& inside = fit[static_cast<std::size_t>(PixelRegion::kInside)];
  for (const double valid : inside.valid) EXPECT_NEAR(valid, 0.75, 1e-12) << "levels without pixels are as the nearest";
  EXPECT_EQ(inside.spread, 0);
  EXPECT_TRUE(std::is_sorted(inside.errors_px[1].begin(), inside.errors_px[1].end()));
  for (const double share : {0.1, 0.33, 0.5, 0.9}) EXPECT_NEAR(fitted_error_px(inside, 0.5, share), -1 + 2 * share, 0.02) << share;
  EXPECT_NEAR(fitted_error_px(inside, 0.1, 0), inside.errors_px[1].front(), 1e-12) << "a group without pixels, too";
  EXPECT_NEAR(fitted_error_px(inside, 0.9, 1), inside.errors_px[1].back(), 1e-12);
}

TEST(StereoFit, TellsWhatIsSpreadOverAnEdge) {
  VERIFIES("LASSO-STE-015~1");
  FitCounts counts;
  for (int i = 0; i < 100; ++i) counts.add({PixelRegion::kFarEdge, 20, 30, 0.5}, i < 30 ? 30.1 : 19.9);
  const RegionFit edge = counts.fit()[static_cast<std::size_t>(PixelRegion::kFarEdge)];
  EXPECT_NEAR(edge.spread, 0.3, 1e-12);
  EXPECT_NEAR(edge.errors_px[1].front(), -0.1, 1e-9);
  EXPECT_NEAR(edge.errors_px[1].back(), 0.1, 1e-9);
}

TEST(StereoFit, ThePresetIsADistributionInEachRegion) {
  VERIFIES("LASSO-STE-015~1");
  for (const RegionFit& region : preset_fit()) {
    for (const double valid : region.valid) EXPECT_TRUE(valid >= 0 && valid <= 1);
    for (const auto& errors_px : region.errors_px) EXPECT_TRUE(std::is_sorted(errors_px.begin(), errors_px.end()));
  }
  const RegionFit& inside = preset_fit()[static_cast<std::size_t>(PixelRegion::kInside)];
  EXPECT_LT(inside.valid.front(), 0.5 * inside.valid[kFitLevels / 2]) << "what is dark is not matched";
  EXPECT_NE(fit_text(preset_fit()).find("{{"), std::string::npos);
}

}  // namespace
}  // namespace lasso::mdat
