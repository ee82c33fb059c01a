#include "mdat/match/rectification.hpp"

#include <gtest/gtest.h>

#include "ut/mdat/match/scenes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

StereoPair generic_pair() {
  StereoPair pair = ideal_pair();
  pair.right = pinhole(316, 244, 391);
  pair.T_left_right = {exp_so3(Vec3(0.02, -0.05, 0.03)), Vec3(0.2, 0.01, -0.02)};
  return pair;
}

Eigen::Vector2d seen_at(const Rectification& ideal, const Vec3& point) {
  return {ideal.center_x_px + ideal.focal_px * point.x() / point.z(), ideal.center_y_px + ideal.focal_px * point.y() / point.z()};
}

TEST(Rectification, APointLiesInOneRowOfBothPictures) {
  VERIFIES("LASSO-STE-005~1");
  const StereoPair pair = generic_pair();
  const Rectification ideal = rectification_of(pair);
  EXPECT_FALSE(ideal.is_ideal);
  for (const Vec3& point : {Vec3(0.1, 0.2, 2), Vec3(-0.4, 0.3, 3), Vec3(0.5, -0.6, 9)}) {
    const Vec3 in_right = inverse(pair.T_left_right) * point;
    const Eigen::Vector2d left = seen_at(ideal, rotate(ideal.q_left_rectified.conjugate(), point));
    const Eigen::Vector2d right = seen_at(ideal, rotate(ideal.q_right_rectified.conjugate(), in_right));
    EXPECT_NEAR(left.y(), right.y(), 1e-9);
    const double depth_m = rotate(ideal.q_left_rectified.conjugate(), point).z();
    EXPECT_NEAR(left.x() - right.x(), ideal.focal_px * ideal.baseline_m / depth_m, 1e-9);
  }
}

TEST(Rectification, AnIdealPairIsLeftAsItIs) {
  VERIFIES("LASSO-STE-005~1");
  const StereoPair pair = ideal_pair();
  const Rectification ideal = rectification_of(pair);
  EXPECT_TRUE(ideal.is_ideal);
  const cv::Mat left = picture_of_plane(pair.left, {}, Vec3::UnitZ(), 2, 0.5),
                right = picture_of_plane(pair.right, pair.T_left_right, Vec3::UnitZ(), 2, 0.5);
  const RectifiedPair pictures = rectified(left, right, pair, ideal);
  EXPECT_EQ(cv::norm(pictures.left, left, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(pictures.right, right, cv::NORM_INF), 0);
}

// What an ideal camera sees of the plane, and what is made of the true one's picture.
TEST(Rectification, PicturesAreThoseOfIdealCameras) {
  VERIFIES("LASSO-STE-005~1");
  const StereoPair pair = generic_pair();
  const Rectification ideal = rectification_of(pair);
  const RectifiedPair pictures = rectified(picture_of_plane(pair.left, {}, Vec3::UnitZ(), 2, 9),
                                           picture_of_plane(pair.right, pair.T_left_right, Vec3::UnitZ(), 2, 9), pair, ideal);
  const PairCamera camera{320, 240, ideal.focal_px, ideal.focal_px, ideal.center_x_px, ideal.center_y_px, {}};
  const Pose T_left_ideal{normalized(pair.T_left_right.q * ideal.q_right_rectified), pair.T_left_right.p};
  const cv::Mat expected = picture_of_plane(camera, T_left_ideal, Vec3::UnitZ(), 2, 9);
  cv::Mat difference;
  cv::absdiff(pictures.right, expected, difference);
  EXPECT_LT(cv::mean(difference, pictures.right_seen)[0], 1.0);
  EXPECT_GT(cv::countNonZero(pictures.right_seen), 320 * 240 / 2);
}

TEST(Rectification, OverlapIsThatOfTheFieldsOfView) {
  VERIFIES("LASSO-STE-005~1");
  const StereoPair pair = ideal_pair();
  const Rectification ideal = rectification_of(pair);
  const cv::Mat picture(240, 320, CV_8U, cv::Scalar(9));
  const RectifiedPair pictures = rectified(picture, picture, pair, ideal);
  EXPECT_NEAR(overlap(pictures, ideal, 1), 1 - 80 / 320.0, 1e-9);  // 400 px * 0.2 m / 1 m
  EXPECT_EQ(overlap(pictures, ideal, 0.2), 0);
}

}  // namespace
}  // namespace lasso::mdat
