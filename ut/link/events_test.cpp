#include "fsw/link/events.hpp"

#include "fsw/link/dictionary.hpp"
#include "ut/link/command_packets.hpp"

namespace lasso {
namespace {

using test::Stream;

TEST(Events, APacketIsNumberAndItemsAtTheEventsTime) {
  VERIFIES("LASSO-LNK-015~2");
  EventRecord event;
  event.id = EventId::kCommandRefused;
  event.severity = Severity::kLow;
  event.size = 5;
  event.t_us = 2500000;
  for (std::uint8_t i = 0; i < 8; ++i) event.items[i] = static_cast<std::uint8_t>(i + 1);
  PacketHeader header;
  header.sequence_count = 3;
  header.message_count = 9;
  header.t_us = event.t_us;
  Stream packet(kMaxEventPacketBytes);
  packet.resize(encode_event(event, header, Bytes(packet.data(), packet.size())));
  PacketHeader parsed;
  ConstBytes data;
  ASSERT_EQ(parse_packet(test::view(packet), parsed, data), PacketFault::kNone);
  EXPECT_EQ(parsed.service, 5);
  EXPECT_EQ(parsed.subservice, 2);
  EXPECT_EQ(parsed.sequence_count, 3);
  EXPECT_EQ(parsed.message_count, 9);
  EXPECT_EQ(parsed.t_us, 2500000);
  EXPECT_EQ(Stream(data.begin(), data.end()), (Stream{0, 4, 1, 2, 3, 4, 5}));
  std::uint8_t small[28];
  EXPECT_EQ(encode_event(event, header, Bytes(small)), 0u);
}

TEST(Events, EveryRowIsAPacketOfItsSeverityAndExplained) {
  VERIFIES("LASSO-LNK-015~2");
  const PacketTable<kEvents - 1> packets = event_rows::packets();
  const event_rows::Choices choices = event_rows::choices();
  ASSERT_TRUE(event_rows::in_order());
  bool severities[5] = {};
  for (std::size_t i = 0; i < packets.size(); ++i) {
    const EventRow& row = event_rows::row_of(static_cast<EventId>(i + 1));
    EXPECT_STREQ(packets[i].name, row.name);
    EXPECT_STREQ(choices.all[i + 1].name, row.name);
    EXPECT_EQ(packets[i].service, 5);
    EXPECT_EQ(packets[i].number, i + 1);
    EXPECT_EQ(packets[i].subservice, static_cast<std::uint8_t>(row.severity));
    severities[packets[i].subservice] = true;
    EXPECT_STRNE(row.meaning, "");
    EXPECT_STRNE(row.cause, "");
    EXPECT_EQ(row.throttle.most == 0, row.throttle.frames == 0) << row.name;
  }
  EXPECT_TRUE(severities[1] && severities[2] && severities[3] && severities[4]);
}

}  // namespace
}  // namespace lasso
