// What a campaign says of a pose, and of all that a flight with a fault sent. A pose is wrong as reqs/README.md says: off by more than 5 of
// its own sigma, in the direction of the error, and by more than 20 mm or 1 deg.
#pragma once

#include "fsw/geometry/portable_math.hpp"
#include "ft/campaign/flight.hpp"
#include "hal_sim/trajectory.hpp"

namespace lasso::campaign {

constexpr double kWrong_m = 0.020;
constexpr double kWrong_rad = 1 * kRadPerDeg;
constexpr double kWrongSigmas = 5;

enum class PoseVerdict : std::uint8_t {
  kRight = 0,
  kCovered = 1,  // off by more than 20 mm or 1 deg, as its covariance admits
  kWrong = 2,    // or not finite
};
// `covariance` of (rotation, translation) in sensor axes.
PoseVerdict judge(const Pose& estimate, const Pose& truth, const Mat6& covariance);
// The worse of registration and filter, where the packet says valid.
PoseVerdict judge_valid(const PoseTelemetry& pose, const Pose& truth);

// How the process of a flight ended.
enum class End : std::uint8_t { kDone = 0, kInvariant = 1, kCrash = 2, kHang = 3 };

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
