// What the estimation says about one scan.
#pragma once

#include <cstdint>

#include "fsw/core/time.hpp"
#include "fsw/geometry/se3.hpp"
#include "fsw/geometry/types.hpp"

namespace lasso {

// Why the iterations ended.
enum class StopReason : std::uint8_t { kConverged = 0, kIterationLimit = 1, kTooFewPoints = 2, kSingular = 3, kNotRun = 4 };

// Why a pose can be trusted, or not.
enum class PoseReason : std::uint8_t {
  kValid = 0,
  kNoScan = 1,          // the scan was lost or incomplete
  kTooFewReturns = 2,   // too few rays came back
  kTooFewInliers = 3,   // too few of them lie on the model
  kLowInlierShare = 4,  // the pose explains too small a share of the returns
  kModelMismatch = 5,   // rays contradict the model at this pose: it is wrong, or the target is not as modelled
  kHighResidual = 6,    // residuals too large for their noise
  kNotConverged = 7,    // iteration limit
  kSingular = 8,        // the normal equations had no solution
  kNoTrack = 9,         // nothing to start from
  kOverrun = 10,        // the estimate was not ready at its boundary: dropped whole
  kImplausible = 11,    // the filter's prediction excludes this pose
  kOnlyBearing = 12,    // a full-field scan: no attitude is looked for
  kFarFromStart = 13,   // farther from the prediction that it was to confirm than 25 squared sigmas
  kSearching = 14,      // no attitude is known: it is looked for
  kPartDisagrees = 15,  // of a part that is elsewhere than the others say
  kTooFast = 16,        // the prediction moves too far within the scan for its points to be brought to one time
  kUnchecked = 17,      // of a start: this scan would confirm it, and a search is still to contradict it or not
  kContradicted = 18,   // of a start: a search of the scan that would confirm it found a pose that explains it better
};
const char* to_string(PoseReason reason);
const char* to_string(StopReason reason);

// Of a return that a pose does not explain, in squared sigmas: what a kernel of 10 sigma makes of it.
constexpr double kUnexplainedCost = 16;

// Registration of a single scan. The prediction is its starting point and not information added to it.
struct Registration {
  std::uint32_t scan_id = 0;
  TimeUs t_us = 0;  // the scan's reference time, at which the pose is stated
  Pose T_sensor_target;
  Mat6 covariance = Mat6::Zero();              // of (rotation about the target's origin in sensor axes [rad], translation [m])
  CommonErrors common = CommonErrors::Zero();  // the share of common errors in it: see common_error.hpp
  StopReason stop = StopReason::kNotRun;
  PoseReason reason = PoseReason::kNoTrack;
  std::uint16_t iterations = 0;
  std::uint16_t rays = 0;                 // with a statement: hits and misses
  std::uint16_t returns = 0;              // hits
  std::uint16_t inliers = 0;              // returns with weight in the last iteration
  std::uint16_t labels = 0;               // silhouette measurements used
  std::uint16_t weak = 0;                 // directions (of 6) whose sigma exceeds tracking.sigma_*_max
  double rms_m = 0;                       // unweighted range residual of the inliers
  double normalized_residual = 0;         // root of chi^2 per degree of freedom
  double inlier_share = 0;                // inliers / returns that can be inliers
  double agreement = 0;                   // 1 less the share of rays that contradict the pose, but for two (agreement.hpp)
  double weakest_sigma_m = 0;             // largest sigma of the covariance's eigen-directions, rotation scaled by the model's radius
  Vec6 weakest_direction = Vec6::Zero();  // that direction: unit vector over (rotation * radius, translation), sensor axes

  bool valid() const { return reason == PoseReason::kValid; }
};

}  // namespace lasso
