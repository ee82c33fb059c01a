#include "fsw/pose/slack.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/symmetric6.hpp"

namespace lasso {
namespace {

constexpr double kSlackShare = 0.5;
constexpr double kLoose = 0.1;  // of the model's radius: where every direction is held better the prediction carries the pose meanwhile

Mat6 scaled(const Vec6& scale, const Mat6& covariance) { return scale.asDiagonal() * covariance * scale.asDiagonal(); }

double larger(double a, double b) { return a > b ? a : b; }

double variance_along(double radius_m, const Vec6& axis, const Mat6& covariance) {
  const Vec6 row = radius_scale(radius_m).cwiseProduct(axis);
  return row.dot(covariance * row);
}

}  // namespace

Directions find_slack(const Mission& mission, const Mat6& covariance) {
  const Eigen6 eigen = eigen6(scaled(radius_scale(mission.radius_m), covariance));
  const double limit_m = mission.parameters.silhouette_band_m;
  const double loosest_m = kLoose * mission.radius_m;
  Directions slack;
  if (!(eigen.values[5] > loosest_m * loosest_m)) return slack;
  for (int i = 0; i < 6; ++i) {
    if (eigen.values[i] > limit_m * limit_m) slack.vectors.col(slack.count++) = eigen.vectors.col(i);
  }
  return slack;
}

Hold hold_by(const Mission& mission, const OutlineFit& outline, const Directions& slack, const Mat6& covariance, Directions& unseen) {
  const double unseen_m = 0.5 * kUnseenSigma * mission.radius_m;
  unseen.count = 0;
  Hold hold;
  hold.band_m = mission.parameters.silhouette_band_m;
  for (int i = 0; i < slack.count; ++i) {
    const Vec6 axis = slack.vectors.col(i);
    if (outline.within_m[i] > 0) {
      hold.band_m = larger(hold.band_m, outline.within_m[i]);
      hold.sigma_m[hold.axes.count] = kSlackShare * larger(mission.parameters.silhouette_band_m, outline.within_m[i]);
      hold.axes.vectors.col(hold.axes.count++) = axis;
    } else if (variance_along(mission.radius_m, axis, covariance) > unseen_m * unseen_m) {
      unseen.vectors.col(unseen.count++) = axis;
    }
  }
  return hold;
}

Mat6 hold_slack(double radius_m, const Hold& hold, const Mat6& covariance) {
  if (hold.axes.count == 0) return covariance;
  const Vec6 scale = radius_scale(radius_m);
  Mat6 held = scaled(scale, covariance);
  for (int i = 0; i < hold.axes.count; ++i) {
    const Vec6 column = held * hold.axes.vectors.col(i);
    held -= column * column.transpose() / (hold.axes.vectors.col(i).dot(column) + hold.sigma_m[i] * hold.sigma_m[i]);
  }
  return scaled(scale.cwiseInverse(), held);
}

Mat6 release_slack(double radius_m, const Hold& hold, const Mat6& covariance) {
  if (hold.axes.count == 0) return covariance;
  const Vec6 scale = radius_scale(radius_m);
  const double anywhere_m = kUnseenSigma * radius_m;
  Mat6 released = scaled(scale, covariance);
  for (int i = 0; i < hold.axes.count; ++i) {
    const double variance = hold.sigma_m[i] * hold.sigma_m[i];
    const double least = variance * variance / (anywhere_m * anywhere_m);
    const Vec6 column = released * hold.axes.vectors.col(i);
    released += column * column.transpose() / larger(variance - hold.axes.vectors.col(i).dot(column), least);
  }
  return scaled(scale.cwiseInverse(), released);
}

Vec6 narrow_hold(const Mission& mission, const PoseBelief& belief, Hold& hold) {
  const double band_m = mission.parameters.silhouette_band_m;
  const Vec6 scale = radius_scale(mission.radius_m);
  const Vec6 mean = scale.cwiseProduct(belief.mean);
  Vec6 step = Vec6::Zero();
  hold.band_m = band_m;
  for (int i = 0; i < hold.axes.count; ++i) {
    const Vec6 axis = hold.axes.vectors.col(i);
    step += axis * axis.dot(mean);
    const double believed_m = kCautious * square_root(variance_along(mission.radius_m, axis, belief.covariance));
    hold.sigma_m[i] = clamp(believed_m, kSlackShare * band_m, hold.sigma_m[i]);
    hold.band_m = larger(hold.band_m, hold.sigma_m[i] / kSlackShare);
  }
  return step.cwiseQuotient(scale);
}

}  // namespace lasso
