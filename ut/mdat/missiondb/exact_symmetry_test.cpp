#include "mdat/missiondb/exact_symmetry.hpp"

#include <numbers>

#include "mdat/missiondb/solid.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/mdat/modelc/meshes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

Mesh prism(int sides) { return make_revolve({{-1, 0}, {-1, 0.8}, {1, 0.8}, {1, 0}}, {0.1, kTurn, sides}); }

Mesh elsewhere(Mesh mesh) {
  shapes::move(mesh, shapes::generic_turn(), {3, -2, 7});
  return mesh;
}

// Orders of the rotation groups: of a cuboid, a square bar, a cube, a prism, a pyramid and an icosahedron.
TEST(ExactSymmetry, FindsTheRotationGroupsOfSolids) {
  VERIFIES("LASSO-GND-112~1");
  EXPECT_EQ(exact_symmetry(elsewhere(make_box({1, 2, 3}))).turns.size(), 4u);
  EXPECT_EQ(exact_symmetry(elsewhere(make_box({1, 2, 2}))).turns.size(), 8u);
  EXPECT_EQ(exact_symmetry(elsewhere(make_box({2, 2, 2}))).turns.size(), 24u);
  EXPECT_EQ(exact_symmetry(elsewhere(prism(7))).turns.size(), 14u);
  EXPECT_EQ(exact_symmetry(elsewhere(make_rod({0, 0, 0}, {2, 0, 0}, 1, 0, 5))).turns.size(), 5u);
  EXPECT_EQ(exact_symmetry(elsewhere(make_rock({{2, 2, 2}, 0, 0, 0}))).turns.size(), 60u);
  EXPECT_TRUE(exact_symmetry(elsewhere(make_rock({{2, 1.5, 1}, 0.2, 3, 2}))).none());
}

TEST(ExactSymmetry, RoundBodiesHaveAnAxisAndSpheresAny) {
  VERIFIES("LASSO-GND-112~1");
  const Eigen::Vector3d axis = shapes::generic_turn() * Eigen::Vector3d::UnitX();
  const ExactSymmetry cylinder = exact_symmetry(elsewhere(prism(48)));
  ASSERT_TRUE(cylinder.axis.has_value());
  EXPECT_LT(cylinder.axis->cross(axis).norm(), 1e-6);
  EXPECT_EQ(cylinder.turns.size(), 2u);  // end for end
  EXPECT_LT((cylinder.turns[1] * axis + axis).norm(), 1e-6);
  const ExactSymmetry cone = exact_symmetry(elsewhere(make_rod({0, 0, 0}, {2, 0, 0}, 1, 0, 48)));
  EXPECT_TRUE(cone.axis.has_value());
  EXPECT_EQ(cone.turns.size(), 1u);
  EXPECT_TRUE(exact_symmetry(elsewhere(make_rock({{2, 2, 2}, 0, 0, 3}))).sphere);
}

TEST(ExactSymmetry, ASmallPartBreaksIt) {
  VERIFIES("LASSO-GND-112~1");
  Mesh mesh = make_box({1, 2, 2});
  Mesh part = make_box({0.02, 0.02, 0.02});
  shapes::move(part, Eigen::Quaterniond::Identity(), {0.5, 0, 0});
  append(mesh, part);
  EXPECT_EQ(exact_symmetry(mesh).turns.size(), 4u);  // on the axis: no more end for end
  shapes::move(part, Eigen::Quaterniond::Identity(), {0, 0.3, 0});
  append(mesh, part);
  EXPECT_TRUE(exact_symmetry(mesh).none());
}

TEST(ExactSymmetry, IsSaidInWords) {
  VERIFIES("LASSO-GND-112~1");
  EXPECT_EQ(symmetry_text(exact_symmetry(make_rod({0, 0, 0}, {2, 0, 0}, 1, 0, 4))), "3 turns, the least by 90 deg about (1, 0, 0)");
  EXPECT_EQ(symmetry_text(exact_symmetry(make_rod({0, 0, 0}, {0, 0, 2}, 1, 0, 40))), "any turn about (0, 0, 1)");
  EXPECT_EQ(symmetry_text(exact_symmetry(prism(40))), "any turn about (1, 0, 0), and end for end");
  EXPECT_EQ(symmetry_text(exact_symmetry(make_rock({{2, 1.5, 1}, 0.2, 3, 1}))), "none");
}

}  // namespace
}  // namespace lasso::mdat
