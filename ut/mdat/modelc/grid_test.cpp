#include "mdat/modelc/grid.hpp"

#include <gtest/gtest.h>

#include "mdat/modelc/repair.hpp"
#include "ut/mdat/modelc/meshes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

Surface surface_of(const Vec3d& low, const Vec3d& high) {
  CompileReport report;
  return repair_mesh(shapes::box(low, high), 0, report);
}

TEST(Grid, CoversTheBoxAndItsMarginWithWholeBricks) {
  VERIFIES("LASSO-MDL-007~1");
  const Surface surface = surface_of({-0.3, 0.1, 0}, {0.4, 0.2, 0.05});
  for (const double margin : {0.0, 0.02, 0.4}) {
    const LengthScale scale(image_reach_m(surface, margin, 0.01));
    const Grid grid = make_grid(surface, margin, 0.01, scale);
    const double least = std::max(margin, 0.02) - 1e-7;
    const Vec3d end = grid.brick_corner(grid.brick_count() - 1) + Vec3d::Constant(grid.brick_m());
    EXPECT_GE((surface.low - grid.origin).minCoeff(), least);
    EXPECT_GE((end - surface.high).minCoeff(), least);
    EXPECT_LT((end - surface.high).maxCoeff(), least + grid.brick_m());
    EXPECT_EQ(grid.origin.x(), scale.round(grid.origin.x()));
    EXPECT_LT(std::ldexp(end.cwiseAbs().maxCoeff(), scale.bits()), 0x1p30);
    EXPECT_LE(std::max(end.cwiseAbs().maxCoeff(), grid.origin.cwiseAbs().maxCoeff()), image_reach_m(surface, margin, 0.01));
  }
}

TEST(Grid, PlacesAndIndicesAgree) {
  VERIFIES("LASSO-MDL-007~1");
  Grid grid;
  grid.bricks = {3, 4, 5};
  grid.cell_m = 0.5;
  for (std::uint32_t i = 0; i < grid.brick_count(); ++i) {
    const auto place = grid.brick_place(i);
    EXPECT_EQ(grid.brick_index(place[0], place[1], place[2]), i);
  }
  EXPECT_EQ(grid.brick_center(3 * 4 + 3 + 1), Vec3d(6, 6, 6));
}

TEST(Grid, RefusesTooManyBricks) {
  VERIFIES("LASSO-MDL-008~1");
  const Surface surface = surface_of({0, 0, 0}, {1, 1, 1});
  const LengthScale scale(2);
  const auto refusal = [&](double cell_m) -> std::string {
    try {
      make_grid(surface, 0.1, cell_m, scale);
    } catch (const CompileError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refusal(1e-4).find("along axis 0; the limit is 1023"), std::string::npos) << refusal(1e-4);
  EXPECT_NE(refusal(1e-3).find("the grid's bricks alone need "), std::string::npos) << "3.4 million bricks";
  EXPECT_NE(refusal(1e-3).find("the limit of an image is "), std::string::npos) << refusal(1e-3);
  EXPECT_NO_THROW(make_grid(surface, 0.1, 5e-3, scale));
}

}  // namespace
}  // namespace lasso::mdat
