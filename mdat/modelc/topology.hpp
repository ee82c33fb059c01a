// Who shares which edge, and a winding that neighbours agree on.
#pragma once

#include <utility>

#include "mdat/modelc/model.hpp"
#include "mdat/modelc/surface.hpp"

namespace lasso::mdat {

// All uses of all edges, sorted by edge, then by triangle: the uses of one edge are consecutive.
std::vector<EdgeUse> edge_uses(const Surface& surface);

// Calls visit(first, last) for the range of uses of each edge.
template <class Visit>
void for_each_edge(const std::vector<EdgeUse>& uses, const Visit& visit) {
  for (std::size_t begin = 0; begin < uses.size();) {
    std::size_t end = begin + 1;
    while (end < uses.size() && uses[end].a == uses[begin].a && uses[end].b == uses[begin].b) ++end;
    visit(uses.data() + begin, uses.data() + end);
    begin = end;
  }
}

struct Components {
  std::vector<std::uint32_t> of_triangle;
  std::vector<std::uint8_t> open;  // per component: has a boundary edge or cannot be oriented
  std::size_t count() const { return open.size(); }
};

// Flips triangles so that the two users of every manifold edge run along it in opposite directions, where possible. Each component keeps
// the winding of the majority of its triangles.
Components orient_consistently(Surface& surface, CompileReport& report);

// A sliver takes the normal of the neighbour across its longest edge; `flap_of` says whose flap each triangle is (itself if no sliver,
// kNone if it hangs on nothing).
std::vector<std::uint32_t> attach_slivers(const Surface& surface, const std::vector<EdgeUse>& uses);

}  // namespace lasso::mdat
