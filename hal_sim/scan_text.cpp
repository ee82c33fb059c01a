#include "hal_sim/scan_text.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>

namespace lasso::sim {
namespace {

constexpr double kFarthestPoint_m = 1e6;
constexpr double kUnitTolerance = 1e-3;

bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string_view trimmed(std::string_view field) {
  while (!field.empty() && is_blank(field.front())) field.remove_prefix(1);
  while (!field.empty() && is_blank(field.back())) field.remove_suffix(1);
  return field;
}

std::string text_of(double value) {
  char buffer[32];
  const auto end = std::to_chars(std::begin(buffer), std::end(buffer), value).ptr;
  return std::string(std::begin(buffer), end);
}

void append(RangeImage& image, const Vec3& unit, double range_m, TimeUs t_us, RayState state, const std::string& place) {
  RangeSample sample;
  for (int axis = 0; axis < 3; ++axis) sample.direction[axis] = static_cast<float>(unit[axis]);
  sample.range_m = static_cast<float>(range_m);
  sample.t_us = t_us;
  sample.state = state;
  if (image.samples.push_back(sample)) return;
  fail(place, "the scan has more than " + std::to_string(kMaxRays) + " rows, the most that can be processed; thin it out or cut it");
}

void check_finite(const Vec3& v, const std::string& place) {
  if (v.allFinite()) return;
  fail(place, "a coordinate is not finite (" + text_of(v.x()) + ", " + text_of(v.y()) + ", " + text_of(v.z()) +
                  "); remove points without a measurement");
}

}  // namespace

std::string at_line(const std::string& file, std::size_t line) { return file + ":" + std::to_string(line); }

std::string at_point(const std::string& file, std::size_t point) { return file + ": point " + std::to_string(point); }

void fail(const std::string& place, const std::string& what) { throw ScanFileError(place + ": " + what); }

std::string shown(std::string_view value) {
  constexpr std::size_t kLongest = 40;
  std::string text(value.substr(0, kLongest));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "\"" + text + (value.size() > kLongest ? "...\"" : "\"");
}

bool Lines::next(std::string_view& line) {
  if (position_ >= text_.size()) return false;
  const std::size_t end = std::min(text_.find('\n', position_), text_.size());
  line = text_.substr(position_, end - position_);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  position_ = std::min(end + 1, text_.size());
  ++number_;
  return true;
}

std::vector<std::string_view> split(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(separator, begin), line.size());
    fields.push_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return fields;
}

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> found;
  for (std::size_t i = 0; i < line.size();) {
    const std::size_t begin = std::min(line.find_first_not_of(" \t", i), line.size());
    const std::size_t end = std::min(line.find_first_of(" \t", begin), line.size());
    if (end > begin) found.push_back(line.substr(begin, end - begin));
    i = end;
  }
  return found;
}

double number(std::string_view field, std::string_view name, const std::string& place) {
  const bool plus = field.size() > 1 && field[0] == '+' && field[1] != '-';
  const std::string_view digits = plus ? field.substr(1) : field;
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool whole = error == std::errc() && end == digits.data() + digits.size() && !digits.empty();
  if (whole && std::isfinite(value)) return value;
  fail(place, std::string(name) + " is " + shown(field) + ", expected a finite decimal number such as 1.25");
}

std::uint64_t count(std::string_view field, std::string_view name, const std::string& place) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error == std::errc() && end == field.data() + field.size() && !field.empty()) return value;
  fail(place, std::string(name) + " is " + shown(field) + ", expected a whole number such as 1024");
}

void append_hit(RangeImage& image, const Vec3& point_m, TimeUs t_us, const std::string& place) {
  check_finite(point_m, place);
  const double range_m = point_m.stableNorm();
  if (range_m > kFarthestPoint_m)
    fail(place, "the point is " + text_of(range_m) + " m away, expected at most 1e6; check that its unit is metres");
  if (!(static_cast<float>(range_m) > 0)) fail(place, "the point lies in the sensor's origin; remove points without a measurement");
  append(image, point_m / range_m, range_m, t_us, RayState::kHit, place);
}

void append_miss(RangeImage& image, const Vec3& direction, TimeUs t_us, const std::string& place) {
  check_finite(direction, place);
  const double length = direction.stableNorm();
  if (!(std::abs(length - 1) <= kUnitTolerance)) {
    fail(place, "the direction of a ray that missed (valid 0) has length " + text_of(length) + ", expected 1; divide x_m, y_m, z_m by it");
  }
  append(image, direction / length, 0, t_us, RayState::kMiss, place);
}

void check_point_count(std::uint64_t points, const std::string& place) {
  if (points == 0) fail(place, "the file declares no point; a scan needs at least one");
  if (points <= kMaxRays) return;
  fail(place,
       "the file declares " + std::to_string(points) + " points, expected at most " + std::to_string(kMaxRays) + "; thin it out or cut it");
}

double scalar_at(const char* bytes, std::size_t size, bool big_endian) {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t from_top = big_endian ? i : size - 1 - i;
    word = (word << 8) | static_cast<unsigned char>(bytes[from_top]);
  }
  return size == 8 ? std::bit_cast<double>(word) : static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(word)));
}

}  // namespace lasso::sim
