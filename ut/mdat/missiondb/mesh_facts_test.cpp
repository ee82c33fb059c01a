#include "mdat/missiondb/mesh_facts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "ut/mdat/modelc/meshes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(MeshFacts, TheSizeIsThatOfTheBoxWhereverItLies) {
  VERIFIES("LASSO-GND-012~1");
  const MeshSize size = size_of(shapes::box({1.5, 2, -0.25}, {2.5, 2.8, 0.25}));
  EXPECT_NEAR((size.center - Eigen::Vector3d(2, 2.4, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((size.sides - Eigen::Vector3d(1, 0.8, 0.5)).norm(), 0, 1e-12);
  EXPECT_NEAR(size.radius_m, 0.5 * std::sqrt(1 + 0.64 + 0.25), 1e-12);
}

// What a laser scanner leaves: each vertex off by noise along the radius.
Mesh scanned_sphere(double radius_m, double sigma_m) {
  Mesh mesh = shapes::sphere(radius_m, 40, 80);
  Random random(7);
  for (Eigen::Vector3d& v : mesh.vertices) v += sigma_m * shapes::random_vector(random);
  return mesh;
}

TEST(MeshFacts, TellsAMeasuredSurfaceFromADrawnOne) {
  VERIFIES("LASSO-GND-043~1");
  EXPECT_EQ(surface_facts(shapes::box({0, 0, 0}, {1, 0.8, 0.5})).regular_share, 1);
  EXPECT_GT(surface_facts(shapes::sphere(0.5, 40, 80)).regular_share, 0.9) << "its facets are copies of each other";
  const SurfaceFacts facts = surface_facts(scanned_sphere(0.5, 0.002));
  EXPECT_LT(facts.regular_share, 0.1);
  EXPECT_TRUE(facts.measured());
  EXPECT_FALSE(surface_facts(shapes::soup(100, 1, 3)).measured()) << "so few triangles are no scan";
}

TEST(MeshFacts, RoughnessIsThatOfTheNoise) {
  VERIFIES("LASSO-GND-043~1");
  // Uniform in [-1, 1]: 0.58 of sigma each axis; a sixth more by the mean of some six neighbours; the median of the size is 0.67 of that.
  const double expected_m = 0.58 * 1.08 * 0.67 * 0.01;
  EXPECT_NEAR(surface_facts(scanned_sphere(0.5, 0.01)).roughness_m, expected_m, 0.4 * expected_m);
  EXPECT_NEAR(surface_facts(shapes::box({0, 0, 0}, {1, 1, 1})).area_m2, 6, 1e-12);
}

TEST(MeshFacts, APartIsAsWideAsItsSecondLargestSide) {
  VERIFIES("LASSO-GND-043~1");
  Mesh mesh = shapes::box({0, 0, 0}, {1, 0.8, 0.5});
  shapes::append(mesh, shapes::box({2, 0, 0}, {4, 0.02, 0.01}));
  std::vector<double> widths = part_widths_m(mesh);
  std::sort(widths.begin(), widths.end());
  ASSERT_EQ(widths.size(), 2U);
  EXPECT_NEAR(widths[0], 0.02, 1e-12);
  EXPECT_NEAR(widths[1], 0.8, 1e-12);
}

}  // namespace
}  // namespace lasso::mdat
