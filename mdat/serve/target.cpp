#include "mdat/serve/target.hpp"

#include <charconv>
#include <cmath>

#include "mdat/serve/http.hpp"

namespace lasso::mdat::serve {
namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

// How many bytes a character of UTF-8 has by its first one; 0: none begins so.
std::size_t utf8_length(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first < 0xe0) return 2;
  if (first >= 0xe0 && first < 0xf0) return 3;
  return first >= 0xf0 && first < 0xf5 ? 4 : 0;
}

bool is_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(static_cast<unsigned char>(text[at]));
    if (length == 0 || length > text.size() - at) return false;
    for (std::size_t i = 1; i < length; ++i) {
      if ((static_cast<unsigned char>(text[at + i]) & 0xc0) != 0x80) return false;
    }
    at += length;
  }
  return true;
}

// Without percents; `plus`: a plus is a space, as in queries.
std::optional<std::string> decoded(std::string_view text, bool plus) {
  std::string result;
  for (std::size_t at = 0; at < text.size(); ++at) {
    char c = plus && text[at] == '+' ? ' ' : text[at];
    if (text[at] == '%') {
      if (text.size() - at < 3 || hex_digit(text[at + 1]) < 0 || hex_digit(text[at + 2]) < 0) return std::nullopt;
      c = static_cast<char>(16 * hex_digit(text[at + 1]) + hex_digit(text[at + 2]));
      at += 2;
    }
    if (is_control(c)) return std::nullopt;
    result.push_back(c);
  }
  return is_utf8(result) ? std::optional(result) : std::nullopt;
}

// Of the text up to `end`, which goes with it.
std::string_view take_until(char end, std::string_view& text) {
  const std::string_view taken = text.substr(0, text.find(end));
  text.remove_prefix(std::min(taken.size() + 1, text.size()));
  return taken;
}

bool take_parts(std::string_view path, std::vector<std::string>& parts) {
  while (!path.empty()) {
    const std::string part(take_until('/', path));
    if (part == "." || part == "..") return false;
    if (!part.empty()) parts.push_back(part);
  }
  return true;
}

bool take_query(std::string_view text, std::map<std::string, std::string>& query) {
  while (!text.empty()) {
    std::string_view pair = take_until('&', text);
    const auto name = decoded(take_until('=', pair), true), value = decoded(pair, true);
    if (!name || !value) return false;
    if (!name->empty()) query[*name] = *value;
  }
  return true;
}

[[noreturn]] void refuse_value(const std::string& name, const std::string& value, const std::string& expected) {
  throw Refusal{400, name + "=" + value.substr(0, 40) + ": expected " + expected, "correct the address"};
}

}  // namespace

std::optional<Target> parse_target(std::string_view text) {
  if (text.empty() || text.front() != '/' || text.size() > kMaxTargetBytes) return std::nullopt;
  text = text.substr(0, text.find('#'));
  const std::optional<std::string> path = decoded(take_until('?', text), false);
  Target target;
  if (!path || path->find('\\') != std::string::npos) return std::nullopt;
  target.path = *path;
  if (!take_parts(target.path, target.parts) || !take_query(text, target.query)) return std::nullopt;
  return target;
}

std::string text_in(const Target& target, const std::string& name) {
  const auto found = target.query.find(name);
  return found != target.query.end() ? found->second : "";
}

double number_in(const Target& target, const std::string& name, double otherwise) {
  const std::string text = text_in(target, name);
  if (text.empty()) return otherwise;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) refuse_value(name, text, "a number");
  return value;
}

std::optional<std::size_t> count_of(std::string_view text) {
  constexpr std::size_t kMost = std::size_t{1} << 53;
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value > kMost) return std::nullopt;
  return value;
}

std::size_t count_in(const Target& target, const std::string& name, std::size_t otherwise, std::size_t most) {
  const std::string text = text_in(target, name);
  if (text.empty()) return otherwise;
  const std::optional<std::size_t> count = count_of(text);
  if (!count || *count > most) refuse_value(name, text, "a whole number up to " + std::to_string(most));
  return *count;
}

std::vector<std::string> list_in(const Target& target, const std::string& name) {
  std::vector<std::string> list;
  const std::string text = text_in(target, name);
  for (std::string_view rest = text; !rest.empty();) list.emplace_back(take_until(',', rest));
  return list;
}

}  // namespace lasso::mdat::serve
