#include "fsw/link/arming.hpp"

namespace lasso {

void Arming::arm(const CommandName& name) {
  name_ = name;
  frames_left_.set(kArmFrames);
}

bool Arming::fire(const CommandName& name, Hazard hazard) {
  const bool fires = armed() && name_ == name;
  frames_left_.set(fires && hazard == Hazard::kRenewed ? kArmFrames : 0);
  return fires;
}

// A copy that differed is put right, of what is not armed, too.
bool Arming::pass_boundary() {
  const std::uint32_t left = frames_left();
  frames_left_.set(left > 0 ? left - 1 : 0);
  return left == 1;
}

std::uint32_t Arming::frames_left() const {
  std::uint32_t left = 0;
  static_cast<void>(frames_left_.get(left));
  return left;
}

}  // namespace lasso
