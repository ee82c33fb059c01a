#include "mdat/run/symmetric_error.hpp"

#include <algorithm>
#include <cmath>

#include "mdat/run/statistics.hpp"

namespace lasso::mdat {
namespace {

// The true pose of the target after the turn about the symmetry's centre, which looks the same.
Pose image_of(const Pose& truth, const Quat& turn, const Vec3& center) { return truth * Pose{turn, center - turn * center}; }

SymmetricError error_of(const Pose& estimate, const Pose& image, const Mat6& covariance) {
  const Vec6 difference = pose_difference(estimate, image);
  return {nees(estimate, image, covariance), difference.tail<3>().norm(), difference.head<3>().norm()};
}

// The angle about the axis that brings the image nearest to the estimate: of the swing-twist decomposition of what is between them.
double twist_rad(const Pose& estimate, const Pose& image, const Vec3& axis) {
  const Quat between = image.q.conjugate() * estimate.q;
  return 2 * std::atan2(between.vec().dot(axis), between.w());
}

SymmetricError round_error(const Pose& estimate, const Pose& image, const Mat6& covariance, const Vec3& axis, const Vec3& center) {
  const auto at = [&](double angle_rad) {
    return error_of(estimate, image_of(image, Quat(Eigen::AngleAxisd(angle_rad, axis)), center), covariance);
  };
  const double middle = twist_rad(estimate, image, axis);
  SymmetricError least = at(middle);
  double best = middle;
  double reach = 20 * kRadPerDeg;
  for (int finer = 0; finer < 4; ++finer, reach /= 8) {
    const double from = best;
    for (int i = -10; i <= 10; ++i) {
      const double angle = from + 0.1 * i * reach, squared = at(angle).squared;
      if (squared >= least.squared) continue;
      least.squared = squared;
      best = angle;
    }
  }
  return least;
}

// Of the centre's place alone: its covariance follows from that of the pose.
SymmetricError sphere_error(const Pose& estimate, const Pose& truth, const Mat6& covariance, const Vec3& center) {
  const Vec3 arm = estimate.q * center, error = estimate * center - truth * center;
  Eigen::Matrix<double, 3, 6> J;
  J << 0, arm.z(), -arm.y(), 1, 0, 0, -arm.z(), 0, arm.x(), 0, 1, 0, arm.y(), -arm.x(), 0, 0, 0, 1;
  const Mat3 C = J * covariance * J.transpose();
  return {error.dot(C.ldlt().solve(error)), error.norm(), 0};
}

}  // namespace

SymmetricError symmetric_error(const Pose& estimate, const Pose& truth, const Mat6& covariance, const ExactSymmetry& symmetry) {
  if (symmetry.sphere) return sphere_error(estimate, truth, covariance, symmetry.center);
  SymmetricError least;
  for (std::size_t i = 0; i < symmetry.turns.size(); ++i) {
    const Pose image = image_of(truth, symmetry.turns[i], symmetry.center);
    const SymmetricError error =
        symmetry.axis ? round_error(estimate, image, covariance, *symmetry.axis, symmetry.center) : error_of(estimate, image, covariance);
    const double squared = i == 0 ? error.squared : std::min(least.squared, error.squared);
    if (i == 0 || error.rotation_rad < least.rotation_rad) least = error;
    least.squared = squared;
  }
  return least;
}

bool is_far(const SymmetricError& error, double size_m) {
  return !(error.translation_m <= kWrongShare * size_m && error.rotation_rad <= kWrongTurn_rad);
}

bool is_wrong(const SymmetricError& error, double size_m) { return !(error.squared <= kWrongSquared) && is_far(error, size_m); }

}  // namespace lasso::mdat
