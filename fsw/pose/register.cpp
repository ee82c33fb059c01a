#include "fsw/pose/register.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/pose/gauss_newton.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

constexpr double kInsignificant = 1;       // squared step in sigmas^2
constexpr double kNarrowestKernel = 1e-4;  // of the kernel's squared width
constexpr int kUndampedPasses = 8;

bool is_small(const Vec6& x, const MissionParameters& p) {
  return x.head<3>().squaredNorm() < p.stop_rotation_rad * p.stop_rotation_rad &&
         x.tail<3>().squaredNorm() < p.stop_translation_m * p.stop_translation_m;
}

// Variance of the residuals over the assumed one.
double noise_of(const Pass& pass, const MatchSettings<N>& s) {
  return pass.sums.rows.chi_squared() / N::to_double(s.reference_variance) / pass.sums.rows.count();
}

// A step below the pose's own uncertainty, by the noise that the residuals show: points at edges may change sides for ever.
bool is_insignificant(const Pass& pass, const MatchSettings<N>& s) {
  return pass.x.dot(pass.H * pass.x) < kInsignificant * noise_of(pass, s);
}

// Where the last pass shows less noise than the mission assumes, the kernel of the next one is narrower: a match with the wrong surface,
// which the assumed noise would excuse, stands out.
void narrow_kernel(const MissionParameters& p, const Pass& last, MatchSettings<N>& s) {
  if (last.status != Status::kOk) return;
  const double share = clamp(noise_of(last, s), kNarrowestKernel, 1.0);
  s.kernel_squared = N::to<N::Kernel>(p.kernel_width * p.kernel_width * share);
}

// Points that met the wrong surface can ask for steps along directions that hardly any other point holds, past the minimum that the start
// lies in and on to another one. No step goes farther than the start is believed to be off, or than the noise reaches.
double longest_step_m(const MissionParameters& p, const MatchSettings<N>& s) {
  const double sigma_m = square_root(N::to_double(s.reference_variance));
  return p.gate_first_m > sigma_m ? p.gate_first_m : sigma_m;
}

StopReason reason_of(Status status) { return status == Status::kNoData ? StopReason::kTooFewPoints : StopReason::kSingular; }

void keep(const Pass& pass, const MatchSettings<N>& s, HitSolution& solution) {
  solution.H = pass.H;
  solution.inliers = pass.sums.rows.count();
  solution.usable = pass.sums.usable;
  solution.chi_squared = pass.sums.rows.chi_squared() / N::to_double(s.reference_variance);
  solution.squared_residual_m2 = pass.sums.rows.squared_range();
}

// Passes over all points. Steps can go round in a ring without ever turning back: later ones are halved by their number.
void iterate_all(const Mission& mission, PassKind kind, MatchSettings<N>& s, double longest_m, Workspace& workspace,
                 HitSolution& solution) {
  const int limit = static_cast<int>(mission.parameters.iterations_max);
  solution.stop = StopReason::kIterationLimit;
  Descent descent{longest_m};
  for (int i = 0; i < limit; ++i) {
    const Pass pass = take_pass(mission, s, kind, descent, workspace, solution.T_target_sensor);
    kind.lookup = Lookup::kLast;
    if (i + 1 >= kUndampedPasses) descent.damping *= 0.5;
    ++solution.iterations;
    keep(pass, s, solution);
    narrow_kernel(mission.parameters, pass, s);
    if (pass.status != Status::kOk) {
      solution.stop = reason_of(pass.status);
      return;
    }
    if (is_small(pass.x, mission.parameters) || is_insignificant(pass, s)) {
      solution.stop = StopReason::kConverged;
      return;
    }
  }
}

// How a look begins: passes with a wide gate that shrinks. Points that they leave out have to be walked along their whole gate after them.
struct Opening {
  int passes;
  double gate;         // of the first, in estimation.gate_first_m
  std::size_t stride;  // of the points
  Lookup next;
};
constexpr double kGateShrink = 0.3;
constexpr Opening kFirstLook{2, 1.0, kQuarter, Lookup::kWalk};
constexpr Opening kSecondLook{2, 2.0, 1, Lookup::kLast};

HitSolution register_from(const Mission& mission, const Pose& start, const Opening& opening, Workspace& workspace) {
  HitSolution solution;
  solution.T_target_sensor = start;
  MatchSettings<N> s = make_settings(mission.parameters, workspace);
  const double longest_m = longest_step_m(mission.parameters, s);
  double gate_m = opening.gate * mission.parameters.gate_first_m;
  PassKind kind{opening.stride, Lookup::kWalk};
  for (int i = 0; i < opening.passes; ++i) {
    set_gate(gate_m, s);
    Descent wide{opening.gate * longest_m};
    narrow_kernel(mission.parameters, take_pass(mission, s, kind, wide, workspace, solution.T_target_sensor), s);
    kind.lookup = Lookup::kLast;
    gate_m *= kGateShrink;
    ++solution.iterations;
  }
  set_gate(0, s);
  iterate_all(mission, PassKind{1, opening.next}, s, longest_m, workspace, solution);
  return solution;
}

}  // namespace

double explained_share(const HitSolution& solution) {
  return solution.usable > 0 ? static_cast<double>(solution.inliers) / solution.usable : 0;
}

double mean_cost(const HitSolution& solution) {
  const double left_out = static_cast<double>(solution.usable) - static_cast<double>(solution.inliers);
  return solution.usable > 0 ? (solution.chi_squared + kUnexplainedCost * left_out) / solution.usable : 1e300;
}

HitSolution weigh_hits(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace) {
  HitSolution solution;
  solution.T_target_sensor = T_target_sensor;
  if (workspace.points.empty()) return solution;
  const MatchSettings<N> s = make_settings(mission.parameters, workspace);
  Pose stepped = T_target_sensor;
  keep(take_pass(mission, s, PassKind{}, workspace, stepped), s, solution);
  return solution;
}

HitSolution register_look(const Mission& mission, RegisterLook look, const Pose& T_target_sensor, Workspace& workspace) {
  if (workspace.points.size() < kMinimumPoints) {
    HitSolution nothing;
    nothing.T_target_sensor = T_target_sensor;
    nothing.stop = StopReason::kTooFewPoints;
    return nothing;
  }
  return register_from(mission, T_target_sensor, look == RegisterLook::kFirst ? kFirstLook : kSecondLook, workspace);
}

HitSolution register_hits(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace) {
  HitSolution first = register_look(mission, RegisterLook::kFirst, T_target_sensor, workspace);
  if (workspace.points.size() < kMinimumPoints || explained_share(first) >= kExplainedShare) return first;
  HitSolution second = register_look(mission, RegisterLook::kSecond, T_target_sensor, workspace);
  second.iterations = static_cast<std::uint16_t>(second.iterations + first.iterations);
  first.iterations = second.iterations;
  return explained_share(second) > explained_share(first) ? second : first;
}

}  // namespace lasso
