#include "mdat/run/verdict.hpp"

#include <algorithm>
#include <cmath>

#include "mdat/run/case.hpp"

namespace lasso::mdat {
namespace {

bool beyond_sigma(const Vec3& error, const Mat3& covariance) {
  const double variance = error.dot(covariance * error);  // of the error's component along itself, times |error|^2
  return !(error.squaredNorm() <= kWrongSigmas * std::sqrt(std::max(variance, 0.0)));
}

PoseVerdict judge(const Vec3& error, double limit, const Mat3& covariance) {
  if (error.norm() <= limit) return PoseVerdict::kRight;
  return std::isfinite(error.norm()) && !beyond_sigma(error, covariance) ? PoseVerdict::kCovered : PoseVerdict::kWrong;
}

Mat6 filter_covariance(const PoseTelemetry& pose) {
  Mat6 covariance = Mat6::Zero();
  for (int i = 0; i < 6; ++i) {
    const auto sigma = static_cast<double>(pose.filter_sigma_pose[i]);
    covariance(i, i) = sigma * sigma;
  }
  return covariance;
}

}  // namespace

PoseVerdict judge(const Pose& estimate, const Pose& truth, const Mat6& covariance) {
  const Vec6 error = pose_difference(estimate, truth);
  return std::max(judge(error.tail<3>(), kWrong_m, covariance.bottomRightCorner<3, 3>()),
                  judge(error.head<3>(), kWrong_rad, covariance.topLeftCorner<3, 3>()));
}

PoseVerdict judge_valid(const PoseTelemetry& pose, const Pose& truth) {
  if (pose.valid == 0) return PoseVerdict::kRight;
  return std::max(judge(registration_pose(pose), truth, registration_covariance(pose)),
                  judge(filtered_pose(pose), truth, filter_covariance(pose)));
}

}  // namespace lasso::mdat
