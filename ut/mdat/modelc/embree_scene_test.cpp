#include "mdat/modelc/embree_scene.hpp"

#include <gtest/gtest.h>

#include "mdat/modelc/repair.hpp"
#include "ut/mdat/modelc/meshes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(EmbreeScene, RaysEscapeWhereNothingIsInTheWay) {
  VERIFIES("LASSO-MDL-011~2");
  CompileReport report;
  const Surface surface = repair_mesh(shapes::box({-1, -1, -1}, {1, 1, 1}), 0, report);
  EmbreeScene scene;
  scene.add_triangles(surface);
  scene.commit();
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d u = shapes::random_unit(random);
    EXPECT_FALSE(scene.escapes(0.9 * shapes::random_vector(random), u));
    EXPECT_TRUE(scene.escapes(2 * u, u));
    EXPECT_FALSE(scene.escapes(2 * u, -u));
  }
}

}  // namespace
}  // namespace lasso::mdat
