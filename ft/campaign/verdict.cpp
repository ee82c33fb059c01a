#include "ft/campaign/verdict.hpp"

#include <algorithm>
#include <cmath>

#include "mdat/run/case.hpp"

namespace lasso::campaign {
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

// The worst of all valid poses.
PoseVerdict judge_all(const std::vector<PoseTelemetry>& poses, const sim::Trajectory& truth) {
  PoseVerdict worst = PoseVerdict::kRight;
  for (const PoseTelemetry& pose : poses) worst = std::max(worst, judge_valid(pose, truth.at(pose.t_measurement_us).T_sensor_target));
  return worst;
}

bool equal(ConstBytes a, ConstBytes b) { return std::equal(a.begin(), a.end(), b.begin(), b.end()); }

Outcome stopped(End end) {
  if (end == End::kInvariant) return Outcome::kInvariant;
  return end == End::kHang ? Outcome::kHang : Outcome::kCrash;
}

}  // namespace

PoseVerdict judge(const Pose& estimate, const Pose& truth, const Mat6& covariance) {
  const Vec6 error = pose_difference(estimate, truth);
  return std::max(judge(error.tail<3>(), kWrong_m, covariance.bottomRightCorner<3, 3>()),
                  judge(error.head<3>(), kWrong_rad, covariance.topLeftCorner<3, 3>()));
}

PoseVerdict judge_valid(const PoseTelemetry& pose, const Pose& truth) {
  if (pose.valid == 0) return PoseVerdict::kRight;
  return std::max(judge(mdat::registration_pose(pose), truth, mdat::registration_covariance(pose)),
                  judge(mdat::filtered_pose(pose), truth, filter_covariance(pose)));
}

Outcome outcome(ConstBytes telemetry, ConstBytes golden, const sim::Trajectory& truth, End end) {
  const Decoded decoded = decode(telemetry);
  const PoseVerdict worst = judge_all(decoded.poses, truth);
  if (worst == PoseVerdict::kWrong) return Outcome::kSilent;
  if (end != End::kDone) return stopped(end);
  if (equal(telemetry, golden)) return Outcome::kMasked;
  const auto valid = std::count_if(decoded.poses.begin(), decoded.poses.end(), [](const PoseTelemetry& pose) { return pose.valid != 0; });
  const bool complete = decoded.broken == 0 && static_cast<std::size_t>(valid) >= decode(golden).poses.size();
  if (!complete) return Outcome::kDetected;
  return worst == PoseVerdict::kCovered ? Outcome::kCovered : Outcome::kHarmless;
}

}  // namespace lasso::campaign
