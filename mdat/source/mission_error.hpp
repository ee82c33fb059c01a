// What is wrong with a mission's files: every problem that was found, with its place, so that a person can repair all of them at once.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace lasso::mdat {

// One line for a person: `file:line:column: key: value: expected`. Line 0 means the file as a whole; empty parts are left out.
struct Problem {
  std::string file;
  int line = 0, column = 0;  // from 1
  std::string key;           // dotted TOML path, e.g. "scan.points"
  std::string value;         // as written, shortened
  std::string expected;      // what was expected, and the remedy
};

std::string to_string(const Problem& problem);

// what() holds one line a problem, in the order of the file.
class MissionError : public std::runtime_error {
 public:
  explicit MissionError(std::vector<Problem> problems);
  explicit MissionError(Problem problem) : MissionError(std::vector<Problem>{std::move(problem)}) {}
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

}  // namespace lasso::mdat
