// Reading a target's surface from a mesh file: STL (binary, ASCII), OBJ, PLY, glTF (.gltf, .glb).
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "mdat/modelc/mesh.hpp"

namespace lasso::mdat {

// what() is the reason, without the file's name.
struct MeshError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

constexpr double kMaxMeshExtent_m = 1000;
constexpr double kMinMeshExtent_m = 1e-3;

// Vertices are the file's times `scale`, identical ones joined; orientation is the file's. Throws MeshError where the file is missing,
// truncated, corrupt, empty, holds NaN, points or lines, or is larger than kMaxMeshExtent_m or smaller than kMinMeshExtent_m after scale.
Mesh import_mesh(const std::filesystem::path& file, double scale);

// Throws MeshError unless every vertex is finite, there are triangles and all indices are in range.
void check_mesh(const Mesh& mesh);

// Throws MeshError unless the largest side of the bounding box is within the limits above.
void check_extent(const Mesh& mesh);

}  // namespace lasso::mdat
