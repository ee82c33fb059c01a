// The files that a mission is made of, to be kept together.
#pragma once

#include <filesystem>
#include <vector>

#include "mdat/missiondb/mission_source.hpp"

namespace lasso::mdat {

// The mission's own, those that it names, and those that these refer to (buffers of a glTF mesh). Absolute, in order of their names,
// each once. The mission has been loaded, its meshes as well. Throws MeshError as import_mesh().
std::vector<std::filesystem::path> files_of(const MissionSource& source);

}  // namespace lasso::mdat
