#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "fsw/geometry/se3.hpp"
#include "hal_sim/ray_caster.hpp"
#include "ut/hal_sim/shapes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

using test::box_mesh;
using test::box_range;
using test::Generator;
using test::kNoHit;
using test::random_unit;
using test::ShapeMesh;

std::unique_ptr<RayCaster> caster_of(const ShapeMesh& mesh) { return make_ray_caster(mesh.vertices, mesh.triangles); }

// Range by Moeller and Trumbore in double, over all triangles.
double brute_force_range(const ShapeMesh& mesh, const Vec3& origin, const Vec3& direction) {
  double nearest = kNoHit;
  for (const auto& t : mesh.triangles) {
    const Vec3 e1 = mesh.vertices[t[1]] - mesh.vertices[t[0]];
    const Vec3 e2 = mesh.vertices[t[2]] - mesh.vertices[t[0]];
    const Vec3 p = direction.cross(e2);
    const double determinant = e1.dot(p);
    const Vec3 s = origin - mesh.vertices[t[0]];
    const Vec3 q = s.cross(e1);
    const double u = s.dot(p) / determinant;
    const double v = direction.dot(q) / determinant;
    const double range = e2.dot(q) / determinant;
    if (u >= 0 && v >= 0 && u + v <= 1 && range > 0) nearest = std::min(nearest, range);
  }
  return nearest;
}

TEST(EmbreeCaster, RangesToABoxAreExact) {
  VERIFIES("LASSO-SIM-003~1");
  const Vec3 half(0.31, 0.57, 0.83);
  const auto caster = caster_of(box_mesh(half));
  Generator generator(1);
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 origin = generator.uniform(1.2, 9) * random_unit(generator);
    const Vec3 aim(generator.uniform(-0.7, 0.7), generator.uniform(-0.7, 0.7), generator.uniform(-0.9, 0.9));
    const Vec3 direction = (aim - origin).normalized();
    const double expected = box_range(half, origin, direction);
    const RayHit hit = caster->cast(origin, direction);
    // At the silhouette single precision may decide the other way; nowhere else.
    const bool near_silhouette =
        (box_range(half * (1 - 1e-5), origin, direction) == kNoHit) != (box_range(half * (1 + 1e-5), origin, direction) == kNoHit);
    if (near_silhouette) continue;
    ASSERT_EQ(hit.hit, expected != kNoHit);
    if (!hit.hit) continue;
    ++hits;
    const Vec3 point = origin + hit.range_m * direction;
    ASSERT_NEAR((point.cwiseAbs() - half).maxCoeff(), 0, 1e-6);                  // on the box, an edge's neighbour included
    ASSERT_NEAR(hit.normal.dot(point), hit.normal.cwiseAbs().dot(half), 2e-14);  // on the plane of the triangle, exactly
    ASSERT_NEAR(hit.range_m, expected, 1e-5);
    ASSERT_LT(hit.normal.dot(direction), 0);
  }
  EXPECT_GT(hits, 5000);
}

TEST(EmbreeCaster, AgreesWithBruteForceOnRandomTriangles) {
  VERIFIES("LASSO-SIM-003~1");
  Generator generator(2);
  ShapeMesh mesh;
  for (std::uint32_t i = 0; i < 400; ++i) {
    const Vec3 center(generator.uniform(-1, 1), generator.uniform(-1, 1), generator.uniform(-1, 1));
    for (int corner = 0; corner < 3; ++corner) mesh.vertices.push_back(center + 0.2 * random_unit(generator));
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const auto caster = caster_of(mesh);
  int hits = 0, disagreements = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 origin = 5 * random_unit(generator);
    const Vec3 direction = (random_unit(generator) * generator.uniform(0, 1) - origin).normalized();
    const double expected = brute_force_range(mesh, origin, direction);
    const RayHit hit = caster->cast(origin, direction);
    const double found = hit.hit ? hit.range_m : kNoHit;
    const bool same = found == expected || std::abs(found - expected) < 1e-10;
    disagreements += same ? 0 : 1;  // a ray within single precision of an edge
    hits += hit.hit ? 1 : 0;
  }
  EXPECT_GT(hits, 2000);
  EXPECT_LE(disagreements, 5);
}

TEST(EmbreeCaster, IsBlockedWhereItHits) {
  VERIFIES("LASSO-SIM-003~1");
  const auto caster = caster_of(box_mesh({0.31, 0.57, 0.83}));
  Generator generator(4);
  int blocked = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 origin = generator.uniform(1.2, 1e4) * random_unit(generator);
    const Vec3 aim(generator.uniform(-0.9, 0.9), generator.uniform(-0.9, 0.9), generator.uniform(-0.9, 0.9));
    const Vec3 direction = (i % 3 == 0 ? -1 : 1) * (aim - origin).normalized();  // every third one leads away
    ASSERT_EQ(caster->is_blocked(origin, direction), caster->cast(origin, direction).hit) << i;
    blocked += caster->is_blocked(origin, direction) ? 1 : 0;
  }
  EXPECT_GT(blocked, 1000);
  EXPECT_LT(blocked, 3500);
}

TEST(EmbreeCaster, RangesStayExactFromAfar) {
  VERIFIES("LASSO-SIM-003~1");
  const Vec3 half(0.31, 0.57, 0.83);
  const auto caster = caster_of(box_mesh(half));
  Generator generator(3);
  for (const double distance : {30.0, 1e3, 1e5}) {
    for (int i = 0; i < 500; ++i) {
      const Vec3 origin = distance * random_unit(generator);
      const Vec3 aim(generator.uniform(-0.2, 0.2), generator.uniform(-0.4, 0.4), generator.uniform(-0.6, 0.6));
      const Vec3 direction = (aim - origin).normalized();
      const RayHit hit = caster->cast(origin, direction);
      ASSERT_TRUE(hit.hit);
      ASSERT_NEAR(hit.range_m, box_range(half, origin, direction), 2e-6 + 1e-14 * distance);
      ASSERT_NEAR(hit.normal.dot(origin + hit.range_m * direction), hit.normal.cwiseAbs().dot(half), 1e-15 * distance + 1e-14);
    }
  }
}

TEST(EmbreeCaster, NoRayLeaksThroughSharedEdgesAndVertices) {
  VERIFIES("LASSO-SIM-003~1");
  ShapeMesh sphere = test::sphere_mesh(1.0, 24);
  for (Vec3& v : sphere.vertices) v = rotate(exp_so3(Vec3(0.3, -0.7, 1.1)), v) + Vec3(0.2, 0.5, -0.1);
  const Vec3 center(0.2, 0.5, -0.1);
  const auto caster = caster_of(sphere);
  Generator generator(4);
  for (const auto& t : sphere.triangles) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3& a = sphere.vertices[t[corner]];
      const Vec3& b = sphere.vertices[t[(corner + 1) % 3]];
      const Vec3 origin = 4 * random_unit(generator);
      for (const double share : {0.0, 0.25, 0.5}) {
        const Vec3 on_edge =
            center + 0.99 * (a + share * (b - a) - center);  // within the sphere: the ray goes in, wherever it meets the surface
        ASSERT_TRUE(caster->cast(on_edge, (on_edge - center).normalized()).hit) << a.transpose() << " to " << b.transpose() << " " << share;
        ASSERT_TRUE(caster->cast(origin, (on_edge - origin).normalized()).hit);
      }
    }
  }
}

TEST(EmbreeCaster, HitsTheBackOfATriangleAndNothingBehindTheOrigin) {
  VERIFIES("LASSO-SIM-003~1");
  ShapeMesh mesh;
  mesh.quad(Vec3(-1, -1, 2), Vec3(1, -1, 2), Vec3(1, 1, 2), Vec3(-1, 1, 2));  // normal +z
  const auto caster = caster_of(mesh);
  const Vec3 direction = Vec3(0.1, -0.2, 1).normalized();
  const RayHit hit = caster->cast(Vec3(0.1, 0.05, 0), direction);
  ASSERT_TRUE(hit.hit);
  EXPECT_NEAR(hit.range_m, 2 / direction.z(), 1e-14);
  EXPECT_GT(hit.normal.z(), 0.999);
  EXPECT_LT(hit.triangle, 2u);
  EXPECT_FALSE(caster->cast(Vec3(0.1, 0.05, 0), -direction).hit);
}

TEST(EmbreeCaster, RefusesAMeshThatItCannotCastAgainst) {
  VERIFIES("LASSO-SIM-004~1");
  ShapeMesh empty;
  EXPECT_THROW(caster_of(empty), std::invalid_argument);
  ShapeMesh mesh = box_mesh(Vec3(1, 1, 1));
  mesh.triangles[5][1] = static_cast<std::uint32_t>(mesh.vertices.size());
  EXPECT_THROW(caster_of(mesh), std::invalid_argument);
  mesh = box_mesh(Vec3(1, 1, 1));
  mesh.vertices[3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(caster_of(mesh), std::invalid_argument);
  mesh = box_mesh(Vec3(1, 1, 1));
  mesh.triangles[2][1] = mesh.triangles[2][0];
  EXPECT_THROW(caster_of(mesh), std::invalid_argument);
}

}  // namespace
}  // namespace lasso::sim
