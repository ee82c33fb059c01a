#include "fsw/link/frame_room.hpp"

namespace lasso {

bool FrameRoom::takes(ConstBytes packet, std::uint16_t apid) const {
  if (strangers_ == 0) return false;
  return commands_ > 0 || (urgent_ > 0 && is_urgent(packet, apid));
}

bool FrameRoom::spend(PacketFault fault, bool from_operator) {
  if (from_operator) {
    --(commands_ > 0 ? commands_ : urgent_);
    return true;
  }
  --strangers_;
  std::uint32_t& left = fault == PacketFault::kRepeated ? recounts_ : refusals_;
  if (left == 0) return false;
  --left;
  return true;
}

}  // namespace lasso
