#include "fsw/link/events.hpp"

namespace lasso {

std::size_t encode_event(const EventRecord& event, PacketHeader header, Bytes out) {
  header.service = kServiceEvent;
  header.subservice = static_cast<std::uint8_t>(event.severity);
  ByteWriter writer(out);
  begin_packet(header, writer);
  writer.u16(static_cast<std::uint16_t>(event.id));
  writer.bytes({event.items, event.size});
  return finish_packet(writer, out);
}

}  // namespace lasso
