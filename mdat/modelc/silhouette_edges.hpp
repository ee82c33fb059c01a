// The edges that can be seen as contours.
#pragma once

#include "mdat/modelc/elements.hpp"

namespace lasso::mdat {

// Edges whose faces differ by more than this are no longer coplanar.
constexpr double kCoplanarAngle_rad = 2e-4;

// Table kEdges: every mesh edge whose faces are not coplanar, and every boundary edge, with the planes of their elements. Slivers count as
// flaps of their host. Where more than two faces meet, each is paired with the next one through the solid; the rest are boundaries.
// Throws CompileError over kMaxEdges.
std::vector<std::uint32_t> make_edges(const Surface& surface, const std::vector<EdgeUse>& uses, const Polygons& polygons,
                                      const std::vector<Element>& elements, const LengthScale& scale, CompileReport& report);

}  // namespace lasso::mdat
