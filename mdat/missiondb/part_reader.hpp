// The parts of a target, [part.NAME], from a mission's file. Inside of missiondb.
#pragma once

#include "mdat/missiondb/toml_reader.hpp"

namespace lasso::mdat {

// Fills source.parts, and the origins of their keys, from the mission's whole table; source.file is set. All problems go to the list.
void read_parts(const toml::table& root, MissionSource& source, ProblemList& problems);

}  // namespace lasso::mdat
