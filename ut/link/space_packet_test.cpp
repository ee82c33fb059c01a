#include "fsw/link/space_packet.hpp"

#include "fsw/link/choices.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

TEST(SpacePacket, HeaderIsBitForBitAsTheStandardSays) {
  VERIFIES("LASSO-LNK-001~1");
  PrimaryHeader header;
  header.version = 5;
  header.type = PacketType::kCommand;
  header.secondary_header = false;
  header.apid = 0x2A5;
  header.sequence_flags = 1;
  header.sequence_count = 0x2C3B;
  std::uint8_t bytes[kPrimaryHeaderBytes] = {};
  ByteWriter writer{Bytes(bytes)};
  write_primary_header(header, writer);
  const std::uint8_t by_hand[kPrimaryHeaderBytes] = {0xB2, 0xA5, 0x6C, 0x3B, 0, 0};
  for (std::size_t i = 0; i < kPrimaryHeaderBytes; ++i) EXPECT_EQ(bytes[i], by_hand[i]) << i;
  bytes[4] = 0x12;
  bytes[5] = 0x34;
  const PrimaryHeader back = read_primary_header({bytes, kPrimaryHeaderBytes});
  EXPECT_EQ(back.version, 5);
  EXPECT_EQ(back.type, PacketType::kCommand);
  EXPECT_FALSE(back.secondary_header);
  EXPECT_EQ(back.apid, 0x2A5);
  EXPECT_EQ(back.sequence_flags, 1);
  EXPECT_EQ(back.sequence_count, 0x2C3B);
  EXPECT_EQ(back.data_length, 0x1234);
}

TEST(SpacePacket, NamesItsFaultsAsTheDictionaryDoes) {
  VERIFIES("LASSO-LNK-005~1 LASSO-LNK-002~1");
  ASSERT_EQ(kPacketFault.choices.size(), static_cast<std::size_t>(PacketFault::kNotAuthentic) + 1);
  for (std::size_t i = 0; i < kPacketFault.choices.size(); ++i) {
    EXPECT_STREQ(to_string(static_cast<PacketFault>(i)), kPacketFault.choices[i].name);
  }
  EXPECT_STREQ(to_string(static_cast<PacketFault>(200)), "no fault");
}

}  // namespace
}  // namespace lasso
