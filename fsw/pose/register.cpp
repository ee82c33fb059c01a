#include "fsw/pose/register.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/symmetric6.hpp"
#include "fsw/pose/match.hpp"

namespace lasso {
namespace {

using N = FlightNumber;
constexpr std::size_t kQuarter = 4;
constexpr std::uint32_t kMinimumPoints = 12;

MatchSettings<N> make_settings(const MissionParameters& p, const Workspace& workspace) {
  MatchSettings<N> s{};
  s.kernel_width = N::to_ratio(p.kernel_width);
  s.kernel_squared = s.kernel_width * s.kernel_width;
  s.surface_variance = N::to_ratio(p.surface_sigma_m * p.surface_sigma_m);
  s.cos_incidence_max = N::to_ratio(sin_cos(p.incidence_max_rad).cos);
  s.reference_variance = workspace.points[workspace.points.size() / 2].range_variance;
  return s;
}

void set_gate(double gate_m, MatchSettings<N>& s) {
  s.gate = N::to_length(gate_m);
  s.walk_extra = s.gate;
}

// A prior as wide as the model itself keeps directions that no ray sees solvable; it says nothing where any ray does.
void add_wide_prior(double radius_m, Mat6& H) {
  const double mean = H.trace() / 6;
  for (int i = 0; i < 3; ++i) {
    H(i, i) += 1 + 1e-7 * mean * radius_m * radius_m;
    H(i + 3, i + 3) += 1 / (radius_m * radius_m) + 1e-7 * mean;
  }
}

struct Step {
  Vec6 x = Vec6::Zero();
  Status status = Status::kNoData;
};

Step solve_pass(const Mission& mission, const MatchSettings<N>& s, const PassSums<N>& sums, Mat6& H) {
  Step step;
  if (sums.equations.count < kMinimumPoints) return step;
  Vec6 b;
  sums.equations.unpack(H, b);
  const double scale = 1 / N::to_double(s.reference_variance);
  H *= scale;
  b *= scale;
  add_wide_prior(mission.radius_m, H);
  step.status = solve6(H, b, step.x);
  return step;
}

struct Pass {
  PassSums<N> sums;
  Step step;
  Mat6 H = Mat6::Zero();
};

// One pass over the points from `pose`, and the step taken.
Pass take_pass(const Mission& mission, const MatchSettings<N>& s, std::size_t stride, Lookup lookup, Workspace& workspace, Pose& pose) {
  Pass pass;
  const Span<MatchPoint<N>> points(workspace.points.begin(), workspace.points.size());
  match_points(mission.field, to_path<N>(pose), s, points, stride, lookup, pass.sums);
  pass.step = solve_pass(mission, s, pass.sums, pass.H);
  if (pass.step.status == Status::kOk) pose = step_pose(pose, pass.step.x);
  return pass;
}

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
    if (pass.step.status != Status::kOk) {
      solution.stop = reason_of(pass.step.status);
      return;
    }
    keep(pass, s, solution);
    if (is_small(pass.step.x, mission.parameters)) {
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
  set_gate(1.5 * mission.parameters.gate_first_m, s);
  (void)take_pass(mission, s, kQuarter, Lookup::kNear, workspace, solution.T_target_sensor);
  set_gate(mission.parameters.gate_first_m, s);
  (void)take_pass(mission, s, kQuarter, Lookup::kWalk, workspace, solution.T_target_sensor);
  solution.iterations = 2;
  set_gate(0, s);
  iterate_all(mission, s, workspace, solution);
  return solution;
}

}  // namespace lasso
