// [material.NAME] of a mission. Inside of missiondb.
#pragma once

#include <vector>

#include "mdat/missiondb/scene_values.hpp"

namespace lasso::mdat {

const std::vector<ValueRow>& material_rows();  // keys without "material.NAME."

// Reads them into the source. What is wrong is a problem.
void read_materials(const toml::table& root, MissionSource& source, ProblemList& problems);

}  // namespace lasso::mdat
