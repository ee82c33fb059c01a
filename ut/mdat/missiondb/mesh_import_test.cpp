#include "mdat/missiondb/mesh_import.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <limits>

#include "mdat/missiondb/sha256.hpp"
#include "mdat/missiondb/solid.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using Eigen::Vector3d;

std::string little_endian(const void* value, std::size_t size) { return {static_cast<const char*>(value), size}; }

std::string binary_stl(const Mesh& mesh) {
  std::string bytes(80, 'x');
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  bytes += little_endian(&count, 4);
  for (const auto& triangle : mesh.triangles) {
    bytes += std::string(12, '\0');
    for (const auto k : triangle) {
      const Eigen::Vector3f p = mesh.vertices[k].cast<float>();
      bytes += little_endian(p.data(), 12);
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

std::string point_text(const Vector3d& p) { return std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()); }

std::string ascii_stl(const Mesh& mesh) {
  std::string text = "solid box\n";
  for (const auto& triangle : mesh.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const auto k : triangle) text += "vertex " + point_text(mesh.vertices[k]) + "\n";
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid box\n";
}

std::string obj(const Mesh& mesh) {
  std::string text;
  for (const auto& v : mesh.vertices) text += "v " + point_text(v) + "\n";
  for (const auto& t : mesh.triangles) {
    text += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " + std::to_string(t[2] + 1) + "\n";
  }
  return text;
}

std::string ply(const Mesh& mesh) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(mesh.vertices.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(mesh.triangles.size()) +
                     "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& v : mesh.vertices) text += point_text(v) + "\n";
  for (const auto& t : mesh.triangles) {
    text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
  }
  return text;
}

// A glTF with its buffer beside it: indices as uint32, then positions.
std::string gltf(const Mesh& mesh, const Folder& folder) {
  std::string buffer;
  for (const auto& t : mesh.triangles) buffer += little_endian(t.data(), 12);
  const std::size_t indices = buffer.size();
  for (const auto& v : mesh.vertices) {
    const Eigen::Vector3f p = v.cast<float>();
    buffer += little_endian(p.data(), 12);
  }
  folder.write("m.bin", buffer);
  const auto n = [](std::size_t value) { return std::to_string(value); };
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"translation":[0,0,0.5]}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":1},"indices":0}]}],"buffers":[{"uri":"m.bin","byteLength":)" +
         n(buffer.size()) + R"(}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":)" + n(indices) +
         R"(},{"buffer":0,"byteOffset":)" + n(indices) + R"(,"byteLength":)" + n(buffer.size() - indices) +
         R"(}],"accessors":[{"bufferView":0,"componentType":5125,"count":)" + n(3 * mesh.triangles.size()) +
         R"(,"type":"SCALAR"},{"bufferView":1,"componentType":5126,"count":)" + n(mesh.vertices.size()) +
         R"(,"type":"VEC3","min":[-1,-1.5,-2.5],"max":[1,1.5,2.5]}]})";
}

const Mesh& box() {
  static const Mesh mesh = make_box({2, 3, 5});
  return mesh;
}

std::string import_error(const std::filesystem::path& file, double scale = 1) {
  try {
    static_cast<void>(import_mesh(file, scale));
  } catch (const MeshError& error) {
    return error.what();
  }
  return "";
}

void expect_box(const Mesh& mesh, double scale) {
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_NEAR(signed_volume(mesh), 30 * scale * scale * scale, 1e-6 * scale);
}

TEST(MeshImport, ReadsEveryFormatAlike) {
  VERIFIES("LASSO-GND-005~1");
  const Folder folder;
  expect_box(import_mesh(folder.write("b.stl", binary_stl(box())), 1), 1);
  expect_box(import_mesh(folder.write("a.stl", ascii_stl(box())), 1), 1);
  expect_box(import_mesh(folder.write("o.obj", obj(box())), 1), 1);
  expect_box(import_mesh(folder.write("p.ply", ply(box())), 1), 1);
  const Mesh moved = import_mesh(folder.write("g.gltf", gltf(box(), folder)), 1);
  expect_box(moved, 1);
  double top = -1e9;
  for (const Vector3d& v : moved.vertices) top = std::max(top, v.z());
  EXPECT_NEAR(top, 3.0, 1e-6);  // the node's translation counts
}

TEST(MeshImport, CutsPolygonsEvenConcaveOnes) {
  VERIFIES("LASSO-GND-005~1");
  const Folder folder;
  // An L of three unit squares as one face, in the plane z = 1, seen from above.
  const Mesh mesh = import_mesh(folder.write("l.obj", "v 0 0 1\nv 2 0 1\nv 2 1 1\nv 1 1 1\nv 1 2 1\nv 0 2 1\nf 1 2 3 4 5 6\n"), 1);
  ASSERT_EQ(mesh.triangles.size(), 4u);
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const Vector3d cross = (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    EXPECT_GT(cross.z(), 0);
    area += cross.z() / 2;
  }
  EXPECT_NEAR(area, 3, 1e-12);
}

TEST(MeshImport, ScalesToMetres) {
  VERIFIES("LASSO-GND-005~1");
  const Folder folder;
  expect_box(import_mesh(folder.write("b.stl", binary_stl(box())), 0.1), 0.1);
}

TEST(MeshImport, RefusesEveryTruncationOfAnStl) {
  VERIFIES("LASSO-GND-014~1");
  const Folder folder;
  const std::string binary = binary_stl(box());
  for (std::size_t size = 0; size < binary.size(); size += 7) {
    EXPECT_NE(import_error(folder.write("b.stl", binary.substr(0, size))), "") << size;
  }
  const std::string ascii = ascii_stl(box());
  for (std::size_t size = 0; size + 20 < ascii.size(); size += 31) {
    EXPECT_NE(import_error(folder.write("a.stl", ascii.substr(0, size))), "") << size;
  }
}

TEST(MeshImport, RefusesTruncationOfOtherFormats) {
  VERIFIES("LASSO-GND-014~1");
  const Folder folder;
  const std::string whole_ply = ply(box());
  const std::string whole_gltf = gltf(box(), folder);
  for (const double share : {0.1, 0.5, 0.8, 0.95}) {
    const auto part = [&](const std::string& text) {
      return text.substr(0, static_cast<std::size_t>(share * static_cast<double>(text.size())));
    };
    EXPECT_NE(import_error(folder.write("p.ply", part(whole_ply))), "") << share;
    EXPECT_NE(import_error(folder.write("g.gltf", part(whole_gltf))), "") << share;
  }
  std::string joined = whole_ply;
  joined.replace(joined.find("end_header\n"), 11, "end_header ");  // the mesh library would search for the header's end for ever
  EXPECT_NE(import_error(folder.write("p.ply", joined)), "");
  const std::string buffer = read_file(folder.path() / "m.bin");
  const auto file = folder.write("g.gltf", whole_gltf);
  EXPECT_EQ(import_error(file), "");
  folder.write("m.bin", buffer.substr(0, buffer.size() / 2));
  EXPECT_NE(import_error(file), "");
}

// The binary form of a glTF text, with an empty buffer chunk.
std::string glb(std::string text, std::uint32_t text_length) {
  const auto word = [](std::uint32_t value) { return little_endian(&value, 4); };
  return "glTF" + word(2) + word(static_cast<std::uint32_t>(20 + text.size())) + word(text_length) + "JSON" + text;
}

TEST(MeshImport, RefusesCountsThatAGltfCannotHold) {
  VERIFIES("LASSO-GND-014~1");
  const Folder folder;
  std::string text = gltf(box(), folder);
  const auto length = static_cast<std::uint32_t>(text.size());
  EXPECT_NE(import_error(folder.write("g.glb", glb(text, length + 1))).find("truncated or corrupt"), std::string::npos);
  EXPECT_NE(import_error(folder.write("g.glb", glb(text, 0xA2000000u))).find("truncated or corrupt"), std::string::npos);
  text.replace(text.find("\"count\":36"), 10, "\"count\":36000000000");
  EXPECT_NE(import_error(folder.write("g.gltf", text)).find("accessor"), std::string::npos);
  text.replace(text.find("36000000000"), 11, "\"many\"");
  EXPECT_NE(import_error(folder.write("g.gltf", text)).find("wrong type"), std::string::npos);
}

TEST(MeshImport, RefusesNotANumber) {
  VERIFIES("LASSO-GND-014~1");
  const Folder folder;
  Mesh bad = box();
  bad.vertices[3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(import_error(folder.write("b.stl", binary_stl(bad))).find("not finite"), std::string::npos);
  EXPECT_NE(import_error(folder.write("o.obj", obj(bad))), "");
  bad.vertices[3].y() = std::numeric_limits<double>::infinity();
  EXPECT_NE(import_error(folder.write("b.stl", binary_stl(bad))).find("not finite"), std::string::npos);
}

TEST(MeshImport, RefusesAbsurdSizesAndAsksForTheScale) {
  VERIFIES("LASSO-GND-014~1");
  const Folder folder;
  const auto file = folder.write("b.stl", binary_stl(box()));
  EXPECT_NE(import_error(file, 1e6).find("5000000 m long"), std::string::npos);
  EXPECT_NE(import_error(file, 1e6).find("is the scale right?"), std::string::npos);
  EXPECT_NE(import_error(file, 1e-6).find("is the scale right?"), std::string::npos);
}

TEST(MeshImport, RefusesWhatIsNoSurface) {
  VERIFIES("LASSO-GND-014~1");
  const Folder folder;
  EXPECT_NE(import_error(folder.path() / "none.stl").find("cannot be read"), std::string::npos);
  EXPECT_NE(import_error(folder.write("empty.stl", "")).find("empty"), std::string::npos);
  EXPECT_NE(import_error(folder.write("none.stl", binary_stl({}))).find("empty"), std::string::npos);
  EXPECT_NE(import_error(folder.write("x.xyz", "1 2 3")).find("expected .stl"), std::string::npos);
  EXPECT_NE(import_error(folder.write("points.ply", ply({box().vertices, {}}))).find("empty"), std::string::npos);
  EXPECT_NE(import_error(folder.write("far.obj", obj(box()) + "f 1 2 99\n")).find("refers to vertex 99"), std::string::npos);
  EXPECT_NE(import_error(folder.write("line.obj", obj(box()) + "l 1 2\n")).find("points and lines"), std::string::npos);
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
