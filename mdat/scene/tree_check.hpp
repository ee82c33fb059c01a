// What is wrong with the nodes of a scene's tree. Inside of scene.
#pragma once

#include <string>
#include <vector>

#include "mdat/scene/tree.hpp"

namespace lasso::mdat::scene {

// The numbers of the nodes' parents, and of the nodes that they point to; their own where they point to none. The root is number 0.
struct TreeLinks {
  std::vector<std::size_t> parents, towards;
};

// `nodes` begins with the root. Throws MissionError with all problems.
TreeLinks checked_links(const std::vector<Node>& nodes);

}  // namespace lasso::mdat::scene
