// What is odd about a mesh as a closed surface: counted after equal vertices are joined, as the model compiler does, and said in words.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mdat/modelc/mesh.hpp"

namespace lasso::mdat {

struct MeshFaults {
  std::size_t open_edges = 0;  // of one triangle
  std::size_t hole_edges = 0;  // of them, those of parts that enclose space
  // Shares of the surface whose back rays from outside reach, 0 below a hundredth: of open parts that enclose space, and of sheets and
  // dishes.
  double seen_behind = 0, sheets = 0;
  std::size_t crowded_edges = 0;   // of more than two triangles
  std::size_t opposite_pairs = 0;  // triangles that share an edge of two and run along it the same way
  std::size_t degenerate = 0;      // triangles without area
  std::size_t duplicates = 0;      // triangles given twice, in either winding
};

// Throws CompileError, as compile_model does of a mesh that cannot be repaired. A mesh with open edges costs 128 rays a
// triangle, of at most 20,000 triangles: of more, so many are asked, spread evenly over the surface.
MeshFaults mesh_faults(const Mesh& mesh);

// One that follows changes what scans fit the model; without it, nothing follows for poses.
struct MeshRemark {
  bool follows = false;
  std::string text;  // a topic, what was counted, what follows, and the remedy
};
std::vector<MeshRemark> mesh_remarks(const MeshFaults& faults);

// The same of a mesh. Throws MissionError, which names the file and why, of one that cannot be compiled. Solids of a parametric model share
// faces by design: of them what follows alone.
std::vector<MeshRemark> mesh_remarks(const std::filesystem::path& file, const Mesh& mesh, bool parametric);

}  // namespace lasso::mdat
