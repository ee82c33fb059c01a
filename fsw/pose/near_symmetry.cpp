#include "fsw/pose/near_symmetry.hpp"

#include "fsw/pose/quality.hpp"
#include "fsw/pose/register.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

constexpr double kNoTwin = -1e9;

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

double twin_advantage(const Mission& mission, const Pose& T_target_sensor, bool misses_known, Workspace& workspace) {
  const std::size_t all = workspace.points.size();
  if (all == 0) return kNoTwin;
  thin_points(workspace);
  const double least = mission.parameters.inliers_min * static_cast<double>(workspace.points.size());  // times `all`
  const double own = cost_of(mission, weigh_hits(mission, T_target_sensor, workspace), misses_known, workspace);
  double most = kNoTwin;
  for (const NearSymmetry<N>& symmetry : mission.search.symmetries) {
    const Pose start = pull_on_rays(mission, twin_of(symmetry, T_target_sensor), workspace);
    const HitSolution twin = register_look(mission, RegisterLook::kFirst, start, workspace);
    if (twin.inliers * static_cast<double>(all) < least) continue;
    const double advantage = own - cost_of(mission, twin, misses_known, workspace);
    if (advantage > most) most = advantage;
  }
  return most;
}

}  // namespace lasso
