#include "fsw/link/command_receiver.hpp"

namespace lasso {
namespace {

constexpr std::uint16_t kReplayWindow = 1U << 13;  // half of all sequence counts

}  // namespace

std::size_t CommandReceiver::take(ConstBytes input) { return finder_.take(input); }

bool CommandReceiver::give_up() {
  static_cast<void>(finder_.take({}));  // the packet behind the last one may be whole
  if (!finder_.packet().empty()) return true;
  if (!finder_.give_up()) return false;
  static_cast<void>(finder_.take({}));
  return true;
}

PacketFault CommandReceiver::accept(ConstBytes packet, Command& command) {
  Command received;
  const PacketFault fault = check(packet, received);
  if (fault != PacketFault::kNone) {
    ++refused_;
    last_fault_ = fault;
    return fault;
  }
  from_operator_ = true;
  heard_ = true;
  last_count_ = received.header.sequence_count;
  ++accepted_;
  command = received;
  return fault;
}

PacketFault CommandReceiver::check(ConstBytes packet, Command& command) {
  const PacketFault fault = decode_command(packet, command, authenticator_, apid_, from_operator_);
  if (fault != PacketFault::kNone) return fault;
  const auto ahead = static_cast<std::uint16_t>((command.header.sequence_count - last_count_) & kSequenceCountMask);
  const bool repeated = heard_ && (ahead == 0 || ahead >= kReplayWindow);
  return repeated ? PacketFault::kRepeated : PacketFault::kNone;
}

}  // namespace lasso
