#include "mdat/render/model_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ut/mdat/render/shapes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(ModelSurface, IsSmoothWhereFacetsMeetAtLittle) {
  VERIFIES("LASSO-PIC-008~1");
  const ModelSurface surface = surface_of(ball(1, 3));
  double worst_smooth = 0, worst_facet = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 direction = exp_so3(Vec3(0.02 * i, 0.7 * i, -0.3)) * Vec3(0.3, 0.5, 0.8).normalized();
    SurfacePoint point;
    ASSERT_TRUE(surface.find(-3 * direction, direction, point));
    worst_smooth = std::max(worst_smooth, (point.smooth_normal + direction).norm());
    worst_facet = std::max(worst_facet, (point.facet_normal + direction).norm());
    EXPECT_NEAR(point.range_m, 2, 0.02);
    EXPECT_LT((point.place_m + direction).norm(), 0.02);
  }
  EXPECT_LT(worst_smooth, 0.02);
  EXPECT_GT(worst_facet, 0.05);
}

TEST(ModelSurface, BodiesStandWhereTheyAreAndKeepTheirOwnPlaces) {
  VERIFIES("LASSO-PIC-016~1");
  const Mesh box = make_box({1, 2, 3});
  const std::vector<std::uint32_t> parts(box.triangles.size(), 0), others(box.triangles.size(), 4);
  const Pose T_target_other{exp_so3(Vec3(0.3, -0.8, 0.5)), Vec3(4, 1, -2)};
  const ModelSurface surface({{box, parts, {}, 0}, {box, others, T_target_other, 7}}, 0.5);
  for (const Vec3& aim : {Vec3(0.5, 0.3, -0.4), Vec3(0.5, -0.8, 1.2)}) {  // on the face x = 0.5
    const Vec3 place = rotate(T_target_other.q, aim) + T_target_other.p, normal = rotate(T_target_other.q, Vec3::UnitX());
    const Vec3 way = (-normal + 0.1 * rotate(T_target_other.q, Vec3(0, 1, 0.5))).normalized();
    SurfacePoint point;
    ASSERT_TRUE(surface.find(place - 0.7 * way, way, point));
    EXPECT_EQ(point.body, 1U);
    EXPECT_EQ(point.part, 4U);
    EXPECT_LT((point.place_m - place).norm(), 1e-12);
    EXPECT_LT((surface.to_body(point) - aim).norm(), 1e-12);
    EXPECT_LT((point.facet_normal - normal).norm(), 1e-12);
    EXPECT_LT((surface.turned_to_body(1, normal) - Vec3::UnitX()).norm(), 1e-12);
  }
  SurfacePoint point;
  ASSERT_TRUE(surface.find(Vec3(-5, 0.2, 0.3), Vec3::UnitX(), point));
  EXPECT_EQ(point.body, 0U);
  EXPECT_EQ(surface.to_body(point), point.place_m);
  EXPECT_DOUBLE_EQ(surface.extent_m(0), 3);
  EXPECT_DOUBLE_EQ(surface.extent_m(1), 7);
}

TEST(ModelSurface, IsAsFineBesideABodyThatIsFarAway) {
  VERIFIES("LASSO-PIC-016~1");
  const Mesh box = make_box({1, 2, 3});
  const std::vector<std::uint32_t> parts(box.triangles.size(), 0);
  const ModelSurface alone(box, parts, 0.5), both({{box, parts, {}, 0}, {box, parts, {Quat(1, 0, 0, 0), Vec3(1e9, 1e9, 1e9)}, 0}}, 0.5);
  for (int i = 0; i < 200; ++i) {
    const Vec3 from(3 * std::sin(0.3 * i), 3 * std::cos(0.7 * i), 4 * std::sin(1.1 * i + 1)),
        way = (Vec3(0.1, -0.3, 0.2) - from).normalized();
    SurfacePoint a, b;
    ASSERT_EQ(alone.find(from, way, a), both.find(from, way, b));
    EXPECT_EQ(a.place_m, b.place_m);
    EXPECT_EQ(alone.is_blocked(from, way), both.is_blocked(from, way));
  }
}

TEST(ModelSurface, KeepsEdges) {
  VERIFIES("LASSO-PIC-008~1");
  const ModelSurface surface = surface_of(make_box({1, 2, 3}));
  SurfacePoint point;
  ASSERT_TRUE(surface.find(Vec3(5, 0.99, 1.45), -Vec3::UnitX(), point));
  EXPECT_LT((point.smooth_normal - Vec3::UnitX()).norm(), 1e-12);
  EXPECT_NEAR(point.range_m, 4.5, 1e-12);
  EXPECT_FALSE(surface.find(Vec3(5, 1.01, 1.45), -Vec3::UnitX(), point));
  EXPECT_DOUBLE_EQ(surface.extent_m(), 3);
}

TEST(ModelSurface, NormalsStandTowardsTheRayWhicheverWayTheFaceIsTurned) {
  VERIFIES("LASSO-PIC-008~1");
  const ModelSurface surface = surface_of(square(2));
  for (const double side : {1.0, -1.0}) {
    SurfacePoint point;
    ASSERT_TRUE(surface.find(Vec3(0.2, 0.3, side), Vec3(0, 0, -side), point));
    EXPECT_NEAR(point.facet_normal.z(), side, 1e-12);
    EXPECT_NEAR(point.smooth_normal.z(), side, 1e-12);
  }
}

TEST(ModelSurface, KnowsPartsAndLeavesOutTrianglesWithoutArea) {
  VERIFIES("LASSO-PIC-013~1");
  Mesh mesh = square(2);
  mesh.triangles.insert(mesh.triangles.begin(), {0, 0, 1});
  const ModelSurface surface(mesh, {7, 1, 2}, 0.5);
  SurfacePoint point;
  ASSERT_TRUE(surface.find(Vec3(0.5, -0.5, 1), -Vec3::UnitZ(), point));
  EXPECT_EQ(point.part, 1U);
  ASSERT_TRUE(surface.find(Vec3(-0.5, 0.5, 1), -Vec3::UnitZ(), point));
  EXPECT_EQ(point.part, 2U);
}

TEST(ModelSurface, BlocksWhatItFinds) {
  VERIFIES("LASSO-PIC-003~1");
  const ModelSurface surface = surface_of(make_box({1, 1, 1}));
  SurfacePoint point;
  for (int i = 0; i < 500; ++i) {
    const Vec3 from(2, 1.3, -0.7), direction = exp_so3(Vec3(0.013 * i, -0.4 * i, 0.9)) * Vec3::UnitX();
    EXPECT_EQ(surface.is_blocked(from, direction), surface.find(from, direction, point)) << i;
  }
}

}  // namespace
}  // namespace lasso::mdat
