#include "mdat/match/matching.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "ut/mdat/match/scenes.hpp"
#include "ut/mdat/pair/scratch.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

Vec3 tilted_normal() { return Vec3(0.25, -0.2, 1).normalized(); }
constexpr double kPlane_m = 2.1, kHalf_m = 0.45;

DisparityMap map_of(const StereoPair& pair, const StereoPair& stated) {
  const cv::Mat left = picture_of_plane(pair.left, {}, tilted_normal(), kPlane_m, kHalf_m);
  const cv::Mat right = picture_of_plane(pair.right, pair.T_left_right, tilted_normal(), kPlane_m, kHalf_m);
  const Rectification ideal = rectification_of(stated);
  return matched(rectified(left, right, stated, ideal), ideal, stated.codes, {1.5, 4});
}

// Distances of the matched points from the plane along their rays, relative to one pixel of disparity.
std::vector<double> errors_px(const DisparityMap& map) {
  std::vector<double> errors;
  for (int row = 0; row < map.codes.height; ++row) {
    for (int column = 0; column < map.codes.width; ++column) {
      if (map.codes.codes[map.index(column, row)] == 0) continue;
      const Vec3 point = map.point_m(column, row), ray = point.normalized();
      const double true_m = kPlane_m / tilted_normal().dot(ray), depth_m = point.z();
      errors.push_back((true_m - point.norm()) / true_m * map.focal_px * map.baseline_m / depth_m);
    }
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

TEST(Matching, ATiltedPlaneIsMeasuredToAFractionOfAPixel) {
  VERIFIES("LASSO-STE-004~1");
  const DisparityMap map = map_of(ideal_pair(), ideal_pair());
  const std::vector<double> errors = errors_px(map);
  const int shown = cv::countNonZero(picture_of_plane(ideal_pair().left, {}, tilted_normal(), kPlane_m, kHalf_m));
  ASSERT_GT(static_cast<double>(errors.size()), 0.75 * shown);
  EXPECT_EQ(errors.size(), map.counts.matched);
  EXPECT_EQ(map.counts.matched + map.counts.ambiguous + map.counts.flat + map.counts.dark, 320U * 240U);
  EXPECT_LT(std::fabs(errors[errors.size() / 2]), 0.06);
  EXPECT_GT(errors[errors.size() / 20], -0.4);
  EXPECT_LT(errors[errors.size() * 19 / 20], 0.4);
}

TEST(Matching, SkyStaysEmpty) {
  VERIFIES("LASSO-STE-006~1");
  const DisparityMap map = map_of(ideal_pair(), ideal_pair());
  std::size_t on_sky = 0;
  const cv::Mat left = picture_of_plane(ideal_pair().left, {}, tilted_normal(), kPlane_m, kHalf_m);
  for (int row = 0; row < 240; ++row) {
    for (int column = 0; column < 320; ++column)
      on_sky += map.codes.codes[map.index(column, row)] > 0 && left.at<std::uint8_t>(row, column) == 0 ? 1U : 0U;
  }
  EXPECT_EQ(on_sky, 0U);
}

TEST(Matching, TurnedCamerasMeasureTheSamePlane) {
  VERIFIES("LASSO-STE-005~1");
  StereoPair turned = ideal_pair();
  turned.right = pinhole(330, 236, 391);
  turned.T_left_right = {exp_so3(Vec3(0.01, -0.04, 0.02)), Vec3(0.2, 0.01, -0.01)};
  const std::vector<double> errors = errors_px(map_of(turned, turned));
  ASSERT_GT(errors.size(), 10000U);
  EXPECT_LT(std::fabs(errors[errors.size() / 2]), 0.1);
  EXPECT_GT(errors[errors.size() / 20], -0.5);
  EXPECT_LT(errors[errors.size() * 19 / 20], 0.5);
}

// A right camera that is turned by y to the right against its calibration shifts all that it sees to the left: disparities grow by f y.
TEST(Matching, BelievesTheCalibrationAndNotTheCameras) {
  VERIFIES("LASSO-STE-005~1");
  StereoPair turned = ideal_pair();
  constexpr double kYaw_rad = 0.005;
  turned.T_left_right.q = exp_so3(Vec3(0, kYaw_rad, 0));
  const std::vector<double> errors = errors_px(map_of(turned, ideal_pair()));
  ASSERT_GT(errors.size(), 10000U);
  EXPECT_NEAR(errors[errors.size() / 2], 400 * kYaw_rad, 0.15);
}

TEST(Matching, DarkPicturesHaveNoDisparity) {
  VERIFIES("LASSO-STE-006~1");
  const cv::Mat black(240, 320, CV_8U, cv::Scalar(0));
  const Rectification ideal = rectification_of(ideal_pair());
  const DisparityMap map = matched(rectified(black, black, ideal_pair(), ideal), ideal, {}, {1, 4});
  EXPECT_EQ(map.counts.dark, 320U * 240U);
  EXPECT_EQ(map.counts.matched, 0U);
}

MatchInput files_of(const Scratch& scratch, const StereoPair& pair, int width) {
  const cv::Mat left = picture_of_plane(pair.left, {}, tilted_normal(), kPlane_m, kHalf_m)(cv::Range::all(), cv::Range(0, width)).clone();
  const cv::Mat right = picture_of_plane(pair.right, pair.T_left_right, tilted_normal(), kPlane_m, kHalf_m);
  const auto png = [](const cv::Mat& picture) {
    return grey_png(GreyPicture<std::uint8_t>{picture.cols, picture.rows, {picture.begin<std::uint8_t>(), picture.end<std::uint8_t>()}});
  };
  return {scratch.write("left.png", png(left)),
          scratch.write("right.png", png(right)),
          scratch.write("pair.toml", stereo_pair_text(pair)),
          {1.5, 4}};
}

// The same files: the same disparities. The matcher has nothing but these.
TEST(Matching, OfFilesDependsOnTheFilesAlone) {
  VERIFIES("LASSO-STE-002~1 LASSO-STE-004~1");
  const Scratch here, there;
  const DisparityMap one = matched_files(files_of(here, ideal_pair(), 320)), other = matched_files(files_of(there, ideal_pair(), 320));
  EXPECT_EQ(one.codes.codes, other.codes.codes);
  EXPECT_EQ(one.codes.codes, map_of(ideal_pair(), ideal_pair()).codes.codes);
}

TEST(Matching, RefusesPicturesOfAnotherSizeAndCamerasThatSeeNothingInCommon) {
  VERIFIES("LASSO-STE-007~1");
  const Scratch scratch;
  const std::string size = said_by([&] { static_cast<void>(matched_files(files_of(scratch, ideal_pair(), 300))); });
  EXPECT_NE(size.find("left.png: has 300 x 240 pixels, and "), std::string::npos) << size;
  EXPECT_NE(size.find("is of 320 x 240"), std::string::npos) << size;
  StereoPair apart = ideal_pair();
  apart.T_left_right.p.x() = 9;
  const std::string nothing = said_by([&] { static_cast<void>(matched_files(files_of(scratch, apart, 320))); });
  EXPECT_NE(nothing.find("pair.toml: the cameras see nothing in common from 1.5 m to 4 m"), std::string::npos) << nothing;
}

}  // namespace
}  // namespace lasso::mdat
