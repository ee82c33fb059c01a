#include "mdat/missiondb/mesh_import.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <map>
#include <tuple>

#include "mdat/missiondb/mesh_precheck.hpp"
#include "mdat/missiondb/sha256.hpp"
#include "mdat/missiondb/value_row.hpp"

namespace lasso::mdat {
namespace {

using Point = std::tuple<float, float, float>;

// Joins identical vertices (exactly: a tolerance would depend on the file's units).
class Joiner {
 public:
  explicit Joiner(double scale) : scale_(scale) {}
  std::uint32_t index_of(const aiVector3D& vertex) {
    const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto [entry, added] = indices_.try_emplace(Point{vertex.x, vertex.y, vertex.z}, next);
    if (added) mesh.vertices.push_back(scale_ * Eigen::Vector3d(double{vertex.x}, double{vertex.y}, double{vertex.z}));
    return entry->second;
  }
  Mesh mesh;

 private:
  double scale_;
  std::map<Point, std::uint32_t> indices_;
};

void check_finite(const aiMesh& part) {
  for (unsigned int i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& v = part.mVertices[i];
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
      throw MeshError("vertex " + std::to_string(i) + " is not finite (NaN or infinite): export the mesh again");
    }
  }
}

void add_faces(const aiMesh& part, Joiner& joiner) {
  for (unsigned int i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) throw MeshError("holds points or lines beside triangles: export the surface only");
    std::array<std::uint32_t, 3> triangle{};
    for (unsigned int k = 0; k < 3; ++k) {
      if (face.mIndices[k] >= part.mNumVertices) throw MeshError("triangle " + std::to_string(i) + " refers to a vertex that is not there");
      triangle[k] = joiner.index_of(part.mVertices[face.mIndices[k]]);
    }
    joiner.mesh.triangles.push_back(triangle);
  }
}

const aiScene& read_scene(Assimp::Importer& importer, const std::filesystem::path& file) {
  const aiScene* scene = importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_PreTransformVertices);
  if (scene == nullptr) throw MeshError(std::string("cannot be read as a mesh: ") + importer.GetErrorString());
  if ((scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0) throw MeshError("is incomplete");
  return *scene;
}

}  // namespace

Mesh import_mesh(const std::filesystem::path& file, double scale) {
  std::string bytes;
  try {
    bytes = read_file(file);
  } catch (const std::runtime_error& error) {
    throw MeshError(error.what());
  }
  const std::size_t faces_expected = precheck_mesh_file(file, bytes);
  Assimp::Importer importer;
  const aiScene& scene = read_scene(importer, file);
  Joiner joiner(scale);
  for (unsigned int i = 0; i < scene.mNumMeshes; ++i) {
    check_finite(*scene.mMeshes[i]);
    add_faces(*scene.mMeshes[i], joiner);
  }
  if (joiner.mesh.triangles.size() < faces_expected) {
    throw MeshError("has " + std::to_string(joiner.mesh.triangles.size()) + " readable triangles, expected at least " +
                    std::to_string(faces_expected) + ": the file is truncated or corrupt");
  }
  check_mesh(joiner.mesh);
  check_extent(joiner.mesh);
  return std::move(joiner.mesh);
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
