// Bytes that claim to be commands, one packet and a stream of them. What the decoder accepts must encode to the same bytes again; what the
// finder finds in a stream, in pieces, must be what looking at every place of it finds. The first byte: bit 0 leaves length and checksum
// as they are, bit 1 puts the packet between two halves of itself; the others say how large the pieces are.
#include <algorithm>
#include <vector>

#include "fsw/core/crc.hpp"
#include "fsw/link/command_rows.hpp"
#include "fsw/link/packet.hpp"
#include "fsw/link/packet_finder.hpp"
#include "fsw/link/telecommand.hpp"
#include "ft/fuzz/exact.hpp"
#include "ft/fuzz/repair.hpp"

namespace lasso::fuzz {
namespace {

using Packets = std::vector<std::vector<std::uint8_t>>;
constexpr std::size_t kRoom = kMaxCommandBytes;
constexpr std::size_t kLargestBytes = 1024;  // more of the same would take longer

void check_command(ConstBytes packet) {
  CommandHeader header;
  ConstBytes data;
  if (parse_command(packet, header, data) != PacketFault::kNone) return expect(data.empty(), "a refused command gives no data");
  std::vector<std::uint8_t> again(packet.size());
  const Bytes out(again.data(), again.size());
  ByteWriter writer(out);
  begin_command(header, writer);
  writer.bytes(data);
  expect(finish_packet(writer, out) == packet.size(), "an accepted command encodes to its own size");
  expect(std::equal(again.begin(), again.end(), packet.begin()), "and to its own bytes");
}

template <class Arguments, std::size_t kRows>
void expect_same(ConstBytes packet, CommandKind kind, const TypedRow<Arguments> (&rows)[kRows], const Arguments& arguments) {
  const auto codec = codec_of(rows);
  std::vector<std::uint8_t> again(codec.bytes);
  ByteWriter writer{Bytes(again.data(), again.size())};
  codec.write(arguments, writer);
  const std::size_t begin = kCommandHeaderBytes + (command_rows::row_of(kind).numbered ? kPacketNumberBytes : 0);
  expect(begin + codec.bytes + kPacketTrailerBytes == packet.size(), "the arguments of a command fill it");
  expect(std::equal(again.begin(), again.end(), packet.begin() + begin), "and encode to their own bytes");
}

void check_arguments(ConstBytes packet) {
  Command command;
  if (decode_command(packet, command) != PacketFault::kNone) return;
  if (command.kind == CommandKind::kMode) expect_same(packet, command.kind, command_rows::kMode, command.mode);
  if (command.kind == CommandKind::kHold) expect_same(packet, command.kind, command_rows::kHold, command.hold);
  if (command.kind == CommandKind::kStart) expect_same(packet, command.kind, command_rows::kStart, command.start);
  const bool of_event = command.kind == CommandKind::kEnableEvent || command.kind == CommandKind::kDisableEvent;
  const bool of_memory = command.kind == CommandKind::kDumpMemory || command.kind == CommandKind::kCheckMemory;
  if (of_memory) expect_same(packet, command.kind, memory_rows::kRange, command.memory);
  if (command.kind == CommandKind::kLoadMemory) expect_same(packet, command.kind, memory_rows::kLoad, command.load);
  if (command.kind == CommandKind::kBeginImage) expect_same(packet, command.kind, memory_rows::kBegin, command.image);
  if (of_event) expect_same(packet, command.kind, command_rows::kEvent, command.event);
}

// The same rule, applied at every place.
bool is_packet(ConstBytes rest, std::size_t& size) {
  if (rest.size() < kPrimaryHeaderBytes) return false;
  const PrimaryHeader header = read_primary_header(rest);
  size = packet_size(rest);
  return header.version == 0 && header.type == PacketType::kCommand && header.secondary_header && header.apid == kApid &&
         header.sequence_flags == kUnsegmented && size >= kPrimaryHeaderBytes + kPacketTrailerBytes && size <= kRoom &&
         size <= rest.size() && crc16_ccitt(rest.first(size)) == 0;
}

Packets packets_by_places(ConstBytes stream) {
  Packets packets;
  for (std::size_t at = 0; at < stream.size();) {
    std::size_t size = 0;
    const ConstBytes rest = stream.subspan(at, stream.size() - at);
    const bool found = is_packet(rest, size);
    if (found) packets.emplace_back(rest.begin(), rest.begin() + size);
    at += found ? size : 1;
  }
  return packets;
}

Packets packets_by_finder(ConstBytes stream, std::size_t piece) {
  const std::vector<std::uint8_t> zeros(kRoom);
  ExactCopy buffer(ConstBytes(zeros.data(), zeros.size()));
  PacketFinder finder(PacketType::kCommand, buffer.bytes());
  Packets packets;
  std::size_t at = 0, in_packets = 0;
  while (true) {
    at += finder.take(stream.subspan(at, std::min(piece, stream.size() - at)));
    if (finder.packet().empty() && at < stream.size()) continue;
    if (finder.packet().empty() && !finder.give_up()) break;
    if (!finder.packet().empty()) packets.emplace_back(finder.packet().begin(), finder.packet().end());
    in_packets += finder.packet().size();
  }
  expect(finder.skipped() == stream.size() - in_packets, "every byte is of a packet or skipped");
  return packets;
}

void run(ConstBytes input, std::uint8_t options) {
  ExactCopy packet(input);
  if ((options & 1) == 0) repair(packet.bytes());
  check_command(packet.bytes());
  check_arguments(packet.bytes());
  std::vector<std::uint8_t> stream(packet.bytes().begin(), packet.bytes().end());
  if ((options & 2) != 0) {
    const std::size_t half = stream.size() / 2;
    const std::vector<std::uint8_t> whole = stream;
    stream.insert(stream.begin(), whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(half));
    stream.insert(stream.end(), whole.begin() + static_cast<std::ptrdiff_t>(half), whole.end());
  }
  ExactCopy exact(ConstBytes(stream.data(), stream.size()));
  const std::size_t piece = std::size_t{1} + (options >> 2);
  expect(packets_by_finder(exact.bytes(), piece) == packets_by_places(exact.bytes()), "the finder finds what is there");
}

}  // namespace
}  // namespace lasso::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 0) lasso::fuzz::run({data + 1, std::min(size - 1, lasso::fuzz::kLargestBytes)}, data[0]);
  return 0;
}
