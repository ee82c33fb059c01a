#include "mdat/missiondb/solid.hpp"

#include <cmath>
#include <numbers>

#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

constexpr double kPi = std::numbers::pi;

// Area of the regular polygon inscribed in a circle of radius 1, over a sweep cut in `sides`.
double unit_area(double sweep_rad, int sides) { return 0.5 * sides * std::sin(sweep_rad / sides); }

TEST(Solid, BoxIsClosedAndHasItsVolume) {
  VERIFIES("LASSO-GND-006~1");
  const Mesh box = make_box({2, 3, 5});
  EXPECT_TRUE(is_closed(box));
  EXPECT_NEAR(signed_volume(box), 30, 1e-12);
}

TEST(Solid, RodAndConeHaveTheVolumeOfTheirPrismAndPyramid) {
  VERIFIES("LASSO-GND-006~1");
  const Eigen::Vector3d from(0.3, -1, 2), to(1.5, 0.7, 0.4);
  const double length = (to - from).norm();
  const Mesh rod = make_rod(from, to, 0.2, 0.2, 17);
  EXPECT_TRUE(is_closed(rod));
  EXPECT_NEAR(signed_volume(rod), unit_area(2 * kPi, 17) * 0.04 * length, 1e-12);
  const Mesh cone = make_rod(from, to, 0.3, 0, 9);
  EXPECT_TRUE(is_closed(cone));
  EXPECT_NEAR(signed_volume(cone), unit_area(2 * kPi, 9) * 0.09 * length / 3, 1e-12);
}

TEST(Solid, RodLiesAroundItsAxis) {
  VERIFIES("LASSO-GND-006~1");
  const Eigen::Vector3d from(0.3, -1, 2), to(1.5, 0.7, 0.4);
  const Eigen::Vector3d axis = (to - from).normalized();
  const Mesh rod = make_rod(from, to, 0.2, 0.2, 12);
  for (const auto& triangle : rod.triangles) {
    for (const auto k : triangle) {
      const Eigen::Vector3d p = rod.vertices[k] - from;
      const double distance = (p - axis * axis.dot(p)).norm();
      EXPECT_TRUE(std::fabs(distance - 0.2) < 1e-12 || distance < 1e-12);
    }
  }
}

TEST(Solid, TubeWithAWallIsClosedWhicheverWayItsProfileRuns) {
  VERIFIES("LASSO-GND-006~1");
  const double expected = unit_area(2 * kPi, 40) * (1.0 - 0.81) * 2;
  const Mesh forward = make_revolve({{0, 0.9}, {0, 1}, {2, 1}, {2, 0.9}}, {0.4, 2 * kPi, 40});
  const Mesh backward = make_revolve({{2, 0.9}, {2, 1}, {0, 1}, {0, 0.9}}, {0.4, 2 * kPi, 40});
  EXPECT_TRUE(is_closed(forward));
  EXPECT_TRUE(is_closed(backward));
  EXPECT_NEAR(signed_volume(forward), expected, 1e-12);
  EXPECT_NEAR(signed_volume(backward), expected, 1e-12);
}

TEST(Solid, PartialTurnIsClosedByCapsEvenOfAConcaveProfile) {
  VERIFIES("LASSO-GND-006~1");
  // An L: 1 x 3 and 2 x 1 in (x, r), its volume by Pappus with the polygon's chord factor.
  const std::vector<Eigen::Vector2d> profile{{0, 1}, {3, 1}, {3, 2}, {1, 2}, {1, 4}, {0, 4}};
  const double moment = 0.5 * (3 * (4 - 1) + 1 * (16 - 4));  // integral of r over the area
  for (const double sweep : {0.3, 1.2, 4.0}) {
    const Mesh sector = make_revolve(profile, {-0.7, sweep, 8});
    EXPECT_TRUE(is_closed(sector)) << sweep;
    EXPECT_NEAR(signed_volume(sector), moment * 8 * std::sin(sweep / 8), 1e-12) << sweep;
  }
}

TEST(Solid, PartialTurnOnTheAxisIsClosed) {
  VERIFIES("LASSO-GND-006~1");
  const Mesh wedge = make_revolve({{0, 0}, {0, 1}, {2, 1}, {2, 0}}, {0, 1.0, 3});
  EXPECT_TRUE(is_closed(wedge));
  EXPECT_NEAR(signed_volume(wedge), 2 * unit_area(1.0, 3), 1e-12);
}

TEST(Solid, DishHasConstantThicknessAlongItsAxisAndFollowsTheParaboloid) {
  VERIFIES("LASSO-GND-006~1");
  const DishShape shape{0.65, 0.24, 0.05, 6, 48};
  const Mesh dish = make_dish(shape);
  EXPECT_TRUE(is_closed(dish));
  EXPECT_NEAR(signed_volume(dish), unit_area(2 * kPi, 48) * 0.65 * 0.65 * 0.05, 1e-12);
  for (const Eigen::Vector3d& p : dish.vertices) {
    const double depth = 0.24 * (p.y() * p.y() + p.z() * p.z()) / (0.65 * 0.65);
    EXPECT_TRUE(std::fabs(p.x() - depth) < 1e-12 || std::fabs(p.x() - depth + 0.05) < 1e-12);
  }
}

// There is no right cut of a polygon that crosses itself or is flat; it takes no longer than another.
TEST(Solid, PolygonsWithoutAnEarAreCut) {
  VERIFIES("LASSO-GND-006~1");
  EXPECT_EQ(triangulate_polygon({{0, 0}, {1, 1}, {1, 0}, {0, 1}}).size(), 2u);
  std::vector<Eigen::Vector2d> flat;
  for (int i = 0; i < 1000; ++i) flat.emplace_back(i, 0);
  EXPECT_EQ(triangulate_polygon(flat).size(), 998u);
}

TEST(Solid, AppendKeepsBothSurfaces) {
  VERIFIES("LASSO-GND-006~1");
  Mesh mesh = make_box({1, 1, 1});
  append(mesh, make_box({2, 2, 2}));
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_NEAR(signed_volume(mesh), 9, 1e-12);
}

// The volume of an ellipsoid is that of a sphere, stretched; the icosphere lies within it.
TEST(Solid, RockWithoutRoughnessIsAnEllipsoid) {
  VERIFIES("LASSO-GND-006~1");
  const Mesh mesh = make_rock({{4, 3, 2}, 0, 7, 4});
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_EQ(mesh.triangles.size(), 20u * 256u);
  EXPECT_NEAR(signed_volume(mesh), kPi / 6 * 4 * 3 * 2, 0.003 * kPi / 6 * 24);
  for (const Eigen::Vector3d& v : mesh.vertices) EXPECT_NEAR(v.cwiseQuotient(Eigen::Vector3d(2, 1.5, 1)).norm(), 1, 1e-12);
}

TEST(Solid, RockIsAsRoughAsSaidAndTheSeedsOwn) {
  VERIFIES("LASSO-GND-006~1");
  const Mesh mesh = make_rock({{2, 2, 2}, 0.3, 7, 3});
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_GT(signed_volume(mesh), 0);
  double farthest = 0;
  for (const Eigen::Vector3d& v : mesh.vertices) farthest = std::max(farthest, std::fabs(v.norm() - 1));
  EXPECT_NEAR(farthest, 0.3, 1e-12);
  EXPECT_EQ(make_rock({{2, 2, 2}, 0.3, 7, 3}).vertices, mesh.vertices);
  EXPECT_NE(make_rock({{2, 2, 2}, 0.3, 8, 3}).vertices, mesh.vertices);
}

}  // namespace
}  // namespace lasso::mdat
