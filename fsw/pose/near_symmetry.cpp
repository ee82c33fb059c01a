#include "fsw/pose/near_symmetry.hpp"

#include "fsw/pose/quality.hpp"
#include "fsw/pose/register.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

// Every n-th point, at most kTwinPoints of them.
void thin_points(Workspace& workspace) {
  FixedVector<MatchPoint<N>, kMaxRays>& points = workspace.points;
  const std::size_t stride = (points.size() + kTwinPoints - 1) / kTwinPoints;
  if (stride < 2) return;
  const std::size_t kept = (points.size() + stride - 1) / stride;
  for (std::size_t i = 0; i < kept; ++i) points[i] = points[i * stride];
  points.shrink(kept);
}

double cost_of(const Mission& mission, const HitSolution& hits, bool misses_known, const Workspace& workspace) {
  const double agreement = hit_miss_agreement(mission, hits.T_target_sensor, hits.inliers, hits.usable, misses_known, workspace);
  return mean_cost(hits) + kUnexplainedCost * (1 - agreement);
}

}  // namespace

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
