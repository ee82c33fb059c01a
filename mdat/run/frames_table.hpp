// Every frame of a run as a row of a table (frames.csv).
#pragma once

#include <string>

#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

// Columns as in docs/user-guide.md, units in their names; what is not known of a frame is an empty cell.
std::string frames_csv(const SimulationResult& result);

}  // namespace lasso::mdat
