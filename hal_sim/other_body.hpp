// A body beside the target that rays of a sensor can meet: a part that moves by itself, the chaser's own structure, debris, a cloud.
#pragma once

#include <memory>
#include <vector>

#include "hal_sim/ray_caster.hpp"
#include "hal_sim/scatter_volume.hpp"
#include "hal_sim/trajectory.hpp"

namespace lasso::sim {

struct OtherBody {
  std::shared_ptr<const RayCaster> surface;               // in its own frame; none: only a volume
  std::shared_ptr<const Trajectory> motion;               // of that frame before the sensor
  std::shared_ptr<const ScatterVolume> volume = nullptr;  // in the same frame; none: only a surface
};
using OtherBodies = std::vector<OtherBody>;

}  // namespace lasso::sim
