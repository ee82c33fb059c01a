#include "fsw/pose/registration/observability.hpp"

#include "fsw/geometry/symmetric6.hpp"

namespace lasso {
namespace {

constexpr double kRounding = 1e-7;     // of the information: what sums may have lost
constexpr double kPriorCounts = 0.01;  // of the information along a direction: less of it is let stand
constexpr double kPriorLeads = 0.5;

// The prior of H's own scan, from the trace that it is part of.
double prior_within(double radius_m, const Mat6& H) {
  const double hits = (H.bottomRightCorner<3, 3>().trace() - 3 * prior_information(radius_m, 0)) / (1 + 3 * kRounding);
  return prior_information(radius_m, hits);
}

// Of a direction whose variance is `variance` with the prior in it.
double variance_without(double prior, double variance, double scale) { return scale * variance / (1 - variance * prior); }

}  // namespace

Vec6 radius_scale(double radius_m) {
  Vec6 scale;
  scale << radius_m, radius_m, radius_m, 1, 1, 1;
  return scale;
}

double prior_information(double radius_m, double translation_trace) { return 1 / (radius_m * radius_m) + kRounding * translation_trace; }

Mat6 covariance_of_hits(double radius_m, const Mat6& H, double scale, Directions& unobservable) {
  unobservable.count = 0;
  Mat6 covariance;
  invariant(invert6(H, covariance) == Status::kOk, "information that was solved for a step has an inverse");
  const Mat6 scaled = at_radius(covariance, radius_m);
  const double prior = prior_within(radius_m, H);
  if (scaled.trace() * prior < kPriorCounts) return scale * covariance;
  const Eigen6 eigen = eigen6(scaled);
  Mat6 whole = Mat6::Zero();
  for (int i = 0; i < 6; ++i) {
    const Vec6 direction = eigen.vectors.col(i);
    const bool is_unobservable = eigen.values[i] * prior > kPriorLeads;
    if (is_unobservable) unobservable.vectors.col(unobservable.count++) = direction;
    const double anywhere_m = kUnobservableSigma * radius_m;
    const double variance = is_unobservable ? anywhere_m * anywhere_m : variance_without(prior, eigen.values[i], scale);
    whole += variance * direction * direction.transpose();
  }
  return at_radius(whole, 1 / radius_m);
}

bool remove_unobservable(double radius_m, const Directions& unobservable, Label& label) {
  const Vec6 to_radius = radius_scale(radius_m);
  Vec6 row = label.a.cwiseQuotient(to_radius);
  for (int i = 0; i < unobservable.count; ++i) {
    const double along = row.dot(unobservable.vectors.col(i));
    if (along * along > kUnobservableLever * kUnobservableLever) return false;
    row -= along * unobservable.vectors.col(i);
  }
  label.a = row.cwiseProduct(to_radius);
  return true;
}

}  // namespace lasso
