// How a node of a scene moves in its parent. A motion is a pure function of time: no hidden state, any time, the same bits each time.
//
// Time is in whole microseconds since the scene's epoch, as the times of samples are, so that steps fall on the frames' beginnings exactly.
#pragma once

#include <cstdint>
#include <memory>

#include "fsw/core/time.hpp"
#include "fsw/geometry/se3.hpp"
#include "mdat/scene/problems.hpp"

namespace lasso::mdat::scene {

// Where frame b is in frame a, and how it moves there. `rates` is in the axes of a: the angular velocity of b relative to a, and the
// velocity of the origin of b. They are the derivative of the pose (but at an instant of a jump).
struct MotionState {
  Pose T_a_b;
  Twist rates;
};

MotionState operator*(const MotionState& a_b, const MotionState& b_c);  // state of c in a
MotionState inverse(const MotionState& a_b);                            // state of a in b

class Motion {
 public:
  virtual ~Motion() = default;
  virtual MotionState at(TimeUs t_us) const = 0;  // of the node (b) in its parent (a)
  // Whether it costs so little that each ray may ask for it (PoseLookup serves all others).
  virtual bool is_quick() const { return false; }
};
using MotionPtr = std::shared_ptr<const Motion>;

// Constructors below throw MissionError with all problems of what they are given, at `place`.

class Still final : public Motion {
 public:
  explicit Still(const Pose& T_parent_node, const Place& place = {});
  MotionState at(TimeUs t_us) const override;
  bool is_quick() const override { return true; }

 private:
  Pose T_parent_node_;
};

// Constant velocity of a point of the node, the pivot, and constant angular velocity about it, both in the parent's axes.
class ConstantRates final : public Motion {
 public:
  struct Setup {
    Pose T_parent_pivot;               // at t = 0: the pivot's position, the node's attitude
    Twist rates;                       // v_mps is the pivot's
    Vec3 pivot_node_m = Vec3::Zero();  // the pivot in the node's frame
  };
  explicit ConstantRates(const Setup& setup, const Place& place = {});
  MotionState at(TimeUs t_us) const override;
  bool is_quick() const override { return true; }

 private:
  Setup setup_;
};

// A turn at the beginning of each period, and no motion between, as in the laboratory test of the 3DLASSO paper: 1 deg a frame.
class Steps final : public Motion {
 public:
  struct Setup {
    Pose T_parent_node;              // of step 0, which begins at t = 0; before it, steps count down from -1
    Vec3 axis_node = Vec3::UnitX();  // unit, node's axes, through the node's origin
    double step_rad = 0;             // right-handed about the axis
    DurationUs period_us = 200000;   // > 0
  };
  explicit Steps(const Setup& setup, const Place& place = {});
  MotionState at(TimeUs t_us) const override;  // rates are zero: the steps happen between the periods
  bool is_quick() const override { return true; }
  std::int64_t step_of(TimeUs t_us) const;

 private:
  Setup setup_;
};

// One motion on another: `outer` moves a frame in the parent, `inner` the node in that frame. Sums are chains, too: of a motion that
// keeps the parent's axes and one that keeps the origin, the first gives the position and the second the attitude.
class Chain final : public Motion {
 public:
  Chain(MotionPtr outer, MotionPtr inner);  // neither is null
  MotionState at(TimeUs t_us) const override { return outer_->at(t_us) * inner_->at(t_us); }
  bool is_quick() const override { return outer_->is_quick() && inner_->is_quick(); }

 private:
  MotionPtr outer_, inner_;
};

// The chain of a motion that keeps the parent's axes, `way`, and any other: positions and velocities add up. Nothing is lost to rounding.
class Sum final : public Motion {
 public:
  Sum(MotionPtr way, MotionPtr motion);  // neither is null
  MotionState at(TimeUs t_us) const override;
  bool is_quick() const override { return way_->is_quick() && motion_->is_quick(); }

 private:
  MotionPtr way_, motion_;
};

}  // namespace lasso::mdat::scene
