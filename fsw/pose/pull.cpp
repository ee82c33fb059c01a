// The pull of a rough hypothesis on the truncated distance to the surface, then on rays with a gate that shrinks.
#include "fsw/pose/gauss_newton.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

constexpr int kDistancePasses = 8;
constexpr double kScaleFirst = 1.0;                       // of the truncation
constexpr double kScaleShrink = 0.84;                     // per pass
constexpr double kRayGates[] = {0.04, 0.02, 0.01, 0.01};  // of the model's size

// Points within `scale` of the surface are pulled on to it along the distance's gradient. Returns the mean distance over the truncation.
double take_distance_pass(const Mission& mission, const MatchSettings<N>& s, N::Length scale, const Workspace& workspace, Pose& pose) {
  const PathPose<N> path = to_path<N>(pose);
  Pass pass;
  N::Sum sum = 0;
  for (const MatchPoint<N>& point : workspace.points) {
    N::Length m[3];
    transform(path, point.p, m);
    const SurfaceDistance<N> d = surface_distance(mission.search, m);
    sum += N::to_double(d.distance);
    if (!(d.distance < scale)) continue;
    const N::Ratio share = d.distance / scale;
    const N::Ratio rest = 1 - share * share;
    pass.sums.rows.add(m, d.away, -d.distance, rest * rest, d.distance);
  }
  pass.sums.rows.flush();
  solve_pass(mission, s, PassKind{}, pass, pose);
  return sum / (N::to_double(mission.search.truncation) * static_cast<double>(workspace.points.size()));
}

}  // namespace

Pose pull_on_rays(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace) {
  if (workspace.points.size() < kMinimumPoints) return T_target_sensor;
  MatchSettings<N> s = make_settings(mission.parameters, workspace);
  Pose pose = T_target_sensor;
  for (const double gate : kRayGates) {
    set_gate(gate * N::to_double(mission.search.size), s);
    (void)take_pass(mission, s, PassKind{}, workspace, pose);
  }
  return pose;
}

Pulled pull_on_distances(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace) {
  Pulled pulled;
  pulled.T_target_sensor = T_target_sensor;
  if (workspace.points.size() < kMinimumPoints) return pulled;
  const MatchSettings<N> s = make_settings(mission.parameters, workspace);
  N::Length scale = N::to_length(kScaleFirst) * mission.search.truncation;
  for (int i = 0; i < kDistancePasses; ++i) {
    pulled.distance = take_distance_pass(mission, s, scale, workspace, pulled.T_target_sensor);
    scale *= N::to_ratio(kScaleShrink);
  }
  return pulled;
}

Pose pull_in(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace) {
  return pull_on_rays(mission, pull_on_distances(mission, T_target_sensor, workspace).T_target_sensor, workspace);
}

}  // namespace lasso
