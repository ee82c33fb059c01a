#include "fsw/link/commands.hpp"

#include "fsw/link/command_rows.hpp"

namespace lasso {
namespace {

constexpr auto kMode = codec_of(command_rows::kMode);
constexpr auto kHold = codec_of(command_rows::kHold);
constexpr auto kStart = codec_of(command_rows::kStart);
constexpr auto kModeLimits = limits_of(command_rows::kMode);
constexpr auto kHoldLimits = limits_of(command_rows::kHold);
constexpr auto kStartLimits = limits_of(command_rows::kStart);

template <class Arguments, std::size_t kRows>
PacketFault read_arguments(ByteReader& in, const Codec<Arguments, kRows>& codec, const Limits<Arguments, kRows>& limits, Arguments& out) {
  if (in.remaining() != codec.bytes) return PacketFault::kBadLength;
  codec.read(in, out);
  return limits.hold(out) ? PacketFault::kNone : PacketFault::kBadArgument;
}

PacketFault decode_function(ByteReader& in, Command& command) {
  const std::uint16_t number = in.u16();
  command.kind = static_cast<CommandKind>(number);
  if (number == static_cast<std::uint16_t>(CommandKind::kMode)) return read_arguments(in, kMode, kModeLimits, command.mode);
  if (number == static_cast<std::uint16_t>(CommandKind::kHold)) return read_arguments(in, kHold, kHoldLimits, command.hold);
  if (number == static_cast<std::uint16_t>(CommandKind::kStart)) return read_arguments(in, kStart, kStartLimits, command.start);
  return PacketFault::kUnknown;
}

PacketFault decode_data(ConstBytes data, Command& command) {
  const CommandHeader& header = command.header;
  ByteReader in(data);
  if (header.service == kServiceTest && header.subservice == kSubservicePing) {
    return data.empty() ? PacketFault::kNone : PacketFault::kBadLength;
  }
  if (header.service != kServiceFunction || header.subservice != kSubservicePerform) return PacketFault::kUnknown;
  return decode_function(in, command);
}

}  // namespace

PacketFault decode_command(ConstBytes packet, Command& command) {
  Command decoded;
  ConstBytes data;
  PacketFault fault = parse_command(packet, decoded.header, data);
  if (fault == PacketFault::kNone) fault = decode_data(data, decoded);
  if (fault == PacketFault::kNone) command = decoded;
  return fault;
}

}  // namespace lasso
