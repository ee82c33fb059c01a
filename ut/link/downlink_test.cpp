#include "fsw/link/downlink.hpp"

#include "fsw/link/dictionary.hpp"
#include "ut/link/command_packets.hpp"

namespace lasso {
namespace {

using test::Stream;

TEST(Downlink, CountsAllPacketsAndEachKind) {
  VERIFIES("LASSO-LNK-001~1");
  Downlink downlink;
  EXPECT_EQ(downlink.next_header({3, 25}, 5).sequence_count, 0);
  EXPECT_EQ(downlink.next_header({5, 2}, 6).message_count, 0);
  const PacketHeader third = downlink.next_header({3, 25}, 7);
  EXPECT_EQ(third.sequence_count, 2);
  EXPECT_EQ(third.message_count, 1);
  EXPECT_EQ(third.service, 3);
  EXPECT_EQ(third.subservice, 25);
  EXPECT_EQ(third.t_us, 7);
  for (int i = 0; i < 0x4000 - 3; ++i) downlink.next_header({17, 2}, 0);
  EXPECT_EQ(downlink.next_header({5, 2}, 0).sequence_count, 0) << "modulo 16384";
}

TEST(Downlink, KnowsEveryKindOfTheDictionary) {
  VERIFIES("LASSO-LNK-001~1");
  Downlink downlink;
  for (const PacketRow& packet : kPackets) {
    if (packet.type == PacketType::kTelemetry) {
      EXPECT_EQ(downlink.next_header({packet.service, packet.subservice}, 0).service, packet.service);
    }
  }
}

TEST(DownlinkDeath, AKindThatTheDictionaryDoesNotHave) {
  VERIFIES("LASSO-LNK-001~1");
  Downlink downlink;
  EXPECT_DEATH(downlink.next_header({5, 9}, 0), "not counted");
}

TEST(Downlink, HeadersStateSpacecraftTimeOnceItIsCorrelated) {
  VERIFIES("LASSO-LNK-037~2");
  Downlink downlink;
  EXPECT_EQ(downlink.next_header({3, 25}, 5).time_status, kTimeStatusFree);
  downlink.correlate_time(1000000);
  const PacketHeader header = downlink.next_header({3, 25}, 5);
  EXPECT_EQ(header.t_us, 1000005);
  EXPECT_EQ(header.time_status, kTimeStatusCorrelated);
  EXPECT_EQ(downlink.time_offset_us(), 1000000);
}

TEST(Downlink, QueuesPacketsOfRows) {
  VERIFIES("LASSO-LNK-002~1");
  Downlink downlink;
  DisabledEvents disabled;
  disabled.mask[15] = 7;
  downlink.send({5, 8}, codec_of(link_report_rows::kDisabled), disabled, 1000000);
  Stream packet(100);
  packet.resize(downlink.take(Bytes(packet.data(), packet.size())));
  PacketHeader header;
  ConstBytes data;
  ASSERT_EQ(parse_packet(test::view(packet), header, data), PacketFault::kNone);
  EXPECT_EQ(header.t_us, 1000000);
  ASSERT_EQ(data.size(), 16u);
  EXPECT_EQ(data[15], 7);
  EXPECT_EQ(downlink.queue().peak(), packet.size());
}

TEST(DownlinkDeath, APacketLargerThanItsBuffer) {
  VERIFIES("LASSO-LNK-002~1");
  Downlink downlink;
  EXPECT_DEATH(downlink.send({}), "larger than its buffer");
}

}  // namespace
}  // namespace lasso
