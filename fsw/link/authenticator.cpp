#include "fsw/link/authenticator.hpp"

namespace lasso {

PacketFault authenticate(ConstBytes packet, Authenticator& authenticator, ConstBytes& data) {
  const std::size_t trailer = authenticator.trailer_bytes();
  if (data.size() < trailer) return PacketFault::kNotAuthentic;
  data = data.first(data.size() - trailer);
  const std::size_t covered = packet.size() - kPacketTrailerBytes - trailer;
  const bool authentic = authenticator.authentic(packet.first(covered), packet.subspan(covered, trailer));
  return authentic ? PacketFault::kNone : PacketFault::kNotAuthentic;
}

}  // namespace lasso
