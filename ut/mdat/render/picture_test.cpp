#include "mdat/render/picture.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "hal_sim/depth_image.hpp"
#include "ut/mdat/render/decoded_png.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

Picture gradient(int width, int height) {
  Picture picture(width, height);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      picture.at(column, row) = {static_cast<std::uint8_t>(3 * column), static_cast<std::uint8_t>(5 * row),
                                 static_cast<std::uint8_t>(column * row)};
    }
  }
  return picture;
}

TEST(Picture, PngHoldsItsPixels) {
  VERIFIES("LASSO-PIC-001~1");
  const Picture picture = gradient(67, 31), read = decoded(png_bytes(picture));
  EXPECT_EQ(read.width, 67);
  EXPECT_EQ(read.height, 31);
  EXPECT_EQ(read.pixels, picture.pixels);
}

TEST(Picture, TheSamePixelsAreTheSameBytes) {
  VERIFIES("LASSO-PIC-002~1");
  const std::string bytes = png_bytes(gradient(40, 40));
  EXPECT_EQ(bytes, png_bytes(gradient(40, 40)));
  for (const char* chunk : {"tIME", "tEXt", "zTXt", "iTXt", "eXIf"}) EXPECT_EQ(bytes.find(chunk), std::string::npos) << chunk;
}

TEST(Picture, SixteenBitsAreReadAsDepthCamerasWriteThem) {
  VERIFIES("LASSO-PIC-008~1");
  const std::string bytes = png_bytes(3, 2, {0, 1000, 65535, 258, 4000, 5});
  sim::DepthCamera camera;
  camera.fx = camera.fy = 100;
  camera.cx = 1;
  camera.cy = 0.5;
  camera.scale_m = 1e-3;
  camera.along_ray = true;
  const sim::RawScan scan = sim::read_depth_image("test", bytes, camera);
  ASSERT_EQ(scan.rays.size(), 6U);
  EXPECT_NEAR(scan.rays[1].place.norm(), 1.0, 1e-9);
  EXPECT_NEAR(scan.rays[2].place.norm(), 65.535, 1e-9);
  EXPECT_NEAR(scan.rays[3].place.norm(), 0.258, 1e-9);
}

TEST(Picture, SizesThatPngDoesNotKnowAreAnError) {
  VERIFIES("LASSO-PIC-011~1");
  EXPECT_THROW(static_cast<void>(png_bytes(0, 1, {1})), std::runtime_error);
}

TEST(Picture, FillsWhatLiesInIt) {
  VERIFIES("LASSO-PIC-001~1");
  Picture picture(4, 3);
  fill(picture, 2, -5, 10, 6, {9, 8, 7});
  int filled = 0;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      const bool within = column >= 2 && row < 1;
      EXPECT_EQ(picture.at(column, row), within ? (Pixel{9, 8, 7}) : (Pixel{0, 0, 0}));
      filled += within ? 1 : 0;
    }
  }
  EXPECT_EQ(filled, 2);
  EXPECT_TRUE(picture.has(3, 2));
  EXPECT_FALSE(picture.has(4, 2));
}

TEST(Picture, StacksFromTheTop) {
  VERIFIES("LASSO-PIC-001~1");
  Picture above(2, 1, {1, 1, 1});
  const Picture both = stacked(above, Picture(2, 2, {2, 2, 2}));
  EXPECT_EQ(both.height, 3);
  EXPECT_EQ(both.pixels[1], (Pixel{1, 1, 1}));
  EXPECT_EQ(both.pixels[2], (Pixel{2, 2, 2}));
}

}  // namespace
}  // namespace lasso::mdat
