#include "fsw/exec/telemetry.hpp"

namespace lasso {

void Telemetry::pass_boundary() {
  for (const EventRecord& event : events_.records()) {
    stored_log_.note(event);
    if (!event.reported) continue;
    std::uint8_t packet[kMaxEventPacketBytes];
    const PacketHeader header = downlink_.next_header({kServiceEvent, static_cast<std::uint8_t>(event.severity)}, event.t_us);
    downlink_.send({packet, encode_event(event, header, Bytes(packet))});
  }
  events_.pass_boundary();
  housekeeping_.pass_boundary();
}

}  // namespace lasso
