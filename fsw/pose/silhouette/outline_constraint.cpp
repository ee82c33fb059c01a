#include "fsw/pose/silhouette/outline_constraint.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/symmetric6.hpp"

namespace lasso {
namespace {

constexpr double kWeaklyObservableShare = 0.5;
constexpr double kWidest = 0.125;     // of the model's radius: a wider constraint would have labels look past other contours
constexpr double kRounding = 4e-15;   // of the largest variance there is: what differences of variances may have lost
constexpr double kShownShare = 0.15;  // of the labels
constexpr double kLoose = 0.1;  // of the model's radius: where every direction is known better the prediction carries the pose meanwhile

double larger(double a, double b) { return a > b ? a : b; }

double variance_along(double radius_m, const Vec6& axis, const Mat6& covariance) {
  const Vec6 row = radius_scale(radius_m).cwiseProduct(axis);
  return row.dot(covariance * row);
}

void add(const Vec6& axis, Directions& directions) { directions.vectors.col(directions.count++) = axis; }

// Into `unobservable` what the hits do not show.
void dropped(const Mission& mission, const Vec6& axis, const Mat6& covariance, Directions& unobservable) {
  const double unobservable_m = 0.5 * kUnobservableSigma * mission.radius_m;
  if (variance_along(mission.radius_m, axis, covariance) > unobservable_m * unobservable_m) add(axis, unobservable);
}

// Mean squares and products of the labels' rows along the constraint's axes; what is beyond these comes last in their order.
Mat6 levers_of(double radius_m, Span<const Label> labels, const Directions& axes) {
  Mat6 levers = Mat6::Zero();
  const Vec6 scale = radius_scale(radius_m);
  int count = 0;
  for (const Label& label : labels) {
    if (label.at_end) continue;
    const Vec6 along = axes.vectors.transpose() * label.a.cwiseQuotient(scale);
    levers += along * along.transpose();
    ++count;
  }
  if (count > 0) levers /= count;
  for (int i = axes.count; i < 6; ++i) levers(i, i) = 6;
  return levers;
}

bool is_shown(double radius_m, Span<const Label> labels, const Vec6& axis, double least_lever) {
  const Vec6 row = axis.cwiseQuotient(radius_scale(radius_m));
  std::size_t count = 0;
  std::size_t showing = 0;
  for (const Label& label : labels) {
    if (label.at_end) continue;
    const double along = row.dot(label.a);
    showing += along * along > least_lever * least_lever ? 1u : 0u;
    ++count;
  }
  return static_cast<double>(showing) > kShownShare * static_cast<double>(count);
}

// Closely, and better than the hits have it.
bool is_held(const Mission& mission, double within_m, const Vec6& axis, const Mat6& covariance) {
  const double sigma_m = kWeaklyObservableShare * within_m;
  return within_m > 0 && within_m < kWidest * mission.radius_m && sigma_m * sigma_m < variance_along(mission.radius_m, axis, covariance);
}

}  // namespace

Directions find_weakly_observable(const Mission& mission, const Mat6& covariance) {
  const Eigen6 eigen = axes_at_radius(covariance, mission.radius_m);
  const double limit_m = mission.parameters.silhouette_band_m;
  const double loosest_m = kLoose * mission.radius_m;
  Directions weakly_observable;
  if (!(eigen.values[5] > loosest_m * loosest_m)) return weakly_observable;
  for (int i = 0; i < 6; ++i) {
    if (eigen.values[i] > limit_m * limit_m) weakly_observable.vectors.col(weakly_observable.count++) = eigen.vectors.col(i);
  }
  return weakly_observable;
}

OutlineConstraint constrain_by_outline(const Mission& mission, const OutlineFit& outline, const Directions& weakly_observable,
                                       const Mat6& covariance, Directions& unobservable) {
  unobservable.count = 0;
  OutlineConstraint constraint;
  constraint.band_m = mission.parameters.silhouette_band_m;
  for (int i = 0; i < weakly_observable.count; ++i) {
    const Vec6 axis = weakly_observable.vectors.col(i);
    if (is_held(mission, outline.within_m[i], axis, covariance)) {
      constraint.band_m = larger(constraint.band_m, outline.within_m[i]);
      constraint.sigma_m[constraint.axes.count] =
          kWeaklyObservableShare * larger(mission.parameters.silhouette_band_m, outline.within_m[i]);
      add(axis, constraint.axes);
    } else {
      dropped(mission, axis, covariance, unobservable);
    }
  }
  return constraint;
}

void keep_shown(const Mission& mission, Span<const Label> labels, const Mat6& covariance, OutlineConstraint& constraint,
                Directions& unobservable) {
  if (constraint.axes.count == 0) return;
  const Eigen6 levers = eigen6(levers_of(mission.radius_m, labels, constraint.axes));
  OutlineConstraint kept;
  kept.band_m = constraint.band_m;
  Directions gone;
  for (int i = 0; i < constraint.axes.count; ++i) {
    const Vec6 within = levers.vectors.col(i);
    const Vec6 axis = constraint.axes.vectors * within;
    const double sigma_m = square_root(within.cwiseAbs2().dot(constraint.sigma_m.cwiseAbs2()));
    if (is_shown(mission.radius_m, labels, axis, larger(kUnobservableLever, sigma_m / mission.radius_m))) {
      kept.sigma_m[kept.axes.count] = sigma_m;
      add(axis, kept.axes);
    } else {
      add(axis, gone);
    }
  }
  if (gone.count == 0) return;
  constraint = kept;
  for (int i = 0; i < gone.count; ++i) dropped(mission, gone.vectors.col(i), covariance, unobservable);
}

Mat6 add_constraint(double radius_m, const OutlineConstraint& constraint, const Mat6& covariance) {
  if (constraint.axes.count == 0) return covariance;
  Mat6 held = at_radius(covariance, radius_m);
  for (int i = 0; i < constraint.axes.count; ++i) {
    const Vec6 column = held * constraint.axes.vectors.col(i);
    held -= column * column.transpose() / (constraint.axes.vectors.col(i).dot(column) + constraint.sigma_m[i] * constraint.sigma_m[i]);
  }
  return at_radius(held, 1 / radius_m);
}

Mat6 remove_constraint(double radius_m, const OutlineConstraint& constraint, const Mat6& covariance) {
  if (constraint.axes.count == 0) return covariance;
  const double anywhere_m = kUnobservableSigma * radius_m;
  Mat6 released = at_radius(covariance, radius_m);
  for (int i = 0; i < constraint.axes.count; ++i) {
    const double variance = constraint.sigma_m[i] * constraint.sigma_m[i];
    const double least = variance * variance / (anywhere_m * anywhere_m);
    const Vec6 column = released * constraint.axes.vectors.col(i);
    const double shown = variance - constraint.axes.vectors.col(i).dot(column);
    const bool is_rounding = shown < kRounding * anywhere_m * anywhere_m;
    released += column * column.transpose() / (is_rounding ? least : larger(shown, least));
  }
  return at_radius(released, 1 / radius_m);
}

Vec6 tighten_constraint(const Mission& mission, const PoseBelief& belief, OutlineConstraint& constraint) {
  const double band_m = mission.parameters.silhouette_band_m;
  const Vec6 scale = radius_scale(mission.radius_m);
  const Vec6 mean = scale.cwiseProduct(belief.mean);
  Vec6 step = Vec6::Zero();
  constraint.band_m = band_m;
  for (int i = 0; i < constraint.axes.count; ++i) {
    const Vec6 axis = constraint.axes.vectors.col(i);
    step += axis * axis.dot(mean);
    const double believed_m = kCautious * square_root(variance_along(mission.radius_m, axis, belief.covariance));
    constraint.sigma_m[i] = clamp(believed_m, kWeaklyObservableShare * band_m, constraint.sigma_m[i]);
    constraint.band_m = larger(constraint.band_m, constraint.sigma_m[i] / kWeaklyObservableShare);
  }
  return step.cwiseQuotient(scale);
}

}  // namespace lasso
