#include "fsw/link/arming.hpp"

namespace lasso {

void Arming::arm(const CommandName& name) {
  name_ = name;
  frames_left_ = kArmFrames;
}

bool Arming::fire(const CommandName& name, Hazard hazard) {
  const bool fires = armed() && name_ == name;
  frames_left_ = fires && hazard == Hazard::kRenewed ? kArmFrames : 0;
  return fires;
}

bool Arming::pass_boundary() {
  if (frames_left_ == 0) return false;
  --frames_left_;
  return frames_left_ == 0;
}

}  // namespace lasso
