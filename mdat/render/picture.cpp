#include "mdat/render/picture.hpp"

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <stdexcept>

namespace lasso::mdat {
namespace {

struct Sink {
  std::string bytes;
  char error[80] = "";
};

void take_bytes(png_structp png, png_bytep data, std::size_t count) {
  static_cast<Sink*>(png_get_io_ptr(png))->bytes.append(reinterpret_cast<const char*>(data), count);
}
void flush_nothing(png_structp) {}
void take_error(png_structp png, png_const_charp what) {
  Sink& sink = *static_cast<Sink*>(png_get_error_ptr(png));
  std::strncpy(sink.error, what, sizeof sink.error - 1);
  longjmp(png_jmpbuf(png), 1);  // the library's way out of itself: it is C
}
void take_warning(png_structp, png_const_charp) {}

// A picture's rows as the file has them.
struct PngRows {
  png_uint_32 width, height;
  int bit_depth, colour_type;
  std::size_t row_bytes;
  const std::uint8_t* bytes;
};

// In a function of its own: a longjmp passes over nothing that has to be destroyed.
void write_rows(png_structp png, png_infop info, const PngRows& rows) {
  png_set_IHDR(png, info, rows.width, rows.height, rows.bit_depth, rows.colour_type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(png, 6);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_ALL_FILTERS);
  png_write_info(png, info);
  for (png_uint_32 row = 0; row < rows.height; ++row) png_write_row(png, rows.bytes + row * rows.row_bytes);
  png_write_end(png, nullptr);
}

bool write_png(Sink& sink, const PngRows& rows) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink, take_error, take_warning);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  if (info == nullptr) throw std::runtime_error("PNG: no memory");
  if (setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_set_write_fn(png, &sink, take_bytes, flush_nothing);
  write_rows(png, info, rows);
  png_destroy_write_struct(&png, &info);
  return true;
}

std::string png_of(const PngRows& rows) {
  Sink sink;
  if (!write_png(sink, rows)) throw std::runtime_error(std::string("PNG: ") + sink.error);
  return sink.bytes;
}

}  // namespace

std::string png_bytes(const Picture& picture) {
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(picture.width);
  return png_of({static_cast<png_uint_32>(picture.width), static_cast<png_uint_32>(picture.height), 8, PNG_COLOR_TYPE_RGB, row_bytes,
                 picture.pixels.front().data()});
}

std::string png_bytes(int width, int height, const std::vector<std::uint16_t>& values) {
  std::vector<std::uint8_t> bytes;
  for (const std::uint16_t value : values) {  // the most significant byte first, whatever the machine
    bytes.push_back(static_cast<std::uint8_t>(value >> 8));
    bytes.push_back(static_cast<std::uint8_t>(value & 255));
  }
  return png_of({static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), 16, PNG_COLOR_TYPE_GRAY,
                 2 * static_cast<std::size_t>(width), bytes.data()});
}

void fill(Picture& picture, int left, int top, int width, int height, const Pixel& colour) {
  for (int row = std::max(0, top); row < std::min(picture.height, top + height); ++row) {
    for (int column = std::max(0, left); column < std::min(picture.width, left + width); ++column) picture.at(column, row) = colour;
  }
}

Picture stacked(const Picture& above, const Picture& below) {
  Picture picture(above.width, above.height + below.height);
  std::copy(above.pixels.begin(), above.pixels.end(), picture.pixels.begin());
  std::copy(below.pixels.begin(), below.pixels.end(), picture.pixels.begin() + static_cast<std::ptrdiff_t>(above.pixels.size()));
  return picture;
}

}  // namespace lasso::mdat
