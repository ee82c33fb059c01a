#include "fsw/exec/command_dispatcher.hpp"

namespace lasso {
namespace {

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

static_assert(kSafeMode == static_cast<std::uint8_t>(TrackingMode::kSafe), "what makes safe has room of its own");

// The command that is spoken of; zeros where its bytes are not there.
Verification verification_of(ConstBytes packet) {
  const std::uint32_t key = command_key(packet);
  Verification verification;
  verification.packet_id = static_cast<std::uint16_t>(key >> 16);
  verification.sequence_control = static_cast<std::uint16_t>(key & 0xFFFF);
  return verification;
}

}  // namespace

std::size_t CommandDispatcher::receive(ConstBytes bytes, TimeUs now_us) {
  if (!bytes.empty()) bytes_came_ = true;
  std::size_t taken = 0;
  bool more = !packet_waits_;  // for the next frame: this one has no room for it
  while (more) {
    taken += receiver_.take(bytes.subspan(taken, bytes.size() - taken));
    more = !receiver_.packet().empty() && answer_if_room(receiver_.packet(), now_us);
  }
  packet_waits_ = !receiver_.packet().empty();
  return taken;
}

// False: it was not looked at, the frame has no room for it.
bool CommandDispatcher::answer_if_room(ConstBytes packet, TimeUs now_us) {
  if (!room_.takes(packet, apid_)) return false;
  answer(packet, now_us);
  return true;
}

void CommandDispatcher::answer(ConstBytes packet, TimeUs now_us) {
  changed_ = true;
  context_.telemetry.events().set_time(now_us);
  Verification verification = verification_of(packet);
  Command command;
  const PacketFault fault = receiver_.accept(packet, command);
  verification.fault = static_cast<std::uint8_t>(fault);
  const bool answered = room_.spend(fault, receiver_.from_operator());
  if (fault != PacketFault::kNone) return refuse(verification, answered, now_us);
  accept(command, verification, now_us);
}

void CommandDispatcher::accept(const Command& command, Verification& verification, TimeUs now_us) {
  context_.health.note_command();
  if ((command.header.acknowledge & kAcknowledgeAcceptance) != 0) verify(kSubserviceAccepted, verification, now_us);
  if ((command.header.acknowledge & kAcknowledgeStart) != 0) verify(kSubserviceStarted, verification, now_us);
  carry_out(command, verification, now_us);
  const bool failed = verification.mode_refusal != 0 || verification.start_refusal != 0 || verification.service_refusal != 0;
  if (failed) return fail(command, verification, now_us);
  if ((command.header.acknowledge & kAcknowledgeCompletion) != 0) verify(kSubserviceCompleted, verification, now_us);
}

void CommandDispatcher::carry_out(const Command& command, Verification& verification, TimeUs now_us) {
  if (!context_.interlocks.may_carry_out(command)) {
    verification.service_refusal = static_cast<std::uint8_t>(ServiceRefusal::kNotArmed);
  } else if (command.kind == CommandKind::kMode) {
    verification.mode_refusal = static_cast<std::uint8_t>(modes_.command_mode(static_cast<TrackingMode>(command.mode.mode)));
  } else if (command.kind == CommandKind::kStart) {
    const auto source = static_cast<InitialPoseSource>(command.start.source);
    verification.start_refusal = static_cast<std::uint8_t>(modes_.offer_start(source, offer_of(command.start)));
  } else {
    verification.service_refusal = static_cast<std::uint8_t>(commands_.serve(command, now_us));
  }
}

// What a false start held back is looked at when nothing has come for a frame.
void CommandDispatcher::answer_waiting(TimeUs now_us) {
  room_.renew();
  bool more = true;
  if (packet_waits_) more = answer_if_room(receiver_.packet(), now_us);
  while (!bytes_came_ && more && receiver_.give_up()) more = receiver_.packet().empty() || answer_if_room(receiver_.packet(), now_us);
  packet_waits_ = !more;
  bytes_came_ = false;
}

void CommandDispatcher::pass_boundary(TimeUs now_us) {
  answer_waiting(now_us);
  const bool skipped = receiver_.skipped() != reported_skipped_;
  if (skipped) context_.telemetry.raise<EventId::kBytesSkipped>(receiver_.skipped());
  if (context_.interlocks.pass_boundary()) changed_ = true;
  commands_.pass_boundary();
  if (context_.telemetry.housekeeping().due(kLinkStructureId, changed_ || skipped)) send_link(now_us);
}

void CommandDispatcher::verify(std::uint8_t subservice, const Verification& verification, TimeUs now_us) {
  Downlink& downlink = context_.telemetry.downlink();
  std::uint8_t packet[kMaxLinkReportBytes];
  const PacketHeader header = downlink.next_header({kServiceVerification, subservice}, now_us);
  downlink.send_answer({packet, encode_verification(verification, header, Bytes(packet))});
}

void CommandDispatcher::refuse(const Verification& verification, bool answered, TimeUs now_us) {
  context_.telemetry.raise<EventId::kCommandRefused>(verification.packet_id, verification.sequence_control, verification.fault);
  if (answered) verify(kSubserviceRefused, verification, now_us);
}

void CommandDispatcher::fail(const Command& command, const Verification& verification, TimeUs now_us) {
  context_.telemetry.raise<EventId::kCommandFailed>(command.header.service, command.header.subservice, verification.sequence_control,
                                                    verification.mode_refusal, verification.start_refusal, verification.service_refusal);
  verify(kSubserviceFailed, verification, now_us);
}

void CommandDispatcher::send_link(TimeUs now_us) {
  Telemetry& telemetry = context_.telemetry;
  changed_ = false;
  reported_skipped_ = receiver_.skipped();
  LinkTelemetry link;
  link.accepted_commands = receiver_.accepted();
  link.refused_commands = receiver_.refused();
  link.last_fault = static_cast<std::uint8_t>(receiver_.last_fault());
  link.skipped_bytes = receiver_.skipped();
  link.queue_peak = static_cast<std::uint16_t>(telemetry.downlink().queue().peak());
  link.armed = context_.interlocks.armed() ? 1 : 0;
  link.laser_enabled = context_.interlocks.laser_enabled() ? 1 : 0;
  link.time_offset_us = telemetry.downlink().time_offset_us();
  telemetry.send_structure<kMaxLinkReportBytes, encode_link>(link, now_us);
}

}  // namespace lasso
