#include "mdat/stereo/exposure_control.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ut/mdat/stereo/images.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// A quarter of the picture is lit, from 0.5 to 1.5 times `radiance`; the rest is sky.
GreyImage lit_target(double radiance) {
  GreyImage image = even(120, 120, 0);
  for (int row = 0; row < 60; ++row) {
    for (int column = 0; column < 60; ++column)
      image.values[static_cast<std::size_t>(row * 120 + column)] = radiance * (0.5 + (row * 60 + column) / 3599.0);
  }
  return image;
}

// Share of the full well below which 90 % of the lit quarter lie.
double ninety_percent_level(const RawFrame& frame) {
  std::vector<std::uint16_t> lit;
  for (std::size_t i = 0; i < frame.numbers.size(); ++i) {
    if (i % 120 < 60 && i / 120 < 60) lit.push_back(frame.numbers[i]);
  }
  std::nth_element(lit.begin(), lit.begin() + 3240, lit.end());
  return lit[3240] / 4095.0;
}

TEST(ExposureControl, PutsNinetyPercentOfTheLitBelowSixTenthsOfTheFullWell) {
  VERIFIES("LASSO-STE-003~1");
  const Imager imager;
  for (const double radiance : {0.3, 3.0, 300.0}) {
    const GreyImage image = lit_target(radiance);
    const double exposure_s = settled_exposure_s(image, imager, {1, 1});
    EXPECT_NEAR(ninety_percent_level(exposed(image, imager, exposure_s, {1, 9})), 0.6, 0.02) << radiance;
  }
}

TEST(ExposureControl, KeepsItsLimits) {
  VERIFIES("LASSO-STE-003~1");
  const Imager imager;
  EXPECT_EQ(settled_exposure_s(even(20, 20, 0), imager, {1, 1}), kLongest_s);
  EXPECT_EQ(settled_exposure_s(even(20, 20, 1e9), imager, {1, 1}), kShortest_s);
}

// The light grows by a thousand while frames take effect late: each asks from what it was exposed with.
TEST(ExposureControl, DoesNotOscillateWithALateMeasurement) {
  VERIFIES("LASSO-STE-003~1");
  const Imager imager;
  for (const int delay : {0, 1, 2}) {
    std::vector<double> exposures(static_cast<std::size_t>(delay) + 1, settled_exposure_s(lit_target(0.3), imager, {1, 1}));
    std::vector<bool> good;
    for (int frame = 0; frame < 24; ++frame) {
      const RawFrame raw =
          exposed(lit_target(300), imager, exposures[static_cast<std::size_t>(frame)], {1, static_cast<std::uint64_t>(frame)});
      const double level = ninety_percent_level(raw);
      good.push_back(level > 0.4 && level < 0.8);
      exposures.push_back(next_exposure_s(raw, imager));
    }
    const auto settled = std::find(good.begin(), good.end(), true);
    EXPECT_LE(settled - good.begin(), 4 * (delay + 1)) << delay;
    EXPECT_TRUE(std::all_of(good.begin() + 4 * (delay + 1), good.end(), [](bool value) { return value; })) << delay;
  }
}

TEST(ExposureControl, CountsWhatIsSaturated) {
  VERIFIES("LASSO-STE-003~1");
  const RawFrame frame{2, 2, 1e-3, {4095, 0, 4094, 4095}};
  EXPECT_DOUBLE_EQ(saturated_share(frame, Imager{}), 0.5);
}

}  // namespace
}  // namespace lasso::mdat
