// Where the packets of a stream are, whoever's they are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fsw/core/span.hpp"
#include "fsw/link/space_packet.hpp"
#include "mdat/link/stream_crc.hpp"

namespace lasso::mdat {

struct PacketPlace {
  std::size_t offset = 0;
  std::size_t size = 0;
};

constexpr std::uint16_t kIdleApid = 0x7FF;

// In the order of the stream, none over another. Three ways:
// - packet after packet from the first byte to the last, by their lengths;
// - packets whose checksums are right, of applications that are believed; between and behind them packets with wrong or no checksums that
//   fill the room by their lengths, so that other bytes are skipped;
// - packets without checksums, each behind a prefix of the same length (at most 32 bytes), most of them of the same applications.
// The first holds where it explains the stream, then the second where its packets are more than half of the stream; otherwise the one of
// the two with more packets whose count follows the one before. A header of six zero bytes is fill. The time is linear in the stream's
// length.
std::vector<PacketPlace> packet_places(ConstBytes stream, const StreamCrc& crc);

}  // namespace lasso::mdat
