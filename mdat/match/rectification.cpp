#include "mdat/match/rectification.hpp"

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "fsw/geometry/so3.hpp"

namespace lasso::mdat {
namespace {

// Closer to an ideal pair than this (radians, and pixels) no picture is resampled: that would blur it.
constexpr double kIdealWithin = 1e-9;

cv::Matx33d matrix_of(const Quat& q) {
  const Mat3 r = q.toRotationMatrix();
  return {r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2)};
}

cv::Matx33d intrinsics(double focal_x, double focal_y, double center_x, double center_y) {
  return {focal_x, 0, center_x, 0, focal_y, center_y, 0, 0, 1};
}

// Takes rectified axes to the left camera's.
Quat rectified_axes(const Pose& T_left_right) {
  const Vec3 x = T_left_right.p.normalized();
  const Vec3 ahead = Vec3::UnitZ() + rotate(T_left_right.q, Vec3::UnitZ());
  const Vec3 z = (ahead - x * ahead.dot(x)).normalized();
  Mat3 axes;
  axes << x, z.cross(x), z;
  return normalized(Quat(axes));
}

bool is_undistorted(const PairCamera& camera) {
  return std::all_of(camera.distortion.begin(), camera.distortion.end(), [](double k) { return k == 0; });
}

bool is_like(const PairCamera& camera, const Rectification& ideal) {
  const auto same = [](double a, double b) { return std::fabs(a - b) <= kIdealWithin; };
  return is_undistorted(camera) && same(camera.focal_x_px, ideal.focal_px) && same(camera.focal_y_px, ideal.focal_px) &&
         same(camera.center_x_px, ideal.center_x_px) && same(camera.center_y_px, ideal.center_y_px);
}

// Where the middle of the picture goes with a principal point at 0, 0.
Eigen::Vector2d middle_of(const PairCamera& camera, const Quat& q_camera_rectified, double focal_px) {
  const Vec3 ray((0.5 * (camera.width - 1) - camera.center_x_px) / camera.focal_x_px,
                 (0.5 * (camera.height - 1) - camera.center_y_px) / camera.focal_y_px, 1);
  const Vec3 turned = rotate(q_camera_rectified.conjugate(), ray);
  return focal_px * turned.head<2>() / turned.z();
}

void resample(const cv::Mat& picture, const PairCamera& camera, const Quat& q_camera_rectified, const Rectification& to, cv::Size size,
              cv::Mat& result, cv::Mat& seen) {
  const cv::Mat distortion = (cv::Mat_<double>(1, 5) << camera.distortion[0], camera.distortion[1], camera.distortion[2],
                              camera.distortion[3], camera.distortion[4]);
  cv::Mat columns, rows;
  cv::initUndistortRectifyMap(intrinsics(camera.focal_x_px, camera.focal_y_px, camera.center_x_px, camera.center_y_px), distortion,
                              matrix_of(q_camera_rectified.conjugate()),
                              intrinsics(to.focal_px, to.focal_px, to.center_x_px, to.center_y_px), size, CV_32FC1, columns, rows);
  cv::remap(picture, result, columns, rows, cv::INTER_CUBIC, cv::BORDER_CONSTANT);
  cv::remap(cv::Mat(picture.size(), CV_8U, cv::Scalar(255)), seen, columns, rows, cv::INTER_NEAREST, cv::BORDER_CONSTANT);
}

}  // namespace

Rectification rectification_of(const StereoPair& pair) {
  Rectification to;
  to.baseline_m = pair.T_left_right.p.norm();
  to.q_left_rectified = rectified_axes(pair.T_left_right);
  to.q_right_rectified = normalized(pair.T_left_right.q.conjugate() * to.q_left_rectified);
  to.focal_px = 0.25 * (pair.left.focal_x_px + pair.left.focal_y_px + pair.right.focal_x_px + pair.right.focal_y_px);
  const double turn = std::max(to.q_left_rectified.vec().norm(), to.q_right_rectified.vec().norm());
  to.center_x_px = pair.left.center_x_px;
  to.center_y_px = pair.left.center_y_px;
  to.is_ideal = turn <= kIdealWithin && is_like(pair.left, to) && is_like(pair.right, to);
  if (to.is_ideal) return to;
  const Eigen::Vector2d middle =
      0.5 * (middle_of(pair.left, to.q_left_rectified, to.focal_px) + middle_of(pair.right, to.q_right_rectified, to.focal_px));
  to.center_x_px = 0.5 * (pair.left.width - 1) - middle.x();
  to.center_y_px = 0.5 * (pair.left.height - 1) - middle.y();
  return to;
}

RectifiedPair rectified(const cv::Mat& left, const cv::Mat& right, const StereoPair& pair, const Rectification& to) {
  RectifiedPair result;
  if (to.is_ideal && left.size() == right.size()) {
    const cv::Mat all(left.size(), CV_8U, cv::Scalar(255));
    return {left, right, all, all};
  }
  resample(left, pair.left, to.q_left_rectified, to, left.size(), result.left, result.left_seen);
  resample(right, pair.right, to.q_right_rectified, to, left.size(), result.right, result.right_seen);
  return result;
}

double overlap(const RectifiedPair& pictures, const Rectification& cameras, double depth_m) {
  const int shift = static_cast<int>(std::lround(std::min(1e6, cameras.focal_px * cameras.baseline_m / depth_m)));
  const int columns = pictures.left.cols - shift;
  if (columns <= 0) return 0;
  const cv::Mat both = pictures.left_seen.colRange(shift, pictures.left.cols) & pictures.right_seen.colRange(0, columns);
  return static_cast<double>(cv::countNonZero(both)) / static_cast<double>(pictures.left.total());
}

}  // namespace lasso::mdat
