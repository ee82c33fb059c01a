#include "mdat/missiondb/mesh_import.hpp"

#include "ut/mdat/missiondb/mesh_files.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

std::string import_error(const std::filesystem::path& file, double scale = 1) {
  try {
    static_cast<void>(import_mesh(file, scale));
  } catch (const MeshError& error) {
    return error.what();
  }
  return "";
}

TEST(MeshImport, ReadsFilesByTheirEnding) {
  VERIFIES("LASSO-GND-005~2");
  const Folder folder;
  expect_box(import_mesh(folder.write("b.stl", binary_stl(box())), 1));
  expect_box(import_mesh(folder.write("A.STL", text_stl(box())), 1));
  expect_box(import_mesh(folder.write("o.Obj", obj(box())), 1));
  EXPECT_NE(import_error(folder.write("x.xyz", "1 2 3")).find("expected .stl"), std::string::npos);
}

TEST(MeshImport, ScalesToMetres) {
  VERIFIES("LASSO-GND-005~2");
  const Folder folder;
  expect_box(import_mesh(folder.write("b.stl", binary_stl(box())), 0.1), 0.1);
}

TEST(MeshImport, MinusZeroIsZero) {
  VERIFIES("LASSO-GND-005~2");
  const Mesh mesh = imported("z.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -0 0 -0\nv 1 1 0\nf 1 2 3\nf 2 5 4\n");
  EXPECT_EQ(mesh.vertices.size(), 4u);
}

TEST(MeshImport, RefusesAbsurdSizesAndAsksForTheScale) {
  VERIFIES("LASSO-GND-014~1");
  const Folder folder;
  const auto file = folder.write("b.stl", binary_stl(box()));
  EXPECT_NE(import_error(file, 1e6).find("5000000 m long"), std::string::npos);
  EXPECT_NE(import_error(file, 1e6).find("is the scale right?"), std::string::npos);
  EXPECT_NE(import_error(file, 1e-6).find("is the scale right?"), std::string::npos);
}

TEST(MeshImport, RefusesWhatIsNoFile) {
  VERIFIES("LASSO-GND-014~1");
  const Folder folder;
  EXPECT_NE(import_error(folder.path() / "none.stl").find("cannot be read"), std::string::npos);
  EXPECT_NE(import_error(folder.write("empty.stl", "")).find("empty"), std::string::npos);
  EXPECT_NE(import_error(folder.path()), "");
}

TEST(MeshImport, ChecksIndices) {
  VERIFIES("LASSO-GND-014~1");
  Mesh mesh = box();
  mesh.triangles[2][1] = 8;
  EXPECT_THROW(check_mesh(mesh), MeshError);
}

}  // namespace
}  // namespace lasso::mdat
