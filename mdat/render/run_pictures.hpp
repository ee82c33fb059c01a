// What the sensors saw in the run of a scene, for its report.
#pragma once

#include <string>
#include <vector>

#include "mdat/common/flight_image.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

struct RunPicture {
  std::string caption, png;
};

// Photos at six times of the run, from its first scan to its last, with the rays of the scans on them: all bodies, in the light of the
// orbit or else the usual one. None where the scenario is no scene. Draws with `jobs` threads; they change nothing.
std::vector<RunPicture> run_pictures(const CompiledMission& mission, const SimulationResult& result, unsigned jobs);

}  // namespace lasso::mdat
