#include "mdat/stereo/disparity_view.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>

#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

constexpr Pixel kHole = {40, 40, 43}, kLegendPaper = {24, 27, 33}, kLegendInk = {226, 231, 238};
// Far to near: the stops of Turbo (Mikhailov 2019), thinned.
constexpr Pixel kFarNear[] = {{48, 18, 59},   {70, 107, 227}, {40, 187, 236}, {49, 242, 153},
                              {162, 252, 60}, {237, 208, 58}, {251, 128, 34}, {210, 49, 5}};
constexpr Pixel kFarToNear[] = {{18, 87, 176}, {120, 180, 235}, {232, 232, 228}, {240, 150, 100}, {190, 30, 35}};  // of errors
constexpr Pixel kWrong = {235, 40, 220};
constexpr int kMargin_px = 12, kBar_px = 14;
constexpr double kLeftOut = 0.01;  // of the disparities at either end of the scale

// Of a scale from 0 to 1 whose colours are evenly spaced.
Pixel colour_at(std::span<const Pixel> scale, double share) {
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(scale.size() - 1);
  const auto low = std::min(scale.size() - 2, static_cast<std::size_t>(place));
  Pixel colour{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double a = scale[low][c], b = scale[low + 1][c];
    colour[c] = static_cast<std::uint8_t>(std::lround(a + (place - static_cast<double>(low)) * (b - a)));
  }
  return colour;
}

struct Span_px {
  double low = 0, high = 0;
};

Span_px span_of(const DisparityMap& map) {
  std::vector<std::uint16_t> codes;
  std::copy_if(map.codes.codes.begin(), map.codes.codes.end(), std::back_inserter(codes), [](std::uint16_t code) { return code > 0; });
  if (codes.empty()) return {};
  std::sort(codes.begin(), codes.end());
  const auto skipped = static_cast<std::size_t>(kLeftOut * static_cast<double>(codes.size()));
  return {static_cast<double>(codes[skipped]) / kDisparitySteps, static_cast<double>(codes[codes.size() - 1 - skipped]) / kDisparitySteps};
}

struct LegendText {
  std::string title, low, middle, high;
};

Picture legend_of(int width, std::span<const Pixel> colours, const LegendText& text) {
  const int scale = width >= 640 ? 2 : 1, line = kLetterHeight * scale + 4;
  Picture legend(width, 2 * line + kBar_px + 2 * kMargin_px, kLegendPaper);
  const int length = width - 2 * kMargin_px, row = kMargin_px + line + kBar_px + 4;
  write(legend, kMargin_px, kMargin_px, text.title, kLegendInk, scale);
  for (int i = 0; i < length && !text.low.empty(); ++i)
    fill(legend, kMargin_px + i, kMargin_px + line, 1, kBar_px, colour_at(colours, static_cast<double>(i) / std::max(1, length - 1)));
  write(legend, kMargin_px, row, text.low, kLegendInk, scale);
  write(legend, (width - text_width(text.middle, scale)) / 2, row, text.middle, kLegendInk, scale);
  write(legend, width - kMargin_px - text_width(text.high, scale), row, text.high, kLegendInk, scale);
  return legend;
}

LegendText depth_text(const DisparityMap& map, const Span_px& span) {
  if (span.high <= 0) return {"nothing was matched", "", "", ""};
  const auto depth = [&](double disparity_px) { return decimals(map.focal_px * map.baseline_m / disparity_px, 2); };
  return {"depth along the boresight, m (grey: none)", depth(span.low), depth(0.5 * (span.low + span.high)), depth(span.high)};
}

void append_float(std::string& bytes, double value) {
  static_assert(std::endian::native == std::endian::little);
  const auto single = static_cast<float>(value);
  char raw[sizeof single];
  std::memcpy(raw, &single, sizeof single);
  bytes.append(raw, sizeof raw);
}

}  // namespace

Picture disparity_view(const DisparityMap& map) {
  const Span_px span = span_of(map);
  Picture picture(map.codes.width, map.codes.height, kHole);
  for (std::size_t i = 0; i < map.codes.codes.size(); ++i) {
    if (map.codes.codes[i] == 0) continue;
    picture.pixels[i] = colour_at(kFarNear, span.high > span.low ? (map.disparity_px(i) - span.low) / (span.high - span.low) : 1);
  }
  return stacked(picture, legend_of(map.codes.width, kFarNear, depth_text(map, span)));
}

Picture error_view(const DisparityMap& map, const std::vector<double>& truth_px) {
  Picture picture(map.codes.width, map.codes.height, kHole);
  for (std::size_t i = 0; i < map.codes.codes.size(); ++i) {
    if (map.codes.codes[i] == 0) continue;
    const double error_px = map.disparity_px(i) - truth_px[i];
    picture.pixels[i] = std::fabs(error_px) > 1 ? kWrong : colour_at(kFarToNear, 0.5 + 0.5 * error_px);
  }
  return stacked(picture, legend_of(map.codes.width, kFarToNear, {"disparity minus the true one, px (magenta: more)", "-1", "0", "+1"}));
}

std::string range_ply(const DisparityMap& map) {
  const auto count = map.codes.codes.size() - static_cast<std::size_t>(std::count(map.codes.codes.begin(), map.codes.codes.end(), 0));
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\ncomment left camera's frame, metres: x right, y down, z ahead\nelement vertex " +
      std::to_string(count) + "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  for (int row = 0; row < map.codes.height; ++row) {
    for (int column = 0; column < map.codes.width; ++column) {
      if (map.codes.codes[map.index(column, row)] == 0) continue;
      const Vec3 point = map.point_m(column, row);
      for (int axis = 0; axis < 3; ++axis) append_float(bytes, point[axis]);
    }
  }
  return bytes;
}

}  // namespace lasso::mdat
