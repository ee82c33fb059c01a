#include "mdat/missiondb/simplify.hpp"

#include <cmath>

#include "mdat/missiondb/mesh_import.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/mdat/modelc/meshes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(Simplify, ASphereKeepsItsSurfaceWithinTheErrorThatIsTold) {
  VERIFIES("LASSO-GND-042~1");
  const double radius_m = 0.5;
  const Mesh fine = shapes::sphere(radius_m, 60, 120);
  const Simplified coarse = simplify(fine, 1000);
  EXPECT_EQ(coarse.triangles_before, fine.triangles.size());
  EXPECT_LE(coarse.mesh.triangles.size(), 1000U);
  EXPECT_GT(coarse.mesh.triangles.size(), 900U);
  // Of 1000 equal triangles on a sphere each has a side of 2.7 R / sqrt(1000): its middle lies some a^2 / 6 R below the surface.
  const double side_m = std::sqrt(4 / std::sqrt(3.0) * 4 * 3.1416 * radius_m * radius_m / 1000);
  const double sagitta_m = side_m * side_m / (6 * radius_m);
  EXPECT_GT(coarse.worst_m, 0.5 * sagitta_m);
  EXPECT_LT(coarse.worst_m, 5 * sagitta_m);
  EXPECT_LT(coarse.rms_m, coarse.worst_m);
  EXPECT_GT(coarse.rms_m, 0.1 * sagitta_m);
  for (const Eigen::Vector3d& v : coarse.mesh.vertices) EXPECT_NEAR(v.norm(), radius_m, 1e-6) << "vertices are some of those given";
}

// A cube of 1 m about the origin; each side of `n` x `n` squares.
Mesh cube_of_squares(std::uint32_t n) {
  Mesh cube;
  for (int side = 0; side < 6; ++side) {
    const int along = side % 3, across = (along + 1) % 3, up = (along + 2) % 3;
    const double sign = side < 3 ? 1 : -1;
    Mesh face = shapes::sheet(1, n);
    for (Eigen::Vector3d& v : face.vertices) {
      const Eigen::Vector3d flat = v - Eigen::Vector3d(0.5, 0.5, 0);
      v[along] = sign / 2;
      v[across] = sign * flat.x();
      v[up] = flat.y();
    }
    shapes::append(cube, face);
  }
  return cube;
}

TEST(Simplify, ABoxOfManyTrianglesLosesNothing) {
  VERIFIES("LASSO-GND-042~1");
  const Simplified coarse = simplify(cube_of_squares(20), 100);
  EXPECT_LE(coarse.mesh.triangles.size(), 100U);
  EXPECT_LT(coarse.worst_m, 1e-6);
}

// A plate of 1 m with 20 notches in its lower edge, each `width_m` wide at its mouth and 0.3 m deep.
Mesh comb(double width_m) {
  constexpr std::uint32_t kNotches = 20;
  Mesh mesh;
  mesh.vertices = {{0, 1, 0}, {1, 1, 0}, {0, 0, 0}};
  const auto tip = [](std::uint32_t i) { return 4 + 3 * i; };
  for (std::uint32_t i = 0; i < kNotches; ++i) {
    const double x = (i + 0.5) / kNotches;
    mesh.vertices.insert(mesh.vertices.end(), {{x - width_m / 2, 0, 0}, {x, 0.3, 0}, {x + width_m / 2, 0, 0}});
    mesh.triangles.push_back({tip(i), i == 0 ? 2 : tip(i) - 2, tip(i) - 1});  // the tooth before it
    mesh.triangles.push_back({0, i == 0 ? 2 : tip(i - 1), tip(i)});
    if (i > 0) mesh.triangles.push_back({tip(i - 1), tip(i - 1) + 1, tip(i)});
  }
  const std::uint32_t last = tip(kNotches - 1);
  mesh.vertices.emplace_back(1, 0, 0);
  mesh.triangles.insert(mesh.triangles.end(), {{last, last + 1, last + 2}, {last, last + 2, 1}, {0, last, 1}});
  return mesh;
}

// A mesh that is coarse enough: it stays as it is.
TEST(Simplify, MoreTrianglesThanThereAreTakeNoneAway) {
  VERIFIES("LASSO-GND-042~1");
  const Mesh ball = shapes::sphere(0.5, 12, 24);
  const Simplified same = simplify(ball, 500'000);
  EXPECT_EQ(same.mesh.triangles.size(), ball.triangles.size());
  EXPECT_LT(same.worst_m, 1e-6);
}

// The plate without notches holds every vertex that was given, but the middle of a mouth is half of its width from the notch's sides.
TEST(Simplify, NotchesThatFacesBridgeAreInTheError) {
  VERIFIES("LASSO-GND-042~1");
  for (const double width_m : {0.004, 0.012}) {
    const Simplified coarse = simplify(comb(width_m), 40);
    ASSERT_LE(coarse.mesh.triangles.size(), 40U);
    EXPECT_GT(coarse.worst_m, 0.4 * width_m);
    EXPECT_LT(coarse.worst_m, 0.51 * width_m);
  }
}

TEST(Simplify, ItsFileReadsBackAsTheSameMesh) {
  VERIFIES("LASSO-GND-042~1");
  const Folder folder;
  const Mesh mesh = simplify(shapes::sphere(0.5, 12, 24), 200).mesh;
  const Mesh read = import_mesh(folder.write("coarse.stl", stl_bytes(mesh)), 1);
  ASSERT_EQ(read.vertices.size(), mesh.vertices.size());
  EXPECT_EQ(read.triangles, mesh.triangles);
  for (std::size_t i = 0; i < read.vertices.size(); ++i) EXPECT_EQ(read.vertices[i], mesh.vertices[i]);
}

}  // namespace
}  // namespace lasso::mdat
