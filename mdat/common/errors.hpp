// What ends a command: each error is one line for a person, and its kind is the exit code.
#pragma once

#include <stdexcept>
#include <string>

namespace lasso::mdat {

constexpr int kExitDone = 0;
constexpr int kExitFailed = 1;     // the run failed
constexpr int kExitBadInput = 2;   // usage or bad input
constexpr int kExitNoPicture = 3;  // done, and all results are written, but a picture could not be drawn

// Usage or input is wrong: names the file and the place. Exit code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The run itself failed (no memory, a tool is missing, ...). Exit code 1.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A picture could not be drawn; all else is done. Exit code 3.
class PictureError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace lasso::mdat
