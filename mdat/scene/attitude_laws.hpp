// Attitudes that follow a law. The node stays at the parent's origin: a chain of a position and a law has both.
//
// In an orbit the parent is the Hill frame (orbit.hpp). What is fixed there, such as an attitude to nadir, is Still.
#pragma once

#include "mdat/scene/motion.hpp"
#include "mdat/scene/orbit.hpp"

namespace lasso::mdat::scene {

// An axis of the node points somewhere; the roll about it brings `up_node` as near to `up_base` as can be.
struct Pointing {
  Vec3 axis_node = Vec3::UnitZ();  // unit
  Vec3 up_node = -Vec3::UnitY();   // unit, not along the axis
  Vec3 up_base = Vec3::UnitZ();    // unit, in the axes that the attitude refers to: the roll reference
};
void check_pointing(const Pointing& pointing, Problems& problems);

// Attitude and angular velocity, in base axes, of a node whose axis points along `way`, any length but 0, which changes by `way_rate`.
// Where the way is within 1e-6 rad of the roll reference, or has no length, the roll reference is the base axis farthest from it.
MotionState point_along(const Pointing& pointing, const Vec3& way, const Vec3& way_rate);

// Inertial: still in axes that do not turn with the orbit, q_hill_node at t = 0. In the Hill frame it turns back by the mean motion.
ConstantRates inertial_attitude(const Orbit& orbit, const Quat& q_hill_node, const Place& place = {});

// The axis to the Sun. The roll reference has to stay 0.6 deg or more from the Sun's direction, and from its opposite, all along the orbit.
class SunPointing final : public Motion {
 public:
  SunPointing(const Orbit& orbit, const Pointing& pointing, const Place& place = {});
  MotionState at(TimeUs t_us) const override;

 private:
  Orbit orbit_;
  Pointing pointing_;
};

}  // namespace lasso::mdat::scene
