#include "hal_sim/scan_text.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>

namespace lasso::sim {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

// The whole field as a number; false where it is none.
bool read_number(std::string_view field, double& value) {
  const bool plus = field.size() > 1 && field[0] == '+' && field[1] != '-';
  const std::string_view digits = plus ? field.substr(1) : field;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return error == std::errc() && end == digits.data() + digits.size() && !digits.empty();
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

std::string text_of(double value) {
  char buffer[32];
  const auto end = std::to_chars(std::begin(buffer), std::end(buffer), value).ptr;
  return std::string(std::begin(buffer), end);
}

std::string_view trimmed(std::string_view field) {
  while (!field.empty() && is_blank(field.front())) field.remove_prefix(1);
  while (!field.empty() && is_blank(field.back())) field.remove_suffix(1);
  return field;
}

std::string_view without_mark(std::string_view text) { return text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text; }

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
  double value = 0;
  if (read_number(field, value) && std::isfinite(value)) return value;
  fail(place, std::string(name) + " is " + shown(field) + ", expected a finite decimal number such as 1.25");
}

double any_number(std::string_view field, std::string_view name, const std::string& place) {
  double value = 0;
  return read_number(field, value) ? value : number(field, name, place);
}

std::uint64_t count(std::string_view field, std::string_view name, const std::string& place) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error == std::errc() && end == field.data() + field.size() && !field.empty()) return value;
  fail(place, std::string(name) + " is " + shown(field) + ", expected a whole number such as 1024");
}

void check_point_count(std::uint64_t points, const std::string& place) {
  constexpr std::uint64_t kMost = 1'000'000'000;
  if (points == 0) fail(place, "the file declares no point; a scan needs at least one");
  if (points > kMost) fail(place, "the file declares " + std::to_string(points) + " points, expected at most 1e9");
}

void check_end(Lines& lines, std::uint64_t points) {
  std::string_view line;
  while (lines.next(line)) {
    if (trimmed(line).empty()) continue;
    fail(lines.place(), "the row is " + shown(line) + ", after all " + std::to_string(points) +
                            " points that the header declares; correct its number of points");
  }
}

double scalar_at(const char* bytes, ScalarType type, bool big_endian) {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < type.bytes; ++i) {
    const std::size_t from_top = big_endian ? i : type.bytes - 1 - i;
    word = (word << 8) | static_cast<unsigned char>(bytes[from_top]);
  }
  if (type.kind == ScalarType::Kind::kUnsigned) return static_cast<double>(word);
  if (type.kind == ScalarType::Kind::kSigned) {
    const unsigned unused = static_cast<unsigned>(64 - 8 * type.bytes);
    return static_cast<double>(static_cast<std::int64_t>(word << unused) >> unused);
  }
  return type.bytes == 8 ? std::bit_cast<double>(word) : static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(word)));
}

}  // namespace lasso::sim
