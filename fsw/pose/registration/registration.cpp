#include "fsw/pose/registration/registration.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/pose/registration/gauss_newton.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

// With estimation.stop_translation_m: 0.1 mm at half a metre from the origin. It counts where the noise shows less than this alone, as a
// step below a sigma of the pose ends a registration, too (docs/decisions/registration-passes.md).
constexpr double kStopRotation_rad = 0.01 * kRadPerDeg;
constexpr double kInsignificant = 1;       // squared step in sigmas^2
constexpr double kOwnUncertainty = 8.56;   // the same: below it are four of five errors of a pose with six directions (chi squared)
constexpr double kNarrowestKernel = 1e-4;  // of the kernel's squared width
constexpr double kNarrowed = 0.5;          // the same, from one pass to the next
constexpr int kUndampedPasses = 8;
constexpr double kNoCost = 1e300;
constexpr double kLeastUsable = 0.5;  // a pose at which fewer of the returns could be inliers is none of theirs

bool is_small(const Vec6& x, const MissionParameters& p) {
  return x.head<3>().squaredNorm() < kStopRotation_rad * kStopRotation_rad &&
         x.tail<3>().squaredNorm() < p.stop_translation_m * p.stop_translation_m;
}

// Variance of the residuals over the assumed one.
double noise_of(const Pass& pass, const MatchSettings<N>& s) {
  return pass.sums.rows.chi_squared() / N::to_double(s.reference_variance) / pass.sums.rows.count();
}

// A step below the pose's own uncertainty, by the noise that the residuals show: points at edges may change sides for ever.
bool is_below(double squared_sigmas, const Pass& pass, const MatchSettings<N>& s) {
  return pass.x.dot(pass.H * pass.x) < squared_sigmas * noise_of(pass, s);
}

// Where the last pass shows less noise than the mission assumes, the kernel of the next one is narrower: a match with the wrong surface,
// which the assumed noise would excuse, stands out. Says whether it is much narrower than the last pass had it.
bool narrow_kernel(const MissionParameters& p, const Pass& last, MatchSettings<N>& s) {
  if (last.status != Status::kOk) return false;
  const double before = N::to_double(s.kernel_squared);
  const double share = clamp(noise_of(last, s), kNarrowestKernel, 1.0);
  s.kernel_squared = N::to<N::Kernel>(p.kernel_width * p.kernel_width * share);
  return N::to_double(s.kernel_squared) < kNarrowed * before;
}

StopReason reason_of(Status status) { return status == Status::kNoData ? StopReason::kTooFewPoints : StopReason::kSingular; }

void keep(const Pass& pass, const MatchSettings<N>& s, HitSolution& solution) {
  solution.H = pass.H;
  solution.inliers = pass.sums.rows.count();
  solution.usable = pass.sums.usable;
  solution.chi_squared = pass.sums.rows.chi_squared() / N::to_double(s.reference_variance);
  solution.squared_residual_m2 = pass.sums.rows.squared_range();
}

// How a look begins: a pass with a wide gate, and one more where its step was cut, with a narrower one.
struct Opening {
  double gate;         // of the first pass, in estimation.gate_first_m
  std::size_t stride;  // of the points
  Lookup next;         // points that it leaves out have to be walked along their whole gate after it
  int patience;        // passes of the estimate after which a step within the pose's own uncertainty ends the look
};
constexpr int kOpeningPasses = 2;
constexpr double kGateShrink = 0.3;
constexpr int kRoughPatience = 6;  // more of it where an opening moves the pose farther than the start is believed to be off
constexpr int kEndless = 1000;     // more of it than there are passes
constexpr Opening kFirstLook{1.0, 2, Lookup::kWalk, 3};
constexpr Opening kSecondLook{2.0, 1, Lookup::kLast, 5};

struct Start {
  Pose T_target_sensor;
  std::uint16_t passes = 0;  // that the estimate has taken
  int patience = 0;          // more of it than the opening has
};

class Look {
 public:
  Look(const Mission& mission, const Opening& opening, const Start& start, Workspace& workspace)
      : mission_(mission), opening_(opening), workspace_(workspace), settings_(make_settings(mission.parameters, workspace)) {
    solution_.T_target_sensor = start.T_target_sensor;
    solution_.iterations = start.passes;
    patience_ = opening.patience + start.patience;
  }

  HitSolution take() {
    const double longest_m = longest_step_m(mission_.parameters, settings_);
    open(longest_m);
    iterate_all(longest_m);
    return solution_;
  }

 private:
  void open(double longest_m) {
    PassKind kind{opening_.stride, Lookup::kWalk};
    double gate_m = opening_.gate * mission_.parameters.gate_first_m;
    bool is_cut = true;
    bool is_rough = false;
    for (int i = 0; i < kOpeningPasses && is_cut; ++i) {
      set_gate(gate_m, settings_);
      Descent wide{opening_.gate * longest_m};
      const Pass pass = step(kind, wide);
      const double length_m = length_of(pass.x, mission_.radius_m);
      is_cut = length_m > wide.longest_step_m;
      is_rough = is_rough || length_m > longest_m;
      kind.lookup = Lookup::kLast;
      gate_m *= kGateShrink;
    }
    if (is_rough) patience_ += kRoughPatience;
    set_gate(0, settings_);
  }

  // Passes over all points. Steps can go round in a ring without ever turning back: later ones are halved by their number.
  void iterate_all(double longest_m) {
    const int limit = static_cast<int>(mission_.parameters.iterations_max);
    solution_.stop = StopReason::kIterationLimit;
    PassKind kind{1, opening_.next};
    Descent descent{longest_m};
    for (int i = 0; i < limit; ++i) {
      const Pass pass = step(kind, descent);
      kind.lookup = Lookup::kLast;
      if (i + 1 >= kUndampedPasses) descent.damping *= 0.5;
      keep(pass, settings_, solution_);
      if (has_ended(pass)) return;
    }
  }

  Pass step(const PassKind& kind, Descent& descent) {
    const Pass pass = take_pass(mission_, settings_, kind, descent, workspace_, solution_.T_target_sensor);
    narrowed_ = narrow_kernel(mission_.parameters, pass, settings_);
    ++solution_.iterations;
    return pass;
  }

  bool has_ended(const Pass& pass) {
    if (pass.status != Status::kOk) {
      solution_.stop = reason_of(pass.status);
      return true;
    }
    if (narrowed_) return false;  // what the kernel leaves out now can move the pose
    const double limit = solution_.iterations > patience_ ? kOwnUncertainty : kInsignificant;
    const bool ended = is_small(pass.x, mission_.parameters) || is_below(limit, pass, settings_);
    if (ended) solution_.stop = StopReason::kConverged;
    return ended;
  }

  const Mission& mission_;
  const Opening& opening_;
  Workspace& workspace_;
  MatchSettings<N> settings_;
  HitSolution solution_;
  bool narrowed_ = false;
  int patience_ = 0;
};

HitSolution register_from(const Mission& mission, RegisterLook look, const Start& start, Workspace& workspace) {
  if (workspace.points.size() < kMinimumPoints) {
    HitSolution nothing;
    nothing.T_target_sensor = start.T_target_sensor;
    nothing.stop = StopReason::kTooFewPoints;
    return nothing;
  }
  return Look(mission, look == RegisterLook::kFirst ? kFirstLook : kSecondLook, start, workspace).take();
}

// Of two that explain as much the second has seen all points from the start.
bool is_better(const HitSolution& second, const HitSolution& first) {
  if (explained_share(second) > explained_share(first)) return true;
  return second.stop == StopReason::kConverged && explained_share(second) >= explained_share(first);
}

}  // namespace

double explained_share(const HitSolution& solution) {
  return solution.usable > 0 ? static_cast<double>(solution.inliers) / solution.usable : 0;
}

double mean_cost(const HitSolution& solution) {
  const double left_out = static_cast<double>(solution.usable) - static_cast<double>(solution.inliers);
  return solution.usable > 0 ? (solution.chi_squared + kUnexplainedCost * left_out) / solution.usable : kNoCost;
}

HitSolution weigh_hits(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace) {
  HitSolution solution;
  solution.T_target_sensor = T_target_sensor;
  if (workspace.points.empty()) return solution;
  const MatchSettings<N> s = make_settings(mission.parameters, workspace);
  Pose stepped = T_target_sensor;
  const Pass pass = take_pass(mission, s, PassKind{}, workspace, stepped);
  keep(pass, s, solution);
  if (pass.status != Status::kOk) solution.stop = reason_of(pass.status);
  return solution;
}

bool move_hits(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace, HitSolution& hits) {
  HitSolution moved = weigh_hits(mission, T_target_sensor, workspace);
  if (moved.stop != StopReason::kNotRun) return false;
  moved.iterations = hits.iterations;
  moved.stop = hits.stop;
  hits = moved;
  return true;
}

double cost_of_hits(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace) {
  HitSolution solution;
  if (workspace.points.empty()) return mean_cost(solution);
  const MatchSettings<N> s = make_settings(mission.parameters, workspace);
  keep(match_pass(mission, s, {}, T_target_sensor, workspace), s, solution);
  return mean_cost(solution);
}

double bounded_cost(const Mission& mission, const Pose& T_target_sensor, double usable, Lookup lookup, Workspace& workspace) {
  if (workspace.points.empty()) return kNoCost;
  MatchSettings<N> s = make_settings(mission.parameters, workspace);
  s.kernel_squared = N::to<N::Kernel>(3 * kMostOfAReturn);  // rho's bound is a third of it
  const Span<MatchPoint<N>> points(workspace.points.begin(), workspace.points.size());
  const CostSums<N> sums = cost_points(mission.field, to_path<N>(T_target_sensor), s, lookup, points);
  if (sums.usable == 0 || kLeastUsable * usable > sums.usable) return kNoCost;
  return kMostOfAReturn * (1 - N::to_double(sums.explained) / sums.usable) * usable;
}

HitSolution register_look(const Mission& mission, RegisterLook look, const Pose& T_target_sensor, Workspace& workspace) {
  return register_from(mission, look, {T_target_sensor, 0, kEndless}, workspace);
}

HitSolution register_first(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace) {
  return register_from(mission, RegisterLook::kFirst, {T_target_sensor}, workspace);
}

HitSolution register_hits(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace) {
  HitSolution first = register_first(mission, T_target_sensor, workspace);
  if (workspace.points.size() < kMinimumPoints || explained_share(first) >= kExplainedShare) return first;
  const HitSolution second = register_from(mission, RegisterLook::kSecond, {T_target_sensor, first.iterations}, workspace);
  first.iterations = second.iterations;
  return is_better(second, first) ? second : first;
}

}  // namespace lasso
