#include "mdat/run/true_target.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/common/errors.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// Two squares in the plane z = 0 that share the edge from (1, 0) to (1, 1): from x = 0 to 1, and from 1 to 3.
Mesh two_squares() {
  Mesh mesh;
  for (const double x : {0.0, 1.0, 3.0}) {
    for (const double y : {0.0, 1.0}) mesh.vertices.emplace_back(x, y, 0);
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {2, 4, 5}, {2, 5, 3}};
  return mesh;
}

Scenario no_error() {
  Scenario scenario;
  scenario.model_turned_box_m = scenario.model_gone_box_m = std::vector<double>(6, 0.0);
  scenario.model_turn_rad = {0, 0, 0};
  return scenario;
}

const std::vector<double> kSecond = {1, 0, -1, 3, 1, 1};  // the box of the second square

double area(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[t[1]] - mesh.vertices[t[0]], b = mesh.vertices[t[2]] - mesh.vertices[t[0]];
    sum += a.cross(b).norm() / 2;
  }
  return sum;
}

TEST(TrueTarget, IsTheModelWhereNothingIsSaid) {
  VERIFIES("LASSO-SIM-043~1");
  EXPECT_FALSE(has_model_error(no_error()));
  const Mesh mesh = true_target(two_squares(), no_error(), 7);
  EXPECT_EQ(mesh.triangles, two_squares().triangles);
  EXPECT_EQ(mesh.vertices, two_squares().vertices);
}

TEST(TrueTarget, ScaleIsAboutTheOrigin) {
  VERIFIES("LASSO-SIM-043~1");
  Scenario scenario = no_error();
  scenario.model_scale = 1.01;
  EXPECT_TRUE(has_model_error(scenario));
  EXPECT_NEAR(area(true_target(two_squares(), scenario, 7)), 3 * 1.01 * 1.01, 1e-12);
  EXPECT_NEAR(true_target(two_squares(), scenario, 7).vertices[4].x(), 3.03, 1e-12);
}

TEST(TrueTarget, KeptTrianglesAreThoseThatAreNotGone) {
  VERIFIES("LASSO-SIM-043~1");
  Scenario scenario = no_error();
  EXPECT_EQ(kept_triangles(two_squares(), scenario), (std::vector<std::uint32_t>{0, 1, 2, 3}));
  scenario.model_gone_box_m = {0, 0, -1, 1, 1, 1};  // the first square
  EXPECT_EQ(kept_triangles(two_squares(), scenario), (std::vector<std::uint32_t>{2, 3}));
  EXPECT_EQ(true_target(two_squares(), scenario, 7).triangles.size(), 2U);
}

TEST(TrueTarget, APartIsGone) {
  VERIFIES("LASSO-SIM-043~1");
  Scenario scenario = no_error();
  scenario.model_gone_box_m = kSecond;
  EXPECT_TRUE(has_model_error(scenario));
  EXPECT_NEAR(area(true_target(two_squares(), scenario, 7)), 1, 1e-12);
  scenario.model_gone_box_m = {-1, -1, -1, 4, 4, 4};
  EXPECT_THROW(true_target(two_squares(), scenario, 7), RunError);
}

// A quarter turn about the box's middle (2, 0.5, 0) and the y axis: x - 2 becomes -z. The first square keeps its place.
TEST(TrueTarget, APartIsTurnedAboutTheMiddleOfItsBox) {
  VERIFIES("LASSO-SIM-043~1");
  Scenario scenario = no_error();
  scenario.model_turned_box_m = kSecond;
  EXPECT_FALSE(has_model_error(scenario)) << "by nothing";
  scenario.model_turn_rad = {0, kPi / 2, 0};
  const Mesh mesh = true_target(two_squares(), scenario, 7);
  EXPECT_NEAR(area(mesh), 3, 1e-12);
  for (std::size_t i = 0; i < 4; ++i) {
    for (const std::uint32_t vertex : mesh.triangles[i]) {
      const Eigen::Vector3d& at = mesh.vertices[vertex];
      EXPECT_NEAR(i < 2 ? at.z() : at.x() - 2, 0, 1e-12) << "triangle " << i;
      EXPECT_NEAR(std::abs(at.z()), i < 2 ? 0 : 1, 1e-12);
    }
  }
  EXPECT_NEAR(mesh.vertices[mesh.triangles[2][1]].z(), -1, 1e-12) << "its far end, x = 3";
}

TEST(TrueTarget, AGoneAndATurnedPartAreThoseOfTheModel) {
  VERIFIES("LASSO-SIM-043~1");
  Scenario scenario = no_error();
  scenario.model_turned_box_m = kSecond;
  scenario.model_turn_rad = {0, 0, kPi};  // onto itself, in other triangles
  scenario.model_gone_box_m = {0, 0, -1, 1, 1, 1};
  EXPECT_NEAR(area(true_target(two_squares(), scenario, 7)), 2, 1e-12);
}

TEST(TrueTarget, VerticesAreOffAsMuchAsSaidAndTheSameBySeed) {
  VERIFIES("LASSO-SIM-043~1");
  Scenario scenario = no_error();
  scenario.model_vertex_sigma_m = 0.02;
  Mesh many;
  for (int i = 0; i < 2000; ++i) many.vertices.emplace_back(i, 2, 3);
  many.triangles = {{0, 1, 2}};
  const Mesh mesh = true_target(many, scenario, 7);
  double squares = 0;
  for (std::size_t i = 0; i < 2000; ++i) squares += (mesh.vertices[i] - many.vertices[i]).squaredNorm();
  EXPECT_NEAR(std::sqrt(squares / 6000), 0.02, 4 * 0.02 / std::sqrt(2 * 6000.0)) << "four standard errors";
  EXPECT_EQ(true_target(many, scenario, 7).vertices, mesh.vertices);
  EXPECT_NE(true_target(many, scenario, 8).vertices, mesh.vertices);
}

// As an STL file has them: three vertices a triangle.
TEST(TrueTarget, ASurfaceOfSeparateTrianglesDoesNotTear) {
  VERIFIES("LASSO-SIM-043~1");
  Scenario scenario = no_error();
  scenario.model_vertex_sigma_m = 0.02;
  const Mesh joined = two_squares();
  Mesh separate;
  for (const auto& triangle : joined.triangles) {
    const auto first = static_cast<std::uint32_t>(separate.vertices.size());
    for (const std::uint32_t vertex : triangle) separate.vertices.push_back(joined.vertices[vertex]);
    separate.triangles.push_back({first, first + 1, first + 2});
  }
  const Mesh moved = true_target(separate, scenario, 7);
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_EQ(moved.vertices[i] == moved.vertices[j], separate.vertices[i] == separate.vertices[j]) << i << j;
  }
}

}  // namespace
}  // namespace lasso::mdat
