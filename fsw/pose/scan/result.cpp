#include "fsw/pose/scan/result.hpp"

namespace lasso {

const char* to_string(PoseReason reason) {
  switch (reason) {
    case PoseReason::kValid:
      return "valid";
    case PoseReason::kNoScan:
      return "no_scan";
    case PoseReason::kTooFewReturns:
      return "too_few_returns";
    case PoseReason::kTooFewInliers:
      return "too_few_inliers";
    case PoseReason::kLowInlierShare:
      return "low_inlier_share";
    case PoseReason::kModelMismatch:
      return "model_mismatch";
    case PoseReason::kHighResidual:
      return "high_residual";
    case PoseReason::kNotConverged:
      return "not_converged";
    case PoseReason::kSingular:
      return "singular";
    case PoseReason::kNoTrack:
      return "no_track";
    case PoseReason::kOverrun:
      return "overrun";
    case PoseReason::kImplausible:
      return "implausible";
    case PoseReason::kOnlyBearing:
      return "only_bearing";
    case PoseReason::kFarFromStart:
      return "far_from_start";
    case PoseReason::kSearching:
      return "searching";
    case PoseReason::kPartDisagrees:
      return "part_disagrees";
    case PoseReason::kTooFast:
      return "too_fast";
    case PoseReason::kUnchecked:
      return "unchecked";
    case PoseReason::kContradicted:
      return "contradicted";
  }
  return "unknown";
}

const char* to_string(StopReason reason) {
  switch (reason) {
    case StopReason::kConverged:
      return "converged";
    case StopReason::kIterationLimit:
      return "iteration_limit";
    case StopReason::kTooFewPoints:
      return "too_few_points";
    case StopReason::kSingular:
      return "singular";
    case StopReason::kNotRun:
      return "not_run";
  }
  return "unknown";
}

}  // namespace lasso
