#include "mdat/render/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(Camera, ShowsTheFieldOfViewFromEdgeToEdge) {
  VERIFIES("LASSO-PIC-001~1");
  const Camera camera = camera_of(size_of(600, 0.3, 0.2), 0.3, 0.2);
  EXPECT_EQ(camera.width, 600);
  EXPECT_EQ(camera.height, static_cast<int>(std::lround(600 * std::tan(0.2) / std::tan(0.3))));
  const Vec3 left = camera.direction(-0.5, camera.center_y), right = camera.direction(camera.width - 0.5, camera.center_y);
  const double pixel = 2 * std::tan(0.3) / 600;  // rows are whole: all of the field of view is shown, and less than a pixel more
  EXPECT_LE(left.x() / left.z(), -std::tan(0.3) + 1e-12);
  EXPECT_GT(left.x() / left.z(), -std::tan(0.3) - pixel);
  EXPECT_DOUBLE_EQ(right.x() / right.z(), -left.x() / left.z());
  const Vec3 top = camera.direction(camera.center_x, -0.5);
  EXPECT_NEAR(top.y() / top.z(), -std::tan(0.2), pixel);  // y is down
  EXPECT_NEAR(left.norm(), 1, 1e-15);
}

TEST(Camera, OfAnotherShapeShowsAllOfTheFieldOfViewAndMore) {
  VERIFIES("LASSO-PIC-001~1");
  const Camera wide = camera_of({800, 200}, 0.2, 0.2), high = camera_of({200, 800}, 0.2, 0.2);
  EXPECT_NEAR(wide.focal_px, 100 / std::tan(0.2), 1e-9);
  EXPECT_DOUBLE_EQ(wide.focal_px, high.focal_px);
  EXPECT_EQ(size_of(500, 0.2, 0.3).height, 500);
  EXPECT_LT(size_of(500, 0.2, 0.3).width, 500);
}

TEST(Camera, PixelIsTheInverseOfDirection) {
  VERIFIES("LASSO-PIC-001~1");
  const Camera camera = camera_of({640, 480}, 0.4, 0.3);
  const Eigen::Vector2d at = camera.pixel(3.7 * camera.direction(123.25, 401.5));
  EXPECT_NEAR(at.x(), 123.25, 1e-9);
  EXPECT_NEAR(at.y(), 401.5, 1e-9);
}

}  // namespace
}  // namespace lasso::mdat
