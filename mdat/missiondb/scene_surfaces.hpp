// What the nodes of a mission's scene look like.
#pragma once

#include "mdat/missiondb/mission_source.hpp"

namespace lasso::mdat {

// Loads the surfaces of all nodes into the source's scene; `target` is load_target's. What a file holds and is no surface joins the
// source's warnings. Throws MissionError with every node that has a problem: a file as load_target, parts that the target has not.
void load_scene(MissionSource& source, const Mesh& target);

}  // namespace lasso::mdat
