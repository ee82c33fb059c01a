#include "mdat/link/decode.hpp"

#include <map>
#include <utility>

#include "fsw/core/crc.hpp"
#include "fsw/link/packet_finder.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kLargestPacket = kPrimaryHeaderBytes + 0x10000;

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

DecodedStream decode_stream(ConstBytes stream, PacketType type) {
  std::vector<std::uint8_t> buffer(kLargestPacket);
  PacketFinder finder(type, Bytes(buffer.data(), buffer.size()));
  DecodedStream decoded;
  std::size_t taken = 0, in_packets = 0;
  while (true) {
    taken += finder.take(stream.subspan(taken, stream.size() - taken));
    const std::size_t size = finder.packet().size();
    if (size == 0 && !finder.give_up()) break;
    if (size == 0) continue;
    // The finder's bytes are those of the stream, in order: this packet begins behind the earlier ones and what was skipped.
    const std::size_t offset = in_packets + finder.skipped();
    decoded.packets.push_back(decode_packet(stream.subspan(offset, size), type));
    decoded.packets.back().offset = offset;
    in_packets += size;
  }
  decoded.other_bytes = stream.size() - in_packets;
  return decoded;
}

HeaderList list_headers(ConstBytes stream) {
  HeaderList list;
  std::map<std::pair<PacketType, std::uint16_t>, std::uint16_t> last;  // count by type and APID
  std::size_t at = 0;
  while (at < stream.size()) {
    const ConstBytes rest = stream.subspan(at, stream.size() - at);
    const std::size_t size = packet_size(rest);
    if (size == 0 || size > rest.size() || read_primary_header(rest).version != 0) break;
    HeaderLine line{at, size, read_primary_header(rest), crc16_ccitt(rest.first(size)) == 0, 0};
    const std::pair key(line.header.type, line.header.apid);
    const auto before = last.find(key);
    const std::uint32_t ahead = before == last.end() ? 1U : (line.header.sequence_count - before->second + 0U) & kSequenceCountMask;
    line.behind = ahead == 0 || ahead > kSequenceCountMask / 2;
    line.missing = line.behind ? 0 : ahead - 1;
    if (!line.behind) last[key] = line.header.sequence_count;
    list.lines.push_back(line);
    at += size;
  }
  list.left_over = stream.size() - at;
  return list;
}

}  // namespace lasso::mdat
