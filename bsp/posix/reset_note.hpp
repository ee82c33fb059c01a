// Why a program of Linux starts: what its last run left in a file of its store's folder. A run that is ended by an invariant, its watchdog
// or an exception of the processor notes that on its way out; one that was killed, or lost its power, leaves what a start writes there.
#pragma once

#include <string>

#include "fsw/exec/watchdog.hpp"

namespace lasso::posix {

class ResetNote {
 public:
  // Reads the file `reset` of the folder, which is there, and from now on notes what ends this program (signals, of which there is one
  // handler: one ResetNote at a time). Without a file the cause is kPowerOn. Throws std::system_error where it cannot be written.
  explicit ResetNote(const std::string& folder);
  ~ResetNote();
  ResetNote(const ResetNote&) = delete;
  ResetNote& operator=(const ResetNote&) = delete;

  ResetCause cause() const { return cause_; }

 private:
  ResetCause cause_ = ResetCause::kPowerOn;
};

}  // namespace lasso::posix
