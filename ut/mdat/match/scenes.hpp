// Pictures of a textured plane, as two given cameras see it, without any renderer.
#pragma once

#include <cmath>
#include <opencv2/core.hpp>

#include "fsw/geometry/so3.hpp"
#include "mdat/missiondb/stereo_pair_file.hpp"

namespace lasso::mdat {

// Smooth and without period: where a point of the plane is brighter, seen from anywhere.
inline double texture_at(double x_m, double y_m) {
  double sum = 0;
  for (int k = 1; k <= 12; ++k) {
    const double turn = 2.399963 * k, frequency = 14 + 9 * k;  // golden angle
    sum += std::sin(frequency * (std::cos(turn) * x_m + std::sin(turn) * y_m) + 1.7 * k);
  }
  return 0.5 + 0.08 * sum;
}

inline PairCamera pinhole(int width, int height, double focal_px) {
  return {width, height, focal_px, focal_px, 0.5 * (width - 1), 0.5 * (height - 1), {}};
}

inline StereoPair ideal_pair() {
  StereoPair pair;
  pair.left = pair.right = pinhole(320, 240, 400);
  pair.T_left_right.p = Vec3(0.2, 0, 0);
  return pair;
}

// What a camera sees of the plane n . x = distance (left camera's axes), where |x|, |y| are within `half_m` of it; black sky beyond.
inline cv::Mat picture_of_plane(const PairCamera& camera, const Pose& T_left_camera, const Vec3& n, double distance_m, double half_m) {
  cv::Mat picture(camera.height, camera.width, CV_8U, cv::Scalar(0));
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      const Vec3 ray = rotate(T_left_camera.q,
                              Vec3((column - camera.center_x_px) / camera.focal_x_px, (row - camera.center_y_px) / camera.focal_y_px, 1));
      const Vec3 point = T_left_camera.p + ray * ((distance_m - n.dot(T_left_camera.p)) / n.dot(ray));
      if (std::fabs(point.x()) > half_m || std::fabs(point.y()) > half_m) continue;
      picture.at<std::uint8_t>(row, column) =
          static_cast<std::uint8_t>(std::lround(30 + 190 * std::min(1.0, std::max(0.0, texture_at(point.x(), point.y())))));
    }
  }
  return picture;
}

}  // namespace lasso::mdat
