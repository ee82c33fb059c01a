#include "mdat/availability/light_phase.hpp"

#include <algorithm>
#include <cmath>

#include "fsw/geometry/so3.hpp"
#include "mdat/common/errors.hpp"

namespace lasso::mdat {

const char* phase_name(LightPhase phase) {
  switch (phase) {
    case LightPhase::kDay:
      return "day";
    case LightPhase::kTerminator:
      return "terminator";
    case LightPhase::kEclipse:
      break;
  }
  return "eclipse";
}

const char* phase_meaning(LightPhase phase) {
  switch (phase) {
    case LightPhase::kDay:
      return "Sun, and light from the Earth";
    case LightPhase::kTerminator:
      return "Sun, and hardly any light from the Earth";
    case LightPhase::kEclipse:
      break;
  }
  return "no Sun";
}

LightAt light_at(const SceneRun& run, TimeUs t_us) {
  if (!run.orbit) throw InputError("the mission has no [orbit]: light follows from it");
  const Quat q_sensor_hill = run.tree.state(0, run.sensor, t_us).T_a_b.q;
  const double cosine = rotate(q_sensor_hill, run.orbit->sun_hill(t_us)).z();
  return {run.orbit->sunlit_share(t_us), std::acos(std::clamp(cosine, -1.0, 1.0)), run.orbit->earthshine(t_us).lit};
}

LightPhase phase_of(const LightAt& light) {
  if (light.sun_share <= 0) return LightPhase::kEclipse;
  return light.earth_lit < kEarthDim ? LightPhase::kTerminator : LightPhase::kDay;
}

}  // namespace lasso::mdat
