#include "mdat/scene/attitude_laws.hpp"

#include <cmath>

#include "fsw/geometry/portable_math.hpp"

namespace lasso::mdat::scene {
namespace {

constexpr double kLeastRoll = 1e-6;  // sine of the angle between way and roll reference
constexpr double kLeastRollOfSun = 0.01;

double length(const Vec3& v) { return square_root(v.squaredNorm()); }

void require_unit(const Vec3& v, const char* key, Problems& problems) {
  problems.require(std::fabs(v.norm() - 1) <= 1e-6, key, "", "is not of unit length: divide it by its length");
}

// The way as first column, the reference's part across it as second one.
Mat3 axes_along(const Vec3& unit, const Vec3& reference) {
  Mat3 axes;
  axes.col(0) = unit;
  axes.col(1) = reference - reference.dot(unit) * unit;
  axes.col(1) /= length(axes.col(1));
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

Vec3 farthest_axis(const Vec3& unit) {
  Eigen::Index axis = 0;
  unit.cwiseAbs().minCoeff(&axis);
  return Vec3::Unit(axis);
}

}  // namespace

void check_pointing(const Pointing& pointing, Problems& problems) {
  require_unit(pointing.axis_node, "axis", problems);
  require_unit(pointing.up_node, "up", problems);
  require_unit(pointing.up_base, "roll reference", problems);
  problems.require(!(pointing.axis_node.cross(pointing.up_node).norm() < kLeastRollOfSun), "up", "",
                   "lies along the axis: expected another direction of the node, best at right angles");
}

MotionState point_along(const Pointing& pointing, const Vec3& way, const Vec3& way_rate) {
  const double distance = length(way);
  const Vec3 unit = distance > 0 ? Vec3(way / distance) : pointing.axis_node;
  const Vec3 unit_rate = distance > 0 ? Vec3((way_rate - unit.dot(way_rate) * unit) / distance) : Vec3(Vec3::Zero());
  const bool rolls = length(unit.cross(pointing.up_base)) >= kLeastRoll;
  const Vec3 reference = rolls ? pointing.up_base : farthest_axis(unit);
  const Mat3 axes = axes_along(unit, reference);
  // The reference's part across the way changes with the way: what of it is across both is a turn about the way.
  const double roll_radps = -reference.dot(unit) * axes.col(2).dot(unit_rate) / axes.col(1).dot(reference);
  MotionState state;
  state.T_a_b.q = to_quaternion(axes * axes_along(pointing.axis_node, pointing.up_node).transpose());
  state.rates.omega_radps = unit.cross(unit_rate) + roll_radps * unit;
  return state;
}

ConstantRates inertial_attitude(const Orbit& orbit, const Quat& q_hill_node, const Place& place) {
  return ConstantRates({{q_hill_node, Vec3::Zero()}, {Vec3(0, 0, -orbit.mean_motion_radps()), Vec3::Zero()}}, place);
}

SunPointing::SunPointing(const Orbit& orbit, const Pointing& pointing, const Place& place) : orbit_(orbit), pointing_(pointing) {
  Problems problems(place);
  check_pointing(pointing, problems);
  problems.throw_if_any();
  // The Sun goes round the cross-track axis at a constant height: the reference is nearest to it, or to its opposite, in one plane.
  const double sun_height = arc_sine(orbit.sun_hill(0).z()), reference_height = arc_sine(clamp(pointing.up_base.z(), -1, 1));
  const double nearest = std::fmin(std::fabs(sun_height - reference_height), std::fabs(sun_height + reference_height));
  problems.require(nearest >= kLeastRollOfSun, "roll reference", "",
                   "meets the Sun's direction, or its opposite, during an orbit: choose another one, such as across the track");
  problems.throw_if_any();
}

MotionState SunPointing::at(TimeUs t_us) const { return point_along(pointing_, orbit_.sun_hill(t_us), orbit_.sun_rate_hill_radps(t_us)); }

}  // namespace lasso::mdat::scene
