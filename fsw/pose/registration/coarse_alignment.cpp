// The wide start: from a rough pose to one that the registration converges from.
#include "fsw/pose/registration/gauss_newton.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

constexpr std::size_t kFarPoints = 96;  // at most, evenly taken, are looked at
constexpr int kFarPasses = 20;
constexpr double kFarGateFirst = 0.9;            // of the model's radius
constexpr double kFarGateShrink = 0.8;           // per pass
constexpr double kFrontOfCenter = 0.15;          // of the radius: how far in front of the model's centre its visible side lies
constexpr int kSlides = 6;                       // each way
constexpr double kSlideSteps[] = {0.055, 0.01};  // of the radius: coarse, fine
constexpr int kPlacesOfAxis = 3;                 // slides along it that are aligned with the model
constexpr double kGoodShare = 0.98;              // of the points explained: no slide can be better by much
constexpr int kPlanePasses = 3;
constexpr int kRayPasses = 3;

std::size_t stride_of(const Workspace& workspace) { return (workspace.points.size() + kFarPoints - 1) / kFarPoints; }

// Slides are aligned by every other of them, of a few by all.
std::size_t slide_stride_of(const Workspace& workspace) {
  const std::size_t stride = stride_of(workspace);
  return workspace.points.size() >= std::size_t{4} * kMinimumPoints * stride ? 2 * stride : stride;
}

// Mean of the points and of their rays, target frame.
struct Cloud {
  Vec3 center = Vec3::Zero();
  Vec3 view = Vec3::Zero();
};

Cloud mean_of(const PathPose<N>& pose, const Workspace& workspace) {
  Cloud cloud;
  double count = 0;
  const std::size_t stride = stride_of(workspace);
  for (std::size_t i = 0; i < workspace.points.size(); i += stride) {
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
  const Cloud cloud = mean_of(to_path<N>(T_target_sensor), workspace);
  Pose moved = T_target_sensor;
  moved.p += mission.center_m - kFrontOfCenter * mission.radius_m * cloud.view - cloud.center;
  return moved;
}

// Adds the step of a point to the model's foot point of its brick: three rows, one per axis, Tukey-weighted by distance.
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

struct PlanePass {
  std::size_t stride;  // of the points
  bool far;            // where the surface is far, foot points
};

// A pass over the points on closest planes.
void take_plane_pass(const Mission& mission, const MatchSettings<N>& s, const PlanePass& kind, const Workspace& workspace, Pose& pose) {
  const Field<N>& field = mission.field;
  const PathPose<N> path = to_path<N>(pose);
  const float gate_m = N::to_float(s.gate);
  Pass pass(mission);
  for (std::size_t i = 0; i < workspace.points.size(); i += kind.stride) {
    FieldRay<N> ray = to_target(path, workspace.points[i]);
    set_cells(field, ray);
    if (!near_grid(ray)) continue;
    const GridPlace<N> place = place_in_grid(field, ray.cell_m);
    if (is_near(field, place)) {
      add_near_plane(field, place, gate_m, ray, pass.sums);
    } else if (kind.far) {
      add_foot(field, place, gate_m, ray, pass.sums);
    }
  }
  pass.sums.rows.flush();
  Descent whole;
  solve_pass(mission, s, whole, pass, pose);
}

void align_to_planes(const Mission& mission, MatchSettings<N> s, std::size_t stride, const Workspace& workspace, Pose& pose) {
  set_gate(2 * mission.parameters.gate_first_m, s);
  for (int i = 0; i < kPlanePasses; ++i) take_plane_pass(mission, s, {stride, false}, workspace, pose);
}

// How many of the points lie on the model, to within their noise and a little more.
std::uint32_t explained(const Mission& mission, MatchSettings<N> s, const Pose& pose, const Workspace& workspace) {
  set_gate(0.2 * mission.parameters.gate_first_m, s);
  const PathPose<N> path = to_path<N>(pose);
  std::uint32_t count = 0;
  const std::size_t stride = stride_of(workspace);
  for (std::size_t i = 0; i < workspace.points.size(); i += stride) {
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

// Aligns along the rays a pose that was aligned with the planes.
Candidate drawn(const Mission& mission, const MatchSettings<N>& settings, Pose pose, Workspace& workspace) {
  MatchSettings<N> s = settings;
  set_gate(mission.parameters.gate_first_m, s);
  PassKind kind{stride_of(workspace), Lookup::kWalk};
  for (int i = 0; i < kRayPasses; ++i) {
    (void)take_pass(mission, s, kind, workspace, pose);
    kind.lookup = Lookup::kLast;
  }
  return {pose, explained(mission, settings, pose, workspace)};
}

Candidate settled(const Mission& mission, const MatchSettings<N>& s, Pose pose, Workspace& workspace) {
  align_to_planes(mission, s, stride_of(workspace), workspace, pose);
  return drawn(mission, s, pose, workspace);
}

// Truncated distances of the points at each slide along an axis, in 255ths of the truncation.
struct SlideDistances {
  std::uint32_t sum[2 * kSlides + 1] = {};
};

// Adds a point's, whose place in the grid of distances is `cell`.
void add_distances(const SearchTables<N>& t, const float (&cell)[3], int axis, float step_cells, SlideDistances& distances) {
  constexpr float kOutside = 1000;  // cells
  std::uint32_t index[3];
  for (int step = -kSlides; step <= kSlides; ++step) {
    for (int i = 0; i < 3; ++i) {
      const float x = i == axis ? cell[i] + static_cast<float>(step) * step_cells : cell[i];
      index[i] = static_cast<std::uint32_t>(static_cast<std::int32_t>(x >= 0 && x < kOutside ? x : kOutside));
    }
    distances.sum[step + kSlides] += distance_byte(t, index[0], index[1], index[2]);
  }
}

SlideDistances distances_of(const Mission& mission, int axis, double step_m, const Pose& pose, const Workspace& workspace) {
  const SearchTables<N>& t = mission.search;
  const PathPose<N> path = to_path<N>(pose);
  SlideDistances distances;
  const std::size_t stride = stride_of(workspace);
  for (std::size_t i = 0; i < workspace.points.size(); i += stride) {
    N::Length m[3];
    transform(path, workspace.points[i].p, m);
    float cell[3];
    for (int k = 0; k < 3; ++k) cell[k] = (N::to_float(m[k]) - t.origin_m[k]) * t.cells_per_m;
    add_distances(t, cell, axis, static_cast<float>(step_m) * t.cells_per_m, distances);
  }
  return distances;
}

// The slide that leaves the points closest to the surface; it and those beside it are not taken again.
int take_closest(SlideDistances& distances) {
  constexpr std::uint32_t kTaken = UINT32_MAX;
  int closest = -kSlides;
  for (int step = -kSlides; step <= kSlides; ++step) {
    if (distances.sum[step + kSlides] < distances.sum[closest + kSlides]) closest = step;
  }
  for (int step = closest - 1; step <= closest + 1; ++step) {
    if (step >= -kSlides && step <= kSlides) distances.sum[step + kSlides] = kTaken;
  }
  return closest;
}

constexpr float kNoDistance = 1e9F;  // m, more than any sum

// Sum of the points' truncated distances to the surface.
float distance_of(const Mission& mission, const Pose& pose, const Workspace& workspace) {
  const PathPose<N> path = to_path<N>(pose);
  float sum = 0;
  const std::size_t stride = stride_of(workspace);
  for (std::size_t i = 0; i < workspace.points.size(); i += stride) {
    N::Length m[3];
    transform(path, workspace.points[i].p, m);
    const float m_float[3] = {N::to_float(m[0]), N::to_float(m[1]), N::to_float(m[2])};
    sum += surface_distance(mission.search, m_float).distance_m;
  }
  return sum;
}

// A wrong minimum is mostly a slide along an axis with a good rotation. Those that leave the points closest to the surface are aligned with
// the model, and the closest of these along the rays.
Candidate slide(const Mission& mission, const MatchSettings<N>& s, int axis, double step_m, const Candidate& start, Workspace& workspace) {
  SlideDistances distances = distances_of(mission, axis, step_m, start.pose, workspace);
  distances.sum[kSlides] = UINT32_MAX;
  Pose closest = start.pose;
  float least_m = kNoDistance;
  for (int i = 0; i < kPlacesOfAxis; ++i) {
    Pose moved = start.pose;
    moved.p[axis] += take_closest(distances) * step_m;
    align_to_planes(mission, s, slide_stride_of(workspace), workspace, moved);
    const float distance_m = distance_of(mission, moved, workspace);
    if (!(distance_m < least_m)) continue;
    least_m = distance_m;
    closest = moved;
  }
  const Candidate candidate = drawn(mission, s, closest, workspace);
  return candidate.score > start.score ? candidate : start;
}

// From far off: the middle of the points, then foot points and planes with a gate that shrinks.
Pose align_from_afar(const Mission& mission, MatchSettings<N> s, const Pose& T_target_sensor, const Workspace& workspace) {
  Pose pose = center_points(mission, T_target_sensor, workspace);
  const double least_m = 2 * mission.parameters.gate_first_m;
  double gate_m = kFarGateFirst * mission.radius_m;
  for (int i = 0; i < kFarPasses; ++i) {
    set_gate(gate_m, s);
    take_plane_pass(mission, s, {stride_of(workspace), true}, workspace, pose);
    gate_m = gate_m * kFarGateShrink > least_m ? gate_m * kFarGateShrink : least_m;
  }
  return pose;
}

}  // namespace

Pose align_coarsely(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace) {
  if (workspace.points.size() < kMinimumPoints) return T_target_sensor;
  const MatchSettings<N> s = make_settings(mission.parameters, workspace);
  const std::size_t stride = stride_of(workspace);
  const std::size_t looked_at = (workspace.points.size() + stride - 1) / stride;
  const double enough = kGoodShare * static_cast<double>(looked_at);
  Candidate best = settled(mission, s, align_from_afar(mission, s, T_target_sensor, workspace), workspace);
  for (const double step : kSlideSteps) {
    for (int axis = 0; axis < 3 && best.score < enough; ++axis) {
      best = slide(mission, s, axis, step * mission.radius_m, best, workspace);
    }
  }
  return best.pose;
}

}  // namespace lasso
