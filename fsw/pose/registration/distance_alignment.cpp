// Aligns a rough hypothesis by the truncated distance to the surface, then along the rays with a gate that shrinks.
#include "fsw/pose/registration/gauss_newton.hpp"
#include "fsw/pose/scan/work_units.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

constexpr float kScaleFirst = 1.0F;                                // of the truncation
constexpr float kScaleShrink = 0.84F;                              // per pass
constexpr double kRayGates[kRaySteps] = {0.04, 0.02, 0.01, 0.01};  // of the model's size

// Points within `scale` of the surface are moved on to it along the distance's gradient. Returns the mean distance over the truncation.
double take_distance_pass(const Mission& mission, const MatchSettings<N>& s, float scale_m, const Workspace& workspace, Pose& pose) {
  const PathPose<N> path = to_path<N>(pose);
  Pass pass(mission);
  double sum = 0;
  for (const MatchPoint<N>& point : workspace.points) {
    N::Length m[3];
    transform(path, point.p, m);
    const float m_float[3] = {N::to_float(m[0]), N::to_float(m[1]), N::to_float(m[2])};
    const SurfaceDistance d = surface_distance(mission.search, m_float);
    sum += static_cast<double>(d.distance_m);
    if (!(d.distance_m < scale_m)) continue;
    const float share = d.distance_m / scale_m;
    const float rest = 1 - share * share;
    const N::Unit away[3] = {N::from_float<N::Unit>(d.away[0]), N::from_float<N::Unit>(d.away[1]), N::from_float<N::Unit>(d.away[2])};
    const auto distance = N::from_float<N::Length>(d.distance_m);
    pass.sums.rows.add(m, away, -distance, N::from_float<N::Weight>(rest * rest), distance);
  }
  pass.sums.rows.flush();
  Descent whole;
  solve_pass(mission, s, whole, pass, pose);
  return sum / (static_cast<double>(mission.search.truncation_m) * static_cast<double>(workspace.points.size()));
}

}  // namespace

Pose align_on_rays(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace) {
  if (workspace.points.size() < kMinimumPoints) return T_target_sensor;
  MatchSettings<N> s = make_settings(mission.parameters, workspace);
  Pose pose = T_target_sensor;
  for (const double gate : kRayGates) {
    set_gate(gate * static_cast<double>(mission.search.size_m), s);
    (void)take_pass(mission, s, PassKind{}, workspace, pose);
  }
  return pose;
}

DistanceAlignment align_on_distances(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace) {
  DistanceAlignment alignment;
  alignment.T_target_sensor = T_target_sensor;
  if (workspace.points.size() < kMinimumPoints) return alignment;
  const MatchSettings<N> s = make_settings(mission.parameters, workspace);
  float scale_m = kScaleFirst * mission.search.truncation_m;
  for (std::uint32_t i = 0; i < kDistanceSteps; ++i) {
    alignment.distance = take_distance_pass(mission, s, scale_m, workspace, alignment.T_target_sensor);
    scale_m *= kScaleShrink;
  }
  return alignment;
}

Pose align_on_both(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace) {
  return align_on_rays(mission, align_on_distances(mission, T_target_sensor, workspace).T_target_sensor, workspace);
}

}  // namespace lasso
