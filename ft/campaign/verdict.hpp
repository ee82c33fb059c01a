// What a campaign says of all that a flight with a fault sent.
#pragma once

#include <sys/types.h>

#include "ft/campaign/flight.hpp"
#include "hal_sim/trajectory.hpp"
#include "mdat/run/verdict.hpp"

namespace lasso::campaign {

using mdat::judge;
using mdat::judge_valid;
using mdat::PoseVerdict;

// How the process of a flight ended.
enum class End : std::uint8_t { kDone = 0, kInvariant = 1, kCrash = 2, kHang = 3 };
// Waits for the child `pid`. RunError where it is none.
End end_of(pid_t pid);

// From harmless to worse. The first three publish nothing wrong and say nothing; silent is what must not be.
enum class Outcome : std::uint8_t {
  kMasked = 0,     // the same bytes as without the fault
  kHarmless = 1,   // other bytes, poses valid and right
  kCovered = 2,    // a valid pose is off, within its sigma
  kDetected = 3,   // a pose is invalid, missing or cannot be decoded
  kInvariant = 4,  // the component stopped itself: a board restarts it
  kCrash = 5,      // the processor's memory protection stopped it
  kHang = 6,       // it used up its processor time
  kSilent = 7,     // a pose was sent as valid and is wrong, whatever followed
};
constexpr const char* kOutcomeNames[] = {"masked", "harmless", "covered", "detected", "invariant", "crash", "hang", "silent"};
Outcome outcome(ConstBytes telemetry, ConstBytes golden, const sim::Trajectory& truth, End end);

}  // namespace lasso::campaign
