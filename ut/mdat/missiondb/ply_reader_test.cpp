#include <algorithm>
#include <limits>

#include "ut/mdat/missiondb/mesh_files.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

struct PlyStyle {
  std::string format = "ascii", end = "\n", head = "";  // `head` stands before the vertices
  std::string list = "property list uchar int vertex_indices";
};

constexpr char kCoordinates[] = "property float x\nproperty float y\nproperty float z\n";

std::string elements(const Mesh& mesh, const PlyStyle& style) {
  return changed("ply\nformat " + style.format + " 1.0\n" + style.head + "element vertex " + std::to_string(mesh.vertices.size()) + "\n" +
                     kCoordinates + "element face " + std::to_string(mesh.triangles.size()) + "\n" + style.list + "\nend_header\n",
                 "\n", style.end);
}

std::string vertex_lines(const Mesh& mesh) {
  std::string text;
  for (const Vector3d& v : mesh.vertices) text += point_text(v) + "\n";
  return text;
}

std::string face_lines(const Mesh& mesh) {
  std::string text;
  for (const auto& t : mesh.triangles) text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
  return text;
}

std::string ply(const Mesh& mesh, const PlyStyle& style = {}) { return elements(mesh, style) + vertex_lines(mesh) + face_lines(mesh); }

// Big- or little-endian, counts of type C, indices of type I.
template <typename C, typename I>
std::string binary_ply(const std::string& count, const std::string& index, bool big) {
  const auto number = [&](auto value) {
    std::string bytes = raw(value);
    if (big) std::reverse(bytes.begin(), bytes.end());
    return bytes;
  };
  std::string bytes = elements(box(), {std::string("binary_") + (big ? "big" : "little") + "_endian", "\n", "comment made by hand\n",
                                       "property list " + count + " " + index + " vertex_index"});
  for (const Vector3d& v : box().vertices) {
    for (const double x : v) bytes += number(static_cast<float>(x));
  }
  for (const auto& t : box().triangles) {
    bytes += number(C{3});
    for (const auto k : t) bytes += number(static_cast<I>(k));
  }
  return bytes;
}

TEST(PlyReader, TextOfOtherPrograms) {
  VERIFIES("LASSO-GND-005~2");
  const std::string head = ply(box());
  const std::string corpus[] = {
      head, ply(box(), {"ascii", "\r\n", ""}), ply(box(), {"ascii", "\r", ""}), "\xEF\xBB\xBF" + head, changed(head, "ply\n", "ply \n"),
      head + "\n\n", ply(box(), {"ascii", "\n", "comment element vertex 3\nobj_info a b c\n\ncomment end_header is near\n"}),
      changed(head, "vertex_indices", "vertex_index"), changed(head, "uchar int", "int8 uint16"),
      changed(head, "uchar int", "float double"), changed(head, "property float", "property float64"),
      changed(changed(head, "float x", "float X"), "float y", "float Y"),
      // other elements, before, between and behind
      changed(ply(box(), {"ascii", "\n", "element camera 1\nproperty float view_px\nproperty float view_py\n"}), "end_header\n",
              "end_header\n0 7\n"),
      changed(changed(head, "element face", "element material 2\nproperty list int float xs\nproperty uchar y\nelement face"),
              "\n" + point_text(box().vertices[7]) + "\n", "\n" + point_text(box().vertices[7]) + "\n3 1 2 3 4\n0 5\n"),
      changed(head, "end_header", "element more 1\nproperty list int int vertex_indices\nend_header") + "2 5 6\n",
      // further properties
      changed(changed(head, "property float z\n", "property float z\nproperty uchar red\nproperty list uchar int near\n"), "00\n",
              "00 255 2 5 6\n"),
      changed(changed(head, "property list", "property uchar flags\nproperty list uchar float texcoord\nproperty list"), "\n3 ",
              "\n1 2 0.5 nan 3 ")};
  for (const std::string& file : corpus) {
    SCOPED_TRACE(file.substr(0, 400));
    std::vector<std::string> left_out;
    expect_box(imported("p.ply", file, &left_out));
    EXPECT_TRUE(left_out.empty());
  }
}

TEST(PlyReader, ListsOfAnyType) {
  VERIFIES("LASSO-GND-005~2");
  for (const bool big : {false, true}) {
    const std::string corpus[] = {binary_ply<std::uint8_t, std::int32_t>("uchar", "int", big),
                                  binary_ply<std::int8_t, std::uint32_t>("int8", "uint32", big),
                                  binary_ply<std::uint16_t, std::uint8_t>("ushort", "uint8", big),
                                  binary_ply<std::int16_t, std::int8_t>("short", "char", big),
                                  binary_ply<std::int32_t, std::int16_t>("int", "short", big),
                                  binary_ply<std::uint32_t, std::uint16_t>("uint", "uint16", big),
                                  binary_ply<float, double>("float", "double", big)};
    for (const std::string& file : corpus) {
      SCOPED_TRACE(file.substr(0, 300));
      std::vector<std::string> left_out;
      expect_box(imported("p.ply", file, &left_out));
      EXPECT_TRUE(left_out.empty());
      expect_box(imported("p.ply", file + "behind", &left_out));
      EXPECT_EQ(left_out, std::vector<std::string>{"6 bytes behind what its header announces"});
    }
  }
}

// The sides of the box as one strip, top and bottom as strips of their own: -1 ends a strip.
TEST(PlyReader, TriangleStrips) {
  VERIFIES("LASSO-GND-005~2");
  const std::string head = std::string("ply\nformat ascii 1.0\nelement vertex 8\n") + kCoordinates;
  const std::string strips = "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
  const std::string list = " 4 0 5 1 7 3 6 2 4 0 -1 1 0 3 2 -1 4 5 6 7 -1\n";
  expect_box(imported("s.ply", head + strips + vertex_lines(box()) + "21" + list));
  // each strip an element of its own, without -1
  const std::string three = changed(strips, "tristrips 1", "tristrips 3");
  expect_box(imported("s.ply", head + three + vertex_lines(box()) + "10 4 0 5 1 7 3 6 2 4 0\n4 1 0 3 2\n4 4 5 6 7\n"));
  EXPECT_EQ(refusal("s.ply", head + strips + vertex_lines(box()) + "4 0 4 1 -2\n"), "has a face that refers to a vertex that is not there");
}

TEST(PlyReader, TellsWhatIsNoSurface) {
  VERIFIES("LASSO-GND-005~2");
  std::vector<std::string> left_out;
  const std::string edges =
      changed(ply(box()), "end_header", "element edge 2\nproperty int vertex1\nproperty int vertex2\nend_header") + "0 1\n1 2\n";
  expect_box(imported("e.ply", edges, &left_out));
  EXPECT_EQ(left_out, std::vector<std::string>{"2 edges"});
  const std::string lines = changed(ply(box()), "element face 12", "element face 13") + "2 0 1\n";
  expect_box(imported("l.ply", lines, &left_out));
  EXPECT_EQ(left_out, std::vector<std::string>{"1 face of fewer than 3 corners"});
  EXPECT_EQ(refusal("p.ply", ply({box().vertices, {}})), "is empty: it holds no face (points alone are a scan, not a target)");
}

TEST(PlyReader, AVertexOfNoFaceMayBeUnknown) {
  VERIFIES("LASSO-GND-005~2");
  Mesh mesh = box();
  mesh.vertices.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  expect_box(imported("p.ply", ply(mesh)));
  mesh.triangles.push_back({0, 1, 8});
  EXPECT_EQ(refusal("p.ply", ply(mesh)), "vertex 8 is not finite (NaN or infinite): export the mesh again");
}

TEST(PlyReader, RefusesWithPlaceAndRemedy) {
  VERIFIES("LASSO-GND-014~1");
  const std::string text = ply(box());
  EXPECT_EQ(refusal("p.ply", changed(text, "3 0 ", "3 ? ")).substr(0, 41), "line 18: expected a number, found \"?\"");
  EXPECT_EQ(refusal("p.ply", text + "3 0 1 2\n"), "line 30: there are more values than the header announces");
  EXPECT_EQ(refusal("p.ply", changed(text, "element vertex 8", "element vertex 18446744073709551615")).substr(0, 5), "line ");
  EXPECT_EQ(refusal("p.ply", changed(text, "\n3 0 ", "\n-3 0 ")), "has a list of -3.000000 values");
  EXPECT_EQ(refusal("p.ply", changed(text, "float x", "half x")), "has a PLY header with an unknown type \"half\"");
  EXPECT_EQ(refusal("p.ply", changed(text, "float x", "float a")), "has vertices without the properties x, y, z");
  EXPECT_EQ(refusal("p.ply", changed(text, "vertex_indices", "corners")), "has face without a list of vertex_index or vertex_indices");
  EXPECT_EQ(refusal("p.ply", changed(text, "end_header\n", "end_header")).substr(0, 59),
            "has a PLY header with a line that is not understood: \"end_h");
  EXPECT_EQ(refusal("p.ply", "ply\nthis is not a mesh\n"), "has a PLY header with a line that is not understood: \"this is not a mesh\"");
  EXPECT_NE(refusal("p.ply", changed(text, "element face 12",
                                     "element vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face 12")),
            "");
}

TEST(PlyReader, RefusesEveryTruncation) {
  VERIFIES("LASSO-GND-014~1");
  const std::string text = ply(box());
  for (std::size_t size = 1; size + 2 < text.size(); size += 3) EXPECT_NE(refusal("p.ply", text.substr(0, size)), "") << size;
  const std::string binary = binary_ply<std::uint8_t, std::int32_t>("uchar", "int", true);
  for (std::size_t size = 1; size < binary.size(); size += 3) EXPECT_NE(refusal("p.ply", binary.substr(0, size)), "") << size;
}

}  // namespace
}  // namespace lasso::mdat
