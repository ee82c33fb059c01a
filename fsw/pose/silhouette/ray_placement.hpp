// Where to look next: aimed rays of the scan that is planned next, two after the estimated one. They go to contours that the model
// predicts, where a hit or a miss says most about what the rest of that scan leaves uncertain, and to its surfaces, where returns do.
//
// Places lie evenly along the contour edges of the predicted view. Each offers rows a of the labels (silhouette.hpp): a.x is how much a
// step x of the pose moves the contour across the rays. Starting from the covariance C that the prediction and the scan's own returns
// will give, the place that takes most off the variance of the target's points, trace(D C D) with D = (model radius, 1), is chosen,
// confirmed by probes, and C is updated by what its rays will tell:
//   w = rays / (0.6 s max(s, s_pred)),  s^2 = a.C a + own,  s_pred^2 = a.P a + own,  P the prediction's covariance;
// a place on a surface has w = rays / (variance of a return);
// and so on, until the mission's share of the scan is used up. A place's rays are spread evenly over two s_pred to either side: rays at
// one offset would say the same. See docs/decisions/aimed-scans.md.
#pragma once

#include "fsw/mission/mission.hpp"
#include "fsw/pose/scan/workspace.hpp"
#include "fsw/sense/scan_plan.hpp"

namespace lasso {

// What is known of the target for the middle of that scan.
struct RayPlacementRequest {
  std::uint32_t scan_id = 0;  // the offsets differ from scan to scan
  Pose T_sensor_target;
  Twist rates;
  Mat6 covariance = Mat6::Zero();  // of T_sensor_target: rotation in sensor axes, translation of the origin
};

constexpr std::size_t kRaysPerPlace = 6;

// `rays` in the order in which their places lie along the contour, then those at surfaces, kRaysPerPlace for each place, all within the
// field of view. Places whose prediction is less certain than estimation.silhouette_band_m get none, and where all are, surfaces neither;
// so there may be fewer rays than the share, or none. Bounds: the model's edges and kMaxContourEdges; kMaxAimPlaces places, each probed
// once (four walks), and kMaxAimSurfaces; kMaxAimedRays / kRaysPerPlace choices, for each of which no place is asked twice; 96 walks for
// the scan's own returns.
void aim_rays(const Mission& mission, const RayPlacementRequest& request, Workspace& workspace, AimedRays& rays);

}  // namespace lasso
