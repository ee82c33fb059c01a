#include "fsw/link/pose_telemetry.hpp"

#include <algorithm>
#include <cstring>
#include <set>
#include <string>
#include <vector>

#include "fsw/core/crc.hpp"
#include "fsw/link/dictionary.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using Packet = std::vector<std::uint8_t>;

Packet encode(const PoseTelemetry& pose, const PacketHeader& header = {}) {
  Packet packet(kMaxPosePacketBytes);
  packet.resize(encode_pose(pose, header, Bytes(packet.data(), packet.size())));
  return packet;
}

ConstBytes view(const Packet& packet) { return ConstBytes(packet.data(), packet.size()); }

void repair_crc(Packet& packet) {
  const std::size_t n = packet.size() - kPacketTrailerBytes;
  const std::uint16_t crc = crc16_ccitt(ConstBytes(packet.data(), n));
  packet[n] = static_cast<std::uint8_t>(crc >> 8);
  packet[n + 1] = static_cast<std::uint8_t>(crc & 0xFF);
}

std::size_t offset_of(const std::string& name) {
  for (std::size_t i = 0; i < kPackets[0].items.size(); ++i) {
    if (name == kPackets[0].items[i].name) return item_offset(kPackets[0], i);
  }
  ADD_FAILURE() << "no item " << name;
  return 0;
}

TEST(PoseTelemetry, LiesAtTheseBytes) {
  VERIFIES("LASSO-LNK-002~1");
  // Written down by hand: who changes the layout changes an interface.
  EXPECT_EQ(offset_of("scan_id"), 22u);
  EXPECT_EQ(offset_of("t_measurement_us"), 26u);
  EXPECT_EQ(offset_of("t_publication_us"), 34u);
  EXPECT_EQ(offset_of("age_us"), 42u);
  EXPECT_EQ(offset_of("valid"), 46u);
  EXPECT_EQ(offset_of("mode"), 49u);
  EXPECT_EQ(offset_of("q_sensor_target"), 50u);
  EXPECT_EQ(offset_of("p_sensor_target_m"), 82u);
  EXPECT_EQ(offset_of("covariance"), 106u);
  EXPECT_EQ(offset_of("filter_q_sensor_target"), 274u);
  EXPECT_EQ(offset_of("filter_omega_radps"), 330u);
  EXPECT_EQ(offset_of("filter_sigma_pose"), 378u);
  EXPECT_EQ(offset_of("rays"), 426u);
  EXPECT_EQ(offset_of("rms_m"), 438u);
  EXPECT_EQ(offset_of("weakest_direction"), 458u);
  EXPECT_EQ(offset_of("plan_center"), 482u);
  EXPECT_EQ(offset_of("plan_points"), 522u);
  EXPECT_EQ(offset_of("image_crc"), 529u);
  EXPECT_EQ(offset_of("frames"), 541u);
  EXPECT_EQ(offset_of("dropped_packets"), 561u);
  EXPECT_EQ(offset_of("held"), 565u);
  EXPECT_EQ(offset_of("changes"), 566u);
  EXPECT_EQ(offset_of("change_from"), 567u);
  EXPECT_EQ(offset_of("change_event"), 571u);
  EXPECT_EQ(offset_of("change_to"), 575u);
  EXPECT_EQ(offset_of("start_source"), 579u);
  EXPECT_EQ(offset_of("refused_starts"), 582u);
  EXPECT_EQ(offset_of("bearing_reason"), 590u);
  EXPECT_EQ(offset_of("bearing_scans"), 595u);
  EXPECT_EQ(offset_of("t_bearing_us"), 599u);
  EXPECT_EQ(offset_of("bearing"), 607u);
  EXPECT_EQ(offset_of("bearing_sigma"), 655u);
  EXPECT_EQ(offset_of("search_outcome"), 679u);
  EXPECT_EQ(offset_of("search_ratio"), 683u);
  EXPECT_EQ(offset_of("t_search_us"), 695u);
  EXPECT_EQ(offset_of("candidate_q_sensor_target"), 703u);
  EXPECT_EQ(offset_of("candidate_p_sensor_target_m"), 767u);
  EXPECT_EQ(offset_of("part"), 815u);
  EXPECT_EQ(offset_of("inconsistency_sigmas"), 818u);
  EXPECT_EQ(encode(PoseTelemetry{}).size(), 835u);
}

TEST(PoseTelemetry, WritesEachValueWhereItsRowSays) {
  VERIFIES("LASSO-LNK-002~1 LASSO-SYS-024~1");
  PoseTelemetry pose;
  pose.scan_id = 0xA1B2C3D4;
  pose.q_sensor_target[3] = -2.0;
  pose.covariance[20] = 1.0;
  pose.iterations = 0x0102;
  const Packet packet = encode(pose);
  const std::uint8_t scan_id[] = {0xA1, 0xB2, 0xC3, 0xD4};
  const std::uint8_t minus_two[] = {0xC0, 0, 0, 0, 0, 0, 0, 0};
  const std::uint8_t one[] = {0x3F, 0xF0, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(std::memcmp(packet.data() + 22, scan_id, 4), 0);
  EXPECT_EQ(std::memcmp(packet.data() + 50 + 24, minus_two, 8), 0);
  EXPECT_EQ(std::memcmp(packet.data() + 106 + 160, one, 8), 0);
  EXPECT_EQ(packet[offset_of("iterations")], 1);
  EXPECT_EQ(packet[offset_of("iterations") + 1], 2);
}

TEST(PoseTelemetry, CarriesServiceStructureAndCounts) {
  VERIFIES("LASSO-LNK-001~1 LASSO-LNK-004~1");
  PacketHeader header;
  header.sequence_count = 77;
  header.t_us = 5000000;
  const Packet packet = encode(PoseTelemetry{}, header);
  EXPECT_EQ(packet[7], 3);
  EXPECT_EQ(packet[8], 25);
  EXPECT_EQ(packet[20], 0);
  EXPECT_EQ(packet[21], kPoseStructureId);
  PacketHeader decoded;
  PoseTelemetry pose;
  ASSERT_EQ(decode_pose(view(packet), decoded, pose), PacketFault::kNone);
  EXPECT_EQ(decoded.sequence_count, 77);
  EXPECT_EQ(decoded.t_us, 5000000);
}

TEST(PoseTelemetry, EncodeDecodeEncodeIsByteIdentical) {
  VERIFIES("LASSO-LNK-032~1");
  test::Generator random(11);
  const Packet blank = encode(PoseTelemetry{});
  for (int i = 0; i < 1000; ++i) {
    Packet packet = blank;
    for (std::size_t j = 22; j + kPacketTrailerBytes < packet.size(); ++j) packet[j] = static_cast<std::uint8_t>(random.below(256));
    repair_crc(packet);
    PacketHeader header;
    PoseTelemetry pose;
    ASSERT_EQ(decode_pose(view(packet), header, pose), PacketFault::kNone);
    ASSERT_EQ(encode(pose, header), packet);
  }
}

TEST(PoseTelemetry, RefusesOtherPacketsAndLeavesThePoseAlone) {
  VERIFIES("LASSO-LNK-005~1");
  const Packet good = encode(PoseTelemetry{});
  PacketHeader header;
  PoseTelemetry pose;
  pose.scan_id = 99;
  Packet other = good;
  other[8] = 26;
  repair_crc(other);
  EXPECT_EQ(decode_pose(view(other), header, pose), PacketFault::kUnknown);
  other = good;
  other[7] = 5;  // an event's service
  repair_crc(other);
  EXPECT_EQ(decode_pose(view(other), header, pose), PacketFault::kUnknown);
  other = good;
  other[21] = 2;
  repair_crc(other);
  EXPECT_EQ(decode_pose(view(other), header, pose), PacketFault::kUnknown);
  other = good;
  other.erase(other.begin() + 100);
  other[5] = static_cast<std::uint8_t>(other[5] - 1);
  repair_crc(other);
  EXPECT_EQ(decode_pose(view(other), header, pose), PacketFault::kBadLength);
  other = good;
  other[100] ^= 1;
  EXPECT_EQ(decode_pose(view(other), header, pose), PacketFault::kBadCrc);
  other = Packet(good.begin(), good.end() - 1);
  EXPECT_EQ(decode_pose(view(other), header, pose), PacketFault::kTruncated);
  EXPECT_EQ(pose.scan_id, 99u);
}

TEST(PoseTelemetry, RefusesEveryTruncationAndEveryBitError) {
  VERIFIES("LASSO-LNK-005~1");
  const Packet good = encode(PoseTelemetry{});
  PacketHeader header;
  PoseTelemetry pose;
  header.destination = 99;
  pose.scan_id = 99;
  for (std::size_t n = 0; n < good.size(); ++n) ASSERT_EQ(decode_pose({good.data(), n}, header, pose), PacketFault::kTruncated) << n;
  Packet damaged = good;
  for (std::size_t bit = 0; bit < good.size() * 8; ++bit) {
    damaged[bit / 8] = static_cast<std::uint8_t>(good[bit / 8] ^ (1u << bit % 8));
    ASSERT_NE(decode_pose(view(damaged), header, pose), PacketFault::kNone) << bit;
    damaged[bit / 8] = good[bit / 8];
  }
  EXPECT_EQ(header.destination, 99);
  EXPECT_EQ(pose.scan_id, 99u);
}

TEST(PoseTelemetry, TooSmallABufferGivesNoPacket) {
  VERIFIES("LASSO-LNK-004~1");
  Packet packet(743);
  EXPECT_EQ(encode_pose(PoseTelemetry{}, PacketHeader{}, Bytes(packet.data(), packet.size())), 0u);
}

TEST(PoseTelemetry, DictionaryIsCompleteAndUnambiguous) {
  VERIFIES("LASSO-LNK-002~1");
  std::set<std::string> names;
  std::set<std::uint16_t> ids;
  for (const ItemRow& row : kPackets[0].items) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_TRUE(ids.insert(row.id).second) << row.name;
    EXPECT_STRNE(row.unit, "") << row.name;
    EXPECT_STRNE(row.meaning, "") << row.name;
  }
}

TEST(PoseTelemetry, FiveFramesASecondFitTheLink) {
  VERIFIES("LASSO-LNK-007~1");
  EXPECT_LE(encode(PoseTelemetry{}).size() * 8 * 5, 64000u);
}

}  // namespace
}  // namespace lasso
