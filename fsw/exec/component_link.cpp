// What the component does with bytes from the ground, and how it answers.
#include "fsw/exec/component.hpp"
#include "fsw/exec/sensor_report.hpp"

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

void Component::use_authenticator(Authenticator& authenticator) {
  receiver_.use_authenticator(authenticator);
  authenticate_images(authenticator);
  key_change_.use_authenticator(authenticator);
}

std::size_t Component::receive(ConstBytes bytes, TimeUs now_us) {
  const Running running(identity_);
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

bool Component::receive_packet(ConstBytes packet, TimeUs now_us) {
  const Running running(identity_);
  return answer_if_room(packet, now_us);
}

// False: it was not looked at, the frame has no room for it.
bool Component::answer_if_room(ConstBytes packet, TimeUs now_us) {
  if (!room_.takes(packet, identity_.apid)) return false;
  answer(packet, now_us);
  return true;
}

void Component::answer(ConstBytes packet, TimeUs now_us) {
  link_changed_ = true;
  events_.set_time(now_us);
  Verification verification = verification_of(packet);
  Command command;
  const PacketFault fault = receiver_.accept(packet, command);
  verification.fault = static_cast<std::uint8_t>(fault);
  const bool answered = room_.spend(fault, receiver_.from_operator());
  if (fault != PacketFault::kNone) return refuse(verification, answered, now_us);
  silent_frames_ = 0;
  if ((command.header.acknowledge & kAcknowledgeAcceptance) != 0) verify(kSubserviceAccepted, verification, now_us);
  if ((command.header.acknowledge & kAcknowledgeStart) != 0) verify(kSubserviceStarted, verification, now_us);
  carry_out(command, verification, now_us);
  const bool failed = verification.mode_refusal != 0 || verification.start_refusal != 0 || verification.service_refusal != 0;
  if (failed) return fail(command, verification, now_us);
  if ((command.header.acknowledge & kAcknowledgeCompletion) != 0) verify(kSubserviceCompleted, verification, now_us);
}

void Component::carry_out(const Command& command, Verification& verification, TimeUs now_us) {
  if (!may_fire(command)) {
    verification.service_refusal = static_cast<std::uint8_t>(ServiceRefusal::kNotArmed);
  } else if (command.kind == CommandKind::kMode) {
    verification.mode_refusal = static_cast<std::uint8_t>(command_mode(static_cast<TrackingMode>(command.mode.mode)));
  } else if (command.kind == CommandKind::kStart) {
    const auto way = static_cast<InitialPoseSource>(command.start.way);
    verification.start_refusal = static_cast<std::uint8_t>(offer_start(way, offer_of(command.start)));
  } else {
    verification.service_refusal = static_cast<std::uint8_t>(serve(command, now_us));
  }
}

// What a false start held back is looked at when nothing has come for a frame.
void Component::pass_link_boundary(TimeUs now_us) {
  room_.renew();
  bool more = true;
  if (packet_waits_) more = answer_if_room(receiver_.packet(), now_us);
  while (!bytes_came_ && more && receiver_.give_up()) more = receiver_.packet().empty() || answer_if_room(receiver_.packet(), now_us);
  packet_waits_ = !more;
  bytes_came_ = false;
  const bool skipped = receiver_.skipped() != skipped_told_;
  if (skipped) events_.raise<EventId::kBytesSkipped>(receiver_.skipped());
  if (arming_.pass_boundary()) {
    link_changed_ = true;
    events_.raise<EventId::kArmExpired>(arming_.name().service, arming_.name().subservice, arming_.name().number);
  }
  if (key_change_.pass_boundary()) events_.raise<EventId::kKeyGivenUp>(key_change_.number());
  if (housekeeping_.due(kLinkStructureId, link_changed_ || skipped)) send_link(now_us);
}

void Component::verify(std::uint8_t subservice, const Verification& verification, TimeUs now_us) {
  std::uint8_t packet[kMaxLinkReportBytes];
  const PacketHeader header = downlink_.next_header({kServiceVerification, subservice}, now_us);
  downlink_.send_answer({packet, encode_verification(verification, header, Bytes(packet))});
}

void Component::refuse(const Verification& verification, bool answered, TimeUs now_us) {
  events_.raise<EventId::kCommandRefused>(verification.packet_id, verification.sequence_control, verification.fault);
  if (answered) verify(kSubserviceRefused, verification, now_us);
}

void Component::fail(const Command& command, const Verification& verification, TimeUs now_us) {
  events_.raise<EventId::kCommandFailed>(command.header.service, command.header.subservice, verification.sequence_control,
                                         verification.mode_refusal, verification.start_refusal, verification.service_refusal);
  verify(kSubserviceFailed, verification, now_us);
}

void Component::send_pong(TimeUs now_us) {
  std::uint8_t packet[kMaxLinkReportBytes];
  downlink_.send_answer({packet, encode_pong(downlink_.next_header({kServiceTest, kSubservicePong}, now_us), Bytes(packet))});
}

void Component::send_link(TimeUs now_us) {
  link_changed_ = false;
  skipped_told_ = receiver_.skipped();
  LinkTelemetry link;
  link.accepted_commands = receiver_.accepted();
  link.refused_commands = receiver_.refused();
  link.last_fault = static_cast<std::uint8_t>(receiver_.last_fault());
  link.skipped_bytes = receiver_.skipped();
  link.queue_peak = static_cast<std::uint16_t>(downlink_.queue().peak());
  link.armed = arming_.armed() ? 1 : 0;
  link.laser_enabled = laser_enabled() ? 1 : 0;
  link.time_offset_us = downlink_.time_offset_us();
  std::uint8_t packet[kMaxLinkReportBytes];
  downlink_.send({packet, encode_link(link, downlink_.next_header(kHousekeepingReport, now_us), Bytes(packet))});
}

// Counters of what knows no events.
void Component::watch_counters() {
  const Watched before = watched_;
  watched_.dropped_packets = downlink_.queue().dropped();
  watched_.slot_slips = executive_.slips();
  watched_.sensors_failed = chooser_.failed(executive_.frame());
  if (watched_.dropped_packets != before.dropped_packets) events_.raise<EventId::kPacketsDropped>(watched_.dropped_packets);
  if (watched_.slot_slips != before.slot_slips) events_.raise<EventId::kSlotLate>(watched_.slot_slips);
  // As a difference of words: with two bools compared in the loop, builds by g++ 12.2 at -O2 and -O3 for x86-64 tell a failure in each
  // frame, those at -O1 do not; ut/exec tells them apart (AFailureIsToldOnceAndSoIsItsEnd).
  const std::uint32_t failed = watched_.sensors_failed, changed = failed ^ before.sensors_failed;
  for (std::uint32_t i = 0; i < kMaxSensors; ++i) {
    if ((changed >> i & 1U) == 0) continue;
    if ((failed >> i & 1U) != 0) {
      events_.raise<EventId::kSensorFailed>(i);
    } else {
      events_.raise<EventId::kSensorBack>(i);
    }
  }
}

// The last of a boundary's work: what happened at it is told by it.
void Component::send_events() {
  watch_counters();
  reset_due_ = reset_asked_;
  for (const EventRecord& event : events_.records()) {
    log_.note(event);
    if (!event.told) continue;
    std::uint8_t packet[kMaxEventPacketBytes];
    const PacketHeader header = downlink_.next_header({kServiceEvent, static_cast<std::uint8_t>(event.severity)}, event.t_us);
    downlink_.send({packet, encode_event(event, header, Bytes(packet))});
  }
  events_.pass_boundary();
  housekeeping_.pass_boundary();
}

// Of each sensor that something went wrong with since it was told last; of all, where none is news. Loop bound: kMaxSensors.
void Component::send_sensors(TimeUs now_us) {
  bool news[kMaxSensors] = {};
  bool any = false;
  SensorTelemetry reports[kMaxSensors];
  const std::size_t sensors = mission().sensors.size();
  for (std::size_t i = 0; i < sensors; ++i) {
    const auto sensor = static_cast<SensorNumber>(i);
    reports[i] = make_sensor_report(sensor, acquisition_.tally(sensor), acquisition_.counters(sensor));
    news[i] = troubles(reports[i]) != troubles_told_[i];
    any = any || news[i];
  }
  if (!housekeeping_.due(kSensorStructureId, any)) return;
  for (std::size_t i = 0; i < sensors; ++i) {
    if (any && !news[i]) continue;
    troubles_told_[i] = troubles(reports[i]);
    std::uint8_t packet[kMaxSensorPacketBytes];
    downlink_.send({packet, encode_sensor(reports[i], downlink_.next_header(kHousekeepingReport, now_us), Bytes(packet))});
  }
}

}  // namespace lasso
