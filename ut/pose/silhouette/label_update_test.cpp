#include "fsw/pose/silhouette/label_update.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <vector>

#include "fsw/geometry/portable_math.hpp"
#include "ut/support/dense.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

double phi(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

Label make_label(const Vec6& a, double d_m, int inside) {
  Label label{};
  label.a = a;
  label.d_m = d_m;
  label.inside = static_cast<std::int8_t>(inside);
  return label;
}

PoseBelief generic_belief(test::Generator& random) {
  Mat6 A;
  for (int i = 0; i < 36; ++i) A.data()[i] = random.uniform(-1, 1);
  PoseBelief belief;
  belief.covariance = 1e-8 * (A * A.transpose() + 0.3 * Mat6::Identity());
  return belief;
}

Vec6 generic_direction(test::Generator& random) {
  Vec6 a;
  for (int i = 0; i < 6; ++i) a[i] = random.uniform(-1, 1);
  return a;
}

constexpr double kWrong = 1e-3;  // probability that a label is wrong, dropouts apart

double likelihood(const Label& label, const MissionParameters& p, const Vec6& x) {
  const double e = label.inside < 0 ? kWrong + (1 - kWrong) * p.dropout_probability : kWrong;
  return e + (1 - e) * phi(label.inside * (label.d_m + label.a.dot(x)) / p.silhouette_sigma_m);
}

// Moments of prior times likelihoods by brute force: weighted samples of the prior.
PoseBelief sample_posterior(const PoseBelief& prior, const std::vector<Label>& labels, const MissionParameters& p,
                            test::Generator& random) {
  const Mat6 L = test::cholesky_of(prior.covariance);
  Vec6 sum = Vec6::Zero();
  Mat6 square = Mat6::Zero();
  double weight = 0;
  for (int i = 0; i < 30000; ++i) {
    Vec6 z;
    for (int k = 0; k < 6; ++k) z[k] = random.normal();
    const Vec6 x = L * z;
    double w = 1;
    for (const Label& label : labels) w *= likelihood(label, p, x);
    weight += w;
    sum += w * x;
    square += w * x * x.transpose();
  }
  PoseBelief posterior;
  posterior.mean = sum / weight;
  posterior.covariance = square / weight - posterior.mean * posterior.mean.transpose();
  return posterior;
}

void expect_close(const PoseBelief& a, const PoseBelief& b, double share) {
  for (int i = 0; i < 6; ++i) {
    const double sigma = std::sqrt(b.covariance(i, i));
    EXPECT_NEAR(a.mean[i], b.mean[i], share * sigma) << i;
    EXPECT_NEAR(std::sqrt(a.covariance(i, i)), sigma, share * sigma) << i;
  }
}

TEST(Labels, OneLabelGivesTheExactMoments) {
  VERIFIES("LASSO-REG-002~1");
  test::Generator random(3);
  const MissionParameters p = preset_parameters();
  for (int i = 0; i < 200; ++i) {
    PoseBelief belief = generic_belief(random);
    const PoseBelief prior = belief;
    const Vec6 a = generic_direction(random);
    const Label label = make_label(a, random.uniform(-3e-4, 3e-4), i % 2 == 0 ? 1 : -1);
    apply_labels(Span<const Label>(&label, 1), p, belief);
    // Closed form: moments of N(m, v) times e + (1 - e) Phi(y s / sigma).
    const double v = a.dot(prior.covariance * a);
    const double own = std::sqrt(v + p.silhouette_sigma_m * p.silhouette_sigma_m);
    const double z = label.inside * label.d_m / own;
    const double e = kWrong;
    const double slope = (1 - e) * std::exp(-z * z / 2) / std::sqrt(2 * kPi) / ((e + (1 - e) * phi(z)) * own);
    const double curvature = slope * (slope + z / own);
    if (!(curvature > 0)) continue;
    const double mean_s = label.d_m + label.inside * v * slope;
    const double variance_s = v - v * v * curvature;
    EXPECT_NEAR(label.d_m + a.dot(belief.mean), mean_s, 2e-3 * std::sqrt(v));
    EXPECT_NEAR(a.dot(belief.covariance * a), variance_s, 4e-3 * v);
  }
}

TEST(Labels, ManyLabelsAgreeWithSampling) {
  VERIFIES("LASSO-REG-002~1");
  test::Generator random(5);
  const MissionParameters p = preset_parameters();
  for (int trial = 0; trial < 3; ++trial) {
    PoseBelief belief = generic_belief(random);
    std::vector<Label> labels;
    for (int i = 0; i < 8; ++i) {
      const Vec6 a = generic_direction(random);
      const double d = random.uniform(-1.5, 1.5) * std::sqrt(a.dot(belief.covariance * a));
      labels.push_back(make_label(a, d, random.uniform(0, 1) < phi(d / 1e-4) ? 1 : -1));
    }
    const PoseBelief truth = sample_posterior(belief, labels, p, random);
    apply_labels(Span<const Label>(labels.data(), labels.size()), p, belief);
    expect_close(belief, truth, 0.08);
  }
}

TEST(Labels, CovarianceShrinksAndStaysPositive) {
  VERIFIES("LASSO-REG-002~1");
  test::Generator random(7);
  const MissionParameters p = preset_parameters();
  for (int trial = 0; trial < 50; ++trial) {
    PoseBelief belief = generic_belief(random);
    const Mat6 before = belief.covariance;
    std::vector<Label> labels;
    for (int i = 0; i < 100; ++i) {  // contradictory labels among them
      labels.push_back(make_label(generic_direction(random), random.uniform(-3e-4, 3e-4), random.uniform(0, 1) < 0.5 ? 1 : -1));
    }
    apply_labels(Span<const Label>(labels.data(), labels.size()), p, belief);
    for (int i = 0; i < 20; ++i) {
      const Vec6 x = generic_direction(random);
      EXPECT_GT(x.dot(belief.covariance * x), 0);
      EXPECT_LE(x.dot(belief.covariance * x), x.dot(before * x) * (1 + 1e-9));
    }
    EXPECT_TRUE(belief.mean.allFinite());
  }
}

TEST(Labels, ADropOutWeighsLessThanAReturn) {
  VERIFIES("LASSO-REG-006~2");
  test::Generator random(9);
  MissionParameters p = preset_parameters();
  p.dropout_probability = 0.3;
  const PoseBelief prior = generic_belief(random);
  const Vec6 a = generic_direction(random);
  const double far_inside = 1.0 * std::sqrt(a.dot(prior.covariance * a));
  PoseBelief missed = prior;  // a miss one sigma inside the contour: most likely a drop-out
  const Label miss = make_label(a, far_inside, -1);
  apply_labels(Span<const Label>(&miss, 1), p, missed);
  PoseBelief returned = prior;  // a return as far outside cannot be one
  const Label hit = make_label(a, -far_inside, 1);
  apply_labels(Span<const Label>(&hit, 1), p, returned);
  EXPECT_GT(std::abs(a.dot(returned.mean)), 0);
  EXPECT_LT(std::abs(a.dot(missed.mean)), 0.6 * std::abs(a.dot(returned.mean)));
}

TEST(Labels, WhatIsKnownExactlyStaysAsItIs) {
  VERIFIES("LASSO-REG-002~1");
  test::Generator random(13);
  PoseBelief belief = generic_belief(random);
  belief.covariance.row(2).setZero();
  belief.covariance.col(2).setZero();
  const Mat6 before = belief.covariance;
  const Label label = make_label(Vec6::Unit(2), -1e-3, 1);
  apply_labels(Span<const Label>(&label, 1), preset_parameters(), belief);
  EXPECT_EQ(belief.covariance, before);
  EXPECT_EQ(belief.mean, Vec6(Vec6::Zero()));
}

// Sharp labels on what is known to kilometres: rounding leaves less than nothing of what was known without one of them.
TEST(Labels, BeliefsOfAllScalesStayFiniteAndPositive) {
  VERIFIES("LASSO-REG-002~1");
  test::Generator random(17);
  MissionParameters p = preset_parameters();
  p.silhouette_sigma_m = 1e-6;
  for (int trial = 0; trial < 200; ++trial) {
    PoseBelief belief = generic_belief(random);
    const Vec6 loose = generic_direction(random);
    belief.covariance += std::pow(10.0, random.uniform(0, 8)) * loose * loose.transpose();
    std::vector<Label> labels;
    for (int i = 0; i < 40; ++i) labels.push_back(make_label(generic_direction(random), random.uniform(-1e-3, 1e-3), i % 2 == 0 ? 1 : -1));
    const double before = belief.covariance.trace();
    apply_labels(Span<const Label>(labels.data(), labels.size()), p, belief);
    EXPECT_TRUE(belief.mean.allFinite());
    EXPECT_TRUE(belief.covariance.allFinite());
    EXPECT_LE(belief.covariance.trace(), before * (1 + 1e-9));
  }
}

TEST(Labels, WithoutLabelsNothingChanges) {
  VERIFIES("LASSO-REG-002~1");
  test::Generator random(11);
  PoseBelief belief = generic_belief(random);
  const Mat6 before = belief.covariance;
  apply_labels(Span<const Label>(), preset_parameters(), belief);
  EXPECT_EQ(belief.covariance, before);
  EXPECT_EQ(belief.mean, Vec6(Vec6::Zero()));
}

}  // namespace
}  // namespace lasso
