// The pixels of a PNG file, by libpng's simplified interface, which mdat does not use.
#pragma once

#include <gtest/gtest.h>
#include <png.h>

#include <string>

#include "mdat/render/picture.hpp"

namespace lasso::mdat {

inline Picture decoded(const std::string& bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) {
    ADD_FAILURE() << image.message;
    return {1, 1};
  }
  image.format = PNG_FORMAT_RGB;
  Picture picture(static_cast<int>(image.width), static_cast<int>(image.height));
  EXPECT_NE(png_image_finish_read(&image, nullptr, picture.pixels.data(), 0, nullptr), 0) << image.message;
  return picture;
}

}  // namespace lasso::mdat
