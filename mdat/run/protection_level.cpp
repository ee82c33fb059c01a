#include "mdat/run/protection_level.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>

#include "fsw/geometry/portable_math.hpp"

namespace lasso::mdat {
namespace {

using GaussLegendre = boost::math::quadrature::gauss<double, 20>;  // on [-1, 1], symmetric: the positive nodes, as constants
constexpr std::size_t kTurns = 8;
constexpr double kOneAxisSigmas = 3.8905, kLikeAxesSigmas = 4.5944;  // just outside of the closed forms of both ends
constexpr int kMostSteps = 20;
constexpr double kSmallestStep = 1e-12;

// P(s > length) and its density there, of the chi distribution with 3 degrees of freedom.
struct Tail {
  double probability = 0, density = 0;
};

Tail chi3_tail(double length) {
  const double density = normal_density(length);
  return {2 * (normal_cumulative(-length) + length * density), 2 * length * length * density};
}

// Squares of the cosines of the turns in the middles of a quarter's parts.
std::array<double, kTurns> squared_cosines() {
  std::array<double, kTurns> values{};
  for (std::size_t i = 0; i < kTurns; ++i)
    values[i] = 0.5 + 0.5 * sin_cos((static_cast<double>(i) + 0.5) * kPi / static_cast<double>(kTurns)).cos;
  return values;
}

// Mean over the directions whose cosine to the axis of variances.z() is `z`.
Tail tail_at(const Vec3& variances, double radius, double z) {
  static const std::array<double, kTurns> cosines = squared_cosines();
  Tail sum;
  for (const double cosine : cosines) {
    const double across = variances.x() * cosine + variances.y() * (1 - cosine);
    const double sigma = std::sqrt(z * z * variances.z() + (1 - z * z) * across);
    if (!(sigma > 0)) continue;
    const Tail one = chi3_tail(radius / sigma);
    sum.probability += one.probability / static_cast<double>(kTurns);
    sum.density += one.density / sigma / static_cast<double>(kTurns);
  }
  return sum;
}

// Of all directions; the density is that of |e|. The variances ascend.
Tail tail_of(const Vec3& variances, double radius) {
  Tail mean;
  for (std::size_t i = 0; i < GaussLegendre::abscissa().size(); ++i) {
    const double weight = 0.5 * GaussLegendre::weights()[i];
    for (const double node : {-GaussLegendre::abscissa()[i], GaussLegendre::abscissa()[i]}) {
      const Tail one = tail_at(variances, radius, 0.5 * (1 + node));
      mean.probability += weight * one.probability;
      mean.density += weight * one.density;
    }
  }
  return mean;
}

// By Halley's method for the logarithm of the probability, whose slope hardly changes: cubic, and some four steps.
double radius_at_risk(const Vec3& variances) {
  double radius = 0.5 * (kOneAxisSigmas + kLikeAxesSigmas);
  for (int step = 0; step < kMostSteps; ++step) {
    const Tail tail = tail_of(variances, radius);
    const double logarithm = 2 * (tail.probability - kProtectionRisk) / (tail.probability + kProtectionRisk);
    const double next = std::clamp(radius + logarithm * tail.probability / tail.density, kOneAxisSigmas, kLikeAxesSigmas);
    const double change = std::abs(next - radius);
    radius = next;
    if (change < kSmallestStep) break;
  }
  return radius;
}

}  // namespace

double exceedance(const Vec3& variances, double radius) {
  Vec3 ascending = variances;
  std::sort(ascending.data(), ascending.data() + ascending.size());
  return tail_of(ascending, radius).probability;
}

double protection_level(const Mat3& covariance) {
  if (!covariance.allFinite()) return std::numeric_limits<double>::infinity();
  const Vec3 variances = Eigen::SelfAdjointEigenSolver<Mat3>(covariance, Eigen::EigenvaluesOnly).eigenvalues().cwiseMax(0);
  if (!(variances.z() > 0)) return 0;
  return std::sqrt(variances.z()) * radius_at_risk(variances / variances.z());
}

ProtectionLevels protection_levels(const Mat6& covariance) {
  return {protection_level(covariance.bottomRightCorner<3, 3>()), std::min(protection_level(covariance.topLeftCorner<3, 3>()), kPi)};
}

}  // namespace lasso::mdat
