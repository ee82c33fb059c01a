#include "mdat/missiondb/mesh_import.hpp"

#include <algorithm>
#include <bit>
#include <unordered_map>

#include "mdat/missiondb/file_mesh.hpp"
#include "mdat/missiondb/gltf_reader.hpp"
#include "mdat/missiondb/mesh_text.hpp"
#include "mdat/missiondb/value_row.hpp"
#include "mdat/source/sha256.hpp"

namespace lasso::mdat {
namespace {

struct PlaceHash {
  std::size_t operator()(const std::array<double, 3>& place) const {
    std::uint64_t hash = 0;
    for (const double value : place) hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15U;
    return hash ^ hash >> 32;
  }
};

// Joins identical vertices (exactly: a tolerance would depend on the file's units). Those of no triangle are left out.
class Joiner {
 public:
  Joiner(const FileMesh& from, double scale) : from_(from), scale_(scale) {}
  Mesh joined() {
    for (const auto& triangle : from_.triangles)
      mesh_.triangles.push_back({index_of(triangle[0]), index_of(triangle[1]), index_of(triangle[2])});
    return std::move(mesh_);
  }

 private:
  std::uint32_t index_of(std::uint32_t number) {
    if (number >= from_.vertices.size()) throw MeshError("has a face that refers to a vertex that is not there");
    const Eigen::Vector3d& v = from_.vertices[number];
    if (!v.allFinite()) throw MeshError("vertex " + std::to_string(number) + " is not finite (NaN or infinite): export the mesh again");
    const auto next = static_cast<std::uint32_t>(mesh_.vertices.size());
    const auto [entry, added] = indices_.try_emplace({v.x() + 0.0, v.y() + 0.0, v.z() + 0.0}, next);  // -0 is 0
    if (added) mesh_.vertices.push_back(scale_ * v);
    return entry->second;
  }

  const FileMesh& from_;
  double scale_;
  Mesh mesh_;
  std::unordered_map<std::array<double, 3>, std::uint32_t, PlaceHash> indices_;
};

FileMesh read_by_kind(const std::filesystem::path& file, std::string_view bytes) {
  if (bytes.empty()) throw MeshError("is empty: it has 0 bytes");
  const std::string kind = lower_case(file.extension().string());
  if (kind == ".stl") return read_stl(bytes);
  if (kind == ".ply") return read_ply(bytes);
  if (kind == ".obj") return read_obj(bytes);
  if (kind == ".glb" || kind == ".gltf") return read_gltf(file.parent_path(), bytes);
  throw MeshError("is of kind \"" + kind + "\", expected .stl, .obj, .ply, .gltf or .glb");
}

}  // namespace

Mesh import_mesh(const std::filesystem::path& file, double scale, std::vector<std::string>* left_out) {
  std::string bytes;
  try {
    bytes = read_file(file);
  } catch (const std::runtime_error& error) {
    throw MeshError(error.what());
  }
  return parse_mesh(file, bytes, scale, left_out);
}

Mesh parse_mesh(const std::filesystem::path& file, std::string_view bytes, double scale, std::vector<std::string>* left_out) {
  const FileMesh read = read_by_kind(file, bytes);
  Mesh mesh = Joiner(read, scale).joined();
  check_mesh(mesh);
  check_extent(mesh);
  if (left_out != nullptr) *left_out = read.left_out;
  return mesh;
}

void check_mesh(const Mesh& mesh) {
  if (mesh.triangles.empty()) throw MeshError("is empty: it holds no triangle");
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    if (!vertex.allFinite()) throw MeshError("has a vertex that is not finite (NaN or infinite)");
  }
  for (const auto& triangle : mesh.triangles) {
    if (*std::max_element(triangle.begin(), triangle.end()) >= mesh.vertices.size()) {
      throw MeshError("has a triangle that refers to a vertex that is not there");
    }
  }
}

void check_extent(const Mesh& mesh) {
  Eigen::Vector3d low = mesh.vertices.at(0);
  Eigen::Vector3d high = low;
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  const double extent = (high - low).maxCoeff();
  if (extent >= kMinMeshExtent_m && extent <= kMaxMeshExtent_m) return;
  throw MeshError("is " + number_text(extent) + " m long after target.scale, expected " + number_text(kMinMeshExtent_m) + " to " +
                  number_text(kMaxMeshExtent_m) + " m: is the scale right? (a mesh in millimetres needs scale = 0.001)");
}

}  // namespace lasso::mdat
