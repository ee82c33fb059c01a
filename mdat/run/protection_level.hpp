// The protection level of a pose: what its covariance promises of the error, as integrity monitoring of navigation systems states it.
#pragma once

#include <cstddef>
#include <limits>

#include "fsw/geometry/se3.hpp"

namespace lasso::mdat {

// The probability with which the error exceeds the level, if the covariance is honest.
constexpr double kProtectionRisk = 1e-4;

// Probability that |e| > radius, of e = N(0, diag(variances)), variances not negative. The error is below 1e-6 of it where the radius is
// at least 3.8 sigma of the largest.
//
// Method: e = s diag(sqrt(variances)) u, with u uniform on the unit sphere and, independent of it, s of the chi distribution with 3 degrees
// of freedom. So the probability is the mean over all directions u of
//   P(s > radius / sqrt(u^T diag(variances) u)),
// taken by Gauss and Legendre along the largest axis (20 nodes), and about it by the midpoint rule (8 nodes a quarter of a turn), which
// is exact to all orders for a periodic function.
double exceedance(const Vec3& variances, double radius);

// The radius of the sphere about 0 that e = N(0, covariance) leaves with the probability kProtectionRisk: 4.594 sigma where all three axes
// are alike, 3.891 sigma where one of them is all. In the unit of sqrt(covariance); the error is below 1e-6 of it; the same bits on each
// machine. Negative eigenvalues, which are rounding, count as 0. Infinite where the covariance is not finite: it then promises nothing.
double protection_level(const Mat3& covariance);

// Of position and attitude (the angle of its whole turn), each for itself, from the covariance of (rotation, translation).
struct ProtectionLevels {
  double position_m = 0, attitude_rad = 0;  // attitude: at most half a turn, as any error is
};
ProtectionLevels protection_levels(const Mat6& covariance);

// Of many valid poses. One whose error exceeds its level is misleading.
struct LevelStatistics {
  std::size_t misleading = 0;
  double median = std::numeric_limits<double>::quiet_NaN(), worst = median;  // levels; of no pose, not numbers
};
struct ProtectionStatistics {
  std::size_t poses = 0, misleading = 0;  // valid ones; of them, those that mislead about the position or the attitude
  LevelStatistics position_mm, attitude_deg;
};

}  // namespace lasso::mdat
