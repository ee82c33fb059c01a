// Do the rays of a scan agree with a pose? A ray contradicts it that met something where the model, at this pose, has nothing or another
// surface in front; or that met nothing where the model is. Many of them mean that the pose is wrong, or that the target is not as
// modelled.
//
// What a pose that is right leaves open contradicts nothing. A ray is asked again at poses two sigmas off along the three least certain
// axes, either way, and two sigmas of its direction and the target's unknown motion beside its line, on four sides. All ranges from the
// nearest to the farthest of those met are as expected; where one of these rays passes, up to the model's farthest. No doubt goes farther
// than a tenth of the model's radius.
#pragma once

#include "fsw/geometry/symmetric6.hpp"
#include "fsw/pose/scan/path_pose.hpp"
#include "fsw/pose/scan/workspace.hpp"

namespace lasso {

// What may be off although the pose is right.
struct PoseDoubt {
  Mat6 covariance = Mat6::Zero();  // of the pose: rotation about the target's origin [rad] and translation [m], target axes
  double noise_scale = 1;          // variance of the noise over the stated one, as residuals show it; below 1 is as 1
  double motion_m = 0;             // most that the target's points may have moved within the scan beyond what its rates say
};

class Expectation {
 public:
  Expectation(const Mission& mission, const Pose& T_target_sensor, const PoseDoubt& doubt);

  // Does the model, at this pose alone, stand where the ray met the target, or not where it met none? `range_variance_m2` is that of its
  // stated noise along the ray, to which the surface's is added and of which five sigmas are allowed; of a miss it is not read. What lies
  // beyond the sensor's ranges need not return. Bound: one walk through the field.
  bool is_met_by(const ScanRay<FlightNumber>& ray, double range_variance_m2) const;

  // The range error that all rays have in common (1 sigma, common_error.hpp). Labels may hold the pose where the ranges do not.
  double common_error_m(double range_m) const;

  // Not met, and not excused by what is in doubt either. A ray that grazes the model (estimation.incidence_max_deg) says nothing. Bound:
  // twelve walks.
  bool is_contradicted_by(const ScanRay<FlightNumber>& ray, double range_variance_m2) const;

 private:
  static constexpr std::size_t kDoubtfulAxes = 3;
  static constexpr std::size_t kPoses = 1 + 2 * kDoubtfulAxes;

  void put_other_poses(const Pose& T_target_sensor, const Mat6& covariance, double most_m);

  const Mission& mission_;
  PathPose<FlightNumber> poses_[kPoses];  // T_target_sensor: the pose, then others that may be the right one
  double scale_;                          // of variances
  double beside_m_;                       // how far beside its line a ray may have met the target
  double farthest_m_;                     // range of the model
  double least_tilt2_;                    // squared cosine of the incidence, below which a ray grazes
};

// 1 less the share of contradicting rays, but for kStray, over the returns that were asked: 1 where all agree, 0 where as many contradict,
// or there is no return. Returns that were aimed at a contour are not asked, nor any of a part's scan, nor misses that are not known. Of
// misses as many are forgiven as stated drop-outs explain, to three sigmas. Rays are asked in six rounds, each spread over the scan, until
// none of 110 returns and the misses beside them contradicts: 1 then. Where 5 % of the returns contradict this happens in one scan of 280.
// Of returns and of misses the first 64 that are not met are looked at again, and others taken for like them. `workspace` is as
// prepare_rays left it. Bound: a walk for each ray, and twelve more for 128.
double agreement_of_rays(const Mission& mission, const Expectation& expectation, bool misses_known, const Workspace& workspace);
constexpr double kStray = 2;  // rays that are off by themselves say nothing of the target

}  // namespace lasso
