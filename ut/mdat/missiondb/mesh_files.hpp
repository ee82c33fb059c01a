// A box of 2 x 3 x 5 as the files of each format have it, and what every reader has to make of them.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "mdat/missiondb/mesh_import.hpp"
#include "mdat/missiondb/solid.hpp"
#include "ut/mdat/missiondb/support.hpp"

namespace lasso::mdat {

using Eigen::Vector3d;

inline const Mesh& box() {
  static const Mesh mesh = make_box({2, 3, 5});
  return mesh;
}

template <typename T>
std::string raw(T value) {  // little-endian, as this computer is
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

inline std::string raw_point(const Vector3d& p) {
  return raw(static_cast<float>(p.x())) + raw(static_cast<float>(p.y())) + raw(static_cast<float>(p.z()));
}

inline std::string point_text(const Vector3d& p) {
  return std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z());
}

inline std::string changed(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) text.replace(at, from.size(), to);
  return text;
}

inline std::string binary_stl(const Mesh& mesh, std::string header = "made") {
  header.resize(80, '\0');
  std::string bytes = header + raw(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    bytes += std::string(12, '\0');
    for (const auto k : triangle) bytes += raw_point(mesh.vertices[k]);
    bytes += std::string(2, '\0');
  }
  return bytes;
}

inline std::string text_stl(const Mesh& mesh) {
  std::string text = "solid box\n";
  for (const auto& triangle : mesh.triangles) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const auto k : triangle) text += "   vertex " + point_text(mesh.vertices[k]) + "\n";
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid box\n";
}

inline std::string obj(const Mesh& mesh) {
  std::string text;
  for (const auto& v : mesh.vertices) text += "v " + point_text(v) + "\n";
  for (const auto& t : mesh.triangles) {
    text += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " + std::to_string(t[2] + 1) + "\n";
  }
  return text;
}

// What import_mesh makes of a file of this name and content.
inline Mesh imported(const std::string& name, const std::string& content, std::vector<std::string>* left_out = nullptr) {
  return parse_mesh(name, content, 1, left_out);
}

inline std::string refusal(const std::string& name, const std::string& content) {
  try {
    static_cast<void>(parse_mesh(name, content, 1));
  } catch (const MeshError& error) {
    return error.what();
  }
  return "";
}

// A box has 8 vertices and 12 triangles; this one lies about `center`, and its volume is 30.
inline void expect_box(const Mesh& mesh, double scale = 1, const Vector3d& center = Vector3d::Zero()) {
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_NEAR(signed_volume(mesh), 30 * scale * scale * scale, 1e-5 * scale);
  Eigen::AlignedBox3d bounds;
  for (const Vector3d& v : mesh.vertices) bounds.extend(v);
  EXPECT_LT((bounds.center() - center).norm(), 1e-6);
  EXPECT_LT((bounds.sizes() - scale * Vector3d(2, 3, 5)).norm(), 1e-5);
}

}  // namespace lasso::mdat
