#include "mdat/stereo/disparity_errors.hpp"

#include <gtest/gtest.h>

#include "ut/mdat/render/shapes.hpp"
#include "ut/mdat/stereo/maps.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(DisparityErrors, TruthIsThatOfThePlane) {
  VERIFIES("LASSO-STE-010~1");
  const ModelSurface surface = surface_of(square(1.0));
  const DisparityMap map = empty_map(41, 31, 60);
  const Pose pose{exp_so3(Vec3(0.2, 0.3, -0.1)), Vec3(0.05, 0.02, 2)};
  const std::vector<double> truth = true_disparities(map, surface, pose);
  const Vec3 normal = rotate(pose.q, Vec3::UnitZ());
  int hits = 0;
  for (int row = 0; row < 31; ++row) {
    for (int column = 0; column < 41; ++column) {
      const Vec3 ray((column - 20.0) / 60, (row - 15.0) / 60, 1);
      const double depth_m = normal.dot(pose.p) / normal.dot(ray);
      const Vec3 on_square = rotate(pose.q.conjugate(), depth_m * ray - pose.p);
      const bool hit = std::max(std::fabs(on_square.x()), std::fabs(on_square.y())) < 0.5;
      EXPECT_NEAR(truth[map.index(column, row)], hit ? 60 * 0.25 / depth_m : 0, 1e-5);
      hits += hit ? 1 : 0;
    }
  }
  EXPECT_GT(hits, 300);
}

// A square of 40 x 40 pixels at disparity 8 on sky.
struct Case {
  DisparityMap map = empty_map(60, 60, 100);
  std::vector<double> truth = std::vector<double>(3600, 0.0);
  Case() {
    for (int row = 10; row < 50; ++row) {
      for (int column = 10; column < 50; ++column) truth[map.index(column, row)] = 8;
    }
  }
  void measure(int column, int row, double disparity_px) {
    map.codes.codes[map.index(column, row)] = static_cast<std::uint16_t>(std::lround(16 * disparity_px));
  }
};

TEST(DisparityErrors, CountsAreByPlace) {
  VERIFIES("LASSO-STE-010~1");
  Case c;
  for (int row = 10; row < 30; ++row) {
    for (int column = 10; column < 50; ++column) c.measure(column, row, 8.25);  // half of the target
  }
  c.measure(30, 20, 10);                            // inside
  c.measure(11, 20, 5);                             // within 5 pixels of the edge
  for (int i = 0; i < 25; ++i) c.measure(2, i, 8);  // sky
  const DisparityErrors errors = disparity_errors(c.map, c.truth);
  EXPECT_EQ(errors.target, 1600U);
  EXPECT_EQ(errors.valid, 825U);
  EXPECT_DOUBLE_EQ(errors.valid_share, 0.5);
  EXPECT_DOUBLE_EQ(errors.sky_share, 25 / 825.0);
  EXPECT_DOUBLE_EQ(errors.bias_px, 0.25);
  EXPECT_DOUBLE_EQ(errors.wrong_interior, 1 / (30.0 * 15));  // rows 15 to 29, columns 15 to 44
  EXPECT_DOUBLE_EQ(errors.wrong_edge, 1 / (800.0 - 450));
}

TEST(DisparityErrors, SpreadIsThatOfTheMiddleHalf) {
  VERIFIES("LASSO-STE-010~1");
  Case c;
  for (int row = 10; row < 50; ++row) {
    for (int column = 10; column < 50; ++column) c.measure(column, row, 8 + ((row + column) % 2 == 0 ? 0.5 : -0.5));
  }
  EXPECT_NEAR(disparity_errors(c.map, c.truth).sigma_px, 1.4826 * 1.0, 1e-9) << "half are 1 px off the median, which is one of the two";
  EXPECT_EQ(disparity_errors(empty_map(60, 60, 100), c.truth).valid_share, 0);
}

}  // namespace
}  // namespace lasso::mdat
