#include "mdat/render/views.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mdat/common/errors.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

constexpr int kSize = 400;
const Camera kCamera = camera_of({kSize, kSize}, 0.3, 0.3);

SeenPoint point_at(double depth_m, const Vec3& normal = -Vec3::UnitZ(), std::uint32_t part = 0) {
  return {true, depth_m, depth_m, normal, part};
}

// Nothing, but for a few pixels.
std::vector<SeenPoint> seen_at(const std::vector<std::pair<std::size_t, SeenPoint>>& points) {
  std::vector<SeenPoint> seen(kSize * kSize);
  for (const auto& [pixel, point] : points) seen[pixel] = point;
  return seen;
}

bool shows(const Picture& picture, const Pixel& colour, int from_row) {
  return std::find(picture.pixels.begin() + static_cast<std::ptrdiff_t>(from_row) * picture.width, picture.pixels.end(), colour) !=
         picture.pixels.end();
}

TEST(Views, DepthGoesFromTheNearestToTheFarthestColour) {
  VERIFIES("LASSO-PIC-008~1");
  const Picture picture = depth_view(seen_at({{5, point_at(3)}, {9, point_at(4)}, {11, point_at(3.5)}}), kCamera);
  EXPECT_GT(picture.height, kSize);                       // a legend below
  EXPECT_TRUE(shows(picture, picture.pixels[5], kSize));  // whose bar has both ends
  EXPECT_TRUE(shows(picture, picture.pixels[9], kSize));
  EXPECT_NE(picture.pixels[5], picture.pixels[11]);
  EXPECT_NE(picture.pixels[11], picture.pixels[9]);
  EXPECT_GT(depth_view(seen_at({}), kCamera).height, kSize);  // and where nothing is seen
}

TEST(Views, DepthInMillimetresIsRounded) {
  VERIFIES("LASSO-PIC-008~1");
  const std::vector<std::uint16_t> values = depth_mm({point_at(3.0004), point_at(3.0006), {}, point_at(65.535)});
  EXPECT_EQ(values, (std::vector<std::uint16_t>{3000, 3001, 0, 65535}));
}

TEST(Views, DepthThatDoesNotFitIsRefused) {
  VERIFIES("LASSO-PIC-011~1");
  try {
    static_cast<void>(depth_mm({point_at(66)}));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("66.000 m"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("--as depth "), std::string::npos) << error.what();
  }
}

TEST(Views, NormalsAreColours) {
  VERIFIES("LASSO-PIC-008~1");
  const Picture picture =
      normals_view(seen_at({{0, point_at(3, Vec3(1, 0, 0))}, {1, point_at(3, Vec3(0, -1, 0))}, {2, point_at(3)}}), kCamera);
  EXPECT_EQ(picture.pixels[0], (Pixel{255, 128, 128}));
  EXPECT_EQ(picture.pixels[1], (Pixel{128, 255, 128}));  // up is -y
  EXPECT_EQ(picture.pixels[2], (Pixel{128, 128, 255}));
}

TEST(Views, LegendNamesThePartsThatAreSeen) {
  VERIFIES("LASSO-PIC-013~1");
  const std::vector<std::string> names{"bus", "hidden wing", "dish"};
  const auto seen = seen_at({{0, point_at(3, -Vec3::UnitZ(), 0)}, {1, point_at(3, -Vec3::UnitZ(), 2)}});
  const Picture picture = parts_view(seen, kCamera, names);
  EXPECT_NE(picture.pixels[0], picture.pixels[1]);
  EXPECT_TRUE(shows(picture, picture.pixels[0], kSize));
  EXPECT_TRUE(shows(picture, picture.pixels[1], kSize));
  const Picture hidden = parts_view(seen_at({{0, point_at(3, -Vec3::UnitZ(), 1)}}), kCamera, names);
  EXPECT_FALSE(shows(picture, hidden.pixels[0], kSize));
}

TEST(Views, ManyPartsHaveColoursOfTheirOwn) {
  VERIFIES("LASSO-PIC-013~1");
  std::vector<std::pair<std::size_t, SeenPoint>> points;
  std::vector<std::string> names;
  for (std::uint32_t part = 0; part < 60; ++part) {
    points.emplace_back(part, point_at(3, -Vec3::UnitZ(), part));
    names.push_back("a part with a rather long name " + std::to_string(part));
  }
  const Picture picture = parts_view(seen_at(points), kCamera, names);
  std::vector<Pixel> colours(picture.pixels.begin(), picture.pixels.begin() + 60);
  std::sort(colours.begin(), colours.end());
  EXPECT_EQ(std::unique(colours.begin(), colours.end()), colours.end());
}

ScanMark mark_at(double column, double row, RayState state, double residual_m = 0) {
  return {kCamera.direction(column, row), state, false, residual_m};
}

TEST(Views, RaysOfAScanAreMarkedWhereTheyGo) {
  VERIFIES("LASSO-PIC-009~1");
  ScanMark aimed = mark_at(300, 100, RayState::kHit);
  aimed.aimed = true;
  const ScanMark behind{-Vec3::UnitZ(), RayState::kHit, false, 0};
  const Picture plain(kSize, kSize, {10, 20, 30});
  const Picture picture = scan_view(plain, kCamera,
                                    {mark_at(100, 50, RayState::kHit), mark_at(200, 50, RayState::kMiss), aimed,
                                     mark_at(50, 300, RayState::kInvalid), mark_at(900, 50, RayState::kHit), behind});
  std::vector<Pixel> colours;
  for (const auto& [column, row] : {std::pair{100, 50}, {200, 50}, {300, 100}, {50, 300}}) {
    colours.push_back(picture.pixels[static_cast<std::size_t>(row * kSize + column)]);
    EXPECT_NE(colours.back(), plain.pixels[0]);
    EXPECT_TRUE(shows(picture, colours.back(), kSize));
  }
  std::sort(colours.begin(), colours.end());
  EXPECT_EQ(std::unique(colours.begin(), colours.end()), colours.end());
  const auto marked =
      std::count_if(picture.pixels.begin(), picture.pixels.begin() + kSize * kSize, [&](const Pixel& p) { return p != plain.pixels[0]; });
  EXPECT_EQ(marked, 16);  // four dots of 2 by 2
}

TEST(Views, ReturnsAreColouredByTheirResiduals) {
  VERIFIES("LASSO-PIC-009~1");
  const Picture plain(kSize, kSize, {100, 100, 100});
  const Picture picture = residual_view(plain, kCamera,
                                        {mark_at(50, 50, RayState::kHit, -2e-3), mark_at(100, 50, RayState::kHit, 2e-3),
                                         mark_at(150, 50, RayState::kHit, std::numeric_limits<double>::quiet_NaN()),
                                         mark_at(200, 50, RayState::kMiss), mark_at(250, 50, RayState::kHit, 0)});
  const auto at = [&](int column) { return picture.pixels[static_cast<std::size_t>(50 * kSize + column)]; };
  EXPECT_EQ(at(50), (Pixel{18, 87, 176}));
  EXPECT_EQ(at(100), (Pixel{179, 16, 42}));
  EXPECT_EQ(at(150), (Pixel{255, 255, 255}));
  EXPECT_EQ(at(200), (Pixel{50, 50, 50}));  // a miss has none: the picture, at half its brightness
  EXPECT_EQ(at(250), (Pixel{242, 212, 61}));
}

}  // namespace
}  // namespace lasso::mdat
