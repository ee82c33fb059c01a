// The light that a scene's sensors have, and which part of an orbit it is of.
#pragma once

#include <cstdint>

#include "mdat/missiondb/scene_source.hpp"

namespace lasso::mdat {

enum class LightPhase : std::uint8_t { kDay = 0, kTerminator = 1, kEclipse = 2 };
constexpr LightPhase kLightPhases[] = {LightPhase::kDay, LightPhase::kTerminator, LightPhase::kEclipse};
const char* phase_name(LightPhase phase);
// What a phase is, in a few words.
const char* phase_meaning(LightPhase phase);

struct LightAt {
  double sun_share = 0;    // of the Sun's disc that the Earth leaves visible, 0 to 1
  double sun_off_rad = 0;  // the Sun's direction off the boresight: 0 is before the sensor, pi behind it
  double earth_lit = 0;    // cosine of the Sun's zenith angle on the ground below, 0 at night
};

// Below this the Earth gives hardly any light: the Sun stands within 6 degrees of the horizon of the ground below, or under it.
constexpr double kEarthDim = 0.1;

// At a time since frame 0, at the orbit's origin. Throws InputError where the run has no orbit.
LightAt light_at(const SceneRun& run, TimeUs t_us);

// kEclipse: nothing of the Sun is seen. kTerminator: of the Sun something is, and the Earth below is dim, so that nothing fills shadows.
LightPhase phase_of(const LightAt& light);

}  // namespace lasso::mdat
