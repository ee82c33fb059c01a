// Reading a target's surface from a mesh file: STL (binary, text), OBJ, PLY, glTF 2.0 (.gltf, .glb).
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "mdat/modelc/mesh.hpp"

namespace lasso::mdat {

// what() is the reason in one line, without the file's name.
struct MeshError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

constexpr double kMaxMeshExtent_m = 1000;
constexpr double kMinMeshExtent_m = 1e-3;

// Vertices are the file's times `scale`, identical ones joined; orientation is the file's. Throws MeshError where the file is missing,
// truncated, corrupt, empty, holds NaN, points or lines alone, or is larger than kMaxMeshExtent_m or smaller than kMinMeshExtent_m after
// scale. What else the file holds and is no surface is told in `left_out`, a line each ("2 edges").
Mesh import_mesh(const std::filesystem::path& file, double scale, std::vector<std::string>* left_out = nullptr);

// The same of bytes: the name says the kind, and where a glTF's buffers lie.
Mesh parse_mesh(const std::filesystem::path& file, std::string_view bytes, double scale, std::vector<std::string>* left_out = nullptr);

// Throws MeshError unless every vertex is finite, there are triangles and all indices are in range.
void check_mesh(const Mesh& mesh);

// Throws MeshError unless the largest side of the bounding box is within the limits above.
void check_extent(const Mesh& mesh);

}  // namespace lasso::mdat
