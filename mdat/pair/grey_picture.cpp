#include "mdat/pair/grey_picture.hpp"

#include <png.h>

#include <csetjmp>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace lasso::mdat {
namespace {

constexpr png_uint_32 kMostPixels = 8192;  // along a side

struct PngText {
  std::string bytes;
  std::size_t at = 0;
  char error[96] = "";
};

PngText& text_of(png_structp png) { return *static_cast<PngText*>(png_get_io_ptr(png)); }

void append_bytes(png_structp png, png_bytep data, std::size_t count) {
  text_of(png).bytes.append(reinterpret_cast<const char*>(data), count);
}
void take_next(png_structp png, png_bytep data, std::size_t count) {
  PngText& text = text_of(png);
  if (count > text.bytes.size() - text.at) png_error(png, "it is cut off");
  std::memcpy(data, text.bytes.data() + text.at, count);
  text.at += count;
}
void flush_none(png_structp) {}
void leave(png_structp png, png_const_charp what) {
  PngText& text = *static_cast<PngText*>(png_get_error_ptr(png));
  std::strncpy(text.error, what, sizeof text.error - 1);
  longjmp(png_jmpbuf(png), 1);  // the library's way out of itself: it is C
}
void say_nothing(png_structp, png_const_charp) {}

struct PngLayout {
  png_uint_32 width = 0, height = 0;
  int bits = 8;
  std::size_t row_bytes = 0;
};

// In functions of their own: a longjmp passes over nothing that has to be destroyed.
void put_rows(png_structp png, png_infop info, const PngLayout& layout, const std::uint8_t* bytes) {
  png_set_IHDR(png, info, layout.width, layout.height, layout.bits, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(png, 3);
  png_write_info(png, info);
  for (png_uint_32 row = 0; row < layout.height; ++row) png_write_row(png, bytes + row * layout.row_bytes);
  png_write_end(png, nullptr);
}

void get_rows(png_structp png, png_infop info, int bits, PngLayout& layout, std::vector<std::uint8_t>& bytes) {
  png_read_info(png, info);
  layout.width = png_get_image_width(png, info);
  layout.height = png_get_image_height(png, info);
  const int colours = png_get_color_type(png, info);
  if (bits == 8 && png_get_bit_depth(png, info) > 8) png_error(png, "it has 16 bits: expected 8, grey or colours");
  if (bits == 16 && (png_get_bit_depth(png, info) != 16 || colours != PNG_COLOR_TYPE_GRAY)) png_error(png, "it is not 16-bit grey");
  if (layout.width > kMostPixels || layout.height > kMostPixels) png_error(png, "it has more than 8192 pixels along a side");
  png_set_expand(png);
  png_set_strip_alpha(png);
  if ((colours & PNG_COLOR_MASK_COLOR) != 0) png_set_rgb_to_gray(png, 1, 0.2126, 0.7152);
  const int passes = png_set_interlace_handling(png);
  png_read_update_info(png, info);
  layout.row_bytes = png_get_rowbytes(png, info);
  if (layout.row_bytes != layout.width * static_cast<std::size_t>(bits / 8)) png_error(png, "its colours are of no known kind");
  bytes.resize(layout.row_bytes * layout.height);
  for (int pass = 0; pass < passes; ++pass) {
    for (png_uint_32 row = 0; row < layout.height; ++row) png_read_row(png, bytes.data() + row * layout.row_bytes, nullptr);
  }
}

bool try_put(png_structp png, png_infop info, const PngLayout& layout, const std::uint8_t* bytes) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  put_rows(png, info, layout, bytes);
  return true;
}

bool try_get(png_structp png, png_infop info, int bits, PngLayout& layout, std::vector<std::uint8_t>& bytes) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  get_rows(png, info, bits, layout, bytes);
  return true;
}

std::string written(const PngLayout& layout, const std::uint8_t* bytes) {
  PngText text;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &text, leave, say_nothing);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  if (info == nullptr) throw std::runtime_error("PNG: no memory");
  png_set_write_fn(png, &text, append_bytes, flush_none);
  const bool whole = try_put(png, info, layout, bytes);
  png_destroy_write_struct(&png, &info);
  if (!whole) throw std::runtime_error(std::string("PNG: ") + text.error);
  return text.bytes;
}

PngText content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream bytes;
  if (!in || !(bytes << in.rdbuf())) throw std::runtime_error(file.string() + ": cannot be read");
  PngText text;
  text.bytes = bytes.str();
  return text;
}

std::vector<std::uint8_t> read_codes(const std::filesystem::path& file, int bits, PngLayout& layout) {
  PngText text = content(file);
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &text, leave, say_nothing);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  if (info == nullptr) throw std::runtime_error("PNG: no memory");
  png_set_read_fn(png, &text, take_next);
  std::vector<std::uint8_t> bytes;
  const bool whole = try_get(png, info, bits, layout, bytes);
  png_destroy_read_struct(&png, &info, nullptr);
  if (!whole) throw std::runtime_error(file.string() + ": cannot be read as a picture: " + text.error + "; expected a PNG");
  return bytes;
}

PngLayout layout_of(int width, int height, int bits) {
  return {static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), bits,
          static_cast<std::size_t>(width) * static_cast<std::size_t>(bits / 8)};
}

}  // namespace

std::string grey_png(const GreyPicture<std::uint8_t>& picture) {
  return written(layout_of(picture.width, picture.height, 8), picture.codes.data());
}

std::string grey_png(const GreyPicture<std::uint16_t>& picture) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(2 * picture.codes.size());
  for (const std::uint16_t code : picture.codes) {  // the most significant byte first, whatever the machine
    bytes.push_back(static_cast<std::uint8_t>(code >> 8));
    bytes.push_back(static_cast<std::uint8_t>(code & 255));
  }
  return written(layout_of(picture.width, picture.height, 16), bytes.data());
}

GreyPicture<std::uint8_t> read_grey_png(const std::filesystem::path& file) {
  PngLayout layout;
  std::vector<std::uint8_t> codes = read_codes(file, 8, layout);
  return {static_cast<int>(layout.width), static_cast<int>(layout.height), std::move(codes)};
}

GreyPicture<std::uint16_t> read_grey16_png(const std::filesystem::path& file) {
  PngLayout layout;
  const std::vector<std::uint8_t> bytes = read_codes(file, 16, layout);
  GreyPicture<std::uint16_t> picture{static_cast<int>(layout.width), static_cast<int>(layout.height), {}};
  picture.codes.reserve(bytes.size() / 2);
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) picture.codes.push_back(static_cast<std::uint16_t>(bytes[i] << 8 | bytes[i + 1]));
  return picture;
}

}  // namespace lasso::mdat
