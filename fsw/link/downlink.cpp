#include "fsw/link/downlink.hpp"

namespace lasso {
namespace {

std::size_t index_of(MessageType type) {
  std::size_t index = 0;
  std::size_t found = kMessageTypeCount;
  for (const MessageType& each : kMessageTypes) {
    if (each.service == type.service && each.subservice == type.subservice) found = index;
    ++index;
  }
  invariant(found < kMessageTypeCount, "telemetry of a kind that is not counted");
  return found;
}

}  // namespace

PacketHeader Downlink::next_header(MessageType type, TimeUs t_us) {
  std::uint16_t& messages = Span<std::uint16_t>(messages_)[index_of(type)];
  PacketHeader header;
  header.apid = apid_;
  header.sequence_count = packets_ & kSequenceCountMask;
  header.service = type.service;
  header.subservice = type.subservice;
  header.message_count = messages;
  header.t_us = t_us + time_offset_us_;
  header.time_status = time_status_;
  ++packets_;
  ++messages;
  return header;
}

void Downlink::correlate_time(TimeUs offset_us) {
  time_offset_us_ = offset_us;
  time_status_ = kTimeStatusCorrelated;
}

void Downlink::forget_time() {
  time_offset_us_ = 0;
  time_status_ = 0;
}

void Downlink::send(ConstBytes packet) {
  invariant(!packet.empty(), "packet larger than its buffer");
  static_cast<void>(queue_.push(packet));
}

void Downlink::send_answer(ConstBytes packet) {
  invariant(!packet.empty(), "answer larger than its buffer");
  static_cast<void>(queue_.push_answer(packet));
}

}  // namespace lasso
