#include "mdat/missiondb/mesh_import.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <map>
#include <tuple>

#include "mdat/missiondb/mesh_precheck.hpp"
#include "mdat/missiondb/sha256.hpp"
#include "mdat/missiondb/solid.hpp"
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
    if (added)
      mesh.vertices.push_back(scale_ *
                              Eigen::Vector3d(static_cast<double>(vertex.x), static_cast<double>(vertex.y), static_cast<double>(vertex.z)));
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

constexpr unsigned int kMaxCorners = 1000;

// The corners in a plane across the polygon's mean normal (Newell), in which it runs counter-clockwise.
std::vector<Eigen::Vector2d> flattened(const std::vector<Eigen::Vector3d>& corners) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) normal += corners[i].cross(corners[(i + 1) % corners.size()]);
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.normalized().cross(u);
  std::vector<Eigen::Vector2d> points;
  for (const Eigen::Vector3d& corner : corners) points.emplace_back(u.dot(corner), v.dot(corner));
  return points;
}

// Polygons are cut here: the library's own step ends the process on some corrupt files.
void add_face(const aiMesh& part, const aiFace& face, Joiner& joiner) {
  if (face.mNumIndices < 3 || face.mNumIndices > kMaxCorners) {
    throw MeshError("has a face of " + std::to_string(face.mNumIndices) +
                    " corners: points and lines are no surface (export triangles only), or the file is truncated");
  }
  std::vector<std::uint32_t> indices;
  std::vector<Eigen::Vector3d> corners;
  for (unsigned int k = 0; k < face.mNumIndices; ++k) {
    if (face.mIndices[k] >= part.mNumVertices) throw MeshError("has a face that refers to a vertex that is not there");
    indices.push_back(joiner.index_of(part.mVertices[face.mIndices[k]]));
    corners.push_back(joiner.mesh.vertices[indices.back()]);
  }
  if (indices.size() == 3) return joiner.mesh.triangles.push_back({indices[0], indices[1], indices[2]});
  for (const auto& triangle : triangulate_polygon(flattened(corners))) {
    joiner.mesh.triangles.push_back({indices[triangle[0]], indices[triangle[1]], indices[triangle[2]]});
  }
}

const aiScene& read_scene(Assimp::Importer& importer, const std::filesystem::path& file) {
  const aiScene* scene = importer.ReadFile(file.string(), aiProcess_PreTransformVertices);
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
    for (unsigned int k = 0; k < scene.mMeshes[i]->mNumFaces; ++k) add_face(*scene.mMeshes[i], scene.mMeshes[i]->mFaces[k], joiner);
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
