// What may be in view instead of the target.
#pragma once

#include "fsw/geometry/types.hpp"
#include "mdat/modelc/mesh.hpp"

namespace lasso {

mdat::Mesh cylinder(double half, double radius);  // about x
mdat::Mesh sphere(double radius);
mdat::Mesh panels(double size);              // a body with two panels
mdat::Mesh twofold(const mdat::Mesh& mesh);  // the mesh and the same turned by half a turn about x

}  // namespace lasso
