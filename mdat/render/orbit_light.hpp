// The light of an orbit on a target that a camera sees.
#pragma once

#include "mdat/render/light.hpp"
#include "mdat/scene/orbit.hpp"

namespace lasso::mdat {

// Sun and Earth in the sensor frame at a time since orbit angle `Setup::angle_rad`: the camera looks along the track, the Earth is below in
// the picture. In Earth's shadow the sun's share is that of its disc which is still seen. No lamp.
Lights orbit_lights(const scene::Orbit& orbit, TimeUs t_us);

}  // namespace lasso::mdat
