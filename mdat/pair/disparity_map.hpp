// What a matcher finds in a pair of pictures, and the two files in which it leaves it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "fsw/geometry/se3.hpp"
#include "mdat/pair/grey_picture.hpp"

namespace lasso::mdat {

constexpr int kDisparitySteps = 16;  // of a pixel; code 0: nothing was found

// How many pixels of the left picture were lost for which reason, the first that holds.
struct MatchCounts {
  std::size_t dark = 0;       // black sky or deep shadow, or near it
  std::size_t glint = 0;      // so bright that it is a mirror image
  std::size_t flat = 0;       // no texture that would place the match
  std::size_t ambiguous = 0;  // the matcher found nothing, or left and right disagree
  std::size_t matched = 0;
};

// Disparities of the rectified left picture. A point at column u and row v lies along ((u - center_x)/focal, (v - center_y)/focal, 1) of
// the rectified axes, at the depth focal * baseline / disparity.
struct DisparityMap {
  double focal_px = 0, center_x_px = 0, center_y_px = 0, baseline_m = 0;
  Quat q_left_rectified = Quat::Identity();  // takes rectified axes to those of the left camera
  MatchCounts counts;
  GreyPicture<std::uint16_t> codes;  // kDisparitySteps to the pixel

  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(codes.width) + static_cast<std::size_t>(column);
  }
  double disparity_px(std::size_t pixel) const { return static_cast<double>(codes.codes[pixel]) / kDisparitySteps; }
  // Where a direction of the left camera's axes is seen; z ahead (> 0) in rectified axes, otherwise far outside.
  Eigen::Vector2d pixel_of(const Vec3& direction_left) const;
  // The point that a pixel shows, left camera's axes; the pixel has a disparity above 0.
  Vec3 point_m(int column, int row) const;
};

// DISPARITY.png of 16 bits, and its geometry and counts as JSON. Throws std::runtime_error.
void write_disparity_map(const DisparityMap& map, const std::filesystem::path& picture, const std::filesystem::path& geometry);
DisparityMap read_disparity_map(const std::filesystem::path& picture, const std::filesystem::path& geometry);

}  // namespace lasso::mdat
