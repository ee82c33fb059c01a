#include "fsw/mission/field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "fsw/geometry/so3.hpp"
#include "fsw/mission/mission.hpp"
#include "ut/support/box_image.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/path_numbers.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

constexpr N::Length kHere{0};
constexpr N::Unit kUp[3] = {N::Unit{0}, N::Unit{0}, N::Unit{1}};
constexpr N::Unit kDown[3] = {N::Unit{0}, N::Unit{0}, N::Unit{-1}};

class FieldTest : public ::testing::Test {
 protected:
  FieldTest() { EXPECT_EQ(load_image(Bytes(image_.data(), image_.size), *mission_).status, Status::kOk); }

  FieldRay<N> ray(const Vec3& m, const Vec3& u) const {
    FieldRay<N> r;
    for (int i = 0; i < 3; ++i) {
      r.m[i] = N::to_length(m[i]);
      r.u[i] = N::to<N::Unit>(u[i]);
    }
    set_cells(mission_->field, r);
    return r;
  }
  // A ray from a random place around the box towards a random place in it.
  void draw(Vec3& origin, Vec3& u) {
    origin = 3 * Vec3(random_.uniform(-1, 1), random_.uniform(-1, 1), random_.uniform(0.2, 1));
    const Vec3 aim =
        model_.center + Vec3(random_.uniform(-1, 1), random_.uniform(-1, 1), random_.uniform(-1, 1)).cwiseProduct(1.2 * model_.half);
    u = (aim - origin).normalized();
  }

  // The box as sheets without thickness: its faces are seen from both sides.
  Field<N> two_sided() {
    sheets_.assign(mission_->field.elements, mission_->field.elements + mission_->field.element_count);
    for (Element<N>& e : sheets_) e.flags = kElementTwoSided;
    Field<N> field = mission_->field;
    field.elements = sheets_.data();
    return field;
  }

  FieldHit<N> walk(const FieldRay<N>& ray, double from_m, double to_m) const { return walk(mission_->field, ray, from_m, to_m); }
  static FieldHit<N> walk(const Field<N>& field, const FieldRay<N>& ray, double from_m, double to_m) {
    return walk_field(field, ray, N::to_length(from_m), N::to_length(to_m));
  }

  // How far off the place of a hit at p may be: by rounding of what it is computed of, the farther the more the ray grazes the face.
  double place_error_m(const Vec3& p, const Vec3& u) const {
    int axis = 0;
    (void)((p - model_.center).cwiseAbs() - model_.half).cwiseAbs().minCoeff(&axis);
    return 16 * test::rounding_of<N::Length>(1) / std::abs(u[axis]);
  }

  std::vector<Element<N>> sheets_;
  test::BoxModel model_;
  test::TestImage image_ = test::make_box_image(preset_parameters(), model_);
  std::unique_ptr<Mission> mission_ = std::make_unique<Mission>();
  test::Generator random_{2005};
};

// The square of 2 m about the origin, which faces along z.
Element<N> square(std::uint32_t flags) {
  Element<N> e{};
  e.n[2] = N::Unit{1};
  e.flags = flags;
  for (int i = 0; i < 4; ++i) {
    e.side[i / 2][i] = i % 2 == 0 ? N::Unit{1} : N::Unit{-1};
    e.side_offset[i] = N::Length{-1};
  }
  return e;
}

// Does a ray along z from 2 m before (side 1) or behind the square hit it with t in [low, high)? It does at t = 2.
bool hits_square(std::uint32_t flags, int side, double low, double high) {
  FieldRay<N> ray{};
  ray.m[2] = N::to_length(2 * side);
  ray.u[2] = N::to<N::Unit>(-side);
  typename N::Length t{};
  const bool hit = hit_element<N>(square(flags), ray, N::to_length(low), N::to_length(high), t);
  return hit && t == N::Length{2};
}

// Each condition of the window and of the face decides by itself: they are joined without branches, where make mcdc does not see them.
TEST(HitElement, CountsInItsWindowAndOnItsFacesAlone) {
  VERIFIES("LASSO-IMG-007~2");
  for (const int side : {1, -1}) {
    for (const std::uint32_t flags : {0U, kElementTwoSided}) {
      const bool faces = side == 1 || flags == kElementTwoSided;
      EXPECT_EQ(hits_square(flags, side, 1, 3), faces) << side << ' ' << flags;
      EXPECT_EQ(hits_square(flags, side, 2, 3), faces) << side << ' ' << flags;
      EXPECT_FALSE(hits_square(flags, side, 1, 2)) << side << ' ' << flags;
      EXPECT_FALSE(hits_square(flags, side, 2.5, 3)) << side << ' ' << flags;
      EXPECT_FALSE(hits_square(flags, side, 3, 1)) << "no window, " << side << ' ' << flags;
    }
  }
}

TEST_F(FieldTest, WalkFindsWhatTheRayHits) {
  VERIFIES("LASSO-IMG-007~2");
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    Vec3 origin;
    Vec3 u;
    draw(origin, u);
    const double range = test::cast_box(model_, origin, u);
    const double start = range > 0 ? range + random_.uniform(-0.05, 0.05) : (model_.center - origin).norm();
    const double reach = random_.uniform(0.0501, 0.1);
    const FieldHit<N> hit = walk(ray(origin + start * u, u), -reach, reach);
    if (range < 0) continue;
    ++hits;
    ASSERT_TRUE(hit.found) << i;
    ASSERT_NEAR(N::to_double(hit.t), range - start, place_error_m(origin + range * u, u)) << i;
  }
  EXPECT_GT(hits, 5000);
}

TEST_F(FieldTest, WalksShorterThanACellSeeBothEnds) {
  VERIFIES("LASSO-IMG-007~2");
  for (int i = 0; i < 5000; ++i) {
    Vec3 origin;
    Vec3 u;
    draw(origin, u);
    const double range = test::cast_box(model_, origin, u);
    if (range < 0) continue;
    const double offset = random_.uniform(-0.004, 0.004);  // a fifth of a cell
    const FieldHit<N> hit = walk(ray(origin + (range + offset) * u, u), -0.0041, 0.0041);
    ASSERT_TRUE(hit.found) << i;
    ASSERT_NEAR(N::to_double(hit.t), -offset, place_error_m(origin + range * u, u)) << i;
  }
}

TEST_F(FieldTest, WalkReportsNothingWhereNothingIs) {
  VERIFIES("LASSO-IMG-007~2");
  int misses = 0;
  for (int i = 0; i < 20000; ++i) {
    Vec3 origin;
    Vec3 u;
    draw(origin, u);
    if (test::cast_box(model_, origin, u) >= 0) continue;
    ++misses;
    ASSERT_FALSE(walk(ray(origin + (model_.center - origin).norm() * u, u), -0.6, 0.6).found) << i;
  }
  EXPECT_GT(misses, 500);
}

TEST_F(FieldTest, BackFacesDoNotCount) {
  VERIFIES("LASSO-IMG-007~2");
  const Vec3 u = Vec3(0.2, -0.1, 1).normalized();
  // From inside the box outwards: only back faces lie ahead.
  EXPECT_FALSE(walk(ray(model_.center, u), 0, 0.5).found);
}

TEST_F(FieldTest, FacesOfSheetsCountFromBothSides) {
  VERIFIES("LASSO-IMG-007~2");
  const Field<N> field = two_sided();
  for (int i = 0; i < 5000; ++i) {
    const Vec3 u = Vec3(random_.uniform(-1, 1), random_.uniform(-1, 1), random_.uniform(-1, 1)).normalized();
    const double way_out = model_.half.cwiseQuotient(u.cwiseAbs()).minCoeff();  // from the middle
    const FieldHit<N> out = walk(field, ray(model_.center, u), 0, 0.5);
    ASSERT_TRUE(out.found);
    ASSERT_NEAR(N::to_double(out.t), way_out, place_error_m(model_.center + way_out * u, u));
    const FieldHit<N> in = walk(field, ray(model_.center - u, u), 0, 2);  // still the first face
    ASSERT_NEAR(N::to_double(in.t), 1 - way_out, place_error_m(model_.center + way_out * u, u));
  }
}

TEST_F(FieldTest, SamplesSeeHalfACellToEitherSide) {
  VERIFIES("LASSO-IMG-007~2");
  const Vec3 u(0, 0, 1);
  const Vec3 face = model_.center - Vec3(0, 0, model_.half[2]);
  const double half = static_cast<double>(mission_->field.cell) / 2;
  N::Length next = kHere;
  for (const double offset : {-0.99, -0.5, 0.0, 0.5, 0.99}) {
    const FieldRay<N> r = ray(face + Vec3(0.013, 0.007, offset * half), u);
    EXPECT_TRUE(sample_field(mission_->field, r, kHere, next).found) << offset;
  }
  EXPECT_FALSE(sample_field(mission_->field, ray(face - Vec3(0, 0, 1.01 * half), u), kHere, next).found);
}

TEST_F(FieldTest, AWalkFromFarAwayEnds) {
  VERIFIES("LASSO-IMG-008~1");
  const FieldRay<N> r = ray(Vec3(0, 0, -1000), Vec3(0, 0, 1));
  EXPECT_FALSE(walk(r, 0, 1e6).found);                                       // 1024 samples of 20 mm do not reach the box
  EXPECT_FALSE(walk(ray(model_.center, Vec3(0, 0, 1)), -1e30, 1e30).found);  // nor from 20 km before it
}

TEST_F(FieldTest, RaysThatStartTooManyCellsAwayAreNotLookedUp) {
  VERIFIES("LASSO-IMG-008~1");
  constexpr double kCellsPerM = 1000;
  mission_->field.cells_per_m = N::to<N::CellRate>(kCellsPerM);
  const double limit_m = static_cast<double>(N::kFarthestCell) / kCellsPerM;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      EXPECT_FALSE(near_grid(ray(1.1 * side * limit_m * Vec3::Unit(axis), Vec3(0, 0, 1))));
      EXPECT_FALSE(near_grid(ray(2 * side * limit_m * Vec3::Unit(axis), Vec3(0, 0, 1))));
      EXPECT_TRUE(near_grid(ray(0.9 * side * limit_m * Vec3::Unit(axis), Vec3(0, 0, 1))));
    }
  }
}

TEST_F(FieldTest, NearElementIsTheClosestThatFaces) {
  VERIFIES("LASSO-IMG-007~2");
  // Below the box's middle: its low z face (4) is closest and faces a ray upwards; for one downwards the opposing face is too far.
  const FieldRay<N> r = ray(model_.center - Vec3(0, 0, model_.half[2] + 0.013), Vec3(0, 0, 1));
  EXPECT_EQ(near_element(mission_->field, place_in_grid(mission_->field, r.cell_m), kUp), 4u);
  EXPECT_EQ(near_element(mission_->field, place_in_grid(mission_->field, r.cell_m), kDown), kNoElement);
  const FieldRay<N> outside = ray(Vec3(9, 9, 9), Vec3(0, 0, 1));
  EXPECT_EQ(near_element(mission_->field, place_in_grid(mission_->field, outside.cell_m), kUp), kNoElement);
}

TEST_F(FieldTest, NearElementOfASheetIsTheClosestOnEitherSide) {
  VERIFIES("LASSO-IMG-007~2");
  const Field<N> field = two_sided();
  const FieldRay<N> r = ray(model_.center - Vec3(0, 0, model_.half[2] + 0.013), Vec3(0, 0, 1));
  for (const N::Unit* direction : {kUp, kDown}) EXPECT_EQ(near_element(field, place_in_grid(field, r.cell_m), direction), 4u);
}

TEST_F(FieldTest, NothingIsNearFarFromTheSurface) {
  VERIFIES("LASSO-IMG-007~2");
  N::Cells corner[3];  // the grid's last cell, far beyond the near band of 0.1 m
  for (int i = 0; i < 3; ++i) corner[i] = N::to<N::Cells>(mission_->field.cells[i] - 1.5);
  const GridPlace<N> place = place_in_grid(mission_->field, corner);
  EXPECT_TRUE(place.inside);
  EXPECT_EQ(near_element(mission_->field, place, kUp), kNoElement);
}

TEST_F(FieldTest, PlacesOutsideTheGridAreItsBorder) {
  VERIFIES("LASSO-IMG-007~2");
  const Field<N>& field = mission_->field;
  const N::Cells low[3] = {N::Cells{-5}, -N::kFarthestCell, N::Cells{-1}};
  const GridPlace<N> first = place_in_grid(field, low);
  EXPECT_FALSE(first.inside);
  EXPECT_EQ(first.brick, 0u);
  const N::Cells high[3] = {N::kFarthestCell, N::kFarthestCell, N::kFarthestCell};
  EXPECT_EQ(place_in_grid(field, high).brick, field.bricks[0] * field.bricks[1] * field.bricks[2] - 1);
}

TEST_F(FieldTest, CurvedElementsTurnTheirNormal) {
  VERIFIES("LASSO-IMG-007~2");
  // A cylinder of radius 0.5 along y: n(p) = n + G (p - c), G = I/r across the axis.
  Element<N> e = mission_->field.elements[5];
  e.curvature = 1;
  Curvature<N> curved[2] = {};
  curved[1].n[2] = N::Unit{1};
  curved[1].g[0] = N::Gradient{2};  // dn_x/dx
  Field<N> field = mission_->field;
  field.curvatures = curved;
  const auto p = test::path_vector<N::Length>(Vec3(0.1, 0.3, 0.5));
  N::Unit n[3];
  surface_normal(field, e, p.data(), n);
  EXPECT_NEAR(static_cast<double>(n[0]), 0.2, 2 * test::rounding_of<N::Length>(0.1));  // as exact as the place
  EXPECT_TRUE(test::is_path_number(n[1], 0));
  EXPECT_TRUE(test::is_path_number(n[2], 1));
}

// Nobody has to make such a surface; no number may wrap where somebody has.
TEST_F(FieldTest, ANormalIsCutToWhatItsTypeHolds) {
  VERIFIES("LASSO-IMG-007~2");
  Element<N> e = mission_->field.elements[5];
  e.curvature = 1;
  Curvature<N> curved[2] = {};
  curved[1].n[2] = N::Unit{1};
  curved[1].g[8] = N::Gradient{10};
  Field<N> field = mission_->field;
  field.curvatures = curved;
  for (const double side : {-1.0, 1.0}) {
    const auto p = test::path_vector<N::Length>(Vec3(0, 0, side * 0.5 - 0.1));
    N::Unit n[3];
    surface_normal(field, e, p.data(), n);
    EXPECT_TRUE(test::is_path_number(n[2], static_cast<double>(N::to<N::Unit>(side * 5)))) << side;
  }
}

}  // namespace
}  // namespace lasso
