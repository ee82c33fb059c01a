#include "fsw/pose/registration/common_error.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/so3.hpp"
#include "fsw/geometry/symmetric6.hpp"
#include "fsw/pose/registration/gauss_newton.hpp"

namespace lasso {
namespace {

using N = FlightNumber;
using Length = N::Length;
using Sigma = N::Sigma;
constexpr double kStep = 0.25;       // of the noise
constexpr double kLeastStep = 1e-6;  // of the range: a dozen of the smallest steps that the path's numbers can make there
constexpr double kLongestLever = 4;  // a step at the model's radius, over the error that makes it

double range_of(const MatchPoint<N>& point) { return N::to_double(bounded<Length>(dot3<N>(point.p, point.u))); }

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

// What the points say of a step from the pose: b of H x = b.
Vec6 gradient(const Mission& mission, const MatchSettings<N>& s, const Pose& T_target_sensor, Workspace& workspace) {
  const Pass pass = match_pass(mission, s, {1, Lookup::kLast}, T_target_sensor, workspace);
  Mat6 H;
  Vec6 b;
  pass.sums.rows.unpack(H, b);
  return b / N::to_double(s.reference_variance);
}

// Of Gaussian residuals r in sigmas and Tukey's weights w = (1 - r^2/k^2)^2: the mean slope of w r over the mean weight. The information
// was summed with a kernel that is narrower where the noise is.
double slope_of(double kernel_width, double noise_scale) {
  const double k2 = kernel_width * kernel_width;
  const double seen2 = k2 / (noise_scale > 1e-6 ? noise_scale : 1e-6);
  const double weighed2 = seen2 < k2 ? seen2 : k2;
  const double slope = 1 - 6 / seen2 + 15 / (seen2 * seen2);
  const double weight = 1 - 2 / weighed2 + 3 / (weighed2 * weighed2);
  return slope / weight;
}

// Cut to the longest that the error can make.
Vec6 bounded_step(const Vec6& step, double radius_m, double longest_m) {
  const double length_m = length_of(step, radius_m);
  return length_m > longest_m ? Vec6(longest_m / length_m * step) : step;
}

}  // namespace

bool has_common_errors(const MissionParameters& p) { return p.common_sigma_m + p.common_sigma_k_per_m + p.common_sigma_rad > 0; }

Vec6 range_step(const Mission& mission, const KnownPose& hits, Workspace& workspace) {
  const MissionParameters& p = mission.parameters;
  const double range_m = range_of(workspace.points[workspace.points.size() / 2]);
  const double error_m = p.common_sigma_m + p.common_sigma_k_per_m * range_m * range_m;
  if (!(error_m > 0)) return Vec6::Zero();
  const double least_m = kLeastStep * range_m;
  const double step_m = kStep * hits.range_sigma_m;
  const double share = clamp((step_m > least_m ? step_m : least_m) / error_m, 0.0, 1.0);
  const MatchSettings<N> s = make_settings(p, workspace);
  move_points(p, share, workspace);
  Vec6 change = gradient(mission, s, hits.T_target_sensor, workspace);
  move_points(p, -2 * share, workspace);
  change -= gradient(mission, s, hits.T_target_sensor, workspace);
  move_points(p, share, workspace);
  change /= 2 * share * hits.trust_scale * slope_of(p.kernel_width, hits.noise_scale);
  return bounded_step(hits.covariance * change, mission.radius_m, kLongestLever * error_m);
}

Vec6 step_after(const Vec6& step, const Mat6& before, const Mat6& after) {
  Vec6 sigma;
  for (int i = 0; i < 6; ++i) sigma[i] = square_root(before(i, i));
  Mat6 correlation;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) correlation(i, j) = before(i, j) / (sigma[i] * sigma[j]);
  }
  Vec6 weighed;
  if (solve6(correlation, step.cwiseQuotient(sigma), weighed) != Status::kOk) return Vec6::Zero();
  return after * weighed.cwiseQuotient(sigma);
}

CommonErrors common_errors(const MissionParameters& p, const Pose& T_target_sensor, const Vec6& step) {
  const Pose T_sensor_target = inverse(T_target_sensor);
  CommonErrors errors;
  errors.col(0) << -rotate(T_sensor_target.q, step.head<3>()), -rotate(T_sensor_target.q, step.tail<3>());
  errors.block<3, 3>(0, 1) = p.common_sigma_rad * Mat3::Identity();
  errors.block<3, 3>(3, 1) = -p.common_sigma_rad * skew(T_sensor_target.p);
  return errors;
}

}  // namespace lasso
