// Poses of a motion for many rays: a cubic between exact states, where that is as good as exact.
#pragma once

#include <cstdint>
#include <functional>

#include "mdat/scene/motion.hpp"

namespace lasso::mdat::scene {

// Time is cut into intervals of 65.536 ms from 0 on. In each a cubic of the position, and one of the rotation vector from the interval's
// begin, pass through the exact states and rates at both ends. Where at a quarter, the middle and three quarters the cubics are within
// 1e-9 rad and 1e-9 of the distance (at least of 1 m), they are taken: a smooth motion's error is below twice that. In all other intervals,
// as where it jumps or turns fast, each pose is exact. What begins and ends within one quarter, 16 ms, is not seen. A pose depends on its
// time alone. The interval in use is kept: one caller at a time.
class PoseLookup {
 public:
  using Exact = std::function<MotionState(TimeUs)>;
  explicit PoseLookup(Exact exact) : exact_(std::move(exact)) {}
  Pose at(TimeUs t_us);

 private:
  static constexpr int kIntervalBits = 16;  // of microseconds
  struct Cubic {
    Vec3 c[4];
    Vec3 at(double u) const { return c[0] + u * (c[1] + u * (c[2] + u * c[3])); }
  };
  void make_interval(std::int64_t number);
  Pose on_cubics(double u) const;
  bool is_near(const Pose& exact, double u) const;

  Exact exact_;
  std::int64_t interval_ = 0;
  bool made_ = false, smooth_ = false;
  Quat q_begin_ = Quat(1, 0, 0, 0);
  Cubic position_, rotation_;
};

}  // namespace lasso::mdat::scene
