#include "fsw/link/memory_report.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "fsw/link/dictionary.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

TEST(MemoryReport, IsThePacketOfItsRows) {
  VERIFIES("LASSO-LNK-002~1 LASSO-IMG-012~1");
  ImageTelemetry image;
  image.active_crc = 0x01020304;
  image.blocks = 300;
  image.missing_first[1] = 7;
  image.repairs = 0x0A0B0C0D;
  std::vector<std::uint8_t> packet(kMaxImagePacketBytes);
  const std::size_t size = encode_image(image, PacketHeader{}, Bytes(packet.data(), packet.size()));
  const PacketRow* row = nullptr;
  for (const PacketRow& each : kPackets) {
    if (each.type == PacketType::kTelemetry && each.service == kServiceHousekeeping && each.number == kImageStructureId) row = &each;
  }
  ASSERT_NE(row, nullptr);
  ASSERT_EQ(size, item_offset(*row, row->items.size()) + kPacketTrailerBytes);
  EXPECT_EQ(packet[21], kImageStructureId);
  EXPECT_EQ(packet[22], 1);
  EXPECT_EQ(packet[25], 4);
  EXPECT_EQ(packet[size - 6], 0x0A);
  EXPECT_EQ(packet[size - 3], 0x0D);
  PacketHeader header;
  ConstBytes data;
  EXPECT_EQ(parse_packet(ConstBytes(packet.data(), size), header, data), PacketFault::kNone);
  EXPECT_EQ(encode_image(image, PacketHeader{}, Bytes(packet.data(), 100)), 0U);
}

}  // namespace
}  // namespace lasso
