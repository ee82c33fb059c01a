#include "mdat/stereo/blur.hpp"

#include <gtest/gtest.h>

#include "ut/mdat/stereo/images.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(Blur, IsThatOfTheTwoDimensionalKernel) {
  VERIFIES("LASSO-STE-001~1");
  GreyImage image = even(23, 17, 0);
  for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = static_cast<double>((i * 7919) % 101);
  const double sigma = 1.3;
  const GreyImage blurred = gaussian_blur(image, sigma);
  double sum = 0;  // of the kernel, by brute force
  for (int y = -6; y <= 6; ++y) {
    for (int x = -6; x <= 6; ++x) sum += std::exp(-0.5 * (x * x + y * y) / (sigma * sigma));
  }
  for (const auto& [row, column] : {std::pair{8, 11}, std::pair{0, 3}, std::pair{16, 22}}) {
    double expected = 0;
    for (int y = -6; y <= 6; ++y) {
      for (int x = -6; x <= 6; ++x) {
        const int r = row + y, c = column + x;
        if (r < 0 || c < 0 || r >= 17 || c >= 23) continue;
        expected += image.values[static_cast<std::size_t>(r * 23 + c)] * std::exp(-0.5 * (x * x + y * y) / (sigma * sigma)) / sum;
      }
    }
    EXPECT_NEAR(blurred.values[static_cast<std::size_t>(row * 23 + column)], expected, 1e-9);
  }
}

TEST(Blur, NoneIsNone) {
  VERIFIES("LASSO-STE-001~1");
  const GreyImage image = even(3, 2, 4);
  EXPECT_EQ(gaussian_blur(image, 0).values, image.values);
}

TEST(Blur, BlocksAreMeansAndComeBackSmoothly) {
  VERIFIES("LASSO-STE-001~1");
  GreyImage ramp = even(32, 24, 0);
  for (int row = 0; row < 24; ++row) {
    for (int column = 0; column < 32; ++column) ramp.values[static_cast<std::size_t>(row * 32 + column)] = 2.0 * column - row;
  }
  const GreyImage small = reduced(ramp, 8);
  ASSERT_EQ(small.width, 4);
  ASSERT_EQ(small.height, 3);
  EXPECT_DOUBLE_EQ(small.values[5], 2 * 11.5 - 11.5);
  const GreyImage back = enlarged(small, 8, 32, 24);
  for (int row = 4; row < 20; ++row) {
    for (int column = 4; column < 28; ++column) {
      const auto at = static_cast<std::size_t>(row * 32 + column);
      EXPECT_NEAR(back.values[at], ramp.values[at], 1e-9);
    }
  }
}

TEST(Blur, BlocksThatAreCutOffCountAsBlackBeyondTheEdge) {
  VERIFIES("LASSO-STE-001~1");
  const GreyImage small = reduced(even(10, 8, 1), 8);
  ASSERT_EQ(small.width, 2);
  EXPECT_DOUBLE_EQ(small.values[1], 0.25);
}

}  // namespace
}  // namespace lasso::mdat
