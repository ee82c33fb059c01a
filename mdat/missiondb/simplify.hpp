// A coarser mesh of the same surface, by meshoptimizer: edges are collapsed by the quadric error metric.
#pragma once

#include <cstddef>
#include <string>

#include "mdat/modelc/mesh.hpp"

namespace lasso::mdat {

constexpr double kSimplifyError = 0.01;  // of the mesh's size: no collapse costs more

// Distances of the vertices that were given from the coarser surface, and of a lattice of 36 points on each of its faces from the given
// one: the larger root mean square of both, and the largest. The coarser surface's vertices are some of those given.
struct Simplified {
  Mesh mesh;
  double rms_m = 0, worst_m = 0;
  std::size_t triangles_before = 0;
};

// At most `triangles`, or as few as the error's bound and the number of separate parts allow. Throws CompileError where nothing is left.
Simplified simplify(const Mesh& mesh, std::size_t triangles);

// A binary STL file in metres.
std::string stl_bytes(const Mesh& mesh);

}  // namespace lasso::mdat
