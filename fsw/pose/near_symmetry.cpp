#include "fsw/pose/near_symmetry.hpp"

#include "fsw/pose/model_ray.hpp"
#include "fsw/pose/register.hpp"

namespace lasso {
namespace {

using N = FlightNumber;
constexpr std::uint32_t kMissSamples = 64;

// Every n-th point, at most kTwinPoints of them.
void thin_points(Workspace& workspace) {
  FixedVector<MatchPoint<N>, kMaxRays>& points = workspace.points;
  const std::size_t stride = (points.size() + kTwinPoints - 1) / kTwinPoints;
  if (stride < 2) return;
  const std::size_t kept = (points.size() + stride - 1) / stride;
  for (std::size_t i = 0; i < kept; ++i) points[i] = points[i * stride];
  points.shrink(kept);
}

struct MissSample {
  std::uint32_t misses = 0;  // all of them
  std::uint32_t looked_up = 0;
  std::uint32_t violated = 0;  // the model says that these should have hit
};

MissSample sample_misses(const Mission& mission, const Pose& T_target_sensor, const Workspace& workspace) {
  MissSample sample;
  for (const ScanRay<N>& ray : workspace.rays) sample.misses += ray.state == RayState::kMiss ? 1u : 0u;
  const std::uint32_t stride = sample.misses / kMissSamples + 1;
  const PathPose<N> pose = to_path<N>(T_target_sensor);
  std::uint32_t index = 0;
  for (const ScanRay<N>& ray : workspace.rays) {
    if (ray.state != RayState::kMiss || index++ % stride != 0) continue;
    ++sample.looked_up;
    if (meets_model(mission, pose, ray)) ++sample.violated;
  }
  return sample;
}

double cost_of(const Mission& mission, const HitSolution& hits, bool misses_known, const Workspace& workspace) {
  const double agreement = hit_miss_agreement(mission, hits.T_target_sensor, hits.inliers, hits.usable, misses_known, workspace);
  return mean_cost(hits) + kUnexplainedCost * (1 - agreement);
}

}  // namespace

double hit_miss_agreement(const Mission& mission, const Pose& T_target_sensor, std::uint32_t inliers, std::uint32_t returns,
                          bool misses_known, const Workspace& workspace) {
  double agreeing = inliers;
  double all = returns;
  if (misses_known) {
    const MissSample sample = sample_misses(mission, T_target_sensor, workspace);
    const double violated = sample.looked_up > 0 ? static_cast<double>(sample.violated) / sample.looked_up : 0;
    const double expected = mission.parameters.dropout_probability;  // drop-outs look like violated misses
    const double blamed = violated > expected ? violated - expected : 0;
    agreeing += sample.misses * (1 - blamed);
    all += sample.misses;
  }
  return all > 0 ? agreeing / all : 0;
}

Pose twin_of(const NearSymmetry<N>& symmetry, const Pose& T_target_sensor) {
  Pose motion;
  motion.q =
      normalized(Quat(N::to_double(symmetry.q[3]), N::to_double(symmetry.q[0]), N::to_double(symmetry.q[1]), N::to_double(symmetry.q[2])));
  motion.p = Vec3(N::to_double(symmetry.p[0]), N::to_double(symmetry.p[1]), N::to_double(symmetry.p[2]));
  return motion * T_target_sensor;
}

bool has_twin_better_by(const Mission& mission, double margin, const Pose& T_target_sensor, bool misses_known, Workspace& workspace) {
  const std::size_t all = workspace.points.size();
  if (all == 0) return false;
  thin_points(workspace);
  const double least = mission.parameters.inliers_min * static_cast<double>(workspace.points.size());  // times `all`
  const HitSolution own = register_look(mission, RegisterLook::kFirst, T_target_sensor, workspace);
  const double most = cost_of(mission, own, misses_known, workspace) - margin;
  for (const NearSymmetry<N>& symmetry : mission.search.symmetries) {
    const Pose start = pull_on_rays(mission, twin_of(symmetry, T_target_sensor), workspace);
    const HitSolution twin = register_look(mission, RegisterLook::kFirst, start, workspace);
    const bool counts = twin.inliers * static_cast<double>(all) >= least && mean_cost(twin) < most;
    if (counts && cost_of(mission, twin, misses_known, workspace) < most) return true;
  }
  return false;
}

}  // namespace lasso
