#include "fsw/link/packet.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "fsw/core/crc.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

constexpr TimeUs kHalfPast = 0x01020304LL * 1000000 + 500000;

// Put together by hand from the standards; the checksum bit by bit with another program.
constexpr std::array<std::uint8_t, 24> kByHand = {0x0B, 0xD1, 0xE5, 0x67, 0x00, 0x11, 0x23, 0x03, 0x19, 0xBE, 0xEF, 0x12,
                                                  0x34, 0x01, 0x02, 0x03, 0x04, 0x80, 0x00, 0x00, 0xCA, 0xFE, 0xF7, 0xD5};

PacketHeader header_by_hand() {
  PacketHeader header;
  header.sequence_count = 0x2567;
  header.time_status = 3;
  header.service = kServiceHousekeeping;
  header.subservice = kSubserviceHousekeepingReport;
  header.message_count = 0xBEEF;
  header.destination = 0x1234;
  header.t_us = kHalfPast;
  return header;
}

std::array<std::uint8_t, 24> packet_by_code() {
  std::array<std::uint8_t, 24> packet{};
  const Bytes out(packet.data(), packet.size());
  ByteWriter writer(out);
  begin_packet(header_by_hand(), writer);
  writer.u16(0xCAFE);
  EXPECT_EQ(finish_packet(writer, out), packet.size());
  return packet;
}

ConstBytes view(const std::array<std::uint8_t, 24>& packet) { return ConstBytes(packet.data(), packet.size()); }

PacketFault fault_of(ConstBytes packet) {
  PacketHeader header;
  ConstBytes data;
  return parse_packet(packet, header, data);
}

std::array<std::uint8_t, 24> with_byte(std::size_t index, std::uint8_t value) {
  std::array<std::uint8_t, 24> packet = kByHand;
  packet[index] = value;
  const std::uint16_t crc = crc16_ccitt(ConstBytes(packet.data(), 22));
  packet[22] = static_cast<std::uint8_t>(crc >> 8);
  packet[23] = static_cast<std::uint8_t>(crc & 0xFF);
  return packet;
}

TEST(Packet, IsByteForByteAsPutTogetherByHand) {
  VERIFIES("LASSO-LNK-001~1");
  EXPECT_EQ(packet_by_code(), kByHand);
}

TEST(Packet, GivesBackItsHeaderAndData) {
  VERIFIES("LASSO-LNK-001~1");
  PacketHeader header;
  ConstBytes data;
  ASSERT_EQ(parse_packet(view(kByHand), header, data), PacketFault::kNone);
  EXPECT_EQ(header.apid, kApid);
  EXPECT_EQ(header.sequence_count, 0x2567);
  EXPECT_EQ(header.time_status, 3);
  EXPECT_EQ(header.service, 3);
  EXPECT_EQ(header.subservice, 25);
  EXPECT_EQ(header.message_count, 0xBEEF);
  EXPECT_EQ(header.destination, 0x1234);
  EXPECT_EQ(header.t_us, kHalfPast);
  ASSERT_EQ(data.size(), 2u);
  EXPECT_EQ(data[0], 0xCA);
  EXPECT_EQ(data[1], 0xFE);
}

TEST(Packet, RefusesEveryTruncationAndEveryBitError) {
  VERIFIES("LASSO-LNK-005~1");
  for (std::size_t n = 0; n < kByHand.size(); ++n) EXPECT_EQ(fault_of(ConstBytes(kByHand.data(), n)), PacketFault::kTruncated);
  for (std::size_t bit = 0; bit < kByHand.size() * 8; ++bit) {
    auto damaged = kByHand;
    damaged[bit / 8] = static_cast<std::uint8_t>(damaged[bit / 8] ^ (1u << (bit % 8)));
    EXPECT_NE(fault_of(view(damaged)), PacketFault::kNone) << "bit " << bit;
  }
}

TEST(Packet, NamesWhatItRefuses) {
  VERIFIES("LASSO-LNK-005~1");
  EXPECT_EQ(fault_of(view(with_byte(0, 0x2B))), PacketFault::kBadVersion);
  EXPECT_EQ(fault_of(view(with_byte(0, 0x1B))), PacketFault::kBadType);
  EXPECT_EQ(fault_of(view(with_byte(0, 0x03))), PacketFault::kNoSecondaryHeader);
  EXPECT_EQ(fault_of(view(with_byte(1, 0xD0))), PacketFault::kOtherApid);
  EXPECT_EQ(fault_of(view(with_byte(2, 0x65))), PacketFault::kSegmented);
  EXPECT_EQ(fault_of(view(with_byte(6, 0x13))), PacketFault::kBadPusVersion);  // PUS-A
  EXPECT_EQ(fault_of(view(with_byte(5, 0x10))), PacketFault::kBadLength);
  EXPECT_EQ(fault_of(view(with_byte(5, 0x12))), PacketFault::kTruncated);
  auto damaged = kByHand;
  damaged[20] ^= 1;
  EXPECT_EQ(fault_of(view(damaged)), PacketFault::kBadCrc);
}

TEST(Packet, WhatDoesNotFitIsNotAPacket) {
  VERIFIES("LASSO-LNK-001~1");
  for (std::size_t room = 0; room < kByHand.size(); ++room) {
    std::array<std::uint8_t, 24> packet{};
    const Bytes out(packet.data(), room);
    ByteWriter writer(out);
    begin_packet(header_by_hand(), writer);
    writer.u16(0xCAFE);
    EXPECT_EQ(finish_packet(writer, out), 0u) << room;
  }
}

TEST(Packet, IsAtMostAsLongAsItsLengthFieldCanSay) {
  VERIFIES("LASSO-LNK-001~1");
  std::vector<std::uint8_t> packet(kPrimaryHeaderBytes + 0x10000 + 1);
  const std::vector<std::uint8_t> data(packet.size() - kPacketHeaderBytes - kPacketTrailerBytes, 0xA5);
  for (const std::size_t too_long : {0u, 1u}) {
    const Bytes out(packet.data(), packet.size());
    ByteWriter writer(out);
    begin_packet(header_by_hand(), writer);
    writer.bytes({data.data(), data.size() - 1 + too_long});
    EXPECT_EQ(finish_packet(writer, out), too_long == 0 ? packet.size() - 1 : 0u);
  }
}

TEST(Packet, SizeIsUnknownUntilThePrimaryHeaderIsWhole) {
  VERIFIES("LASSO-LNK-001~1");
  for (std::size_t bytes = 0; bytes < kPrimaryHeaderBytes; ++bytes) EXPECT_EQ(packet_size({kByHand.data(), bytes}), 0u) << bytes;
  EXPECT_EQ(packet_size({kByHand.data(), kPrimaryHeaderBytes}), kByHand.size());
}

TEST(Packet, SequenceCountWrapsAtFourteenBits) {
  VERIFIES("LASSO-LNK-001~1");
  PacketHeader header;
  header.sequence_count = 0x4001;  // one beyond 2^14
  std::array<std::uint8_t, 24> packet{};
  const Bytes out(packet.data(), packet.size());
  ByteWriter writer(out);
  begin_packet(header, writer);
  ASSERT_EQ(finish_packet(writer, out), 22u);
  EXPECT_EQ(packet[2], 0xC0);
  EXPECT_EQ(packet[3], 0x01);
}

TEST(CucTime, CountsSecondsAndFractions) {
  VERIFIES("LASSO-LNK-003~1");
  EXPECT_EQ(to_cuc(0).seconds, 0u);
  EXPECT_EQ(to_cuc(1250000).seconds, 1u);
  EXPECT_EQ(to_cuc(1250000).fraction, 0x400000u);
  EXPECT_EQ(to_cuc(1).fraction, 17u);             // 2^24 / 10^6 = 16.78
  EXPECT_EQ(to_cuc(999999).fraction, 16777199u);  // 16777199.2: no carry into the seconds
  EXPECT_EQ(to_cuc(-1).seconds, 0xFFFFFFFFu);     // wraps
  EXPECT_EQ(to_cuc((1LL << 32) * 1000000).seconds, 0u);
}

TEST(CucTime, KeepsEveryMicrosecond) {
  VERIFIES("LASSO-LNK-003~1");
  test::Generator random(7);
  for (int i = 0; i < 100000; ++i) {
    const TimeUs t_us = static_cast<TimeUs>(random.below((1ULL << 32) * 1000000));
    ASSERT_EQ(from_cuc(to_cuc(t_us)), t_us);
  }
}

}  // namespace
}  // namespace lasso
