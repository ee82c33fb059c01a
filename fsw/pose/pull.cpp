// The pull of a rough hypothesis on the truncated distance to the surface, then on rays with a gate that shrinks.
#include "fsw/pose/gauss_newton.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

constexpr int kDistancePasses = 8;
constexpr double kScaleFirst = 1.0;                       // of the truncation
constexpr double kScaleShrink = 0.84;                     // per pass
constexpr double kRayGates[] = {0.04, 0.02, 0.01, 0.01};  // of the model's size

// Points within `scale` of the surface are pulled on to it along the distance's gradient.
void take_distance_pass(const Mission& mission, const MatchSettings<N>& s, N::Length scale, const Workspace& workspace, Pose& pose) {
  const PathPose<N> path = to_path<N>(pose);
  Pass pass;
  for (const MatchPoint<N>& point : workspace.points) {
    N::Length m[3];
    transform(path, point.p, m);
    const SurfaceDistance<N> d = surface_distance(mission.search, m);
    if (!(d.distance < scale)) continue;
    const N::Ratio share = d.distance / scale;
    const N::Ratio rest = 1 - share * share;
    pass.sums.rows.add(m, d.away, -d.distance, rest * rest, d.distance);
  }
  pass.sums.rows.flush();
  solve_pass(mission, s, PassKind{}, pass, pose);
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

Pose pull_in(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace) {
  if (workspace.points.size() < kMinimumPoints) return T_target_sensor;
  const MatchSettings<N> s = make_settings(mission.parameters, workspace);
  Pose pose = T_target_sensor;
  N::Length scale = N::to_length(kScaleFirst) * mission.search.truncation;
  for (int i = 0; i < kDistancePasses; ++i) {
    take_distance_pass(mission, s, scale, workspace, pose);
    scale *= N::to_ratio(kScaleShrink);
  }
  return pull_on_rays(mission, pose, workspace);
}

}  // namespace lasso
