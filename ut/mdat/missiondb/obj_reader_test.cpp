#include "ut/mdat/missiondb/mesh_files.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// The box's faces as quads, and its vertices, apart: a file may have them in any order.
const std::string kVertices = [] {
  std::string text;
  for (const Vector3d& v : box().vertices) text += "v " + point_text(v) + "\n";
  return text;
}();
constexpr char kQuads[] = "f 1 5 7 3\nf 2 4 8 6\nf 1 2 6 5\nf 3 7 8 4\nf 1 3 4 2\nf 5 6 8 7\n";

TEST(ObjReader, FilesOfOtherPrograms) {
  VERIFIES("LASSO-GND-005~2");
  const std::string text = kVertices + kQuads;
  const std::string textures = "vt 0 0\nvt 1 0\nvn 0 0 1\n";
  const std::string back = kVertices + "f -8 -4 -2 -6\nf -7 -5 -1 -3\nf -8 -7 -3 -4\nf -6 -2 -1 -5\nf -8 -6 -5 -7\nf -4 -3 -1 -2\n";
  const std::string corpus[] = {
      obj(box()), text, back, "\xEF\xBB\xBF" + text, "\xEF\xBB\xBF# made\n" + text, changed(text, "\n", "\r\n"), changed(text, "\n", "\r"),
      changed(text, " ", "\t  "), kQuads + kVertices, changed(text, "\n", " # top\n"), text.substr(0, text.size() - 1),
      // a line that goes on
      changed(text, "f 1 ", "f 1 \\\n "), changed(text, "f 1 ", "f 1\\\r\n\t"), changed(text, "f 1 5 ", "f \\\n1 \\ \n5 \\\n"),
      changed(text, "v 1.0", "v \\\n 1.0"),
      // paths of Windows are none
      "# from C:\\temp\\\nmtllib C:\\mine\\\n" + text, "o body\\\ng a b\\\n" + text,
      // textures, normals, colours, weights
      textures + changed(changed(text, " 1 5 7 3", " 1/1 5/2 7/1 3/2"), " 2 4 8 6", " 2//1 4//1 8//1 6//1"),
      textures + changed(text, " 5 6 8 7", " 5/1/1 6/2/1 8/1/1 7/2/1"), changed(kVertices, "00\n", "00 1.0\n") + kQuads,
      changed(kVertices, "00\n", "00 0.5 0.5 0.5\n") + kQuads, changed(text, "f ", "fo "),
      "mtllib a.mtl\no body\ng one\nusemtl x\ns off\n" + text,
      "v 900 900 900\n" + changed(text, kQuads, "f 2 6 8 4\nf 3 5 9 7\nf 2 3 7 6\nf 4 8 9 5\nf 2 4 5 3\nf 6 7 9 8\n")};
  for (const std::string& file : corpus) {
    SCOPED_TRACE(file.substr(0, 300));
    std::vector<std::string> left_out;
    expect_box(imported("o.obj", file, &left_out));
    EXPECT_TRUE(left_out.empty());
  }
}

TEST(ObjReader, TellsEdgesPointsAndCurves) {
  VERIFIES("LASSO-GND-005~2");
  std::vector<std::string> left_out;
  expect_box(imported("o.obj", kVertices + kQuads + "l 1 2 3\nl 1 \\\n 2\np 1\ncurv 0 1 1 2\n", &left_out));
  EXPECT_EQ(left_out, (std::vector<std::string>{"2 line elements", "1 point element", "1 free-form curve or surface"}));
  expect_box(imported("o.obj", "call part.obj 1\ncsh -ls\n" + kVertices + kQuads, &left_out));
  EXPECT_EQ(left_out.back(), "2 call or csh statements");
  EXPECT_EQ(refusal("o.obj", kVertices + "l 1 2\n"), "is empty: it holds no face, but 1 line element: export triangles");
  EXPECT_EQ(refusal("o.obj", kVertices), "is empty: it holds no face");
}

TEST(ObjReader, CutsPolygonsEvenConcaveOnes) {
  VERIFIES("LASSO-GND-005~2");
  // An L of three unit squares as one face, in the plane z = 1, seen from above.
  const Mesh mesh = imported("l.obj", "v 0 0 1\nv 2 0 1\nv 2 1 1\nv 1 1 1\nv 1 2 1\nv 0 2 1\nf 1 2 3 4 5 6\n");
  ASSERT_EQ(mesh.triangles.size(), 4u);
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const Vector3d cross = (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    EXPECT_GT(cross.z(), 0);
    area += cross.z() / 2;
  }
  EXPECT_NEAR(area, 3, 1e-12);
}

// Half a millimetre, 500 km from the origin: a float would keep 31 mm there.
TEST(ObjReader, KeepsWhatADoubleKeeps) {
  VERIFIES("LASSO-GND-005~2");
  const Mesh mesh = imported("far.obj", "v 500000.0005 0 0\nv 500001 0 0\nv 500000 1 0\nf 1 2 3\n");
  EXPECT_NEAR(mesh.vertices[1].x() - mesh.vertices[0].x(), 0.9995, 1e-9);
}

TEST(ObjReader, RefusesWithPlaceAndRemedy) {
  VERIFIES("LASSO-GND-014~1");
  const auto said = [](const std::string& faces) { return refusal("o.obj", kVertices + faces); };
  EXPECT_EQ(said("f 1 2 99\n"), "line 9: a face refers to vertex 99, but there are 8: the file is truncated or corrupt");
  EXPECT_EQ(said("f 1 2 -9\n"), "line 9: a face refers to vertex -9, but there are 8 before it");
  EXPECT_EQ(said("f 1 2\n"), "line 9: a face has fewer than 3 corners: the file is truncated or corrupt");
  EXPECT_EQ(said("f 0 1 2\n"), "line 9: expected a vertex's number (from 1), found \"0\"");
  EXPECT_EQ(said("f 1 2 three\n"), "line 9: expected a vertex's number (from 1), found \"three\"");
  EXPECT_EQ(said("f 1 2 99999999999999999999\n"), "line 9: expected a vertex's number (from 1), found \"99999999999999999999\"");
  EXPECT_EQ(said("v 1 2\n"), "line 9: a number is missing: the file is truncated or corrupt");
  EXPECT_EQ(said("v 1,5 2,5 3,5\n"), "line 9: expected a number, found \"1,5\": numbers have a decimal point, no comma");
  EXPECT_NE(said("v nan 0 0\nf 1 2 9\n").find("vertex 8 is not finite"), std::string::npos);
  std::string polygon = "f";
  for (int i = 0; i < 1001; ++i) polygon += " 1";
  EXPECT_NE(said(polygon).find("1001 corners, at most 1000"), std::string::npos);
}

}  // namespace
}  // namespace lasso::mdat
