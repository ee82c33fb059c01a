// Both pictures as ideal cameras beside each other would have taken them: what is in one row of the left is in the same row of the right.
#pragma once

#include <opencv2/core.hpp>

#include "mdat/missiondb/stereo_pair_file.hpp"

namespace lasso::mdat {

// The ideal cameras: equal, of the left picture's size, x axes along the baseline, z axes as near as can be to the mean of the true ones.
struct Rectification {
  double focal_px = 0, center_x_px = 0, center_y_px = 0, baseline_m = 0;
  Quat q_left_rectified = Quat::Identity();
  Quat q_right_rectified = Quat::Identity();
  bool is_ideal = false;  // the pictures are that already
};
Rectification rectification_of(const StereoPair& pair);

struct RectifiedPair {
  cv::Mat left, right;            // 8-bit codes
  cv::Mat left_seen, right_seen;  // 255 where the camera's picture is, 0 beyond it
};
// `left` and `right` have the calibration's sizes. Interpolation is bicubic; an ideal pair is handed through.
RectifiedPair rectified(const cv::Mat& left, const cv::Mat& right, const StereoPair& pair, const Rectification& to);

// Share of the left picture that the right camera sees at this depth.
double overlap(const RectifiedPair& pictures, const Rectification& cameras, double depth_m);

}  // namespace lasso::mdat
