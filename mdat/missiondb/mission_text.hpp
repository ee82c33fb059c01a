// What `mdat mission check` and `mdat mission info` print.
#pragma once

#include <string>

#include "mdat/missiondb/mission_source.hpp"

namespace lasso::mdat {

// One line of what was found good, after the warnings. Loads the target; throws MissionError where that fails.
std::string check_text(const MissionSource& source, const Mesh& mesh);

// Every effective value with its unit, its meaning and where it came from (file:line or preset); scenario "" shows the mission's own.
std::string info_text(const MissionSource& source, const std::string& scenario = "");

}  // namespace lasso::mdat
