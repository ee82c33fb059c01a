#include "mdat/stereo/disparity_view.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "ut/mdat/stereo/maps.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

DisparityMap ramp() {
  DisparityMap map = empty_map(100, 40, 80);
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 100; ++column) map.codes.codes[map.index(column, row)] = static_cast<std::uint16_t>(160 + 8 * column);
  }
  return map;
}

TEST(DisparityView, FarIsColdNearIsWarmAndHolesAreGrey) {
  VERIFIES("LASSO-STE-010~1");
  Picture picture = disparity_view(ramp());
  EXPECT_GT(picture.height, 40) << "a legend";
  EXPECT_GT(picture.at(5, 5)[2], picture.at(5, 5)[0]) << "blue";
  EXPECT_GT(picture.at(97, 5)[0], 2 * picture.at(97, 5)[2]) << "red";
  const Pixel hole = picture.at(50, 30);
  EXPECT_EQ(hole[0] / 8, hole[2] / 8) << "grey";
  EXPECT_LT(hole[0], 60);
  Picture empty = disparity_view(empty_map(100, 40, 80));
  EXPECT_EQ(empty.at(3, 3), hole);
}

TEST(DisparityView, ErrorsAreShownBySignAndSize) {
  VERIFIES("LASSO-STE-010~1");
  const DisparityMap map = ramp();
  std::vector<double> truth;
  for (std::size_t i = 0; i < map.codes.codes.size(); ++i) truth.push_back(map.disparity_px(i));
  truth[map.index(10, 10)] -= 0.9;  // measured too near
  truth[map.index(20, 10)] += 0.9;
  truth[map.index(30, 10)] += 1.5;
  Picture picture = error_view(map, truth);
  EXPECT_GT(picture.at(10, 10)[0], picture.at(10, 10)[2] + 50) << "red";
  EXPECT_GT(picture.at(20, 10)[2], picture.at(20, 10)[0] + 50) << "blue";
  EXPECT_GT(picture.at(30, 10)[0], 200);
  EXPECT_GT(picture.at(30, 10)[2], 200);
  EXPECT_LT(picture.at(30, 10)[1], 80) << "magenta";
}

TEST(DisparityView, CloudHasAPointForEachDisparityAndNoneForHoles) {
  VERIFIES("LASSO-STE-010~1");
  const DisparityMap map = ramp();
  const std::string ply = range_ply(map);
  EXPECT_NE(ply.find("element vertex 2000\n"), std::string::npos);
  const std::size_t body = ply.find("end_header\n") + 11;
  ASSERT_EQ(ply.size(), body + 2000 * 12);
  float point[3];
  std::memcpy(point, ply.data() + body + 12 * (100 * 7 + 31), sizeof point);
  const Vec3 expected = map.point_m(31, 7);
  for (int axis = 0; axis < 3; ++axis) EXPECT_FLOAT_EQ(point[axis], static_cast<float>(expected[axis]));
}

}  // namespace
}  // namespace lasso::mdat
