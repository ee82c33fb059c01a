// An operator of the component before a simulated box: by the link alone.
#pragma once

#include <algorithm>

#include "fsw/link/dictionary.hpp"
#include "ut/exec/component_scene.hpp"
#include "ut/link/command_packets.hpp"

namespace lasso::test {

struct Packet {
  PacketHeader header;
  Stream data;
  bool is(std::uint8_t service, std::uint8_t subservice) const { return header.service == service && header.subservice == subservice; }
};

inline std::vector<Packet> packets_of(const Stream& stream) {
  std::vector<Packet> packets;
  for (std::size_t at = 0; at < stream.size();) {
    const std::size_t size = packet_size({stream.data() + at, stream.size() - at});
    Packet packet;
    ConstBytes data;
    EXPECT_EQ(parse_packet({stream.data() + at, size}, packet.header, data), PacketFault::kNone);
    packet.data.assign(data.begin(), data.end());
    packets.push_back(packet);
    at += size;
  }
  return packets;
}

// The reason of a command's refusal, by what was reported since it was sent. It asks for its completion.
inline ServiceRefusal answer_in(const std::vector<Packet>& packets) {
  for (const Packet& packet : packets) {
    if (packet.is(1, 8)) return static_cast<ServiceRefusal>(packet.data.back());
    EXPECT_FALSE(packet.is(1, 2)) << "refused as a packet: " << int{packet.data.back()};
    if (packet.is(1, 7)) return ServiceRefusal::kNone;
  }
  ADD_FAILURE() << "no answer";
  return ServiceRefusal::kNone;
}

inline Stream telemetry_of(Component& component) {
  Stream bytes(kTelemetryQueueBytes);
  bytes.resize(component.take_telemetry(Bytes(bytes.data(), bytes.size())));
  return bytes;
}

// The slots of one frame; the bytes that were sent at its boundary.
inline Stream run_frame(Component& component) {
  do {
    component.run_slot(component.next_slot_us());
    component.run_estimation();
  } while (!component.next_slot_is_boundary());
  return telemetry_of(component);
}

class Link {
 public:
  Link() : scene(box_parameters(default_scene())) { scene.begin(); }

  Component& component() { return *scene.component; }
  std::size_t send(const Stream& bytes) { return component().receive(view(bytes), component().next_slot_us()); }
  std::vector<Packet> answers() { return packets_of(telemetry_of(component())); }
  // What it reported but for poses, health and events.
  std::vector<Packet> run_link_frame() {
    std::vector<Packet> others;
    for (const Packet& packet : run_frame()) {
      const bool pose = packet.is(3, 25) && packet.data[1] == kPoseStructureId;
      const bool health = packet.is(3, 25) && packet.data[1] == kHealthStructureId;
      if (!pose && !health && packet.header.service != 5) others.push_back(packet);
    }
    return others;
  }
  // The slots of one frame; what was reported at its boundary.
  std::vector<Packet> run_frame() { return packets_of(test::run_frame(component())); }
  PoseTelemetry pose_of(const std::vector<Packet>& packets) {
    PoseTelemetry pose;
    for (const Packet& packet : packets) {
      if (packet.is(3, 25) && packet.data[1] == kPoseStructureId) {
        ByteReader in(view(packet.data));
        in.u16();
        codec_of(pose_rows::kRows).read(in, pose);
      }
    }
    return pose;
  }
  ComponentScene scene;
};

inline StartCommand true_start(TimeUs t_us) {
  const BoxScene truth = default_scene();
  const Pose pose = truth.pose_at(t_us);
  StartCommand start;
  start.source = static_cast<std::uint8_t>(InitialPoseSource::kUplink);
  start.t_us = t_us;
  const double q[4] = {pose.q.x(), pose.q.y(), pose.q.z(), pose.q.w()};
  for (std::size_t i = 0; i < 4; ++i) start.q_sensor_target[i] = q[i];
  for (int i = 0; i < 3; ++i) {
    start.p_sensor_target_m[i] = pose.p[i];
    start.omega_radps[i] = truth.rates.omega_radps[i];
    start.v_mps[i] = truth.rates.v_mps[i];
  }
  const std::size_t diagonal[] = {0, 6, 11, 15, 18, 20};
  for (const std::size_t term : diagonal) start.covariance[term] = term < 12 ? 1e-2F : 1e-3F;
  return start;
}

// The events among them, as number and items.
inline std::vector<Stream> events_of(const std::vector<Packet>& packets) {
  std::vector<Stream> events;
  for (const Packet& packet : packets) {
    if (packet.header.service == 5 && packet.header.subservice < 5) events.push_back(packet.data);
  }
  return events;
}

inline std::vector<Packet> without_events(const std::vector<Packet>& packets) {
  std::vector<Packet> others;
  for (const Packet& packet : packets) {
    if (packet.header.service != 5) others.push_back(packet);
  }
  return others;
}

// The refusal of a service in the last answer; 0: completed, 255: there is none.
inline std::uint8_t refusal_of(const std::vector<Packet>& packets) {
  std::uint8_t refusal = 0xFF;
  for (const Packet& packet : packets) {
    if (packet.is(1, 7)) refusal = 0;
    if (packet.is(1, 8)) refusal = packet.data[6];
  }
  return refusal;
}

inline bool told(const std::vector<Packet>& packets, EventId event) {
  const std::vector<Stream> events = events_of(packets);
  return std::any_of(events.begin(), events.end(), [&](const Stream& items) { return items[1] == static_cast<std::uint8_t>(event); });
}

}  // namespace lasso::test
