// What a frame has room for of what comes from the ground. Commands of who may command, what makes safe, and packets of nobody who may
// command have room of their own each: so a flood of the last kind takes nothing from the first two, and is hardly answered.
#pragma once

#include <cstdint>

#include "cfg/capacities.hpp"
#include "fsw/link/commands.hpp"

namespace lasso {

class FrameRoom {
 public:
  // May the next packet be looked at in this frame? Where the commands are used up, what makes the component `apid` safe still may.
  bool takes(ConstBytes packet, std::uint16_t apid = kApid) const;
  // It was, and the receiver said this of it. Is its sender answered? Who may command always is; of the others' refusals so many in a
  // frame. Those whose sequence count alone is wrong are counted apart: without an authenticator an operator is among them.
  bool spend(PacketFault fault, bool from_operator);
  // A frame begins.
  void renew() { *this = FrameRoom(); }

 private:
  std::uint32_t commands_ = kMaxCommandsPerFrame, urgent_ = kMaxUrgentPerFrame;
  std::uint32_t strangers_ = kMaxStrangersPerFrame;
  std::uint32_t refusals_ = kMaxRefusalsPerFrame, recounts_ = kMaxRefusalsPerFrame;
};

}  // namespace lasso
