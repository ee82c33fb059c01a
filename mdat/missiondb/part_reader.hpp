// The parts of a target, [part.NAME], from a mission's file. Inside of missiondb.
#pragma once

#include "mdat/missiondb/toml_reader.hpp"

namespace lasso::mdat {

// Fills source.parts, and the origins of their keys, from the mission's whole table; source.file is set. Problems go to the list;
// what a part's values say together is checked where none was found before.
void read_parts(const toml::table& root, MissionSource& source, ProblemList& problems);

}  // namespace lasso::mdat
