// The faults that the component watches for, as a table that it executes as written: what is seen in so many frames running is confirmed,
// and answered; what is not seen for so many is cleared. `mdat faults` prints it (docs/faults.md).
#pragma once

#include <cstdint>

#include "fsw/core/span.hpp"

namespace lasso {

enum class Fault : std::uint8_t {
  kSensorSilent = 0,
  kSensorLate = 1,
  kSensorCorrupt = 2,
  kSensorStuck = 3,
  kSensorSaturated = 4,
  kScanIncomplete = 5,
  kEstimateOverrun = 6,
  kSlotSlip = 7,
  kTimeJump = 8,
  kImplausiblePose = 9,
  kFilterDivergence = 10,
  kModeCorrupt = 11,
  kModeLost = 12,
  kImageCorrupt = 13,
  kImageLost = 14,
  kParametersCorrupt = 15,
  kParametersLost = 16,
  kCodeCorrupt = 17,
  kLinkSilent = 18,
  kMemoryHigh = 19,
  kWatchdogReset = 20,
  kSelfTestFailed = 21,
  kLaserCorrupt = 22,
};
constexpr std::size_t kFaults = 23;

// In the order of their weight: of several, the heaviest is carried out.
enum class FaultReaction : std::uint8_t {
  kReport = 0,     // it is reported; what belongs to it has been done where it was seen (a scan not used, a copy repaired)
  kReacquire = 1,  // the prediction has lost its meaning: the target is looked for near it
  kMakeSafe = 2,   // mode safe
};
const char* to_string(FaultReaction reaction);  // never null

struct FaultRow {
  Fault fault;
  std::uint8_t confirm_frames;  // seen in so many frames running: confirmed; at least 1
  std::uint8_t clear_frames;    // not seen in so many frames running: cleared; 0: never, until the component starts again
  FaultReaction reaction;       // when it is confirmed
};
Span<const FaultRow> fault_table();  // the row of a fault at its number

// Faults, a bit each: 1 << number.
class FaultSet {
 public:
  void add(Fault fault, bool seen = true) { bits_ |= seen ? bit(fault) : 0; }
  void add(const FaultSet& others) { bits_ |= others.bits_; }
  void remove(Fault fault) { bits_ &= ~bit(fault); }
  bool has(Fault fault) const { return (bits_ & bit(fault)) != 0; }
  bool empty() const { return bits_ == 0; }
  std::uint32_t bits() const { return bits_; }

 private:
  static constexpr std::uint32_t bit(Fault fault) { return 1u << static_cast<unsigned>(fault); }
  std::uint32_t bits_ = 0;
};

struct FaultChanges {
  FaultSet confirmed;
  FaultSet cleared;
  FaultReaction reaction = FaultReaction::kReport;  // the heaviest of those confirmed
};

class FaultMonitor {
 public:
  // One frame, and what was seen in it. Loop bound: kFaults.
  FaultChanges step(const FaultSet& seen);

  const FaultSet& active() const { return active_; }              // confirmed, not cleared
  const FaultSet& ever() const { return ever_; }                  // confirmed since the start
  std::uint32_t confirmations() const { return confirmations_; }  // of all faults; wraps

 private:
  void confirm(const FaultRow& row, FaultChanges& changes);
  void clear(const FaultRow& row, FaultChanges& changes);

  std::uint8_t frames_[kFaults] = {};  // running, in which a fault that is not active was seen, or an active one was not
  FaultSet active_;
  FaultSet ever_;
  std::uint32_t confirmations_ = 0;
};

}  // namespace lasso
