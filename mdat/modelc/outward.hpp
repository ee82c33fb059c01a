// Which side of the surface is outside: the side that light from far away reaches.
#pragma once

#include "mdat/modelc/model.hpp"
#include "mdat/modelc/topology.hpp"

namespace lasso::mdat {

// From seeded random points on both sides of each triangle, cosine-weighted rays are followed (Embree). A component turns to the side from
// which more rays escape (by area); a closed hidden one to positive volume. Triangles of open components whose both sides let rays escape
// become two-sided: all of a component's triangles if that is so for more than half of its lit area, else one by one.
//
// With `asked`, rays are followed from those triangles alone whose value there is above 0. The others have their component's answer.
void turn_outward(Surface& surface, const Components& components, CompileReport& report, const std::vector<double>& asked = {});

}  // namespace lasso::mdat
