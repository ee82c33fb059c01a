// What mdat run leaves in its folder.
#pragma once

#include <string>

#include "mdat/common/flight_image.hpp"
#include "mdat/common/output.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

// Results, frames, telemetry, and relative poses where there are any; what an earlier run left of these and its report is removed.
void write_results(const SimulationResult& result, OutputFolder& folder);

// After all else: what goes wrong here costs a picture. `picture`: a file for the scan on the target; empty: none. Throws PictureError.
void write_pictures(bool report, const std::string& picture, const CompiledMission& mission, const SimulationResult& result,
                    OutputFolder& folder);

}  // namespace lasso::mdat
