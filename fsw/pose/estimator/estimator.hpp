// From a range image to a pose and its covariance: registration, outline, silhouettes, tests of validity. The workspace is a member; no
// state is kept from scan to scan. Work is bounded by kMaxRays, estimation.iterations_max, what an outline may ask (outline_fit.hpp) and
// the field's list and walk bounds.
#pragma once

#include "fsw/mission/mission.hpp"
#include "fsw/pose/scan/result.hpp"
#include "fsw/pose/scan/start_point.hpp"
#include "fsw/pose/scan/workspace.hpp"
#include "fsw/sense/range_image.hpp"

namespace lasso {

// Does the target move too fast for rays to be moved back, with estimation.deskew: too far in the time, or beyond all measure? By half of a
// scan, all that is between its reference time and a sample: there Cayley's map is off by a twelfth of a radian, and fixed point
// (number.hpp) has nothing beyond.
bool is_too_fast(const MissionParameters& parameters, const Twist& rates, double half_scan_s);
constexpr double kMostTurn_rad = 1;
constexpr double kFastestTurn_radps = 60;
constexpr double kMostWay_m = 50;
constexpr double kFastest_mps = 500;

class Estimator {
 public:
  // Never fails silently: result.reason says whether and why the pose can(not) be trusted. With nothing to work on the pose is the start.
  Registration estimate(const Mission& mission, const RangeImage& scan, const StartPoint& start);

  // Room for other stages to work in between two estimates.
  Workspace& workspace() { return workspace_; }

 private:
  Workspace workspace_;
};

}  // namespace lasso
