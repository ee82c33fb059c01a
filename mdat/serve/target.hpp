// The target of a request: what it asks for, and with which values.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lasso::mdat::serve {

struct Target {
  std::string path;                          // begins with "/", without percents
  std::vector<std::string> parts;            // of the path, between slashes, none empty
  std::map<std::string, std::string> query;  // the last of equal names
};

// None: no absolute path (RFC 9112, origin form), a percent without two digits, a control character, a part "." or "..", or text that is
// not UTF-8. Bound: one pass.
std::optional<Target> parse_target(std::string_view text);

// A value of a query as a number or a list. Throws Refusal (400) that names it.
double number_in(const Target& target, const std::string& name, double otherwise);
std::size_t count_in(const Target& target, const std::string& name, std::size_t otherwise, std::size_t most);
std::vector<std::string> list_in(const Target& target, const std::string& name);
std::string text_in(const Target& target, const std::string& name);

// A whole number in decimal digits. None: anything else, or more than 2^53.
std::optional<std::size_t> count_of(std::string_view text);

}  // namespace lasso::mdat::serve
