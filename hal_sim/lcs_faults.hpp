// What goes wrong with a simulated laser camera and its line: a script.
#pragma once

#include <cstdint>
#include <vector>

#include "fsw/core/time.hpp"

namespace lasso::sim {

// One thing that goes wrong, from a time until another (not included); times are the component's.
enum class LcsFaultKind : std::uint8_t {
  kDrop = 0,         // value: probability of each frame that the camera sends
  kRepeat = 1,       // value: the same
  kCorrupt = 2,      // one bit; value: the same
  kLate = 3,         // value: delay of each frame, s
  kSilent = 4,       // the camera says nothing
  kStuckMirror = 5,  // mirror x stays where it is
  kSaturated = 6,    // each spot is too bright
  kClockJump = 7,    // value: s by which the camera's clock jumps at from_us
  kClockRate = 8,    // value: by how much the clock runs fast, as a share
  kReset = 9,        // the camera boots at from_us
  kBitErrors = 10,   // value: share of the bits on the line, both ways
};
struct LcsFault {
  LcsFaultKind kind = LcsFaultKind::kDrop;
  TimeUs from_us = 0, until_us = 0;
  double value = 0;
};
using LcsFaults = std::vector<LcsFault>;

}  // namespace lasso::sim
