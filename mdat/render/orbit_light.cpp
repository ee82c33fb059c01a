#include "mdat/render/orbit_light.hpp"

namespace lasso::mdat {
namespace {

// Hill frame: x away from the Earth, y along the track, z across it. Sensor frame: z ahead, x right, y down.
Vec3 sensor_from_hill(const Vec3& v) { return {-v.z(), -v.x(), v.y()}; }

}  // namespace

Lights orbit_lights(const scene::Orbit& orbit, TimeUs t_us) {
  const scene::Earthshine earth = orbit.earthshine(t_us);
  Lights lights;
  lights.sun = sensor_from_hill(orbit.sun_hill(t_us));
  lights.sun_share = orbit.sunlit_share(t_us);
  lights.earth = sensor_from_hill(earth.direction_hill);
  lights.earth_half_angle_rad = earth.half_angle_rad;
  return lights;
}

}  // namespace lasso::mdat
