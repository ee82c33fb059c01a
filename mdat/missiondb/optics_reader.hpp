// Lamps and cameras that stand at nodes, node.NAME.lamp and node.NAME.camera of a mission. Inside of missiondb.
#pragma once

#include <string>
#include <vector>

#include "mdat/missiondb/scene_values.hpp"

namespace lasso::mdat {

// Their rows after those of a node.
std::vector<ValueRow> with_optics_rows(std::vector<ValueRow> rows);

// Reads them into the source's scene. What is wrong is a problem.
void read_optics(SceneValues& values, const std::string& node, MissionSource& source);

// Lamps that are on and stand in a sensor, or in a camera: what a point that shines there would light is the sensor's own inside. `tree` is
// that of the source's nodes; its further sensors have been read. Each is a problem.
void refuse_lamps_in_sensors(const scene::Tree& tree, const MissionSource& source, ProblemList& problems);

}  // namespace lasso::mdat
