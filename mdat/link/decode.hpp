// Streams of packets, by the dictionary.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fsw/link/dictionary.hpp"
#include "fsw/link/space_packet.hpp"
#include "mdat/link/number.hpp"

namespace lasso::mdat {

struct DecodedItem {
  const ItemRow* row = nullptr;
  std::vector<Number> values;  // row->count of them
};

struct DecodedPacket {
  std::size_t offset = 0;             // in the stream
  ConstBytes bytes;                   // of the stream
  std::vector<std::uint64_t> header;  // of the fields of header_fields()
  const PacketRow* row = nullptr;     // null: not in the dictionary, or not as long as its items
  std::vector<DecodedItem> items;
  const char* name() const { return row != nullptr ? row->name : "unknown"; }
};

struct DecodedStream {
  std::vector<DecodedPacket> packets;
  std::size_t other_bytes = 0;  // that belong to no packet
};

// Of the primary and the secondary header, in the order of the wire.
std::vector<HeaderField> header_fields(PacketType type);

// The packets of the component `apid` in `stream`, which outlives them: found by their headers and CRC, whatever lies between them.
DecodedStream decode_stream(ConstBytes stream, PacketType type, std::uint16_t apid = kApid);

// The packet at the start of `bytes`, which has to be whole and its CRC right.
DecodedPacket decode_packet(ConstBytes bytes, PacketType type);

// Whose the packet at the start of `bytes` is; of less than a primary header the preset.
std::uint16_t apid_of(ConstBytes bytes);

}  // namespace lasso::mdat
