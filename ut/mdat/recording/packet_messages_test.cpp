#include "mdat/recording/packet_messages.hpp"

#include <gtest/gtest.h>

#include <set>

#include "hal_sim/random.hpp"
#include "mdat/mcap/definition.hpp"
#include "mdat/mcap/message_value.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// A packet of any row: headers as told, items of random bytes, no CRC that anybody looks at.
std::vector<std::uint8_t> random_packet(const PacketRow& row, sim::Random& random) {
  std::vector<std::uint8_t> bytes(item_offset(row, row.items.size()) + kPacketTrailerBytes);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.uniform(0, 128));  // no real of them is infinite or none
  bytes[7] = row.service;
  bytes[8] = row.subservice;
  if (row.numbered) {
    bytes[data_offset(row) - 2] = static_cast<std::uint8_t>(row.number >> 8U);
    bytes[data_offset(row) - 1] = static_cast<std::uint8_t>(row.number & 0xFFU);
  }
  return bytes;
}

double element(const mcap::MessageValue& value, std::size_t i) {
  if (value.is_binary()) return value.get_binary().at(i);
  return value.is_array() ? value.at(i).get<double>() : value.get<double>();
}

// What a reader makes of the message by the definition that comes with it.
TEST(PacketMessages, SayWhatTheDictionaryDecodes) {
  VERIFIES("LASSO-REC-024~1");
  sim::Random random(24);
  for (const PacketRow* row : told_packets()) {
    const std::vector<std::uint8_t> bytes = random_packet(*row, random);
    const DecodedPacket packet = decode_packet(ConstBytes(bytes.data(), bytes.size()), PacketType::kTelemetry);
    ASSERT_EQ(packet.row, row) << row->name;
    const RosSchema schema = packet_schema(*row);
    const mcap::MessageValue value = mcap::value_of(mcap::parse_definition(schema.name, schema.text), packet_message(2'500'000, packet));
    EXPECT_EQ(value.at("header").at("stamp").at("sec"), 2);
    EXPECT_EQ(value.at("sequence_count").get<unsigned>(), ((bytes[2] & 0x3FU) << 8U) | bytes[3]);
    EXPECT_EQ(value.size(), 2 + packet.items.size());
    for (const DecodedItem& item : packet.items) {
      for (std::size_t i = 0; i < item.values.size(); ++i)
        EXPECT_EQ(element(value.at(item.row->name), i), value_of(item.values[i])) << row->name << " " << item.row->name << " " << i;
    }
  }
}

TEST(PacketMessages, HaveNamesAsRosHasThem) {
  VERIFIES("LASSO-REC-024~1");
  std::set<std::string> topics, types;
  for (const PacketRow* row : told_packets()) {
    topics.insert(packet_topic(*row));
    types.insert(packet_schema(*row).name);
  }
  EXPECT_EQ(topics.size(), told_packets().size());
  EXPECT_EQ(types.size(), told_packets().size());
  EXPECT_TRUE(topics.count("/telemetry/mode_changed") == 1 && types.count("lasso_msgs/msg/ModeChanged") == 1);
  EXPECT_EQ(types.count("lasso_msgs/msg/Packet"), 0U) << "which is that of /packets";
}

TEST(PacketMessages, HaveTheValuesOfEnumerationsAsConstants) {
  VERIFIES("LASSO-REC-024~1");
  for (const PacketRow* row : told_packets()) {
    if (std::string(row->name) != "pose") continue;
    const std::string text = packet_schema(*row).text;
    EXPECT_NE(text.find("uint8 MODE_STANDBY=0\nuint8 MODE_STARTING=1\nuint8 MODE_TRACKING=2\n"), std::string::npos);
    EXPECT_NE(text.find("float64[21] covariance # "), std::string::npos);
    EXPECT_NE(text.find("int64 t_measurement_us # "), std::string::npos);
  }
}

}  // namespace
}  // namespace lasso::mdat
