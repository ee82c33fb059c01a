// A mesh as its file has it, before vertices are joined and scaled. Inside of missiondb.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lasso::mdat {

struct FileMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::string> left_out;  // what the file holds besides, a line each
  std::size_t cut_tests = 0;          // work of cutting its polygons into triangles
};

// A face of any simple polygon, cut into triangles. Throws MeshError: fewer than 3 corners, more than 1000, one that is no vertex, or too
// much work to cut all those of the mesh.
void add_polygon(FileMesh& mesh, const std::vector<std::uint32_t>& corners);

// A strip, each triangle of which shares two corners with the one before; every second one is turned.
void add_strip(FileMesh& mesh, const std::vector<std::uint32_t>& corners);

// The readers throw MeshError: another kind of file, truncated, or corrupt. Indices of triangles may lie beyond the vertices.
FileMesh read_stl(std::string_view bytes);
FileMesh read_obj(std::string_view bytes);
FileMesh read_ply(std::string_view bytes);

}  // namespace lasso::mdat
