#include "mdat/missiondb/model_file.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mdat/missiondb/solid.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const std::filesystem::path kHubble = kSourceFolder / "cfg/models/hubble_tenth.toml";
const std::filesystem::path kProbeModel = kSourceFolder / "cfg/models/probe.toml";

double nearest_vertex(const Mesh& mesh, const Eigen::Vector3d& p) {
  double least = 1e9;
  for (const Eigen::Vector3d& v : mesh.vertices) least = std::min(least, (v - p).norm());
  return least;
}

// Largest distance from a vertex of the mesh, turned by half a turn about x, to the mesh's nearest vertex.
double half_turn_asymmetry(const Mesh& mesh) {
  double largest = 0;
  for (const Eigen::Vector3d& v : mesh.vertices) largest = std::max(largest, nearest_vertex(mesh, {v.x(), -v.y(), -v.z()}));
  return largest;
}

TEST(ModelFile, HubbleIsClosedOfTheStatedSizeAndCount) {
  VERIFIES("LASSO-GND-007~1");
  const Mesh mesh = build_model(kHubble, {});
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_GE(mesh.triangles.size(), 4000u);
  EXPECT_LE(mesh.triangles.size(), 7000u);
  double aft = 0, tube = 0;
  for (const Eigen::Vector3d& v : mesh.vertices) {
    aft = std::min(aft, v.x());
    if (std::fabs(v.x() - 0.665) < 1e-9) tube = std::max(tube, std::hypot(v.y(), v.z()));
  }
  EXPECT_NEAR(aft, -0.665, 1e-9);  // 13.3 m, a tenth, about the origin
  EXPECT_NEAR(tube, 0.154, 1e-3);  // light shield of about 3 m diameter
}

TEST(ModelFile, TellsItsSolidsInTheOrderOfTheirTriangles) {
  VERIFIES("LASSO-PIC-013~1");
  std::vector<ModelSolid> solids;
  const Mesh mesh = build_model(kHubble, {}, &solids);
  std::size_t first = 0;
  for (const ModelSolid& solid : solids) {
    if (solid.name == "trunnions") break;
    first += solid.triangles;
  }
  for (std::size_t i = first; i < first + 2 * 64; ++i) {  // two rods of 16 sides: there, and at the other side
    const Eigen::Vector3d& v = mesh.vertices[mesh.triangles[i][0]];
    EXPECT_NEAR(v.x(), -0.21, 0.0131);
    EXPECT_GT(std::fabs(v.y()), 0.199);
  }
  std::size_t all = 0;
  for (const ModelSolid& solid : solids) all += solid.triangles;
  EXPECT_EQ(all, mesh.triangles.size());
}

TEST(ModelFile, HubbleHasNoTwoFoldSymmetry) {
  VERIFIES("LASSO-GND-007~1");
  EXPECT_GT(half_turn_asymmetry(build_model(kHubble, {})), 0.05);
}

TEST(ModelFile, ArrayAngleTurnsTheArraysAboutTheirBoomAndNothingElse) {
  VERIFIES("LASSO-GND-008~1");
  const double angle_deg = 37;
  const Mesh flat = build_model(kHubble, {});
  const Mesh turned = build_model(kHubble, {{"array_angle_deg", angle_deg}});
  ASSERT_EQ(flat.vertices.size(), turned.vertices.size());
  const Eigen::Vector3d boom(0.065, 0, 0);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(angle_deg * M_PI / 180, Eigen::Vector3d::UnitY()).toRotationMatrix();
  int moved = 0;
  for (std::size_t i = 0; i < flat.vertices.size(); ++i) {
    if ((flat.vertices[i] - turned.vertices[i]).norm() < 1e-12) continue;
    ++moved;
    EXPECT_LT((boom + R * (flat.vertices[i] - boom) - turned.vertices[i]).norm(), 1e-12);
  }
  EXPECT_EQ(moved, 16);  // two boxes
}

TEST(ModelFile, DoorOpensAboutItsHinge) {
  VERIFIES("LASSO-GND-008~1");
  const auto forward_end = [](double angle_deg) {
    const Mesh mesh = build_model(kHubble, {{"door_angle_deg", angle_deg}});
    return std::max_element(mesh.vertices.begin(), mesh.vertices.end(), [](const auto& a, const auto& b) { return a.x() < b.x(); })->x();
  };
  EXPECT_GT(forward_end(90), forward_end(30) + 0.1);
  EXPECT_NEAR(forward_end(90), 0.670 + 0.162 + 0.152, 1e-3);  // hinge, then the door's far rim
}

TEST(ModelFile, ProbeIsClosedAndAsymmetric) {
  VERIFIES("LASSO-GND-007~1");
  const Mesh mesh = build_model(kProbeModel, {});
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_GT(half_turn_asymmetry(mesh), 0.1);
}

TEST(ModelFile, ParametersAreListedWithUnitAndRange) {
  VERIFIES("LASSO-GND-008~1");
  const std::vector<ModelParameter> parameters = model_parameters(kHubble);
  ASSERT_EQ(parameters.size(), 2u);
  EXPECT_EQ(parameters[0].name, "array_angle_deg");
  EXPECT_EQ(parameters[0].unit, "deg");
  EXPECT_EQ(parameters[0].minimum, -360);
  EXPECT_EQ(parameters[1].preset, 105);
}

TEST(ModelFile, RepeatTurnsCopiesAboutTheAxis) {
  VERIFIES("LASSO-GND-006~1");
  const Folder folder;
  const auto file = folder.write("m.toml",
                                 "scale = 0.5\n[[part]]\nkind = 'box'\nsize = [1, 1, 1]\nplace = [{move = [0, 4, 0]}]\n"
                                 "repeat = {count = 4, axis = [1, 0, 0], angle_deg = 90}\n");
  const Mesh mesh = build_model(file, {});
  EXPECT_NEAR(signed_volume(mesh), 4 * 0.125, 1e-12);
  EXPECT_LT(nearest_vertex(mesh, {0.25, 0.25, 2.25}), 1e-12);
  EXPECT_LT(nearest_vertex(mesh, {0.25, -0.25, -2.25}), 1e-12);
}

struct BadModel {
  const char *text, *expected;
};
class BadModels : public ::testing::TestWithParam<BadModel> {};

TEST_P(BadModels, AreRefusedWithPlaceAndReason) {
  VERIFIES("LASSO-GND-003~1 LASSO-GND-006~1");
  const Folder folder;
  const auto file = folder.write("m.toml", GetParam().text);
  const std::string message = mission_error_of([&] { static_cast<void>(build_model(file, {})); });
  EXPECT_NE(message.find(GetParam().expected), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(
    ModelFile, BadModels,
    ::testing::Values(
        BadModel{"name = 'x'\n", "at least one [[part]]"}, BadModel{"[[part]]\nkind = 'ball'\n", "m.toml:1:1: part: kind: \"ball\""},
        BadModel{"[[part]]\nkind = 'box'\nsize = [1, 1]\n", "m.toml:3:8: part: size: expected a list of 3"},
        BadModel{"[[part]]\nkind = 'box'\nsize = [1, nan, 1]\n", "m.toml:3:12: part: size: nan: not a finite number"},
        BadModel{"[[part]]\nkind = 'box'\nsize = [1, 0, 1]\n", "greater than 0"},
        BadModel{"[[part]]\nkind = 'box'\nsize = [1, 'wide', 1]\n", "or the name of a parameter"},
        BadModel{"[[part]]\nkind = 'box'\nsise = [1, 1, 1]\n", "m.toml:3:1: part: sise: unknown key; did you mean size?"},
        BadModel{"[[part]]\nkind = 'rod'\nfrom = [0,0,0]\nto = [0,0,0]\nradius = 1\n", "another point"},
        BadModel{"[[part]]\nkind = 'rod'\nfrom = [0,0,0]\nto = [1,0,0]\n", "part: radius: is missing"},
        BadModel{"[[part]]\nkind = 'revolve'\nprofile = [[0,1],[1,1]]\n", "at least 3 points"},
        BadModel{"[[part]]\nkind = 'revolve'\nprofile = [[0,1],[1,1],[2,1]]\n", "has no volume"},
        BadModel{"[[part]]\nkind = 'revolve'\nprofile = [[0,1],[1,-1],[2,1]]\n", "m.toml:3:21: part: profile: -1: out of range"},
        BadModel{"[[part]]\nkind = 'revolve'\nsides = 2\nprofile = [[0,1],[1,2],[2,1]]\n", "at most every 120 deg"},
        BadModel{"[[part]]\nkind = 'box'\nsize = [1,1,1]\nplace = [{turn = [0,0,0], angle_deg = 3}]\n", "length 0"},
        BadModel{"[[part]]\nkind = 'box'\nsize = [1,1,1]\nplace = [3]\n", "expected a step"},
        BadModel{"[[part]]\nkind = 'box'\nsize = [1,1,1]\nrepeat = {count = 2000, axis = [1,0,0], angle_deg = 1}\n", "2000: out of range"},
        BadModel{"[parameters.a]\npreset = 1\n", "parameters.a.unit: is missing"}, BadModel{"scale = 'x'\n", "scale: 'x': wrong type"},
        BadModel{"scale = \n", "not valid TOML"}));

}  // namespace
}  // namespace lasso::mdat
