#include "mdat/match/matching.hpp"

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "mdat/match/masks.hpp"

namespace lasso::mdat {
namespace {

constexpr int kBlock_px = 5, kSmallStep = 8 * kBlock_px * kBlock_px, kLargeStep = 32 * kBlock_px * kBlock_px;  // penalties P1 and P2
constexpr int kUniqueness_percent = 15, kFilterCap = 63, kSpeckle_px = 100, kSpeckleRange = 2;
constexpr int kBothWaysWithin = 1 * kDisparitySteps;
constexpr int kMargin_px = 16;  // of dark around what is lit
constexpr double kLeastOverlap = 0.01;
constexpr int kMostDisparities = 2032;  // of 16 bits with 4 of them behind the point

struct DisparityWindow {
  int least = 0, count = 0;  // count: a multiple of 16
  int end() const { return least + count; }
};

DisparityWindow disparity_window(const Rectification& cameras, const DepthWindow& window) {
  const double scale = cameras.focal_px * cameras.baseline_m;
  const int least = static_cast<int>(std::floor(std::min(scale / window.farthest_m, 1.0 * kMostDisparities)));
  const int greatest = static_cast<int>(std::ceil(std::min(scale / window.nearest_m, 1.0 * kMostDisparities)));
  return {least, std::max(1, (greatest - least + 1 + 15) / 16) * 16};
}

// Columns and rows of the left picture, not all of which it has.
struct Cut {
  int left = 0, top = 0, width = 0, height = 0;
};

// What is lit, with as much on its left as the right camera sees there, and on its right as the matching of the mirrored pictures asks:
// OpenCV has no disparities in its first columns.
Cut cut_about(const cv::Mat& lit, const DisparityWindow& window) {
  const cv::Rect box = cv::boundingRect(lit);
  const int top = std::max(0, box.y - kMargin_px), bottom = std::min(lit.rows, box.y + box.height + kMargin_px);
  const int left = box.x - kMargin_px - window.end(), right = box.x + box.width + kMargin_px + window.count;
  return {left, top, right - left, bottom - top};
}

// Black where the picture has nothing.
cv::Mat cut_out(const cv::Mat& picture, const Cut& cut) {
  cv::Mat part(cut.height, cut.width, CV_8U, cv::Scalar(0));
  const int from = std::max(0, cut.left), to = std::min(picture.cols, cut.left + cut.width);
  picture(cv::Range(cut.top, cut.top + cut.height), cv::Range(from, to)).copyTo(part.colRange(from - cut.left, to - cut.left));
  return part;
}

cv::Mat semi_global(const cv::Mat& left, const cv::Mat& right, const DisparityWindow& window) {
  const auto matcher = cv::StereoSGBM::create(window.least, window.count, kBlock_px, kSmallStep, kLargeStep, 1, kFilterCap,
                                              kUniqueness_percent, kSpeckle_px, kSpeckleRange, cv::StereoSGBM::MODE_HH);
  cv::Mat disparity;  // 16-bit, in sixteenths; below 16 * least: none
  matcher->compute(left, right, disparity);
  return disparity;
}

cv::Mat mirrored_picture(const cv::Mat& picture) {
  cv::Mat result;
  cv::flip(picture, result, 1);
  return result;
}

// The right picture's disparities, by the same matcher on both pictures mirrored.
cv::Mat of_the_right(const cv::Mat& left, const cv::Mat& right, const DisparityWindow& window) {
  return mirrored_picture(semi_global(mirrored_picture(right), mirrored_picture(left), window));
}

bool agree(const cv::Mat& of_left, const cv::Mat& of_right, int row, int column) {
  const int disparity = of_left.at<std::int16_t>(row, column);
  const int other = column - (disparity + kDisparitySteps / 2) / kDisparitySteps;
  return other >= 0 && std::abs(of_right.at<std::int16_t>(row, other) - disparity) <= kBothWaysWithin;
}

// The disparity in sixteenths, 0 where there is none.
cv::Mat checked_disparity(const RectifiedPair& pictures, const Cut& cut, const DisparityWindow& window) {
  const cv::Mat left = cut_out(pictures.left, cut), right = cut_out(pictures.right, cut);
  const cv::Mat of_left = semi_global(left, right, window), of_right = of_the_right(left, right, window);
  cv::Mat result(pictures.left.size(), CV_16U, cv::Scalar(0));
  const int least = std::max(1, window.least * kDisparitySteps);
  for (int row = 0; row < cut.height; ++row) {
    for (int column = std::max(0, -cut.left); column < std::min(cut.width, pictures.left.cols - cut.left); ++column) {
      const int disparity = of_left.at<std::int16_t>(row, column);
      if (disparity < least || !agree(of_left, of_right, row, column)) continue;
      const int whole = disparity / kDisparitySteps, place = cut.left + column;  // the right picture ends, and blackness begins, at 0
      if (place - whole >= 0) result.at<std::uint16_t>(cut.top + row, place) = static_cast<std::uint16_t>(disparity);
    }
  }
  return result;
}

cv::Mat picture_of(const std::filesystem::path& file, const PairCamera& camera, const std::filesystem::path& calibration) {
  const GreyPicture<std::uint8_t> picture = read_grey_png(file);
  if (picture.width == camera.width && picture.height == camera.height)
    return cv::Mat(picture.height, picture.width, CV_8U, const_cast<std::uint8_t*>(picture.codes.data())).clone();
  const auto size = [](int width, int height) { return std::to_string(width) + " x " + std::to_string(height); };
  throw std::runtime_error(file.string() + ": has " + size(picture.width, picture.height) + " pixels, and " + calibration.string() +
                           " is of " + size(camera.width, camera.height) +
                           ": give the picture as the camera took it, or the calibration of this size");
}

DisparityMap empty_map_of(const RectifiedPair& pictures, const Rectification& cameras) {
  DisparityMap map;
  map.focal_px = cameras.focal_px;
  map.center_x_px = cameras.center_x_px;
  map.center_y_px = cameras.center_y_px;
  map.baseline_m = cameras.baseline_m;
  map.q_left_rectified = cameras.q_left_rectified;
  map.codes = {pictures.left.cols, pictures.left.rows, std::vector<std::uint16_t>(pictures.left.total(), 0)};
  return map;
}

// Masks, by which a pixel is left out or not.
struct Reasons {
  cv::Mat lit, glint, textured;

  // Where a pixel with this disparity (0: none) is counted.
  std::size_t& count_of(MatchCounts& counts, std::uint16_t code, int row, int column) const {
    if (lit.at<std::uint8_t>(row, column) == 0) return counts.dark;
    if (glint.at<std::uint8_t>(row, column) != 0) return counts.glint;
    if (textured.at<std::uint8_t>(row, column) == 0) return counts.flat;
    return code == 0 ? counts.ambiguous : counts.matched;
  }
};

}  // namespace

DisparityMap matched(const RectifiedPair& pictures, const Rectification& cameras, const PairCodes& codes, const DepthWindow& window) {
  DisparityMap map = empty_map_of(pictures, cameras);
  const cv::Mat lit = lit_mask(pictures.left, codes) & pictures.left_seen;
  if (cv::countNonZero(lit) == 0) {
    map.counts.dark = pictures.left.total();
    return map;
  }
  const DisparityWindow disparities = disparity_window(cameras, window);
  const Reasons reasons{lit, glint_mask(pictures.left, codes), predicted_sigma_px(pictures.left, codes) < kWorstSigma_px};
  const cv::Mat disparity = checked_disparity(pictures, cut_about(lit, disparities), disparities);
  for (int row = 0; row < lit.rows; ++row) {
    for (int column = 0; column < lit.cols; ++column) {
      const std::uint16_t code = disparity.at<std::uint16_t>(row, column);
      std::size_t& count = reasons.count_of(map.counts, code, row, column);
      ++count;
      if (&count == &map.counts.matched) map.codes.codes[map.index(column, row)] = code;
    }
  }
  return map;
}

DisparityMap matched_files(const MatchInput& input) {
  const StereoPair pair = load_stereo_pair(input.calibration);
  const Rectification cameras = rectification_of(pair);
  const RectifiedPair pictures = rectified(picture_of(input.left, pair.left, input.calibration),
                                           picture_of(input.right, pair.right, input.calibration), pair, cameras);
  const double shared = std::max(overlap(pictures, cameras, input.window.nearest_m), overlap(pictures, cameras, input.window.farthest_m));
  if (shared < kLeastOverlap) {
    char text[160];
    std::snprintf(text, sizeof text, ": the cameras see nothing in common from %g m to %g m: check right.position_m and right.quaternion",
                  input.window.nearest_m, input.window.farthest_m);
    throw std::runtime_error(input.calibration.string() + text);
  }
  return matched(pictures, cameras, pair.codes, input.window);
}

}  // namespace lasso::mdat
