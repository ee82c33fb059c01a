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

TEST(Simplify, ABoxOfManyTrianglesLosesNothing) {
  VERIFIES("LASSO-GND-042~1");
  Mesh box;  // each side of 20 x 20 squares
  for (int side = 0; side < 6; ++side) {
    Mesh face = shapes::sheet(1, 20);
    shapes::move(face, Eigen::Quaterniond::Identity(), {-0.5, -0.5, 0});
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(side % 3);
    const double sign = side < 3 ? 1 : -1;
    shapes::move(face, Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), sign * axis), sign * axis / 2);
    shapes::append(box, face);
  }
  const Simplified coarse = simplify(box, 12);
  EXPECT_LT(coarse.mesh.triangles.size(), 200U);
  EXPECT_LT(coarse.worst_m, 1e-6);
}

// A square plate of 1 m has a notch, 12 mm wide at its edge and 0.3 m deep. The plate that is left lacks it: every vertex that was given
// lies on that, but the middle of the notch's mouth is 6 mm from the notch's sides.
TEST(Simplify, ASlotThatAFaceBridgesIsInTheError) {
  VERIFIES("LASSO-GND-042~1");
  Mesh plate;
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.494, 0.0}, {0.5, 0.3}, {0.506, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
    plate.vertices.emplace_back(x, y, 0);
  plate.triangles = {{0, 1, 2}, {0, 2, 6}, {2, 5, 6}, {2, 4, 5}, {2, 3, 4}};
  const Simplified coarse = simplify(plate, 2);
  ASSERT_LT(coarse.mesh.triangles.size(), 5U);
  EXPECT_GT(coarse.worst_m, 0.004);
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
