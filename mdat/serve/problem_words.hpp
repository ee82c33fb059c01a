// A mission's problem in words of the page. Inside of serve's answers.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "mdat/source/mission_error.hpp"

namespace lasso::mdat::serve {

// As the command line says it, with the file's name instead of its whole path.
inline std::string problem_words(Problem problem) {
  problem.file = std::filesystem::path(problem.file).filename().string();
  return to_string(problem);
}

}  // namespace lasso::mdat::serve
