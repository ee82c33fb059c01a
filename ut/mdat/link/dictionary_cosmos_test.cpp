#include "mdat/link/dictionary_cosmos.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <iterator>
#include <set>
#include <sstream>
#include <vector>

#include "fsw/link/dictionary.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// An item as COSMOS sees it: where it begins, behind all before it.
struct CosmosItem {
  std::string name, type;
  std::size_t bit = 0, bits = 0;  // of the whole array
  std::vector<std::string> rest;  // words behind the type, without quoted ones
  std::vector<std::string> states;
  std::string unit;
};
struct CosmosPacket {
  std::string name;
  std::vector<CosmosItem> items;
  bool hazardous = false;
  const CosmosItem* item(const std::string& wanted) const {
    for (const CosmosItem& one : items) {
      if (one.name == wanted) return &one;
    }
    return nullptr;
  }
};

std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  std::size_t at = line.find_first_not_of(' ');
  while (at != std::string::npos) {
    const std::size_t end = line[at] == '"' ? line.find('"', at + 1) + 1 : line.find(' ', at);
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(' ', std::min(end, line.size()));
  }
  return words;
}

// Reads what COSMOS reads: APPEND_ lines put items one behind the other.
std::vector<CosmosPacket> read_definitions(std::string text) {
  for (std::size_t at = text.find("<%="); at != std::string::npos; at = text.find("<%="))
    text.replace(at, text.find("%>", at) + 2 - at, "T");
  std::vector<CosmosPacket> packets;
  std::size_t bit = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::vector<std::string> words = words_of(line);
    if (words.empty() || words[0] == "#") continue;
    if (words[0] == "TELEMETRY" || words[0] == "COMMAND") {
      packets.push_back({words.at(2), {}});
      bit = 0;
    } else if (words[0] == "HAZARDOUS") {
      packets.back().hazardous = true;
    } else if (words[0] == "STATE") {
      packets.back().items.back().states.push_back(words.at(1));
      EXPECT_EQ(words.at(2), std::to_string(packets.back().items.back().states.size() - 1)) << line;
    } else if (words[0] == "UNITS") {
      packets.back().items.back().unit = words.at(2);
    } else if (words[0].rfind("APPEND_", 0) == 0) {
      const bool array = words[0].find("ARRAY") != std::string::npos;
      const std::size_t bits = std::stoul(words.at(array ? 4 : 2));
      packets.back().items.push_back({words.at(1), words.at(3), bit, bits, {words.begin() + 4, words.end() - 1}, {}, ""});
      bit += bits;
    } else {
      EXPECT_EQ(words[0], "REQUIRED") << line;
    }
  }
  return packets;
}

std::string in_capitals(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

const CosmosPacket& packet_of(const std::vector<CosmosPacket>& packets, const PacketRow& row) {
  static const CosmosPacket kNone;
  for (const CosmosPacket& packet : packets) {
    if (packet.name == in_capitals(row.name)) return packet;
  }
  ADD_FAILURE() << row.name;
  return kNone;
}

void expect_item(const CosmosPacket& packet, const PacketRow& row, std::size_t index) {
  const ItemRow& item = row.items[index];
  const CosmosItem* found = packet.item(in_capitals(item.name));
  ASSERT_NE(found, nullptr) << row.name << " " << item.name;
  EXPECT_EQ(found->bit, 8 * item_offset(row, index)) << row.name << " " << item.name;
  EXPECT_EQ(found->bits, 8 * item.size()) << row.name << " " << item.name;
  EXPECT_EQ(found->type == "FLOAT", is_real(item.type)) << row.name << " " << item.name;
  EXPECT_EQ(found->type == "INT", item.type == WireType::kI64) << row.name << " " << item.name;
  EXPECT_EQ(found->states.size(), item.enumeration == nullptr ? 0U : item.enumeration->choices.size()) << row.name << " " << item.name;
  EXPECT_EQ(found->unit, std::string(item.unit) == "1" ? "" : "\"" + std::string(item.unit) + "\"") << row.name << " " << item.name;
}

void expect_packet(const CosmosPacket& packet, const PacketRow& row) {
  std::set<std::string> names;
  for (const CosmosItem& item : packet.items) EXPECT_TRUE(names.insert(item.name).second) << row.name << " has two of " << item.name;
  ASSERT_FALSE(packet.items.empty()) << row.name;
  const CosmosItem& last = packet.items.back();
  EXPECT_EQ(last.name, "PACKET_CRC");
  EXPECT_EQ(last.bit + last.bits, 8 * (item_offset(row, row.items.size()) + kPacketTrailerBytes)) << row.name;
  for (std::size_t i = 0; i < row.items.size(); ++i) expect_item(packet, row, i);
  ASSERT_NE(packet.item("PUS_SERVICE"), nullptr);
  EXPECT_EQ(packet.item("PUS_SERVICE")->rest.at(0), std::to_string(row.service)) << row.name;
  EXPECT_EQ(packet.item("PUS_SUBSERVICE")->rest.at(0), std::to_string(row.subservice)) << row.name;
  EXPECT_EQ(packet.item("CCSDS_APID")->bit, 5U);
  const CosmosItem* number = packet.item("PUS_NUMBER");
  EXPECT_EQ(number == nullptr ? "none" : number->rest.at(0), row.numbered ? std::to_string(row.number) : "none") << row.name;
}

TEST(Cosmos, TelemetryIsWhereTheDictionarySays) {
  VERIFIES("LASSO-GND-145~1");
  const std::vector<CosmosPacket> packets = read_definitions(dictionary_cosmos().at("targets/LASSO/cmd_tlm/tlm.txt"));
  std::size_t count = 0;
  for (const PacketRow& row : kPackets) {
    if (row.type != PacketType::kTelemetry) continue;
    expect_packet(packet_of(packets, row), row);
    ++count;
  }
  EXPECT_EQ(packets.size(), count);
}

TEST(Cosmos, CommandsAreWhereTheDictionarySaysWithTheirRanges) {
  VERIFIES("LASSO-GND-145~1");
  const std::vector<CosmosPacket> packets = read_definitions(dictionary_cosmos().at("targets/LASSO/cmd_tlm/cmd.txt"));
  EXPECT_EQ(packets.size(), std::size(command_rows::kCommands));
  for (const PacketRow& row : command_rows::kCommands) {
    const CosmosPacket& packet = packet_of(packets, row);
    expect_packet(packet, row);
    EXPECT_EQ(packet.hazardous, row.hazard != Hazard::kNone) << row.name;
    const std::size_t bytes = item_offset(row, row.items.size()) + kPacketTrailerBytes;
    EXPECT_EQ(packet.item("CCSDS_DATA_LENGTH")->rest.at(2), std::to_string(bytes - 7)) << row.name;
    for (const ItemRow& item : row.items) {
      if (item.count > 1 || item.range.maximum > 1e9) continue;
      const CosmosItem& found = *packet.item(in_capitals(item.name));
      EXPECT_EQ(std::stod(found.rest.at(1)), item.range.maximum) << row.name << " " << item.name;
      const double first = std::stod(found.rest.at(2));
      EXPECT_TRUE(first >= item.range.minimum && first <= item.range.maximum) << row.name << " " << item.name;
    }
  }
}

TEST(Cosmos, ScreenAndProtocolsNameItemsThatAreThere) {
  VERIFIES("LASSO-GND-145~1");
  const std::map<std::string, std::string> files = dictionary_cosmos();
  const std::vector<CosmosPacket> packets = read_definitions(files.at("targets/LASSO/cmd_tlm/tlm.txt"));
  std::istringstream lines(files.at("targets/LASSO/screens/pose.txt"));
  int shown = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(" POSE ");
    if (line.find("LABELVALUE") == std::string::npos) continue;
    EXPECT_NE(packets[0].item(words_of(line.substr(at + 6))[0]), nullptr) << line;
    ++shown;
  }
  EXPECT_GT(shown, 5);
  EXPECT_NE(files.at("plugin.txt").find("CrcProtocol PACKET_CRC false ERROR -16 16 BIG_ENDIAN 0x1021 0xFFFF false false"),
            std::string::npos);
  EXPECT_NE(files.at("targets/LASSO/lib/lasso_sequence_protocol.rb").find("CCSDS_SEQUENCE_COUNT"), std::string::npos);
}

}  // namespace
}  // namespace lasso::mdat
