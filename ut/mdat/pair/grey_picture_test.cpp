#include "mdat/pair/grey_picture.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include "ut/mdat/pair/scratch.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// By libpng's simple interface, which the reader does not use.
void write_by_library(const std::filesystem::path& file, png_uint_32 format, int width, int height, const void* pixels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = format;
  ASSERT_NE(png_image_write_to_file(&image, file.c_str(), 0, pixels, 0, nullptr), 0);
}

TEST(GreyPicture, WhatIsWrittenIsRead) {
  VERIFIES("LASSO-STE-007~1");
  const Scratch scratch;
  GreyPicture<std::uint8_t> eight{5, 3, {}};
  GreyPicture<std::uint16_t> sixteen{3, 5, {}};
  for (int i = 0; i < 15; ++i) {
    eight.codes.push_back(static_cast<std::uint8_t>(17 * i));
    sixteen.codes.push_back(static_cast<std::uint16_t>(4369 * i));
  }
  const auto read8 = read_grey_png(scratch.write("8.png", grey_png(eight)));
  const auto read16 = read_grey16_png(scratch.write("16.png", grey_png(sixteen)));
  EXPECT_EQ(read8.codes, eight.codes);
  EXPECT_EQ(read8.width, 5);
  EXPECT_EQ(read8.height, 3);
  EXPECT_EQ(read16.codes, sixteen.codes);
  EXPECT_EQ(read16.width, 3);
}

TEST(GreyPicture, ColoursBecomeGreyAsTheEyeSeesThem) {
  VERIFIES("LASSO-STE-007~1");
  const Scratch scratch;
  const std::uint8_t pixels[] = {200, 0, 0, 0, 200, 0, 0, 0, 200, 90, 90, 90};
  write_by_library(scratch / "c.png", PNG_FORMAT_RGB, 2, 2, pixels);
  const auto read = read_grey_png(scratch / "c.png");
  ASSERT_EQ(read.codes.size(), 4U);
  EXPECT_EQ(read.codes[3], 90);
  EXPECT_GT(read.codes[1], read.codes[0]);
  EXPECT_GT(read.codes[0], read.codes[2]);
}

TEST(GreyPicture, RefusesWithTheFileAndWhatIsExpected) {
  VERIFIES("LASSO-STE-007~1");
  const Scratch scratch;
  const GreyPicture<std::uint16_t> sixteen{4, 4, std::vector<std::uint16_t>(16, 1000)};
  const GreyPicture<std::uint8_t> eight{64, 64, std::vector<std::uint8_t>(4096, 7)};
  scratch.write("16.png", grey_png(sixteen));
  scratch.write("cut.png", grey_png(eight).substr(0, 60));
  scratch.write("text.png", "hello");
  scratch.write("8.png", grey_png(eight));
  const auto refusal = [&](const char* name) { return said_by([&] { static_cast<void>(read_grey_png(scratch / name)); }); };
  EXPECT_NE(refusal("16.png").find("16 bits: expected 8"), std::string::npos) << refusal("16.png");
  EXPECT_NE(refusal("cut.png").find("cut.png: cannot be read as a picture"), std::string::npos) << refusal("cut.png");
  EXPECT_NE(refusal("text.png").find("expected a PNG"), std::string::npos) << refusal("text.png");
  EXPECT_NE(refusal("none.png").find("cannot be read"), std::string::npos);
  EXPECT_NE(said_by([&] { static_cast<void>(read_grey16_png(scratch / "8.png")); }).find("not 16-bit grey"), std::string::npos);
}

}  // namespace
}  // namespace lasso::mdat
