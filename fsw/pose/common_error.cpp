#include "fsw/pose/common_error.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/so3.hpp"
#include "fsw/pose/gauss_newton.hpp"

namespace lasso {
namespace {

using N = FlightNumber;
using Length = N::Length;
using Sigma = N::Sigma;
constexpr double kStep = 0.25;  // of the noise: weights fall by a thousandth there

double range_error(const MissionParameters& p, double range_m) { return p.common_sigma_m + p.common_sigma_k_per_m * range_m * range_m; }

// Each return farther along its ray, by `share` of the common error's sigma.
void move_points(const MissionParameters& p, double share, Workspace& workspace) {
  const auto constant = N::to<Sigma>(share * p.common_sigma_m);
  const auto k = N::to<N::SigmaRate>(share * p.common_sigma_k_per_m);
  for (MatchPoint<N>& point : workspace.points) {
    const auto range = bounded<Length>(dot3<N>(point.p, point.u));
    const auto rate = bounded<Sigma>(k * range);  // of no unit
    const auto way = bounded<Length>(constant + bounded<Sigma>(rate * range));
    for (int i = 0; i < 3; ++i) point.p[i] = bounded<Length>(point.p[i] + way * point.u[i]);
  }
}

// What the points say of a step from the pose: b of H x = b, per m^2 of the reference variance.
Vec6 gradient(const Mission& mission, const MatchSettings<N>& s, const Pose& T_target_sensor, Workspace& workspace) {
  const Pass pass = match_pass(mission, s, {1, Lookup::kLast}, T_target_sensor, workspace);
  Mat6 H;
  Vec6 b;
  pass.sums.rows.unpack(H, b);
  return b / N::to_double(s.reference_variance);
}

// The step x of T_target_sensor that 1 sigma of the common range error makes.
Vec6 range_step(const Mission& mission, const KnownPose& pose, Workspace& workspace) {
  const MissionParameters& p = mission.parameters;
  const double range_m = square_root(pose.T_target_sensor.p.squaredNorm());
  const double error_m = range_error(p, range_m);
  if (!(error_m > 0)) return Vec6::Zero();
  const double share = clamp(kStep * pose.range_sigma_m / error_m, 0.0, 1.0);
  const MatchSettings<N> s = make_settings(p, workspace);
  move_points(p, share, workspace);
  Vec6 change = gradient(mission, s, pose.T_target_sensor, workspace);
  move_points(p, -2 * share, workspace);
  change -= gradient(mission, s, pose.T_target_sensor, workspace);
  move_points(p, share, workspace);
  return pose.covariance * change / (2 * share * pose.noise_scale);
}

}  // namespace

bool has_common_errors(const MissionParameters& p) { return p.common_sigma_m + p.common_sigma_k_per_m + p.common_sigma_rad > 0; }

CommonErrors common_errors(const Mission& mission, const KnownPose& pose, Workspace& workspace) {
  const Pose T_sensor_target = inverse(pose.T_target_sensor);
  const double turn_rad = mission.parameters.common_sigma_rad;
  const Vec6 step = range_step(mission, pose, workspace);
  CommonErrors errors;
  errors.col(0) << -rotate(T_sensor_target.q, step.head<3>()), -rotate(T_sensor_target.q, step.tail<3>());
  errors.block<3, 3>(0, 1) = turn_rad * Mat3::Identity();
  errors.block<3, 3>(3, 1) = -turn_rad * skew(T_sensor_target.p);
  return errors;
}

}  // namespace lasso
