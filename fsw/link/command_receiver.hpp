// Bytes from the ground become commands: found, checked, counted. A command is accepted once: its sequence count has to be after the last
// accepted one's by less than half of all counts, so that what was recorded is refused when it is sent again.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"
#include "fsw/link/commands.hpp"
#include "fsw/link/packet_finder.hpp"

namespace lasso {

class CommandReceiver {
 public:
  // For the component `apid`.
  explicit CommandReceiver(std::uint16_t apid = kApid) : apid_(apid), finder_(PacketType::kCommand, Bytes(buffer_), apid) {}
  CommandReceiver(const CommandReceiver&) = delete;
  CommandReceiver& operator=(const CommandReceiver&) = delete;

  // From now on commands are authenticated. It outlives the receiver.
  void use_authenticator(Authenticator& authenticator) { authenticator_ = &authenticator; }

  // Takes bytes until a packet is whole; how many. Loop bound: the bytes, each at most one checksum over kMaxCommandBytes.
  std::size_t take(ConstBytes input);
  // No more bytes will come of what seems to have begun: looks behind it. False: nothing waits. Loop bound as of take().
  bool give_up();

  // What take() or give_up() found; empty: nothing.
  ConstBytes packet() const { return finder_.packet(); }
  // Decodes and counts a packet. When it is refused, `command` and the sequence are as they were.
  PacketFault accept(ConstBytes packet, Command& command);
  // Does the last packet that was decoded come from who may command? The authenticator says so; without one, that it was accepted does.
  bool from_operator() const { return from_operator_; }

  std::uint32_t accepted() const { return accepted_; }
  std::uint32_t refused() const { return refused_; }
  PacketFault last_fault() const { return last_fault_; }
  std::uint32_t skipped() const { return finder_.skipped(); }

 private:
  PacketFault check(ConstBytes packet, Command& command);

  std::uint16_t apid_;
  std::uint8_t buffer_[kMaxCommandBytes] = {};
  PacketFinder finder_;
  Authenticator* authenticator_ = nullptr;
  bool from_operator_ = false;
  bool heard_ = false;  // the count below is that of a command
  std::uint16_t last_count_ = 0;
  std::uint32_t accepted_ = 0;
  std::uint32_t refused_ = 0;
  PacketFault last_fault_ = PacketFault::kNone;
};

}  // namespace lasso
