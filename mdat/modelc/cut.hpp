// What of a mesh lies in a box.
#pragma once

#include "mdat/modelc/mesh.hpp"

namespace lasso::mdat {

// Triangles that cross the box are cut at its faces, so that the surface ends there. No vertices where nothing lies in the box.
Mesh cut_by_box(const Mesh& mesh, const Eigen::Vector3d& low, const Eigen::Vector3d& high);

}  // namespace lasso::mdat
