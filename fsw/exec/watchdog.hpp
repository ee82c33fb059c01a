// The board's watchdog, and who has to check in before it is fed.
#pragma once

#include <cstdint>

#include "fsw/exec/executive.hpp"

namespace lasso {

// Given by the board. It resets the processor, or ends the process, when it has not been fed for longer than its own time, which is
// more than two frames.
class Watchdog {
 public:
  virtual void feed() = 0;

 protected:
  ~Watchdog() = default;  // never deleted through this interface: no operator delete in flight code
};

// Why the component starts, as the board knows it.
enum class ResetCause : std::uint8_t {
  kPowerOn = 0,
  kCommanded = 1,
  kWatchdog = 2,   // it was not fed in time
  kInvariant = 3,  // an invariant of the component did not hold
  kException = 4,  // the processor met an instruction or address that it could not
};

class CheckIn {
 public:
  void slot(std::uint32_t slot) { slots_ |= 1u << slot; }
  // A boundary: may the watchdog be fed? Every slot of the frame that ends must have run, and the estimation thread must have been seen
  // idle in one of the last kEstimationFrames frames. The first boundary has no frame behind it.
  bool boundary(bool estimation_idle) {
    busy_frames_ = estimation_idle ? 0 : busy_frames_ + 1;
    const bool all = !begun_ || slots_ == (1u << kSlotsPerFrame) - 1;
    begun_ = true;
    slots_ = 0;
    return all && busy_frames_ < kEstimationFrames;
  }

  static constexpr std::uint32_t kEstimationFrames = 10;

 private:
  bool begun_ = false;
  std::uint32_t slots_ = 0;
  std::uint32_t busy_frames_ = 0;
};
static_assert(kSlotsPerFrame < 32, "a bit a slot");

}  // namespace lasso
