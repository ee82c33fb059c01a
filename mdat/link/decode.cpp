#include "mdat/link/decode.hpp"

#include "mdat/link/stream_crc.hpp"

namespace lasso::mdat {
namespace {

// Service, subservice and, where there is one, number.
bool is_of(const PacketRow& row, ConstBytes packet, PacketType type) {
  if (row.type != type || packet.size() < data_offset(row) + kPacketTrailerBytes) return false;
  if (row.service != packet[7] || row.subservice != packet[8]) return false;
  return !row.numbered || row.number == read_bits(packet, 8 * (data_offset(row) - kPacketNumberBytes), 8 * kPacketNumberBytes);
}

// A command may have an authentication trailer behind its items.
bool has_size_of(const PacketRow& row, std::size_t size) {
  const std::size_t own = item_offset(row, row.items.size()) + kPacketTrailerBytes;
  return row.type == PacketType::kCommand ? size >= own && size <= own + kMaxAuthenticationBytes : size == own;
}

// The row of a packet with these headers; null: none, or another length.
const PacketRow* row_of(ConstBytes packet, PacketType type) {
  for (const PacketRow& row : kPackets) {
    if (is_of(row, packet, type)) return has_size_of(row, packet.size()) ? &row : nullptr;
  }
  return nullptr;
}

DecodedItem decode_item(const ItemRow& row, ConstBytes bytes) {
  DecodedItem item{&row, {}};
  const std::size_t size = wire_size(row.type);
  for (std::size_t i = 0; i < row.count; ++i) item.values.push_back(read_number(row.type, bytes.subspan(i * size, size)));
  return item;
}

// The size of the packet that `bytes` begin with, by a header of the component; 0: another header, or not whole.
std::size_t own_packet(ConstBytes bytes, PacketType type, std::uint16_t apid) {
  if (bytes.size() < kPrimaryHeaderBytes) return 0;
  const PrimaryHeader header = read_primary_header(bytes);
  const bool own = header.version == 0 && header.type == type && header.secondary_header && header.apid == apid;
  const std::size_t size = packet_size(bytes);
  const bool fits = size >= kPrimaryHeaderBytes + kPacketTrailerBytes && size <= bytes.size();
  return own && header.sequence_flags == kUnsegmented && fits ? size : 0;
}

}  // namespace

std::vector<HeaderField> header_fields(PacketType type) {
  std::vector<HeaderField> fields(std::begin(kPrimaryFields), std::end(kPrimaryFields));
  if (type == PacketType::kTelemetry) fields.insert(fields.end(), std::begin(kTelemetryFields), std::end(kTelemetryFields));
  if (type == PacketType::kCommand) fields.insert(fields.end(), std::begin(kCommandFields), std::end(kCommandFields));
  return fields;
}

DecodedPacket decode_packet(ConstBytes bytes, PacketType type) {
  DecodedPacket packet;
  packet.bytes = bytes;
  for (const HeaderField& field : header_fields(type)) {
    if (static_cast<std::size_t>(field.bit) + field.bits > 8 * bytes.size()) break;  // shorter than its headers
    packet.header.push_back(read_bits(bytes, field.bit, field.bits));
  }
  packet.row = row_of(bytes, type);
  if (packet.row == nullptr) return packet;
  std::size_t at = data_offset(*packet.row);
  for (const ItemRow& row : packet.row->items) {
    packet.items.push_back(decode_item(row, bytes.subspan(at, row.size())));
    at += row.size();
  }
  return packet;
}

DecodedStream decode_stream(ConstBytes stream, PacketType type, std::uint16_t apid) {
  const StreamCrc crc(stream);
  DecodedStream decoded;
  std::size_t in_packets = 0;
  for (std::size_t at = 0; at < stream.size();) {
    const std::size_t size = own_packet(stream.subspan(at, stream.size() - at), type, apid);
    if (size == 0 || !crc.right(at, size)) {
      ++at;
      continue;
    }
    decoded.packets.push_back(decode_packet(stream.subspan(at, size), type));
    decoded.packets.back().offset = at;
    in_packets += size;
    at += size;
  }
  decoded.other_bytes = stream.size() - in_packets;
  return decoded;
}

std::uint16_t apid_of(ConstBytes bytes) { return bytes.size() < kPrimaryHeaderBytes ? kApid : read_primary_header(bytes).apid; }

}  // namespace lasso::mdat
