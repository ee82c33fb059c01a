// A beam with a square section, which looks the same after a quarter turn about its axis, x; and one with a peg that tells the turn.
#pragma once

#include "fsw/geometry/portable_math.hpp"
#include "fsw/pose/registration/registration.hpp"
#include "ut/pose/pose_fixture.hpp"

namespace lasso::test {

constexpr double kQuarterTurn_rad = 90 * kRadPerDeg;

inline BoxModel beam() { return {{0, 0, 0}, {0.30, 0.08, 0.08}, 0.02, 0.2}; }
inline BoxModel peg() { return {{0.15, 0, -0.10}, {0.02, 0.02, 0.02}, 0.02, 0.2}; }

inline const Mission& plain_mission() {
  static const LoadedImage loaded(Boxes{beam()});
  return loaded.mission;
}
inline const Mission& pegged_mission() {
  static const LoadedImage loaded(Boxes{beam(), peg()});
  return loaded.mission;
}

class BeamTest : public PoseFixture {
 protected:
  explicit BeamTest(const Mission& mission = plain_mission()) : PoseFixture(mission) {
    scan_.model = beam();
    scan_.sigma_m = 1e-3;
    scan_.T_sensor_target.q = exp_so3(Vec3(0.7, 0.35, 0.2));
    scan_.T_sensor_target.p = Vec3(0.03, -0.02, 2.5);
  }

  Pose turned(double angle_rad) const { return step_of(angle_rad) * truth(); }
  HitSolution registered(const Pose& T_target_sensor) { return register_first(mission_, T_target_sensor, *workspace_); }
  double turn_of(const Pose& T_target_sensor) const { return log_so3(T_target_sensor.q * truth().q.conjugate())[0]; }

 private:
  static Pose step_of(double angle_rad) {
    Pose step;
    step.q = exp_so3(Vec3(angle_rad, 0, 0));
    return step;
  }
};

class PeggedBeamTest : public BeamTest {
 protected:
  PeggedBeamTest() : BeamTest(pegged_mission()) { scan_.others = {peg()}; }
};

}  // namespace lasso::test
