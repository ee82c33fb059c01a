#include "hal_sim/depth_image.hpp"

#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstring>
#include <vector>

#include "hal_sim/scan_text.hpp"

namespace lasso::sim {
namespace {

constexpr std::size_t kMostPixels = std::size_t{1} << 24;  // 4096 by 4096: as rays they take 0.7 GB
constexpr std::size_t kMostPixelsAByte = 600;              // of a file: its compression makes 1032 bytes of one at most

struct Source {
  std::string_view bytes;
  std::size_t at = 0;
  char error[80] = "";
};

struct Grey16 {
  png_uint_32 width = 0, height = 0;
  std::vector<std::uint16_t> values;
};

void read_bytes(png_structp png, png_bytep out, std::size_t count) {
  Source& source = *static_cast<Source*>(png_get_io_ptr(png));
  if (count > source.bytes.size() - source.at) png_error(png, "it is cut off");
  std::memcpy(out, source.bytes.data() + source.at, count);
  source.at += count;
}

void keep_error(png_structp png, png_const_charp what) {
  Source& source = *static_cast<Source*>(png_get_error_ptr(png));
  std::strncpy(source.error, what, sizeof source.error - 1);
  longjmp(png_jmpbuf(png), 1);  // the library's way out of itself: it is C
}

void be_silent(png_structp, png_const_charp) {}

void read_rows(png_structp png, png_infop info, Grey16& image) {
  png_read_info(png, info);
  image.width = png_get_image_width(png, info);
  image.height = png_get_image_height(png, info);
  if (png_get_bit_depth(png, info) != 16 || png_get_color_type(png, info) != PNG_COLOR_TYPE_GRAY)
    png_error(png, "it is not 16-bit greyscale");
  if (image.width > kMostPixels / image.height) png_error(png, "it has more than 16777216 pixels");
  const Source& source = *static_cast<const Source*>(png_get_io_ptr(png));
  if (image.width > kMostPixelsAByte * source.bytes.size() / image.height) png_error(png, "it has more pixels than its bytes can hold");
  png_set_swap(png);  // to the machine's order, which is little endian (checked below)
  const int passes = png_set_interlace_handling(png);
  png_read_update_info(png, info);
  image.values.resize(std::size_t{image.width} * image.height);
  for (int pass = 0; pass < passes; ++pass) {
    for (png_uint_32 row = 0; row < image.height; ++row) {
      png_read_row(png, reinterpret_cast<png_bytep>(image.values.data() + std::size_t{row} * image.width), nullptr);
    }
  }
}

// False with the library's own words in the source. Nothing with a destructor lives in the frames that are left by its longjmp.
bool decode(png_structp png, png_infop info, Grey16& image) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  read_rows(png, info, image);
  return true;
}

Grey16 grey16_of(const std::string& file, std::string_view bytes) {
  Source source{bytes};
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, keep_error, be_silent);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  if (info == nullptr) fail(file, "cannot be read: no memory");
  png_set_read_fn(png, &source, read_bytes);
  Grey16 image;
  const bool whole = decode(png, info, image);
  png_destroy_read_struct(&png, &info, nullptr);
  if (!whole) fail(file, std::string("cannot be read as a depth image: ") + source.error + "; expected a PNG of 16-bit greyscale");
  return image;
}

}  // namespace

RawScan read_depth_image(const std::string& file, std::string_view bytes, const DepthCamera& camera) {
  static_assert(std::endian::native == std::endian::little);
  const Grey16 image = grey16_of(file, bytes);
  RawScan scan;
  scan.file = file;
  scan.misses_known = true;
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const std::size_t row = i / image.width;
    const double u = static_cast<double>(i % image.width), v = static_cast<double>(row);
    const Vec3 ray((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1);
    if (image.values[i] == 0) {
      scan.add_miss(ray.normalized(), 0, i + 1);
    } else {
      scan.add_point(camera.scale_m * image.values[i] * (camera.along_ray ? ray.normalized() : ray), 0, i + 1);
    }
  }
  return scan;
}

}  // namespace lasso::sim
