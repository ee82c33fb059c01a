// Authentication of commands: with an authenticator (fsw/core/authenticator.hpp) each packet of a command carries its trailer between
// application data and CRC.
#pragma once

#include "fsw/core/authenticator.hpp"
#include "fsw/link/space_packet.hpp"

namespace lasso {

// Takes the trailer off `data`, the end of a command's packet before its CRC, and has it judged. The packet's headers and CRC are right.
PacketFault authenticate(ConstBytes packet, Authenticator& authenticator, ConstBytes& data);

}  // namespace lasso
