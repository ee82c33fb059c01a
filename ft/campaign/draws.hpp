// What campaigns draw at random.
#pragma once

#include <cmath>

#include "fsw/geometry/se3.hpp"
#include "fsw/geometry/so3.hpp"
#include "hal_sim/random.hpp"

namespace lasso::campaign {

// The generator of one trial: it depends on the campaign's seed and the trial's number alone.
inline sim::Random trial_stream(std::uint64_t seed, std::uint32_t trial) { return sim::ray_stream(seed, trial, 0); }

inline Vec3 draw_in_box(sim::Random& random) { return {random.uniform() * 2 - 1, random.uniform() * 2 - 1, random.uniform() * 2 - 1}; }

inline Vec3 draw_direction(sim::Random& random) {
  for (;;) {
    const Vec3 v = draw_in_box(random);
    if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
  }
}

// Any attitude is as likely as any other.
inline Quat draw_attitude(sim::Random& random) {
  for (;;) {
    const Quat q(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    if (q.norm() > 0.1 && q.norm() < 1) return q.normalized();
  }
}

// The pose turned by up to `turn_rad` about a random axis, and shifted by up to `shift_m` on each axis.
inline Pose disturbed(const Pose& pose, double turn_rad, double shift_m, sim::Random& random) {
  Pose result;
  const double angle = (random.uniform() * 2 - 1) * turn_rad;
  result.q = exp_so3(angle * draw_direction(random)) * pose.q;
  result.p = pose.p + shift_m * draw_in_box(random);
  return result;
}

}  // namespace lasso::campaign
