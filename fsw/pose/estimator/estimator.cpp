#include "fsw/pose/estimator/estimator.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/symmetric6.hpp"
#include "fsw/pose/registration/agreement.hpp"
#include "fsw/pose/registration/common_error.hpp"
#include "fsw/pose/registration/integrity.hpp"
#include "fsw/pose/registration/registration.hpp"
#include "fsw/pose/registration/weak_axis.hpp"
#include "fsw/pose/scan/path_pose.hpp"
#include "fsw/pose/scan/prepare.hpp"
#include "fsw/pose/silhouette/information_forecast.hpp"
#include "fsw/pose/silhouette/label_update.hpp"
#include "fsw/pose/silhouette/outline_constraint.hpp"
#include "fsw/pose/silhouette/outline_fit.hpp"
#include "fsw/pose/silhouette/silhouette.hpp"

namespace lasso {
namespace {

constexpr double kPoseDimensions = 6;
constexpr double kMotionSigmas = 3;  // rates that the target is believed to have are farther off in one scan of 400, if they are Gaussian
constexpr double kSmallestNoiseScale = 1e-6;  // of the variance: a scan without any noise still has rounding

static_assert(kMaxRays <= 65535, "counts of rays fit into the result");
std::uint16_t to_count(std::size_t n) { return static_cast<std::uint16_t>(n); }

// Variance of the residuals over the assumed variance. Tukey's kernel trims the tails: for Gaussian noise its weighted sum of squares is
// 1 - 6/k^2 + 15/k^4 of the whole. Ranges that the sensor itself trusts less may be wrong all alike, which residuals do not show.
double noise_scale(const MissionParameters& p, const HitSolution& hits, bool trusted) {
  const double k2 = p.kernel_width * p.kernel_width;
  const double trimmed = 1 - 6 / k2 + 15 / (k2 * k2);
  const double freedom = static_cast<double>(hits.inliers) - kPoseDimensions;
  const double scale = freedom > 0 ? hits.chi_squared / (freedom * trimmed) : 1;
  const double smallest = trusted ? kSmallestNoiseScale : 1;
  return scale > smallest ? scale : smallest;
}

// A step x of T_target_sensor in target axes is a step -R x of T_sensor_target in sensor axes, for rotation and translation alike.
Mat6 to_sensor_axes(const Mat6& covariance, const Pose& T_target_sensor) {
  return rotated_covariance(to_matrix(T_target_sensor.q).transpose(), covariance);
}

double range_sigma(const MissionParameters& p, double range_m, double scale) { return square_root(range_variance(p, range_m) * scale); }

// Labels are linear within the band around the contour. Where the hits leave the pose more uncertain than that, the contours nearest to the
// rays may be other ones than those that they passed, and labels would confirm a wrong pose.
bool are_held(const Mission& mission, const LabelSearch& search, const Directions& unobservable, FixedVector<Label, kMaxSites>& labels) {
  for (Label& label : labels) {
    if (!remove_unobservable(mission.radius_m, unobservable, label)) return false;
    if (!(label.a.dot(search.covariance * label.a) < search.band_m * search.band_m)) return false;
  }
  return true;
}

bool has_information(const HitSolution& hits) { return hits.stop == StopReason::kConverged || hits.stop == StopReason::kIterationLimit; }

// What the hits know of the pose.
struct HitKnowledge {
  double scale = 1;        // of the noise's variance over the assumed one
  double trust_scale = 1;  // the same as the covariance takes it (estimation.noise_estimated)
  Mat6 covariance = Mat6::Zero();
  Directions unobservable;
  Directions weakly_observable;  // too loose for labels
  OutlineConstraint constraint;  // by the outline, of what is weakly observable
};

void learn_from(const Mission& mission, const HitSolution& hits, Workspace& workspace, HitKnowledge& known) {
  const MissionParameters& p = mission.parameters;
  known.scale = noise_scale(p, hits, !(workspace.sigma_factor > FlightNumber::Factor{1}));
  known.covariance.setZero();
  known.unobservable.count = known.weakly_observable.count = known.constraint.axes.count = 0;
  known.constraint.band_m = p.silhouette_band_m;
  if (!has_information(hits)) return;
  known.trust_scale = p.noise_estimated > 0.5 ? known.scale : 1;
  known.covariance = covariance_of_hits(mission.radius_m, hits.H, known.trust_scale, known.unobservable);
  if (explained_share(hits) < p.inlier_share_min) return;  // it is refused, however sure it is
  widen_weak_axes(mission, hits, known.trust_scale, workspace, known.covariance, known.unobservable);
  add_others(hits, known.covariance, known.unobservable);
  known.weakly_observable = find_weakly_observable(mission, known.covariance);
}

double range_sigma(const MissionParameters& p, const Pose& T_target_sensor, const HitKnowledge& known) {
  return range_sigma(p, square_root(T_target_sensor.p.squaredNorm()), known.scale);
}

OutlineFit outline_of(const Mission& mission, const HitSolution& hits, const HitKnowledge& known, std::uint32_t most_asked,
                      Workspace& workspace) {
  const MissionParameters& p = mission.parameters;
  const double factor = FlightNumber::to_double(workspace.sigma_factor);
  const double range_m = square_root(hits.T_target_sensor.p.squaredNorm());
  const double variance = range_variance(p, range_m) * factor * factor + p.surface_sigma_m * p.surface_sigma_m;
  const OutlineCare care{square_root(variance * (known.scale > 1 ? known.scale : 1)), p.edge_depth_m, most_asked};
  return fit_outline(mission, hits.T_target_sensor, known.weakly_observable, care, workspace);
}

// Registers the hits from where the outline has the pose: a few of them may have kept it on a side of the model that they never met. False,
// with all as it was before, where the registration there fails.
bool follow_outline(const Mission& mission, Workspace& workspace, HitSolution& hits, HitKnowledge& known, OutlineFit& fit) {
  const HitSolution before = hits;
  hits = register_hits(mission, fit.T_target_sensor, workspace);
  hits.iterations = static_cast<std::uint16_t>(hits.iterations + before.iterations);
  learn_from(mission, hits, workspace, known);
  fit = outline_of(mission, hits, known, kMostAskedAgain, workspace);
  if (fit.settled) return true;
  hits = before;
  learn_from(mission, hits, workspace, known);
  return false;
}

// Where the hits let the pose slide, the outline says where it is.
void constrain_weakly_observable(const Mission& mission, HitSolution& hits, Workspace& workspace, HitKnowledge& known) {
  if (known.weakly_observable.count == 0) return;
  OutlineFit fit = outline_of(mission, hits, known, kMostAsked, workspace);
  if (!fit.settled) return;
  if (fit.moved && !follow_outline(mission, workspace, hits, known, fit)) return;
  hits.T_target_sensor = fit.T_target_sensor;
  known.constraint = constrain_by_outline(mission, fit, known.weakly_observable, known.covariance, known.unobservable);
}

// What hits, outline and labels say, as a step from the pose; false where labels cannot be used, and are dropped.
bool ask_labels(const Mission& mission, bool misses_known, HitKnowledge& known, const Pose& pose, Workspace& workspace,
                PoseBelief& belief) {
  const double sigma_m = range_sigma(mission.parameters, pose, known);
  LabelSearch search{misses_known, add_constraint(mission.radius_m, known.constraint, known.covariance), sigma_m, known.constraint.band_m};
  find_labels(mission, pose, search, workspace);
  keep_shown(mission, workspace.labels.span(), known.covariance, known.constraint, known.unobservable);
  search.covariance = add_constraint(mission.radius_m, known.constraint, known.covariance);
  if (!are_held(mission, search, known.unobservable, workspace.labels)) {
    workspace.labels.clear();
    return false;
  }
  belief = {Vec6::Zero(), search.covariance};
  apply_labels(workspace.labels.span(), mission.parameters, belief);
  return true;
}

// Applies the labels: moves the pose and shrinks the covariance. What only the outline constrains is done twice, as labels are
// linear near their contours alone: the first look slides the pose, the second one is from there.
void use_silhouettes(const Mission& mission, bool misses_known, HitKnowledge& known, Workspace& workspace, Pose& pose) {
  PoseBelief belief;
  Pose from = pose;
  for (int look = known.constraint.axes.count > 0 ? 0 : 1; look < 2; ++look) {
    if (!ask_labels(mission, misses_known, known, from, workspace, belief)) return;
    if (look == 0) from = step_pose(from, tighten_constraint(mission, belief, known.constraint));
  }
  pose = step_pose(from, belief.mean);
  known.covariance = remove_constraint(mission.radius_m, known.constraint, belief.covariance);
}

// Figures of the scan as a whole.
struct ScanCare {
  bool misses_known = false;
  bool shows_outline = false;
  double motion_m = 0;  // as PoseDoubt's
};

// What the hits' common range error makes of the pose, which joins their covariance: labels and rays are asked of a pose that may be off
// so. Never inlined, as the next one: their matrices are off the stack where rays and labels are asked.
[[gnu::noinline]] Vec6 add_range_error(const Mission& mission, const HitSolution& hits, HitKnowledge& known, Workspace& workspace) {
  const MissionParameters& p = mission.parameters;
  if (!has_common_errors(p)) return Vec6::Zero();
  const double sigma_m = range_sigma(p, square_root(hits.T_target_sensor.p.squaredNorm()), 1);
  const Vec6 step = range_step(mission, {hits.T_target_sensor, known.covariance, known.scale, known.trust_scale, sigma_m}, workspace);
  known.covariance += step * step.transpose();
  return step;
}

// All of them, once labels have had their say.
[[gnu::noinline]] void describe_common(const Mission& mission, const Pose& T_target_sensor, const Vec6& step, Registration& result) {
  const MissionParameters& p = mission.parameters;
  if (!has_common_errors(p)) return;
  result.common = common_errors(p, T_target_sensor, step);
  result.covariance += result.common.rightCols<3>() * result.common.rightCols<3>().transpose();
}

// The pose that hits and silhouettes give, with its covariance, into the result.
void describe_pose(const Mission& mission, const HitSolution& hits, const ScanCare& care, HitKnowledge& known, Workspace& workspace,
                   Registration& result) {
  Pose pose = hits.T_target_sensor;
  Vec6 range_error = add_range_error(mission, hits, known, workspace);
  if (mission.parameters.silhouettes > 0.5) {
    const Mat6 of_hits = known.covariance;
    use_silhouettes(mission, care.misses_known, known, workspace, pose);
    result.labels = to_count(workspace.labels.size());
    if (!range_error.isZero(0.0)) range_error = step_after(range_error, of_hits, known.covariance);
  }
  result.T_sensor_target = inverse(pose);
  result.covariance = to_sensor_axes(known.covariance, pose);
  const Expectation expectation(mission, pose, {known.covariance, known.scale, care.motion_m});
  result.agreement = agreement_of_rays(mission, expectation, care.misses_known, workspace);
  describe_common(mission, pose, range_error, result);
  find_weak_directions(mission, result);
}

void describe_hits(const HitSolution& hits, double scale, const Workspace& workspace, Registration& result) {
  result.stop = hits.stop;
  result.iterations = hits.iterations;
  result.rays = to_count(workspace.rays.size());
  result.returns = to_count(workspace.points.size());
  result.inliers = to_count(hits.inliers);
  result.inlier_share = hits.usable > 0 ? static_cast<double>(hits.inliers) / hits.usable : 0;
  result.rms_m = hits.inliers > 0 ? square_root(hits.squared_residual_m2 / hits.inliers) : 0;
  result.normalized_residual = square_root(scale);
}

// Of residuals, over that of the noise: a motion by up to `way_m`, spread evenly over the scan.
double motion_variance(const Mission& mission, const StartPoint& start, double way_m) {
  const MissionParameters& p = mission.parameters;
  const double noise = range_variance(p, square_root(start.T_sensor_target.p.squaredNorm())) + p.surface_sigma_m * p.surface_sigma_m;
  return way_m * way_m / 3 / noise;
}

// A start that may be rough: coarse alignment is taken only where the near registration does not explain the scan, and ends too close for a
// second look.
HitSolution register_wide(const Mission& mission, const Pose& T_target_sensor, Workspace& workspace) {
  HitSolution near = register_hits(mission, T_target_sensor, workspace);
  if (explained_share(near) >= kExplainedShare) return near;
  const Pose closer = align_coarsely(mission, T_target_sensor, workspace);
  const HitSolution far = register_first(mission, closer, workspace);
  return explained_share(far) > explained_share(near) ? far : near;
}

// Its matrices are off the stack before those of `describe` are on it.
[[gnu::noinline]] void register_scan(const Mission& mission, const StartPoint& start, Workspace& workspace, HitSolution& hits) {
  const Pose pose = inverse(start.T_sensor_target);
  hits = start.wide ? register_wide(mission, pose, workspace) : register_hits(mission, pose, workspace);
  if (!start.partial) minimise_weak_axis(mission, start, workspace, hits);
}

[[gnu::noinline]] void describe(const Mission& mission, const ScanCare& care, HitSolution& hits, Workspace& workspace,
                                Registration& result) {
  HitKnowledge known;
  learn_from(mission, hits, workspace, known);
  if (mission.parameters.silhouettes > 0.5 && care.shows_outline) constrain_weakly_observable(mission, hits, workspace, known);
  describe_hits(hits, known.scale, workspace, result);
  if (has_information(hits)) describe_pose(mission, hits, care, known, workspace, result);
}

// More than `most` within the time, or than `fastest` by itself; so is what is not a number.
bool exceeds(const Vec3& rate, double time_s, double most, double fastest) {
  const double limit = fastest * time_s > most ? most / time_s : fastest;
  return !(rate.squaredNorm() <= limit * limit);
}

double half_of(const RangeImage& scan) {
  return scan.samples.empty() ? 0 : to_seconds(scan.samples[scan.samples.size() - 1].t_us - scan.reference_time_us());
}

}  // namespace

bool is_too_fast(const MissionParameters& p, const Twist& rates, double half_scan_s) {
  if (!(p.deskew > 0.5)) return false;
  return exceeds(rates.omega_radps, half_scan_s, kMostTurn_rad, kFastestTurn_radps) ||
         exceeds(rates.v_mps, half_scan_s, kMostWay_m, kFastest_mps);
}

Registration Estimator::estimate(const Mission& mission, const RangeImage& scan, const StartPoint& start) {
  Registration result;
  result.scan_id = scan.scan_id;
  result.t_us = scan.reference_time_us();
  result.T_sensor_target = start.T_sensor_target;
  if (is_too_fast(mission.parameters, start.rates, half_of(scan))) {
    result.reason = PoseReason::kTooFast;
    return result;
  }
  prepare_rays(mission, scan, start, workspace_);
  HitSolution hits;
  register_scan(mission, start, workspace_, hits);
  const ScanCare care{scan.misses_known, scan.misses_known && !start.partial, kMotionSigmas * start.rate_sigma_mps * half_of(scan)};
  describe(mission, care, hits, workspace_, result);
  result.reason = judge(mission.parameters, result, motion_variance(mission, start, care.motion_m));
  return result;
}

}  // namespace lasso
