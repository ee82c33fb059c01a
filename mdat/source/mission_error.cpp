#include "mdat/source/mission_error.hpp"

#include <algorithm>
#include <tuple>

namespace lasso::mdat {
namespace {

std::string joined(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) text += (text.empty() ? "" : "\n") + to_string(problem);
  return text;
}

std::vector<Problem> in_order(std::vector<Problem> problems) {
  const auto place = [](const Problem& p) { return std::tie(p.file, p.line, p.column, p.key, p.value, p.expected); };
  std::sort(problems.begin(), problems.end(), [&](const Problem& a, const Problem& b) { return place(a) < place(b); });
  return problems;
}

// One line, whatever a file's own words are: what a terminal would obey is shown as a question mark.
std::string one_line(std::string text) {
  for (char& c : text) {
    const bool obeyed = (c >= 0 && c < ' ') || c == 0x7F;
    if (obeyed) c = '?';
  }
  return text;
}

std::string shortened_key(std::string key) {
  constexpr std::size_t kLongest = 120;
  if (key.size() > kLongest) key.replace(kLongest, std::string::npos, "...");
  return key;
}

}  // namespace

std::string to_string(const Problem& problem) {
  std::string text = problem.file;
  if (problem.line > 0) text += ":" + std::to_string(problem.line) + ":" + std::to_string(problem.column);
  if (!problem.key.empty()) text += ": " + shortened_key(problem.key);
  if (!problem.value.empty()) text += ": " + problem.value;
  return one_line(text + ": " + problem.expected);
}

MissionError::MissionError(std::vector<Problem> problems)
    : std::runtime_error(joined(in_order(problems))), problems_(in_order(std::move(problems))) {}

}  // namespace lasso::mdat
