#include "mdat/pair/disparity_map.hpp"

#include <gtest/gtest.h>

#include "fsw/geometry/so3.hpp"
#include "ut/mdat/pair/scratch.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

DisparityMap generic_map() {
  DisparityMap map;
  map.focal_px = 700;
  map.center_x_px = 31.5;
  map.center_y_px = 20.25;
  map.baseline_m = 0.25;
  map.q_left_rectified = exp_so3(Vec3(0.02, -0.05, 0.03));
  map.counts = {1, 2, 3, 4, 5};
  map.codes = {64, 40, std::vector<std::uint16_t>(64 * 40, 0)};
  map.codes.codes[map.index(10, 7)] = 16 * 35 + 8;
  return map;
}

// Two ideal cameras see a point where the disparity says.
TEST(DisparityMap, APointIsSeenByBothCamerasWhereItWasMatched) {
  VERIFIES("LASSO-STE-004~1");
  const DisparityMap map = generic_map();
  const Vec3 point = map.point_m(10, 7);
  const Vec3 rectified = rotate(map.q_left_rectified.conjugate(), point), from_right = rectified - Vec3(map.baseline_m, 0, 0);
  EXPECT_NEAR(map.center_x_px + 700 * rectified.x() / rectified.z(), 10, 1e-9);
  EXPECT_NEAR(map.center_y_px + 700 * rectified.y() / rectified.z(), 7, 1e-9);
  EXPECT_NEAR(map.center_x_px + 700 * from_right.x() / from_right.z(), 10 - 35.5, 1e-9);
  EXPECT_LT((map.pixel_of(point) - Eigen::Vector2d(10, 7)).norm(), 1e-9);
  EXPECT_LT(map.pixel_of(-point).x(), -1e6) << "behind the camera";
}

TEST(DisparityMap, WhatIsWrittenIsRead) {
  VERIFIES("LASSO-STE-004~1");
  const Scratch scratch;
  const DisparityMap map = generic_map();
  write_disparity_map(map, scratch / "d.png", scratch / "g.json");
  const DisparityMap read = read_disparity_map(scratch / "d.png", scratch / "g.json");
  EXPECT_EQ(read.codes.codes, map.codes.codes);
  EXPECT_EQ(read.focal_px, map.focal_px);
  EXPECT_EQ(read.center_y_px, map.center_y_px);
  EXPECT_EQ(read.baseline_m, map.baseline_m);
  EXPECT_LT((read.q_left_rectified.coeffs() - map.q_left_rectified.coeffs()).norm(), 1e-15);
  EXPECT_EQ(read.counts.glint, 2U);
  EXPECT_EQ(read.counts.flat, 3U);
  EXPECT_EQ(read.counts.matched, 5U);
  EXPECT_DOUBLE_EQ(read.disparity_px(read.index(10, 7)), 35.5);
}

TEST(DisparityMap, RefusesWhatIsNone) {
  VERIFIES("LASSO-STE-004~1");
  const Scratch scratch;
  scratch.write("g.json", "{\"steps_per_pixel\": 4}");
  EXPECT_NE(said_by([&] { static_cast<void>(read_disparity_map(scratch / "d.png", scratch / "g.json")); }).find("is not the geometry"),
            std::string::npos);
  EXPECT_NE(said_by([&] { write_disparity_map(generic_map(), scratch / "no/d.png", scratch / "g.json"); }).find("cannot be written"),
            std::string::npos);
}

}  // namespace
}  // namespace lasso::mdat
