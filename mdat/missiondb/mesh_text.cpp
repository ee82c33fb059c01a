#include "mdat/missiondb/mesh_text.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <limits>

#include "mdat/missiondb/mesh_import.hpp"

namespace lasso::mdat {
namespace {

constexpr std::string_view kLineEnds = "\r\n";
constexpr std::string_view kWordEnds(" \t\v\f\r\n\0", 7);

// Microsoft's C library writes 1.#QNAN, 1.#IND, 1.#INF and -nan(ind); others nan, NaN, -nan, nan(0x8000).
bool parse_number(std::string_view word, double& value) {
  if (word.find(".#") != std::string_view::npos) {
    value = std::numeric_limits<double>::quiet_NaN();
    return true;
  }
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::result_out_of_range) value = std::strtod(std::string(word).c_str(), nullptr);  // 0 or infinite
  return error != std::errc::invalid_argument && end == word.data() + word.size();
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

std::string excerpt(std::string_view text) {
  constexpr std::size_t kLength = 40;
  std::string shown(text.substr(0, kLength));
  for (char& c : shown) {
    if (c < ' ' || c > '~') c = '?';
  }
  return '"' + shown + (text.size() > kLength ? "...\"" : "\"");
}

std::string count_text(std::size_t count, const std::string& name) { return std::to_string(count) + " " + name + (count == 1 ? "" : "s"); }

std::string_view plain_text(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) throw MeshError("is UTF-16 text: save it as UTF-8 or ASCII");
  return bytes.starts_with("\xEF\xBB\xBF") ? bytes.substr(3) : bytes;
}

void Words::skip_line_end() {
  const bool two = text_.substr(position_, 2) == "\r\n";
  position_ += two ? 2 : 1;
  ++line_;
}

std::string_view Words::next() {
  while (position_ < text_.size() && kWordEnds.find(text_[position_]) != std::string_view::npos) {
    if (kLineEnds.find(text_[position_]) != std::string_view::npos) {
      skip_line_end();
    } else {
      ++position_;
    }
  }
  const std::size_t begin = position_;
  position_ = std::min(text_.find_first_of(kWordEnds, begin), text_.size());
  return text_.substr(begin, position_ - begin);
}

std::string_view Words::rest_of_line() {
  const std::size_t begin = position_;
  position_ = std::min(text_.find_first_of(kLineEnds, begin), text_.size());
  const std::string_view line = text_.substr(begin, position_ - begin);
  if (position_ < text_.size()) skip_line_end();
  return line;
}

double Words::number() {
  const std::string_view word = next();
  if (word.empty()) refuse("a number is missing: the file is truncated or corrupt");
  double value = 0;
  if (parse_number(word, value)) return value;
  refuse("expected a number, found " + excerpt(word) +
         (word.find(',') == std::string_view::npos ? "" : ": numbers have a decimal point, no comma"));
}

void Words::refuse(const std::string& reason) const { throw MeshError("line " + std::to_string(line_) + ": " + reason); }

}  // namespace lasso::mdat
