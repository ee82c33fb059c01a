// Packets `pose` as a component sends them, and a link whose bytes the test chooses.
#pragma once

#include <deque>
#include <vector>

#include "fsw/link/byte_link.hpp"
#include "fsw/link/pose_telemetry.hpp"

namespace lasso::mdat {

using TelemetryBytes = std::vector<std::uint8_t>;

inline TelemetryBytes pose_packet(const PoseTelemetry& pose, const PacketHeader& header) {
  TelemetryBytes packet(kMaxPosePacketBytes);
  packet.resize(encode_pose(pose, header, Bytes(packet.data(), packet.size())));
  return packet;
}

inline TelemetryBytes pose_packet(std::uint16_t count, TimeUs t_us = 0) {
  PoseTelemetry pose;
  pose.scan_id = count;
  pose.t_publication_us = t_us;
  PacketHeader header;
  header.sequence_count = count;
  header.t_us = t_us;
  return pose_packet(pose, header);
}

// Gives the pieces one after the other.
class PieceLink final : public ByteLink {
 public:
  explicit PieceLink(bool datagrams) : datagrams_(datagrams) {}
  void add(const TelemetryBytes& piece) { pieces_.push_back(piece); }
  bool datagrams() const override { return datagrams_; }
  std::size_t read(Bytes out) override {
    if (pieces_.empty()) return 0;
    const TelemetryBytes piece = pieces_.front();
    pieces_.pop_front();
    for (std::size_t i = 0; i < piece.size(); ++i) out.data()[i] = piece[i];
    return piece.size();
  }
  std::size_t write(ConstBytes packets) override { return packets.size(); }

 private:
  bool datagrams_;
  std::deque<TelemetryBytes> pieces_;
};

}  // namespace lasso::mdat
