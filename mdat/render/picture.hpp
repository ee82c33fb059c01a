// Pictures as people and programs open them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace lasso::mdat {

using Pixel = std::array<std::uint8_t, 3>;  // red, green, blue; sRGB

// Row by row from the top.
struct Picture {
  Picture(int picture_width, int picture_height, const Pixel& fill = {})
      : width(picture_width),
        height(picture_height),
        pixels(static_cast<std::size_t>(picture_width) * static_cast<std::size_t>(picture_height), fill) {}
  int width, height;
  std::vector<Pixel> pixels;

  Pixel& at(int column, int row) {
    return pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)];
  }
  bool has(int column, int row) const { return column >= 0 && row >= 0 && column < width && row < height; }
};

// PNG files: the same bytes for the same pixels, of one version of libpng and zlib. No time is written. Throws std::runtime_error.
std::string png_bytes(const Picture& picture);
// 16-bit greyscale, `values` row by row.
std::string png_bytes(int width, int height, const std::vector<std::uint16_t>& values);

// Fills what of the rectangle lies in the picture.
void fill(Picture& picture, int left, int top, int width, int height, const Pixel& colour);

// Text of printable ASCII (other characters are shown as ?), its upper left corner at (left, top); each dot is `scale` pixels wide.
// What does not fit into the picture is not drawn.
void write(Picture& picture, int left, int top, const std::string& text, const Pixel& colour, int scale);
constexpr int kLetterWidth = 6, kLetterHeight = 9;  // with the gap to the next one, in dots
inline int text_width(const std::string& text, int scale) { return scale * kLetterWidth * static_cast<int>(text.size()); }

// Pictures of one width below each other.
Picture stacked(const Picture& above, const Picture& below);

}  // namespace lasso::mdat
