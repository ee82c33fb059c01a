#include "mdat/render/views.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "mdat/common/errors.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

constexpr Pixel kSky = {12, 14, 18}, kPaper = {24, 27, 33}, kInk = {226, 231, 238};
constexpr int kMargin = 12;
constexpr Pixel kNearFar[] = {{38, 28, 92}, {37, 89, 150}, {32, 146, 140}, {120, 196, 92}, {246, 226, 74}};
constexpr Pixel kLowHigh[] = {{18, 87, 176}, {73, 160, 232}, {242, 212, 61}, {239, 125, 43}, {179, 16, 42}};  // as reports have them

Pixel mixed(const Pixel& a, const Pixel& b, double share) {
  Pixel result{};
  for (std::size_t c = 0; c < 3; ++c) result[c] = static_cast<std::uint8_t>(std::lround(a[c] + share * (b[c] - a[c])));
  return result;
}

// Of a scale from 0 to 1 whose colours are evenly spaced.
Pixel on_scale(std::span<const Pixel> colours, double value) {
  const double place = std::clamp(value, 0.0, 1.0) * static_cast<double>(colours.size() - 1);
  const auto low = std::min(colours.size() - 2, static_cast<std::size_t>(place));
  return mixed(colours[low], colours[low + 1], place - static_cast<double>(low));
}

struct ScaleText {
  std::string title, low, middle, high;
};

// A bar of colours with its title above and its ends below.
Picture scale_legend(int width, std::span<const Pixel> colours, const ScaleText& text) {
  const int scale = width >= text_width(text.title, 2) + 2 * kMargin ? 2 : 1, line = kLetterHeight * scale + 4, bar = 8 * scale;
  Picture legend(width, 2 * line + bar + 2 * kMargin, kPaper);
  write(legend, kMargin, kMargin, text.title, kInk, scale);
  const int length = width - 2 * kMargin;
  for (int i = 0; i < length; ++i) {
    fill(legend, kMargin + i, kMargin + line, 1, bar, on_scale(colours, static_cast<double>(i) / std::max(1, length - 1)));
  }
  const int row = kMargin + line + bar + 4;
  write(legend, kMargin, row, text.low, kInk, scale);
  write(legend, (width - text_width(text.middle, scale)) / 2, row, text.middle, kInk, scale);
  write(legend, width - kMargin - text_width(text.high, scale), row, text.high, kInk, scale);
  return legend;
}

struct NamedColour {
  Pixel colour;
  std::string name;
};

// Colours and names, line by line in as many columns as fit.
Picture names_legend(int width, const std::vector<NamedColour>& entries) {
  const int scale = width >= 640 ? 2 : 1, line = kLetterHeight * scale + 4, chip = 8 * scale;
  int longest = 1;
  for (const NamedColour& entry : entries) longest = std::max(longest, text_width(entry.name, scale));
  const int column_width = longest + chip + 3 * kMargin;
  const int columns = std::max(1, (width - kMargin) / column_width);
  const int rows = (static_cast<int>(entries.size()) + columns - 1) / columns;
  Picture legend(width, std::max(1, rows) * line + 2 * kMargin, kPaper);
  for (int i = 0; i < static_cast<int>(entries.size()); ++i) {
    const int left = kMargin + i / std::max(1, rows) * column_width, top = kMargin + i % std::max(1, rows) * line;
    fill(legend, left, top, chip, 7 * scale, entries[static_cast<std::size_t>(i)].colour);
    write(legend, left + chip + kMargin / 2, top, entries[static_cast<std::size_t>(i)].name, kInk, scale);
  }
  return legend;
}

// Colours that differ from their neighbours: hues turn by the golden ratio, brightness takes three steps.
Pixel part_colour(std::size_t part) {
  const double hue = std::fmod(0.13 + 0.618033988749895 * static_cast<double>(part), 1.0);
  constexpr double kBright[] = {0.95, 0.72, 0.5};
  Pixel colour{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double place = std::fabs(std::fmod(6 * hue + (c == 0 ? 3.0 : c == 1 ? 1.0 : 5.0), 6.0) - 3) - 1;
    const double pure = std::clamp(place, 0.0, 1.0);
    colour[c] = static_cast<std::uint8_t>(std::lround(255 * kBright[part % 3] * (0.25 + 0.75 * pure)));
  }
  return colour;
}

// A dot of a mark, where it lies in the picture.
void draw_mark(Picture& picture, const Camera& camera, const ScanMark& mark, const Pixel& colour) {
  if (!(mark.direction.z() > 0)) return;
  const Eigen::Vector2d at = camera.pixel(mark.direction);
  if (!(at.cwiseAbs().maxCoeff() < 1e6)) return;
  const int size = std::max(2, camera.width / 300);
  fill(picture, static_cast<int>(std::lround(at.x())) - size / 2, static_cast<int>(std::lround(at.y())) - size / 2, size, size, colour);
}

// The largest residual that is not exceptional, at least 1 um.
double residual_span(const std::vector<ScanMark>& marks) {
  std::vector<double> sizes;
  for (const ScanMark& mark : marks) {
    if (mark.state == RayState::kHit && !std::isnan(mark.residual_m)) sizes.push_back(std::fabs(mark.residual_m));
  }
  if (sizes.empty()) return 1e-3;
  std::sort(sizes.begin(), sizes.end());
  return std::max(1e-6, sizes[sizes.size() * 97 / 100]);
}

}  // namespace

Picture depth_view(const std::vector<SeenPoint>& seen, const Camera& camera) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const SeenPoint& point : seen) {
    if (point.hit) low = std::min(low, point.depth_m);
    if (point.hit) high = std::max(high, point.depth_m);
  }
  Picture picture(camera.width, camera.height, kSky);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen[i].hit) picture.pixels[i] = on_scale(kNearFar, high > low ? (seen[i].depth_m - low) / (high - low) : 0);
  }
  const std::string title = "depth along the boresight, m";
  if (high == 0) return stacked(picture, scale_legend(camera.width, kNearFar, {title + ": the target is not in view", "", "", ""}));
  return stacked(picture,
                 scale_legend(camera.width, kNearFar, {title, decimals(low, 3), decimals((low + high) / 2, 3), decimals(high, 3)}));
}

std::vector<std::uint16_t> depth_mm(const std::vector<SeenPoint>& seen) {
  std::vector<std::uint16_t> values;
  for (const SeenPoint& point : seen) {
    const double value = point.hit ? std::round(1e3 * point.depth_m) : 0;
    if (value > 65535)
      throw InputError("--as depth16: a depth of " + decimals(point.depth_m, 3) +
                       " m does not fit: 16 bits hold 65.535 m in millimetres; --as depth shows any");
    values.push_back(static_cast<std::uint16_t>(value));
  }
  return values;
}

Picture normals_view(const std::vector<SeenPoint>& seen, const Camera& camera) {
  Picture picture(camera.width, camera.height, kSky);
  const auto code = [](double value) { return static_cast<std::uint8_t>(std::lround(127.5 * (1 + std::clamp(value, -1.0, 1.0)))); };
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Vec3& n = seen[i].normal;
    if (seen[i].hit) picture.pixels[i] = {code(n.x()), code(-n.y()), code(-n.z())};
  }
  const auto colour = [&](double x, double y, double z) { return Pixel{code(x), code(-y), code(-z)}; };
  return stacked(picture, names_legend(camera.width, {{colour(1, 0, 0), "normal to the right"},
                                                      {colour(-1, 0, 0), "to the left"},
                                                      {colour(0, -1, 0), "upwards"},
                                                      {colour(0, 1, 0), "downwards"},
                                                      {colour(0, 0, -1), "towards the camera"}}));
}

Picture parts_view(const std::vector<SeenPoint>& seen, const Camera& camera, const std::vector<std::string>& names) {
  Picture picture(camera.width, camera.height, kSky);
  std::vector<bool> is_seen(names.size(), false);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!seen[i].hit) continue;
    picture.pixels[i] = part_colour(seen[i].part);
    is_seen[seen[i].part] = true;
  }
  std::vector<NamedColour> entries;
  for (std::size_t part = 0; part < names.size(); ++part) {
    if (is_seen[part]) entries.push_back({part_colour(part), names[part]});
  }
  return stacked(picture, names_legend(camera.width, entries));
}

Picture scan_view(const Picture& picture, const Camera& camera, const std::vector<ScanMark>& marks) {
  constexpr Pixel kColours[] = {{70, 230, 110}, {128, 136, 150}, {196, 120, 255}, {255, 70, 60}};
  constexpr const char* kNames[] = {"returns", "misses", "aimed at contours", "no statement"};
  Picture result = picture;
  std::size_t counts[4] = {};
  for (const ScanMark& mark : marks) {
    const std::size_t kind = mark.aimed ? 2 : mark.state == RayState::kHit ? 0 : mark.state == RayState::kMiss ? 1 : 3;
    ++counts[kind];
    draw_mark(result, camera, mark, kColours[kind]);
  }
  std::vector<NamedColour> entries;
  for (std::size_t kind = 0; kind < 4; ++kind) {
    if (counts[kind] > 0) entries.push_back({kColours[kind], std::to_string(counts[kind]) + " " + kNames[kind]});
  }
  return stacked(result, names_legend(picture.width, entries));
}

Picture residual_view(const Picture& picture, const Camera& camera, const std::vector<ScanMark>& marks) {
  Picture result = picture;
  for (Pixel& pixel : result.pixels) {
    const auto grey = static_cast<std::uint8_t>((54 * pixel[0] + 183 * pixel[1] + 19 * pixel[2]) / 512);
    pixel = {grey, grey, grey};
  }
  const double span_m = residual_span(marks);
  for (const ScanMark& mark : marks) {
    if (mark.state != RayState::kHit) continue;
    if (std::isnan(mark.residual_m)) {
      draw_mark(result, camera, mark, {255, 255, 255});
    } else {
      draw_mark(result, camera, mark, on_scale(kLowHigh, 0.5 + 0.5 * mark.residual_m / span_m));
    }
  }
  const std::string span = format("%.3g mm", 1e3 * span_m);
  return stacked(result,
                 scale_legend(picture.width, kLowHigh,
                              {"measured minus predicted range at the true pose; white: no model there", "-" + span, "0", "+" + span}));
}

}  // namespace lasso::mdat
