// What was flown: mission, target, scenario, sensor, flight images, program, the values that are not presets, and what is stated of lasers.
#pragma once

#include <string>

#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

std::string about_section(const CompiledMission& mission, const SimulationResult& result);

}  // namespace lasso::mdat
