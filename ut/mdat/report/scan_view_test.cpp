#include "mdat/report/scan_view.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

struct Size {
  unsigned width = 0, height = 0;
};

// As the PNG's first chunk says: big-endian, from byte 16 on.
Size size_of(const std::string& png) {
  const auto word = [&png](std::size_t place) {
    unsigned value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(png.at(place + i));
    return value;
  };
  return {word(16), word(20)};
}

// Of so many scans whose plans have these half extents.
Size picture_of(double half_x, double half_y, std::size_t scans, const std::string& title = "a scan") {
  const std::vector<Vec3> vertices = {Vec3(-half_x, -half_y, 0), Vec3(half_x, -half_y, 0), Vec3(0, half_y, 0)};
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}};
  KeptScan scan;
  scan.telemetry.p_sensor_target_m[2] = 1;
  scan.telemetry.plan_half_extents[0] = half_x;
  scan.telemetry.plan_half_extents[1] = half_y;
  Plotter plotter(testing::TempDir());
  return size_of(
      scan_view_png(plotter, *sim::make_ray_caster(vertices, triangles), std::vector<ScanPanel>(scans, {&scan, title}), true, 1));
}

TEST(ScanView, IsAsWideAsItsTarget) {
  VERIFIES("LASSO-GND-030~1");
  const Size wide = picture_of(0.3, 0.1, 1), tall = picture_of(0.1, 0.3, 1);
  const unsigned margins = 88 + 132;  // of the axis and the colours
  EXPECT_GT(wide.width - margins, 2 * (wide.height - 98)) << "98: a line and an axis";
  EXPECT_LT(tall.width - margins, tall.height);
}

TEST(ScanView, OfSeveralScansFitsAPage) {
  VERIFIES("LASSO-GND-030~1");
  const Size three = picture_of(0.1, 0.3, 3), wide = picture_of(0.3, 0.1, 3), one = picture_of(0.3, 0.1, 1);
  EXPECT_GT(three.width, three.height) << "side by side";
  EXPECT_EQ(wide.width, one.width) << "below each other";
  EXPECT_EQ(wide.height, 3 * one.height);
  for (const Size& size : {three, wide}) EXPECT_LE(size.width, 1230U);
  EXPECT_GT(picture_of(0.3, 0.1, 1, "two\\nlines").height, one.height);
}

}  // namespace
}  // namespace lasso::mdat
