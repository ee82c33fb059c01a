#include "fsw/link/telecommand.hpp"

#include <array>

#include "fsw/core/crc.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using Telecommand = std::array<std::uint8_t, 15>;

// Put together by hand from the standards; the checksum bit by bit with another program.
constexpr Telecommand kCommandByHand = {0x1B, 0xD1, 0xE5, 0x67, 0x00, 0x08, 0x29, 0x11, 0x01, 0x12, 0x34, 0xCA, 0xFE, 0xB6, 0x14};

CommandHeader command_header_by_hand() {
  CommandHeader header;
  header.sequence_count = 0x2567;
  header.service = 17;
  header.subservice = 1;
  header.source = 0x1234;
  return header;
}

Telecommand command_with_byte(std::size_t index, std::uint8_t value) {
  Telecommand packet = kCommandByHand;
  packet[index] = value;
  const std::uint16_t crc = crc16_ccitt(ConstBytes(packet.data(), 13));
  packet[13] = static_cast<std::uint8_t>(crc >> 8);
  packet[14] = static_cast<std::uint8_t>(crc & 0xFF);
  return packet;
}

PacketFault command_fault_of(const Telecommand& packet, std::size_t size = 15) {
  CommandHeader header;
  header.source = 77;
  ConstBytes data;
  const PacketFault fault = parse_command(ConstBytes(packet.data(), size), header, data);
  if (fault != PacketFault::kNone) {
    EXPECT_EQ(header.source, 77) << "untouched when refused";
    EXPECT_TRUE(data.empty());
  }
  return fault;
}

TEST(Telecommand, IsByteForByteAsPutTogetherByHand) {
  VERIFIES("LASSO-LNK-033~1");
  Telecommand packet{};
  const Bytes out(packet.data(), packet.size());
  ByteWriter writer(out);
  begin_command(command_header_by_hand(), writer);
  writer.u16(0xCAFE);
  ASSERT_EQ(finish_packet(writer, out), packet.size());
  EXPECT_EQ(packet, kCommandByHand);
}

TEST(Telecommand, GivesBackItsHeaderAndData) {
  VERIFIES("LASSO-LNK-033~1");
  CommandHeader header;
  ConstBytes data;
  ASSERT_EQ(parse_command(ConstBytes(kCommandByHand.data(), kCommandByHand.size()), header, data), PacketFault::kNone);
  EXPECT_EQ(header.apid, kApid);
  EXPECT_EQ(header.sequence_count, 0x2567);
  EXPECT_EQ(header.acknowledge, kAcknowledgeAcceptance | kAcknowledgeCompletion);
  EXPECT_EQ(header.service, 17);
  EXPECT_EQ(header.subservice, 1);
  EXPECT_EQ(header.source, 0x1234);
  ASSERT_EQ(data.size(), 2u);
  EXPECT_EQ(data[0], 0xCA);
}

TEST(Telecommand, RefusesEveryTruncationAndEveryBitError) {
  VERIFIES("LASSO-LNK-034~1");
  for (std::size_t n = 0; n < kCommandByHand.size(); ++n) EXPECT_EQ(command_fault_of(kCommandByHand, n), PacketFault::kTruncated) << n;
  for (std::size_t bit = 0; bit < kCommandByHand.size() * 8; ++bit) {
    Telecommand damaged = kCommandByHand;
    damaged[bit / 8] = static_cast<std::uint8_t>(damaged[bit / 8] ^ (1u << (bit % 8)));
    EXPECT_NE(command_fault_of(damaged), PacketFault::kNone) << "bit " << bit;
  }
}

TEST(Telecommand, NamesWhatItRefuses) {
  VERIFIES("LASSO-LNK-034~1");
  EXPECT_EQ(command_fault_of(command_with_byte(0, 0x3B)), PacketFault::kBadVersion);
  EXPECT_EQ(command_fault_of(command_with_byte(0, 0x0B)), PacketFault::kBadType);
  EXPECT_EQ(command_fault_of(command_with_byte(0, 0x13)), PacketFault::kNoSecondaryHeader);
  EXPECT_EQ(command_fault_of(command_with_byte(1, 0xD2)), PacketFault::kOtherApid);
  EXPECT_EQ(command_fault_of(command_with_byte(2, 0xA5)), PacketFault::kSegmented);
  EXPECT_EQ(command_fault_of(command_with_byte(6, 0x19)), PacketFault::kBadPusVersion);
  EXPECT_EQ(command_fault_of(command_with_byte(5, 0x07)), PacketFault::kBadLength);
  EXPECT_EQ(command_fault_of(command_with_byte(5, 0x09)), PacketFault::kTruncated);
}

}  // namespace
}  // namespace lasso
