// What the component does with bytes from the ground, and how it answers.
#include "fsw/exec/component.hpp"

namespace lasso {
namespace {

struct MessageType {
  std::uint8_t service, subservice;
};
constexpr MessageType kMessageTypes[] = {{kServiceHousekeeping, kSubserviceHousekeepingReport},
                                         {kServiceVerification, kSubserviceAccepted},
                                         {kServiceVerification, kSubserviceRefused},
                                         {kServiceVerification, kSubserviceCompleted},
                                         {kServiceVerification, kSubserviceFailed},
                                         {kServiceTest, kSubservicePong}};

StartOffer offer_of(const StartCommand& command) {
  StartOffer offer;
  offer.t_us = command.t_us;
  const double(&q)[4] = command.q_sensor_target;
  offer.T_sensor_target.q = Quat(q[3], q[0], q[1], q[2]);
  offer.T_sensor_target.p = Vec3(command.p_sensor_target_m);
  offer.rates.omega_radps = Vec3(command.omega_radps);
  offer.rates.v_mps = Vec3(command.v_mps);
  std::size_t term = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      offer.covariance(row, column) = static_cast<double>(command.covariance[term]);
      offer.covariance(column, row) = offer.covariance(row, column);
      ++term;
    }
  }
  return offer;
}

// The command that is spoken of; zeros where its bytes are not there.
Verification verification_of(ConstBytes packet) {
  ByteReader in(packet);
  Verification verification;
  verification.packet_id = in.u16();
  verification.sequence_control = in.u16();
  return verification;
}

}  // namespace

std::size_t Component::receive(ConstBytes bytes, TimeUs now_us) {
  if (!bytes.empty()) bytes_came_ = true;
  std::size_t taken = 0;
  bool found = true;
  while (found && commands_left_ > 0) {
    taken += receiver_.take(bytes.subspan(taken, bytes.size() - taken));
    found = !receiver_.packet().empty();
    if (found) answer(receiver_.packet(), now_us);
  }
  return taken;
}

bool Component::receive_packet(ConstBytes packet, TimeUs now_us) {
  if (commands_left_ == 0) return false;
  answer(packet, now_us);
  return true;
}

void Component::answer(ConstBytes packet, TimeUs now_us) {
  --commands_left_;
  link_changed_ = true;
  Verification verification = verification_of(packet);
  Command command;
  const PacketFault fault = receiver_.accept(packet, command);
  verification.fault = static_cast<std::uint8_t>(fault);
  if (fault != PacketFault::kNone) return verify(Message::kRefused, verification, now_us);
  if ((command.header.acknowledge & kAcknowledgeAcceptance) != 0) verify(Message::kAccepted, verification, now_us);
  carry_out(command, verification, now_us);
  const bool failed = verification.mode_refusal != 0 || verification.start_refusal != 0;
  if (failed) return verify(Message::kFailed, verification, now_us);
  if ((command.header.acknowledge & kAcknowledgeCompletion) != 0) verify(Message::kCompleted, verification, now_us);
}

void Component::carry_out(const Command& command, Verification& verification, TimeUs now_us) {
  if (command.kind == CommandKind::kPing) return send_pong(now_us);
  if (command.kind == CommandKind::kHold) return hold_mode(command.hold.held != 0);
  if (command.kind == CommandKind::kMode) {
    verification.mode_refusal = static_cast<std::uint8_t>(command_mode(static_cast<TrackingMode>(command.mode.mode)));
    return;
  }
  const auto way = static_cast<StartWay>(command.start.way);
  verification.start_refusal = static_cast<std::uint8_t>(offer_start(way, offer_of(command.start)));
}

// What a false start held back is looked at when nothing has come for a frame.
void Component::pass_link_boundary(TimeUs now_us) {
  commands_left_ = kMaxCommandsPerFrame;
  while (!bytes_came_ && commands_left_ > 0 && receiver_.give_up()) {
    if (!receiver_.packet().empty()) answer(receiver_.packet(), now_us);
  }
  bytes_came_ = false;
  if (link_changed_ || receiver_.skipped() != skipped_told_) send_link(now_us);
}

PacketHeader Component::next_header(Message message, TimeUs now_us) {
  const auto index = static_cast<std::size_t>(message);
  const MessageType& type = Span<const MessageType>(kMessageTypes)[index];
  PacketHeader header;
  header.sequence_count = packets_ & kSequenceCountMask;
  header.service = type.service;
  header.subservice = type.subservice;
  header.message_count = messages_[index];
  header.t_us = now_us;
  ++packets_;
  ++messages_[index];
  return header;
}

// A full queue counts what it drops.
void Component::enqueue(ConstBytes packet) {
  invariant(!packet.empty(), "packet larger than its buffer");
  static_cast<void>(queue_.push(packet));
}

void Component::verify(Message message, const Verification& verification, TimeUs now_us) {
  std::uint8_t packet[kMaxLinkReportBytes];
  enqueue({packet, encode_verification(verification, next_header(message, now_us), Bytes(packet))});
}

void Component::send_pong(TimeUs now_us) {
  std::uint8_t packet[kMaxLinkReportBytes];
  enqueue({packet, encode_pong(next_header(Message::kPong, now_us), Bytes(packet))});
}

void Component::send_link(TimeUs now_us) {
  link_changed_ = false;
  skipped_told_ = receiver_.skipped();
  LinkTelemetry link;
  link.accepted_commands = receiver_.accepted();
  link.refused_commands = receiver_.refused();
  link.last_fault = static_cast<std::uint8_t>(receiver_.last_fault());
  link.skipped_bytes = receiver_.skipped();
  link.queue_peak = static_cast<std::uint16_t>(queue_.peak());
  std::uint8_t packet[kMaxLinkReportBytes];
  enqueue({packet, encode_link(link, next_header(Message::kHousekeeping, now_us), Bytes(packet))});
}

}  // namespace lasso
