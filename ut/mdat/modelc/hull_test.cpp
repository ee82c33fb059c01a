#include "mdat/modelc/hull.hpp"

#include <gtest/gtest.h>

#include "ut/mdat/modelc/meshes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

double reach(const std::vector<Vec3d>& points, const Vec3d& u) {
  double best = -1e9;
  for (const Vec3d& p : points) best = std::max(best, u.dot(p));
  return best;
}

TEST(Hull, ReachesAsFarAsTheMeshInEveryDirection) {
  VERIFIES("LASSO-MDL-015~2");
  auto meshes = shapes::property_meshes();
  meshes.emplace_back("fine sphere", shapes::sphere(0.5, 90, 120));
  Random random(51);
  for (const auto& [name, mesh] : meshes) {
    SCOPED_TRACE(name);
    const auto points = extreme_points(mesh.vertices, 1, 256);
    EXPECT_LE(points.size(), 256u);
    for (int i = 0; i < 500; ++i) {
      const Vec3d u = shapes::random_unit(random);
      const double width = reach(mesh.vertices, u) + reach(mesh.vertices, -u);
      EXPECT_LE(reach(mesh.vertices, u) - reach(points, u), 0.005 * std::max(width, 0.1));
    }
  }
}

TEST(Hull, ABoxHasItsEightCorners) {
  VERIFIES("LASSO-MDL-015~2");
  Mesh mesh = shapes::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  shapes::append(mesh, shapes::sphere(0.4, 10, 10));
  EXPECT_EQ(extreme_points(mesh.vertices, 1, 256).size(), 8u);
}

}  // namespace
}  // namespace lasso::mdat
