// A rigid body that tumbles without torque: the exact solution, at any time, of any body.
#pragma once

#include "mdat/scene/elliptic.hpp"
#include "mdat/scene/motion.hpp"

namespace lasso::mdat::scene {

// The parent's axes are inertial, the node's are principal axes of inertia, and its origin is the centre of mass, which stays. Chains say
// all else: a node about another point, a centre of mass that drifts, a parent that turns (attitude_laws.hpp: inertial_attitude).
//
// Angular velocities by Jacobi's elliptic functions, the attitude by the angle of precession about the angular momentum, an elliptic
// integral of the third kind (Landau and Lifshitz, Mechanics, 37; NIST Handbook of Mathematical Functions, 19.25 and 22.20). Energy and
// angular momentum hold to rounding. A state within rounding of the one that parts tumbling about the axis of the greatest moment from
// tumbling about that of the least is known no better than its numbers: there the next flip's time is uncertain. Boost takes a
// logarithm of the C library: between machines whose libraries differ, last bits may.
class TorqueFree final : public Motion {
 public:
  struct Setup {
    Pose T_parent_node;                    // at t = 0
    Vec3 omega_node_radps = Vec3::Zero();  // at t = 0, the node's axes
    Vec3 inertia = Vec3::Ones();           // principal moments about the node's axes, in any unit: their ratios matter
  };
  explicit TorqueFree(const Setup& setup, const Place& place = {});
  MotionState at(TimeUs t_us) const override;

 private:
  void solve(const Mat3& R_node_top);
  Vec3 omega_top_radps(const Amplitude& amplitude) const;
  Mat3 momentum_axes(const Vec3& omega_top) const;

  Setup setup_;
  bool spins_ = true;  // about a principal axis, or any of a sphere: the angular velocity is constant
  // The axes of the top: 3 is the one about which it goes round, 1 the other outer one, 2 the middle one.
  Mat3 R_node_top_ = Mat3::Identity();
  Vec3 inertia_top_ = Vec3::Ones(), peak_top_radps_ = Vec3::Zero();
  double m1_ = 1, characteristic_ = 0;  // of the elliptic functions and the integral
  double pace_ = 0, phase_ = 0;         // u = pace * t + phase
  double precession_radps_ = 0, precession_factor_ = 0, precession_begin_ = 0;
  Mat3 R_node_momentum_ = Mat3::Identity();  // at t = 0
};

}  // namespace lasso::mdat::scene
