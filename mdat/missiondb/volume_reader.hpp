// Clouds that scatter a laser's light, node.NAME.scatter of a mission. Inside of missiondb.
#pragma once

#include <string>
#include <vector>

#include "mdat/missiondb/scene_values.hpp"

namespace lasso::mdat {

// Its rows after those of a node.
std::vector<ValueRow> with_volume_rows(std::vector<ValueRow> rows);

// Reads it into the source's scene. What is wrong is a problem.
void read_volume(SceneValues& values, const std::string& node, MissionSource& source);

}  // namespace lasso::mdat
