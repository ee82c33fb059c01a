// The model's contour in the sensor's view, and which rays pass near which of its edges.
#pragma once

#include "fsw/mission/mission.hpp"
#include "fsw/pose/scan/path_pose.hpp"
#include "fsw/pose/scan/workspace.hpp"

namespace lasso {

// Where a view is taken from: T_target_sensor, in the path's types.
template <class N>
struct View {
  PathPose<N> pose;
  typename N::Length target_depth;  // of the target's centre along the boresight
};

inline View<FlightNumber> make_view(const Mission& mission, const Pose& T_target_sensor) {
  View<FlightNumber> view{};
  view.pose = to_path<FlightNumber>(T_target_sensor);
  const Vec3 center_sensor = inverse(T_target_sensor) * mission.center_m;
  view.target_depth = FlightNumber::to_length(center_sensor[2]);
  return view;
}

struct ImagePoint {
  FlightNumber::Tangent x, y;  // tangent plane
  FlightNumber::Length z;      // depth; 0 for a point that is not in front of the sensor
};

ImagePoint project(const PathPose<FlightNumber>& T_target_sensor, const FlightNumber::Length* p_target);

// Fills workspace.contour with the edges that have one face towards the sensor and one away. Bound: the model's edges; past
// kMaxContourEdges the rest is left out.
void find_contour(const Mission& mission, const View<FlightNumber>& view, Workspace& workspace);

// Fills workspace.ray_edges with the contour edges within `band` (at the edge's depth) of each ray, at most kEdgesPerRay, nearest first.
// Bound: edges times the rays in the bins that their bands touch.
void find_ray_edges(const View<FlightNumber>& view, FlightNumber::Length band, Workspace& workspace);

// Fills workspace.near_contour: is there one such edge? Bound: the same, but a ray that has one is not asked again.
void find_rays_near_contour(const View<FlightNumber>& view, FlightNumber::Length band, Workspace& workspace);

}  // namespace lasso
