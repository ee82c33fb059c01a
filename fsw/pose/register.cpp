#include "fsw/pose/register.hpp"

#include "fsw/pose/gauss_newton.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

bool is_small(const Vec6& x, const MissionParameters& p) {
  return x.head<3>().squaredNorm() < p.stop_rotation_rad * p.stop_rotation_rad &&
         x.tail<3>().squaredNorm() < p.stop_translation_m * p.stop_translation_m;
}

StopReason reason_of(Status status) { return status == Status::kNoData ? StopReason::kTooFewPoints : StopReason::kSingular; }

void keep(const Pass& pass, const MatchSettings<N>& s, HitSolution& solution) {
  solution.H = pass.H;
  solution.inliers = pass.sums.equations.count;
  solution.usable = pass.sums.usable;
  solution.chi_squared = static_cast<double>(pass.sums.chi_squared) / N::to_double(s.reference_variance);
  solution.squared_residual_m2 = static_cast<double>(pass.sums.squared_residual);
}

// Passes over all points, the first of them a walk along the whole gate: without one, surfaces in front go unnoticed.
void iterate_all(const Mission& mission, const MatchSettings<N>& s, Workspace& workspace, HitSolution& solution) {
  const int limit = static_cast<int>(mission.parameters.iterations_max);
  solution.stop = StopReason::kIterationLimit;
  for (int i = 0; i < limit; ++i) {
    const Pass pass = take_pass(mission, s, 1, i == 0 ? Lookup::kWalk : Lookup::kLast, workspace, solution.T_target_sensor);
    ++solution.iterations;
    keep(pass, s, solution);
    if (pass.status != Status::kOk) {
      solution.stop = reason_of(pass.status);
      return;
    }
    if (is_small(pass.x, mission.parameters)) {
      solution.stop = StopReason::kConverged;
      return;
    }
  }
}

}  // namespace

HitSolution register_hits(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace) {
  HitSolution solution;
  solution.T_target_sensor = T_target_sensor;
  solution.stop = StopReason::kTooFewPoints;
  if (workspace.points.size() < kMinimumPoints) return solution;
  MatchSettings<N> s = make_settings(mission.parameters, workspace);
  const double gate_m = mission.parameters.gate_first_m;
  if (gate_m > 0) {
    set_gate(1.5 * gate_m, s);
    (void)take_pass(mission, s, kQuarter, Lookup::kNear, workspace, solution.T_target_sensor);
    set_gate(gate_m, s);
    (void)take_pass(mission, s, kQuarter, Lookup::kWalk, workspace, solution.T_target_sensor);
    solution.iterations = 2;
  }
  set_gate(0, s);
  iterate_all(mission, s, workspace, solution);
  return solution;
}

}  // namespace lasso
