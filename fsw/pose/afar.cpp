// The wide start: from a rough pose to one that the registration converges from.
#include "fsw/pose/gauss_newton.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

constexpr int kFarPasses = 20;
constexpr double kFarGateFirst = 0.9;            // of the model's radius
constexpr double kFarGateShrink = 0.8;           // per pass
constexpr double kFrontOfCenter = 0.15;          // of the radius: how far in front of the model's centre its visible side lies
constexpr int kSlides = 6;                       // each way
constexpr double kSlideSteps[] = {0.055, 0.01};  // of the radius: coarse, fine
constexpr double kGoodShare = 0.98;              // of the points explained: no slide can be better by much
constexpr int kNearPasses = 4;
constexpr int kRayPasses = 3;

// Mean of a quarter of the points and of their rays, target frame.
struct Cloud {
  Vec3 center = Vec3::Zero();
  Vec3 view = Vec3::Zero();
};

Cloud mean_of_quarter(const PathPose<N>& pose, const Workspace& workspace) {
  Cloud cloud;
  double count = 0;
  for (std::size_t i = 0; i < workspace.points.size(); i += kQuarter) {
    N::Length m[3];
    N::Unit u[3];
    transform(pose, workspace.points[i].p, m);
    rotate(pose, workspace.points[i].u, u);
    cloud.center += Vec3(N::to_double(m[0]), N::to_double(m[1]), N::to_double(m[2]));
    cloud.view += Vec3(N::to_double(u[0]), N::to_double(u[1]), N::to_double(u[2]));
    count += 1;
  }
  cloud.center /= count;
  cloud.view /= count;
  return cloud;
}

// Puts the middle of the points where the visible side of the model is expected.
Pose center_points(const Mission& mission, const Pose& T_target_sensor, const Workspace& workspace) {
  const Cloud cloud = mean_of_quarter(to_path<N>(T_target_sensor), workspace);
  Pose moved = T_target_sensor;
  moved.p += mission.center_m - kFrontOfCenter * mission.radius_m * cloud.view - cloud.center;
  return moved;
}

// Pulls a point to the model's foot point of its brick: three rows, one per axis, Tukey-weighted by distance.
void add_foot(const Field<N>& field, const GridPlace<N>& place, float gate_m, const FieldRay<N>& ray, PassSums<N>& sums) {
  const N::Length* foot = field.foot_points + std::size_t{3} * place.brick;
  const N::Length gap[3] = {foot[0] - ray.m[0], foot[1] - ray.m[1], foot[2] - ray.m[2]};
  const float distance[3] = {N::to_float(gap[0]), N::to_float(gap[1]), N::to_float(gap[2])};
  const float q = dot3<FloatNumber>(distance, distance) / (gate_m * gate_m);
  if (!(q < 1)) return;
  for (int axis = 0; axis < 3; ++axis) {
    N::Unit n[3] = {N::Unit{0}, N::Unit{0}, N::Unit{0}};
    n[axis] = N::Unit{1};
    sums.rows.add(ray.m, n, gap[axis], N::from_float<N::Weight>((1 - q) * (1 - q)), gap[axis]);
  }
}

// The plane of the closest element that faces the ray: cheap and wide, exact only near the near cell's centre.
void add_near_plane(const Field<N>& field, const GridPlace<N>& place, float gate_m, const FieldRay<N>& ray, PassSums<N>& sums) {
  const std::uint32_t index = near_element(field, place, ray.u);
  if (index == kNoElement) return;
  const Element<N>& e = field.elements[index];
  const N::Length distance = e.d - dot3<N>(e.n, ray.m);
  const float q = N::to_float(distance) / gate_m;
  if (!(q < 1 && q > -1)) return;
  sums.rows.add(ray.m, e.n, distance, N::from_float<N::Weight>((1 - q * q) * (1 - q * q)), distance);
}

bool is_near(const Field<N>& field, const GridPlace<N>& place) {
  return place.inside && field.brick_words[kBrickWords * place.brick + 1] != 0;
}

// A pass over a quarter of the points on closest planes and, where `far` and the surface is far, foot points.
void take_plane_pass(const Mission& mission, const MatchSettings<N>& s, bool far, const Workspace& workspace, Pose& pose) {
  const Field<N>& field = mission.field;
  const PathPose<N> path = to_path<N>(pose);
  const float gate_m = N::to_float(s.gate);
  Pass pass(mission);
  for (std::size_t i = 0; i < workspace.points.size(); i += kQuarter) {
    FieldRay<N> ray = to_target(path, workspace.points[i]);
    set_cells(field, ray);
    if (!near_grid(ray)) continue;
    const GridPlace<N> place = place_in_grid(field, ray.cell_m);
    if (is_near(field, place)) {
      add_near_plane(field, place, gate_m, ray, pass.sums);
    } else if (far) {
      add_foot(field, place, gate_m, ray, pass.sums);
    }
  }
  pass.sums.rows.flush();
  Descent whole;
  solve_pass(mission, s, whole, pass, pose);
}

void settle(const Mission& mission, MatchSettings<N>& s, Workspace& workspace, Pose& pose) {
  const double gate_m = mission.parameters.gate_first_m;
  set_gate(2 * gate_m, s);
  for (int i = 0; i < kNearPasses; ++i) take_plane_pass(mission, s, false, workspace, pose);
  set_gate(gate_m, s);
  for (int i = 0; i < kRayPasses; ++i) (void)take_pass(mission, s, PassKind{kQuarter}, workspace, pose);
}

// How many of a quarter of the points lie on the model, to within their noise and a little more.
std::uint32_t explained(const Mission& mission, MatchSettings<N> s, const Pose& pose, const Workspace& workspace) {
  set_gate(0.2 * mission.parameters.gate_first_m, s);
  const PathPose<N> path = to_path<N>(pose);
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < workspace.points.size(); i += kQuarter) {
    const MatchPoint<N>& point = workspace.points[i];
    FieldRay<N> ray = to_target(path, point);
    set_cells(mission.field, ray);
    if (!near_grid(ray)) continue;
    const N::Length reach = N::to<N::Unit>(0.4) * point.reach + s.gate;
    if (walk_field(mission.field, ray, -reach, reach).found) ++count;
  }
  return count;
}

struct Candidate {
  Pose pose;
  std::uint32_t score = 0;
};

Candidate settled(const Mission& mission, const MatchSettings<N>& settings, Pose pose, Workspace& workspace) {
  MatchSettings<N> s = settings;
  settle(mission, s, workspace, pose);
  return {pose, explained(mission, settings, pose, workspace)};
}

// A wrong minimum is mostly a slide along an axis with a good rotation: tries them.
Candidate slide(const Mission& mission, const MatchSettings<N>& s, int axis, double step_m, const Candidate& start, Workspace& workspace) {
  Candidate best = start;
  for (int step = -kSlides; step <= kSlides; ++step) {
    if (step == 0) continue;
    Pose moved = start.pose;
    moved.p[axis] += step * step_m;
    const Candidate candidate = settled(mission, s, moved, workspace);
    if (candidate.score > best.score) best = candidate;
  }
  return best;
}

}  // namespace

Pose approach_from_afar(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace) {
  if (workspace.points.size() < kQuarter * kMinimumPoints) return T_target_sensor;
  MatchSettings<N> s = make_settings(mission.parameters, workspace);
  Pose pose = center_points(mission, T_target_sensor, workspace);
  double gate_m = kFarGateFirst * mission.radius_m;
  for (int i = 0; i < kFarPasses; ++i) {
    set_gate(gate_m, s);
    take_plane_pass(mission, s, true, workspace, pose);
    gate_m = gate_m * kFarGateShrink > 2 * mission.parameters.gate_first_m ? gate_m * kFarGateShrink : 2 * mission.parameters.gate_first_m;
  }
  Candidate best = settled(mission, s, pose, workspace);
  const double enough = kGoodShare * static_cast<double>(workspace.points.size()) / kQuarter;
  for (const double step : kSlideSteps) {
    for (int axis = 0; axis < 3 && best.score < enough; ++axis) {
      best = slide(mission, s, axis, step * mission.radius_m, best, workspace);
    }
  }
  return best.pose;
}

}  // namespace lasso
