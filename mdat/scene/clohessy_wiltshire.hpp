// Relative motion near a circular orbit by the equations of Clohessy and Wiltshire (1960), in closed form, in the Hill frame (orbit.hpp):
// x radial, y along the track, z across it. They hold while distances are small against the orbit's radius.
#pragma once

#include <string>
#include <vector>

#include "mdat/scene/motion.hpp"

namespace lasso::mdat::scene {

// Position and velocity in the Hill frame.
struct RelativeState {
  Vec3 p_m = Vec3::Zero(), v_mps = Vec3::Zero();
};

// Free drift for t_s, of any sign.
RelativeState drift(const RelativeState& begin, double mean_motion_radps, double t_s);

// A flight plan: legs one after the other from a start. Impulses change the velocity at the legs' ends. The node keeps the Hill axes:
// chains add an attitude. Before the plan it rests at the start, but for a plan that begins with a drift, which has come from before. After
// the plan it rests where the last leg ends, but for a drift, which goes on.
class ClohessyWiltshire final : public Motion {
 public:
  enum class LegKind : std::uint8_t {
    kHold,      // at rest in the Hill frame: a hold point, kept by thrust
    kDrift,     // free, from `vector` as its velocity in m/s
    kTransfer,  // free, from an impulse that brings it to the way point `vector`, in m, where a second impulse stops it
  };
  struct Leg {
    LegKind kind = LegKind::kHold;
    double duration_s = 0;  // > 0
    Vec3 vector = Vec3::Zero();
  };
  struct Setup {
    double mean_motion_radps = 0;  // of the orbit (Orbit::mean_motion_radps)
    Vec3 start_m = Vec3::Zero();   // at t = 0
    std::vector<Leg> legs;         // none: it rests at the start
  };
  explicit ClohessyWiltshire(const Setup& setup, const Place& place = {});
  MotionState at(TimeUs t_us) const override;

 private:
  struct Piece {
    double from_s = 0;   // until the next one's
    double epoch_s = 0;  // of its state
    RelativeState state;
    bool free = false;  // or at rest
  };
  void add_leg(const Leg& leg, const std::string& name, Problems& problems);

  double mean_motion_radps_;
  std::vector<Piece> pieces_;  // the first from ever
  double end_s_ = 0;           // of the legs so far, and where they end
  Vec3 end_m_;
};

}  // namespace lasso::mdat::scene
