#include "mdat/modelc/elements.hpp"

#include <gtest/gtest.h>

#include "cfg/capacities.hpp"
#include "mdat/modelc/repair.hpp"
#include "ut/mdat/modelc/meshes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

struct Made {
  std::vector<Polygon> polygons;
  ElementSet set;
  CompileReport report;
};

Made elements_of(const Mesh& mesh, const LengthScale& scale) {
  Made made;
  const Surface surface = repair_mesh(mesh, 0, made.report);
  made.polygons = make_polygons(surface, edge_uses(surface), smooth_normals(surface, 0.6)).list;
  made.set = make_elements(made.polygons, scale, surface.extent, made.report);
  return made;
}

TEST(LengthScale, IsTheFinestThatHoldsTwiceTheReach) {
  VERIFIES("LASSO-MDL-013~2");
  for (const double reach : {0.4, 0.5001, 1.0, 1.3, 700.0, 4e6}) {
    const LengthScale scale(reach);
    EXPECT_LT(std::ldexp(2 * reach, scale.bits()), 0x1p31);
    if (scale.bits() < 30) {
      EXPECT_GE(std::ldexp(2 * reach, scale.bits() + 1), 0x1p31);
    }
    EXPECT_NEAR(scale.round(0.77 * reach), 0.77 * reach, scale.resolution_m() / 2);
    EXPECT_THROW(scale.to_word(5 * reach + 3), CompileError);
  }
  EXPECT_THROW(LengthScale(1e8), CompileError);
}

// Independent reading of a curvature record.
Vec3d normal_at(const std::vector<std::uint32_t>& words, std::uint32_t record, const Vec3d& p, const LengthScale& scale) {
  const auto word = [&](std::size_t i) { return static_cast<double>(static_cast<std::int32_t>(words[record * kCurvatureWords + i])); };
  Vec3d n;
  for (std::size_t row = 0; row < 3; ++row) {
    double value = std::ldexp(word(row), -30);
    for (std::size_t column = 0; column < 3; ++column) {
      const double offset = p[static_cast<int>(column)] - word(3 + column) * scale.resolution_m();
      value += std::ldexp(word(6 + 3 * column + row), -16) * offset;
    }
    n[static_cast<int>(row)] = value;
  }
  return n;
}

TEST(Elements, CurvatureGivesTheCornerNormalsOfTriangles) {
  VERIFIES("LASSO-MDL-012~2");
  const LengthScale scale(1.0);
  Mesh mesh = shapes::sphere(0.5, 10, 14);
  Random random(4);
  for (Vec3d& v : mesh.vertices) v *= 1 + 0.02 * random.uniform();  // no quad stays planar
  shapes::move(mesh, shapes::generic_turn(), {0.1, 0.2, -0.1});
  const Made made = elements_of(mesh, scale);
  EXPECT_EQ(made.report.curved_elements, made.polygons.size());
  for (std::size_t i = 0; i < made.polygons.size(); ++i) {
    ASSERT_EQ(made.polygons[i].sides, 3);
    const Vec3d beside = 0.01 * made.polygons[i].normal;  // off the plane nothing changes
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d n = normal_at(made.set.curvature_words, made.set.list[i].curvature, made.polygons[i].corners[k] + beside, scale);
      EXPECT_LT((n - made.polygons[i].corner_normals[k]).norm(), 1e-5);
    }
  }
}

TEST(Elements, CurvatureOfCylinderFacetsIsRadialAlongTheFacet) {
  VERIFIES("LASSO-MDL-012~2");
  const LengthScale scale(1.0);
  const Made made = elements_of(shapes::cylinder(0.3, 0.5, 36), scale);
  EXPECT_EQ(made.report.curved_elements, 36u);
  for (std::size_t i = 0; i < made.polygons.size(); ++i) {
    const Polygon& p = made.polygons[i];
    if (std::abs(p.normal.z()) > 0.5) {
      EXPECT_EQ(made.set.list[i].curvature, 0u);
      continue;
    }
    const Vec3d at = 0.3 * p.corners[0] + 0.2 * p.corners[1] + 0.4 * p.corners[2] + 0.1 * p.corners[3];
    const Vec3d truth = Vec3d(at.x(), at.y(), 0).normalized();
    EXPECT_LT((normal_at(made.set.curvature_words, made.set.list[i].curvature, at, scale).normalized() - truth).norm(), 1e-3);
  }
}

TEST(Elements, FlatModelsHaveTheZeroRecordOnly) {
  VERIFIES("LASSO-MDL-012~2");
  const Made made = elements_of(shapes::box({0, 0, 0}, {0.4, 0.5, 0.6}), LengthScale(1.0));
  EXPECT_EQ(made.set.curvature_words, std::vector<std::uint32_t>(kCurvatureWords, 0));
  EXPECT_EQ(made.report.quads, 6u);
}

// Both faces of a roof differ from the mean of their normals by half of its bend.
TEST(Elements, AreFlatWhereTheirCornerNormalsHardlyDiffer) {
  VERIFIES("LASSO-MDL-012~2");
  for (const double half_bend : {0.95e-4, 1.05e-4}) {
    Mesh roof;
    roof.vertices = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, -half_bend}, {0.5, -1, -half_bend}};
    roof.triangles = {{0, 1, 2}, {1, 0, 3}};
    EXPECT_EQ(elements_of(roof, LengthScale(1.0)).report.curved_elements, half_bend > 1e-4 ? 2u : 0u);
  }
}

TEST(Elements, RegionsExceedTheirPolygonsByLessThanTheRelaxationAtRightAngles) {
  VERIFIES("LASSO-MDL-005~2");
  Mesh mesh = shapes::box({0, 0, 0}, {0.4, 0.5, 0.6});
  shapes::move(mesh, shapes::generic_turn(), {0.1, -0.2, 0.05});
  const Made made = elements_of(mesh, LengthScale(1.0));
  for (const Element& e : made.set.list) {
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_GT((e.outline[i] - e.corners[i]).norm(), 1e-7);
      EXPECT_LT((e.outline[i] - e.corners[i]).norm(), 3e-7);
      for (std::size_t k = 0; k < 4; ++k) EXPECT_GE(e.m[k].dot(e.corners[i]), e.c[k]);
    }
  }
}

// A region's corner lies beyond the polygon's by the relaxation over the sine of half the angle: needles reach far.
TEST(Elements, RegionsExceedTheirPolygonsTheMoreTheSharperACornerIs) {
  VERIFIES("LASSO-MDL-005~2");
  Mesh mesh = shapes::soup(200, 1, 11);
  for (const double width : {0.3, 0.06, 0.02, 2e-3, 2e-4}) {
    const auto first = shapes::u32(mesh.vertices.size());
    for (const Vec3d& corner : {Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(1, width, 0)}) mesh.vertices.push_back(corner);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  const Made made = elements_of(mesh, LengthScale(2.0));
  CompileReport report;
  const double extent = repair_mesh(mesh, 0, report).extent;
  int sharp = 0;
  for (const Element& e : made.set.list) {
    const auto sides = static_cast<std::size_t>(e.sides);
    for (std::size_t i = 0; i < sides; ++i) {
      const Vec3d& at = e.corners[i];
      const Vec3d a = (e.corners[(i + 1) % sides] - at).normalized(), b = (e.corners[(i + sides - 1) % sides] - at).normalized();
      const double half = std::atan2(a.cross(b).norm(), a.dot(b)) / 2;
      const bool is_sharp = 2 * half < 3 * std::numbers::pi / 180;
      sharp += is_sharp ? 1 : 0;
      EXPECT_LT((e.outline[i] - at).norm(), extent * (is_sharp ? 2.5e-7 / std::sin(half) : 1e-5)) << half;
    }
  }
  EXPECT_GE(sharp, 3);
}

TEST(Elements, RefuseMoreThanTheFlightComponentHolds) {
  VERIFIES("LASSO-MDL-008~1");
  const std::vector<Polygon> many(kMaxElements + 1);
  CompileReport report;
  try {
    make_elements(many, LengthScale(1.0), 1, report);
    FAIL();
  } catch (const CompileError& error) {
    EXPECT_EQ(std::string(error.what()).find("the model has 262145 elements; the limit is 262144"), 0U) << error.what();
  }
}

TEST(Elements, ClosestPointBeatsADenseSampleOfThePolygon) {
  VERIFIES("LASSO-MDL-004~1");
  const Made made = elements_of(shapes::soup(30, 0.8, 9), LengthScale(1.0));
  Random random(10);
  for (const Element& e : made.set.list) {
    const Vec3d p = 0.5 * shapes::random_vector(random);
    const double distance = (closest_point(e, p) - p).norm();
    double sampled = 10;
    for (int i = 0; i <= 200; ++i) {
      for (int k = 0; i + k <= 200; ++k) {
        const Vec3d q = e.corners[0] + i / 200.0 * (e.corners[1] - e.corners[0]) + k / 200.0 * (e.corners[2] - e.corners[0]);
        sampled = std::min(sampled, (q - p).norm());
      }
    }
    EXPECT_LE(distance, sampled + 1e-8);
    EXPECT_GE(distance, sampled - 3e-3);
  }
}

}  // namespace
}  // namespace lasso::mdat
