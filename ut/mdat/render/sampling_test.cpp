#include "mdat/render/sampling.hpp"

#include <gtest/gtest.h>

#include <set>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(PixelSamples, TakeEachCellOnceInAnOrderOfTheirOwn) {
  VERIFIES("LASSO-PIC-002~1");
  std::set<int> first_cells;
  for (std::uint64_t pixel = 0; pixel < 200; ++pixel) {
    const PixelSamples samples(pixel, 3);
    std::set<int> cells;
    for (int i = 0; i < samples.count(); ++i) {
      const UnitSquare at = samples.at(i, 4);
      ASSERT_GE(std::min(at.u, at.v), 0);
      ASSERT_LT(std::max(at.u, at.v), 1);
      cells.insert(static_cast<int>(3 * at.u) + 3 * static_cast<int>(3 * at.v));
      if (i == 0) first_cells.insert(*cells.begin());
    }
    EXPECT_EQ(cells.size(), 9U) << pixel;
  }
  EXPECT_EQ(first_cells.size(), 9U);
}

TEST(PixelSamples, DifferByPurposeAndPixelAndAreTheSameAgain) {
  VERIFIES("LASSO-PIC-002~1");
  EXPECT_EQ(PixelSamples(5, 4).at(7, 1).u, PixelSamples(5, 4).at(7, 1).u);
  EXPECT_NE(PixelSamples(5, 4).at(7, 1).u, PixelSamples(5, 4).at(7, 2).u);
  EXPECT_NE(PixelSamples(5, 4).at(7, 1).u, PixelSamples(6, 4).at(7, 1).u);
}

TEST(PixelSamples, AreUniform) {
  VERIFIES("LASSO-PIC-002~1");
  double sum_u = 0, sum_uv = 0;
  constexpr int kPixels = 20000;
  for (int pixel = 0; pixel < kPixels; ++pixel) {
    const UnitSquare at = PixelSamples(static_cast<std::uint64_t>(pixel), 1).at(0, 3);
    sum_u += at.u / kPixels;
    sum_uv += at.u * at.v / kPixels;
  }
  EXPECT_NEAR(sum_u, 0.5, 0.01);  // five sigma
  EXPECT_NEAR(sum_uv, 0.25, 0.01);
}

}  // namespace
}  // namespace lasso::mdat
