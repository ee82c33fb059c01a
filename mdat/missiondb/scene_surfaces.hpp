// What the nodes of a mission's scene look like.
#pragma once

#include "mdat/missiondb/mission_source.hpp"

namespace lasso::mdat {

// Loads the surfaces of all nodes into the source's scene; `target` is load_target's. What a file holds and is no surface joins the
// source's warnings. Throws MissionError with every node that has a problem: a file as load_target, parts that the target has not; then
// with every material of a part that is not there, or has one already.
void load_scene(MissionSource& source, const Mesh& target);

// Names of the parts that pictures of the mission show: those of the target, then those of other nodes, NODE.PART, or NODE of one that is
// all of one part. `target` is load_target's; the scene is loaded.
std::vector<std::string> part_names_of(const MissionSource& source, const Mesh& target);
// Numbers, among these, of the parts of a node's surface.
std::vector<std::uint32_t> part_numbers_of(const BodySource& body, const BodySurface& surface, std::vector<std::string>& names);

}  // namespace lasso::mdat
