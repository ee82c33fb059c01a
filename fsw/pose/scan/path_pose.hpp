// The pose as the per-point path uses it: T_target_sensor as a rotation matrix and a translation in the path's number type.
#pragma once

#include "fsw/geometry/number.hpp"
#include "fsw/geometry/se3.hpp"

namespace lasso {

template <class N>
struct PathPose {
  typename N::Unit R[3][3];
  typename N::Length t[3];
};

template <class N>
PathPose<N> to_path(const Pose& T_target_sensor) {
  PathPose<N> path{};
  const Mat3 R = to_matrix(T_target_sensor.q);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) path.R[i][j] = N::template to<typename N::Unit>(R(i, j));
    path.t[i] = N::to_length(T_target_sensor.p[i]);
  }
  return path;
}

template <class N, class V>
inline void rotate(const PathPose<N>& path, const V* v, V* out) {
  for (int i = 0; i < 3; ++i) out[i] = dot3<N>(path.R[i], v);
}

template <class N>
inline void transform(const PathPose<N>& path, const typename N::Length* p, typename N::Length* out) {
  for (int i = 0; i < 3; ++i) out[i] = bounded<typename N::Length>(path.t[i] + dot3<N>(path.R[i], p));
}

// Left step of a pose in target axes, x = (rotation, translation): p' = R(x) p + x_translation. Cayley's map for the rotation: no sine.
Pose step_pose(const Pose& T_target_sensor, const Vec6& x);

// The step from one pose to another, by the rotation vector: that of step_pose where it is small.
Vec6 way_between(const Pose& from_T_target_sensor, const Pose& to_T_target_sensor);

}  // namespace lasso
