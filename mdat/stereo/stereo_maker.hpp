// The mission's stereo head as a sensor of a case that is flown: by rendered and matched pairs, or by errors that were fitted to such.
#pragma once

#include "mdat/common/flight_image.hpp"
#include "mdat/run/case.hpp"

namespace lasso::mdat {

// Whether one of the mission's sensors is a stereo head.
bool has_stereo_head(const MissionSource& source);

// For SimulationOptions::make_stereo, by the mission's stereo.model. Keeps the mission by reference. `target_seed`: the run's, of what the
// simulated target differs in; `jobs`: threads that render a picture, of no effect on it.
MakeStereo stereo_maker(const MissionInput& mission, std::uint64_t target_seed, unsigned jobs);

// Throws InputError where pictures would be rendered: they take seconds a frame, which `what`, in the plural ("campaigns"), do not wait
// for.
void refuse_pictures(const MissionSource& source, const std::string& what);

// The same sensor of fitted errors alone; empty where the mission has no stereo head. Throws as refuse_pictures.
MakeStereo stereo_without_pictures(const MissionInput& mission, std::uint64_t target_seed, const std::string& what);

}  // namespace lasso::mdat
