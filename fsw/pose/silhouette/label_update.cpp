#include "fsw/pose/silhouette/label_update.hpp"

#include "fsw/geometry/portable_math.hpp"

namespace lasso {
namespace {

// Probability that a label of a ray is wrong, dropouts apart: one that lies five sigmas of the hits on the wrong side is likelier wrong
// than they are (docs/experiments/2026-11-26-aimed-scans.md).
constexpr double kLabelError = 1e-3;
constexpr double kDamping = 0.7;
constexpr double kConverged = 1e-3;

// A label's Gaussian approximation: precision and precision-times-mean of its distance s.
struct Site {
  double precision = 0;
  double information = 0;
};
// As it is kept from sweep to sweep: rounding is far below what a label knows, and the stack is short.
struct KeptSite {
  float precision = 0;
  float information = 0;
};

struct Moments {
  double slope = 0;      // d log Z / d mean
  double curvature = 0;  // -d^2 log Z / d mean^2
};

// Z = e + (1 - e) Phi(z) with z = mean / sqrt(variance), mean and variance of y s including the label's own uncertainty.
Moments label_moments(double mean, double variance, double error) {
  const double sigma = square_root(variance);
  const double z = mean / sigma;
  const double Z = error + (1 - error) * normal_cumulative(z);
  Moments moments;
  moments.slope = (1 - error) * normal_density(z) / (Z * sigma);
  moments.curvature = moments.slope * (moments.slope + z / sigma);
  return moments;
}

double wrong_label_probability(const Label& label, const MissionParameters& p) {
  return label.inside < 0 ? kLabelError + (1 - kLabelError) * p.dropout_probability : kLabelError;
}

// Moves the belief by a change of one site's Gaussian along a, Ca = C a: precision += change, information += change_information.
void move_belief(const Vec6& Ca, double variance, double distance, const Site& change, PoseBelief& belief) {
  const double gain = 1 / (1 + change.precision * variance);
  const double pull = change.information - change.precision * distance;
  belief.mean += Ca * (pull * gain);
  belief.covariance -= (change.precision * gain) * Ca * Ca.transpose();
}

// One site's update; returns how much it changed relative to what was known.
double update_site(const Label& label, const MissionParameters& p, KeptSite& kept, PoseBelief& belief) {
  const Site site{static_cast<double>(kept.precision), static_cast<double>(kept.information)};
  const double y = label.inside;
  const Vec6 a = y * label.a;
  const Vec6 Ca = belief.covariance * a;
  const double variance = a.dot(Ca);
  const double distance = y * label.d_m + a.dot(belief.mean);
  if (!(variance > 0)) return 0;
  const double cavity_precision = 1 / variance - site.precision;
  if (!(cavity_precision > 0)) return 0;
  const double cavity_variance = 1 / cavity_precision;
  const double cavity_mean = cavity_variance * (distance / variance - site.information);
  const double own = p.silhouette_sigma_m * p.silhouette_sigma_m + label.across_variance;
  const Moments moments = label_moments(cavity_mean, cavity_variance + own, wrong_label_probability(label, p));
  Site target;  // a negative precision would claim that a label takes knowledge away
  if (moments.curvature > 0) {
    const double rest = 1 - moments.curvature * cavity_variance;  // above 0: Phi's curvature times its variance is below 1
    target.precision = moments.curvature / rest;
    target.information = (cavity_mean * moments.curvature + moments.slope) / rest;
  }
  Site change;
  change.precision = kDamping * (target.precision - site.precision);
  change.information = kDamping * (target.information - site.information);
  kept.precision = static_cast<float>(site.precision + change.precision);
  kept.information = static_cast<float>(site.information + change.information);
  move_belief(Ca, variance, distance, change, belief);
  return (change.precision < 0 ? -change.precision : change.precision) * variance;
}

}  // namespace

void apply_labels(Span<const Label> labels, const MissionParameters& parameters, PoseBelief& belief) {
  KeptSite sites[kMaxSites];
  invariant(labels.size() <= kMaxSites, "no more labels than sites");
  for (int sweep = 0; sweep < kMaxLabelSweeps; ++sweep) {
    double change = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const double moved = update_site(labels[i], parameters, sites[i], belief);
      if (moved > change) change = moved;
    }
    if (change < kConverged) return;
  }
}

}  // namespace lasso
