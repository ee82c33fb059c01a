// What is scanned where a closed form of the range is wanted.
#pragma once

#include "hal_sim/ray_caster.hpp"

namespace lasso::mdat::test {

// A wall through the target's origin, along its x and y.
class Wall final : public sim::RayCaster {
 public:
  sim::RayHit cast(const Vec3& origin_m, const Vec3& direction) const override {
    sim::RayHit hit;
    hit.range_m = -origin_m.z() / direction.z();
    hit.hit = hit.range_m > 0;
    return hit;
  }
};

}  // namespace lasso::mdat::test
