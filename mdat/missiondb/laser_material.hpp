// What the lasers see of materials.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal_sim/laser_reflection.hpp"
#include "mdat/missiondb/mission_source.hpp"

namespace lasso::mdat {

// At 1550 nm, of a preset's name (material_source.hpp); those at 1500 nm are the same within what is known of them.
sim::LaserReflection laser_preset(const std::string& preset);

// Of a part by the mission's [material.NAME], or else by the part's name.
sim::LaserReflection laser_reflection(const MissionSource& source, const std::string& part);

// Of each triangle; `names` as part_names_of has them, `of_triangle` indices into them.
std::vector<sim::LaserReflection> laser_reflections(const MissionSource& source, const std::vector<std::string>& names,
                                                    const std::vector<std::uint32_t>& of_triangle);

// Whether any sensor of the mission sees light, so that it matters.
bool has_detector(const MissionSource& source);

}  // namespace lasso::mdat
