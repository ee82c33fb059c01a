// Authentication of commands, for links that do not authenticate below this component. A board supplies it (Component::use_authenticator);
// without one, commands have no trailer. With one, each packet of a command carries the authenticator's trailer between its application
// data and its CRC. What the trailer holds (a code, a number that has to grow, a key's name) is its own business.
#pragma once

#include <cstddef>

#include "fsw/core/span.hpp"
#include "fsw/link/space_packet.hpp"

namespace lasso {

constexpr std::size_t kMaxAuthenticationBytes = 32;

class Authenticator {
 public:
  // Of its trailer: 1 to kMaxAuthenticationBytes, always the same.
  virtual std::size_t trailer_bytes() const = 0;

  // Does `trailer` show that `packet`, all bytes before it, comes from who may command, and is not sent again? Asked once for each packet
  // with right CRC and headers, before its arguments are looked at. Bounded; never waits.
  virtual bool authentic(ConstBytes packet, ConstBytes trailer) = 0;

 protected:
  ~Authenticator() = default;  // never deleted through this interface: no operator delete in flight code
};

// Takes the trailer off `data`, the end of a command's packet before its CRC, and has it judged. The packet's headers and CRC are right.
PacketFault authenticate(ConstBytes packet, Authenticator& authenticator, ConstBytes& data);

}  // namespace lasso
