// [stereo] of a mission. Inside of missiondb.
#pragma once

#include <vector>

#include "mdat/missiondb/scene_values.hpp"

namespace lasso::mdat {

const std::vector<ValueRow>& stereo_rows();  // keys without "stereo."

// Reads it into the source. What is wrong is a problem.
void read_stereo(const toml::table& root, MissionSource& source, ProblemList& problems);

}  // namespace lasso::mdat
