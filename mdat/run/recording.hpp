// Simulated scans as files, with the poses to replay them from.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "hal_sim/sensor_recording.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

// Runs the scenario as it stands and writes for each range a folder `RANGEm` with `scans/fNNNNN.csv`, `truth.csv` (the true pose of each
// scan) and `poses.csv` (the true pose one frame before), both in the form of replay's initial poses. Throws as simulate, and InputError.
void write_recording(const CompiledMission& mission, SimulationOptions options, const std::filesystem::path& folder);

// What sensors gave (hal_sim/sensor_recording.hpp), as a file's content, and out of a file. Throws InputError that names the file.
std::string recording_text(const sim::SensorRecording& recording);
std::shared_ptr<const sim::SensorRecording> load_sensor_recording(const std::filesystem::path& file);

}  // namespace lasso::mdat
