#include "mdat/scene/motion.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "hal_sim/scan_text.hpp"

namespace lasso::mdat::scene {
namespace {

void require_pose(const Pose& pose, const char* key, Problems& problems) {
  problems.require(is_valid(pose), key, "", "is not a pose: expected finite numbers and a quaternion of unit length");
}

}  // namespace

MotionState operator*(const MotionState& a_b, const MotionState& b_c) {
  const Quat& q_a_b = a_b.T_a_b.q;
  const Vec3 lever_a = rotate(q_a_b, b_c.T_a_b.p);
  MotionState a_c;
  a_c.T_a_b = a_b.T_a_b * b_c.T_a_b;
  a_c.rates.omega_radps = a_b.rates.omega_radps + rotate(q_a_b, b_c.rates.omega_radps);
  a_c.rates.v_mps = a_b.rates.v_mps + a_b.rates.omega_radps.cross(lever_a) + rotate(q_a_b, b_c.rates.v_mps);
  return a_c;
}

MotionState inverse(const MotionState& a_b) {
  const Quat q_b_a = a_b.T_a_b.q.conjugate();
  MotionState b_a;
  b_a.T_a_b = inverse(a_b.T_a_b);
  b_a.rates.omega_radps = -rotate(q_b_a, a_b.rates.omega_radps);
  b_a.rates.v_mps = rotate(q_b_a, a_b.rates.omega_radps.cross(a_b.T_a_b.p) - a_b.rates.v_mps);
  return b_a;
}

Still::Still(const Pose& T_parent_node, const Place& place) : T_parent_node_(T_parent_node) {
  Problems problems(place);
  require_pose(T_parent_node, "pose", problems);
  problems.throw_if_any();
}

MotionState Still::at(TimeUs /*t_us*/) const { return {T_parent_node_, Twist{}}; }

ConstantRates::ConstantRates(const Setup& setup, const Place& place) : setup_(setup) {
  Problems problems(place);
  require_pose(setup.T_parent_pivot, "pose", problems);
  problems.require(setup.rates.omega_radps.allFinite(), "angular velocity", "", "expected finite numbers");
  problems.require(setup.rates.v_mps.allFinite(), "velocity", "", "expected finite numbers");
  problems.require(setup.pivot_node_m.allFinite(), "pivot", "", "expected finite numbers");
  problems.throw_if_any();
}

MotionState ConstantRates::at(TimeUs t_us) const {
  MotionState state{propagate(setup_.T_parent_pivot, setup_.rates, to_seconds(t_us)), setup_.rates};
  if (setup_.pivot_node_m.isZero(0)) return state;
  const Vec3 to_origin_m = rotate(state.T_a_b.q, Vec3(-setup_.pivot_node_m));
  state.T_a_b.p += to_origin_m;
  state.rates.v_mps += state.rates.omega_radps.cross(to_origin_m);
  return state;
}

Steps::Steps(const Setup& setup, const Place& place) : setup_(setup) {
  Problems problems(place);
  require_pose(setup.T_parent_node, "pose", problems);
  problems.require(std::abs(setup.axis_node.norm() - 1) <= 1e-6, "axis", "", "is not of unit length: divide it by its length");
  problems.require(std::isfinite(setup.step_rad), "step", sim::text_of(setup.step_rad), "expected a finite angle");
  problems.require(setup.period_us > 0, "period", std::to_string(setup.period_us) + " us", "expected more than 0 us");
  problems.throw_if_any();
}

std::int64_t Steps::step_of(TimeUs t_us) const {
  const std::int64_t step = t_us / setup_.period_us;
  return t_us % setup_.period_us < 0 ? step - 1 : step;
}

MotionState Steps::at(TimeUs t_us) const {
  const Pose& begin = setup_.T_parent_node;
  const Quat turn = exp_so3(setup_.axis_node * (setup_.step_rad * static_cast<double>(step_of(t_us))));
  return {Pose{normalized(begin.q * turn), begin.p}, Twist{}};
}

Chain::Chain(MotionPtr outer, MotionPtr inner) : outer_(std::move(outer)), inner_(std::move(inner)) {
  if (outer_ == nullptr || inner_ == nullptr) throw std::invalid_argument("chain of motions: one of them is missing");
}

Sum::Sum(MotionPtr way, MotionPtr motion) : way_(std::move(way)), motion_(std::move(motion)) {
  if (way_ == nullptr || motion_ == nullptr) throw std::invalid_argument("sum of motions: one of them is missing");
}

MotionState Sum::at(TimeUs t_us) const {
  const MotionState way = way_->at(t_us);
  MotionState state = motion_->at(t_us);
  state.T_a_b.p += way.T_a_b.p;
  state.rates.v_mps += way.rates.v_mps;
  return state;
}

}  // namespace lasso::mdat::scene
