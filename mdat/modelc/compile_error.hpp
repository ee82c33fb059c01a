// Why a model cannot become a flight image.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace lasso::mdat {

// The message says what was found, where, its figure and the limit; the caller adds the file's name.
class CompileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A cell lists more elements than the flight component looks through. Smaller cells help.
class CrowdedCellError : public CompileError {
 public:
  using CompileError::CompileError;
};

// The image has no room for the look-up field. Larger cells help.
class LargeFieldError : public CompileError {
 public:
  using CompileError::CompileError;
};

// What helps where cells do not.
constexpr const char* kCoarserMesh = "take a coarser mesh (mdat mission new --simplify makes one)";

// Joins anything that prints into one CompileError and throws it.
template <class Error = CompileError, class... Parts>
[[noreturn]] void fail(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  throw Error(text.str());
}

}  // namespace lasso::mdat
