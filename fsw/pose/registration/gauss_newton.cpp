#include "fsw/pose/registration/gauss_newton.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/symmetric6.hpp"
#include "fsw/pose/registration/observability.hpp"

namespace lasso {

double length_of(const Vec6& x, double radius_m) {
  return square_root(x.tail<3>().squaredNorm()) + radius_m * square_root(x.head<3>().squaredNorm());
}

namespace {

using N = FlightNumber;

constexpr double kHeld = 1e3;  // of the information of all axes at the radius: a held one has that much more

// A prior as wide as the model itself keeps directions that no ray sees solvable; it says nothing where any ray does. The part that grows
// with the information covers the rounding of the sums.
void add_wide_prior(double radius_m, Mat6& H) {
  const double prior = prior_information(radius_m, H.bottomRightCorner<3, 3>().trace());
  for (int i = 0; i < 3; ++i) {
    H(i, i) += prior * radius_m * radius_m;
    H(i + 3, i + 3) += prior;
  }
}

// The normal equations of the sums into H of the pass and b; false where there are too few points.
bool set_up(const Mission& mission, const MatchSettings<N>& s, Pass& pass, Vec6& b) {
  if (pass.sums.rows.count() < kMinimumPoints) return false;
  pass.sums.rows.unpack(pass.H, b);
  const double scale = 1 / N::to_double(s.reference_variance);
  pass.H *= scale;
  b *= scale;
  add_wide_prior(mission.radius_m, pass.H);
  return true;
}

Vec6 cut_step(const Vec6& x, double radius_m, double longest_m) {
  const double step_m = length_of(x, radius_m);
  return step_m > longest_m ? Vec6(longest_m / step_m * x) : x;
}

}  // namespace

MatchSettings<N> make_settings(const MissionParameters& p, const Workspace& workspace) {
  MatchSettings<N> s{};
  s.kernel_squared = N::to<N::Kernel>(p.kernel_width * p.kernel_width);
  const auto surface_variance = bounded<N::Variance>(N::to<N::Variance>(p.surface_sigma_m * p.surface_sigma_m));
  s.surface_variance = surface_variance + N::kLeastVariance;
  s.cos_incidence_max = N::to<N::Unit>(sin_cos(p.incidence_max_rad).cos);
  const float factor = N::to_float(workspace.sigma_factor);
  const float worst = N::to_float(workspace.points[workspace.points.size() / 2].range_variance);
  s.reference_variance = N::from_float<N::Variance>(worst / (factor * factor)) + s.surface_variance;
  return s;
}

void set_gate(double gate_m, MatchSettings<N>& s) { s.gate = N::to_length(gate_m); }

void solve_pass(const Mission& mission, const MatchSettings<N>& s, Descent& descent, Pass& pass, Pose& T_target_sensor) {
  Vec6 b;
  if (!set_up(mission, s, pass, b)) return;
  pass.status = solve6(pass.H, b, pass.x);
  if (pass.status != Status::kOk) return;
  if (descent.last.dot(pass.H * pass.x) < 0) descent.damping *= 0.5;
  pass.x *= descent.damping;
  descent.last = cut_step(pass.x, mission.radius_m, descent.longest_step_m);
  T_target_sensor = step_pose(T_target_sensor, descent.last);
}

Pass match_pass(const Mission& mission, const MatchSettings<N>& s, const PassKind& kind, const Pose& T_target_sensor,
                Workspace& workspace) {
  Pass pass(mission);
  const Span<MatchPoint<N>> points(workspace.points.begin(), workspace.points.size());
  match_points(mission.field, to_path<N>(T_target_sensor), s, points, kind, pass.sums);
  return pass;
}

Pass take_pass(const Mission& mission, const MatchSettings<N>& s, const PassKind& kind, Descent& descent, Workspace& workspace,
               Pose& T_target_sensor) {
  Pass pass = match_pass(mission, s, kind, T_target_sensor, workspace);
  solve_pass(mission, s, descent, pass, T_target_sensor);
  return pass;
}

Pass take_pass(const Mission& mission, const MatchSettings<N>& s, const PassKind& kind, Workspace& workspace, Pose& T_target_sensor) {
  Descent whole;
  return take_pass(mission, s, kind, whole, workspace, T_target_sensor);
}

double longest_step_m(const MissionParameters& p, const MatchSettings<N>& s) {
  const double sigma_m = square_root(N::to_double(s.reference_variance));
  return p.gate_first_m > sigma_m ? p.gate_first_m : sigma_m;
}

void take_held_pass(const Mission& mission, const Vec6& axis, Lookup lookup, Workspace& workspace, Pose& T_target_sensor) {
  const MatchSettings<N> s = make_settings(mission.parameters, workspace);
  Pass pass = match_pass(mission, s, {1, lookup}, T_target_sensor, workspace);
  Vec6 b;
  if (!set_up(mission, s, pass, b)) return;
  const Vec6 scale = radius_scale(mission.radius_m);
  Mat6 H = at_radius(pass.H, 1 / mission.radius_m);
  H += kHeld * H.trace() * axis * axis.transpose();
  Vec6 step_m;
  if (solve6(H, b.cwiseQuotient(scale), step_m) != Status::kOk) return;
  const Vec6 x = cut_step(step_m.cwiseQuotient(scale), mission.radius_m, longest_step_m(mission.parameters, s));
  T_target_sensor = step_pose(T_target_sensor, x);
}

}  // namespace lasso
