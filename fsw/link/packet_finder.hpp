// Framing of byte streams: packets follow each other without anything between them, and a packet is found by its own header and CRC.
//
// A packet may begin where version, type, secondary header flag, APID and sequence flags are those of the packets that are looked for, and
// the data length is one that the buffer holds. It is a packet when its CRC is right. Where either fails, the search goes on with the next
// byte: so no packet is lost after garbage of any length, and none within it. What looks like a header but is none delays the packets
// behind it, until as many bytes have come as it states (at most the buffer's) or the caller gives it up. Garbage passes for a packet as
// often as a CRC is right by chance, 1 in 2^16, where it has a header. Nothing is allocated: the buffer is the caller's.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"
#include "fsw/link/space_packet.hpp"

namespace lasso {

class PacketFinder {
 public:
  // Of the packets of the component `apid`. `buffer` outlives the finder and holds at least a primary header; a packet that it does not
  // hold is none.
  PacketFinder(PacketType type, Bytes buffer, std::uint16_t apid = kApid) : type_(type), apid_(apid), buffer_(buffer) {}

  // Takes bytes until a packet is whole or `input` has no more, and returns how many it took. Call it again with the others. Loop bound:
  // bytes of buffer and input; each costs at most one checksum over the buffer.
  std::size_t take(ConstBytes input);

  // For where the rest of a packet will not come: drops the byte at which it seemed to begin, so that the next take() looks behind it.
  // False: nothing waits.
  bool give_up();

  // The packet that the last take() found, until the next one; empty: none.
  ConstBytes packet() const { return {buffer_.data(), found_}; }
  // Bytes that belonged to no packet, so far. Wraps.
  std::uint32_t skipped() const { return skipped_; }
  // Bytes that wait for the rest of a packet.
  std::size_t waiting() const { return size_ - found_; }

 private:
  enum class Candidate : std::uint8_t { kNone, kOpen, kPacket };
  bool search();
  Candidate candidate(std::size_t at) const;
  bool may_begin(ConstBytes bytes) const;
  void drop(std::size_t bytes);

  PacketType type_;
  std::uint16_t apid_;
  Bytes buffer_;
  std::size_t size_ = 0;
  std::size_t found_ = 0;
  std::uint32_t skipped_ = 0;
};

}  // namespace lasso
