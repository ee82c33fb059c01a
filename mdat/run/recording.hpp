// Simulated scans as files, with the poses to replay them from.
#pragma once

#include <filesystem>

#include "mdat/common/flight_image.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

// Runs the scenario as it stands and writes for each range a folder `RANGEm` with `scans/fNNNNN.csv`, `truth.csv` (the true pose of each
// scan) and `poses.csv` (the true pose one frame before), both in the form of replay's initial poses. Throws as simulate, and InputError.
void write_recording(const CompiledMission& mission, SimulationOptions options, const std::filesystem::path& folder);

}  // namespace lasso::mdat
