#include "mdat/link/command_encoder.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "mdat/common/errors.hpp"
#include "mdat/link/decode.hpp"
#include "mdat/link/dictionary_text.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using Bytes8 = std::vector<std::uint8_t>;

std::string refusal_of(const std::string& name, const std::map<std::string, std::string>& values) {
  try {
    encode_command(command_row(name), values, 0);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// A value that the item takes.
std::string drawn(const ItemRow& item, test::Generator& random) {
  if (item.enumeration != nullptr) return item.enumeration->choices[random.below(item.enumeration->choices.size())].name;
  const double low = std::isinf(item.range.minimum) ? (is_real(item.type) || item.type == WireType::kI64 ? -1e6 : 0) : item.range.minimum;
  const double high = std::isinf(item.range.maximum) ? (item.type == WireType::kU8 ? 255 : 65535) : item.range.maximum;
  const double value = low + (high - low) * static_cast<double>(random.below(1000000)) / 1e6;
  return is_real(item.type) ? text_of(Number(value)) : std::to_string(static_cast<std::int64_t>(value));
}

TEST(CommandEncoder, EveryCommandIsAcceptedByTheFlightDecoderAndReadBackTheSame) {
  VERIFIES("LASSO-LNK-023~2 LASSO-GND-021~2");
  test::Generator random(31);
  for (const PacketRow& row : kPackets) {
    if (row.type != PacketType::kCommand) continue;
    for (std::uint16_t round = 0; round < 20; ++round) {
      std::map<std::string, std::string> values;
      for (const ItemRow& item : row.items) {
        std::string text;
        for (std::size_t i = 0; i < item.count; ++i) text += (i == 0 ? "" : ",") + drawn(item, random);
        values[item.name] = text;
      }
      const Bytes8 packet = encode_command(row, values, round);
      Command command;
      ASSERT_EQ(decode_command({packet.data(), packet.size()}, command), PacketFault::kNone) << row.name;
      EXPECT_EQ(command.header.sequence_count, round);
      EXPECT_TRUE((command.name == CommandName{row.service, row.subservice, row.number})) << row.name;
      const DecodedStream decoded = decode_stream({packet.data(), packet.size()}, PacketType::kCommand);
      ASSERT_EQ(decoded.packets.size(), 1U);
      ASSERT_EQ(decoded.packets[0].row, &row);
      std::map<std::string, std::string> again;
      for (const DecodedItem& item : decoded.packets[0].items) {
        for (const Number& number : item.values) again[item.row->name] += (again[item.row->name].empty() ? "" : ",") + text_of(number);
      }
      EXPECT_EQ(encode_command(row, again, round), packet) << row.name;
    }
  }
}

TEST(CommandEncoder, IsByteForByteAsPutTogetherByHand) {
  VERIFIES("LASSO-LNK-033~1");
  const Bytes8 packet = encode_command(command_row("set_structure_period"), {{"structure", "pose"}, {"period_frames", "5"}}, 7);
  EXPECT_EQ(Bytes8(packet.begin(), packet.end() - 2), (Bytes8{0x1B, 0xD1, 0xC0, 0x07, 0x00, 0x0A, 0x29, 3, 31, 0, 0, 0, 1, 0, 5}));
  const Bytes8 arm = arm_for(command_row("enable_laser"), 1);
  EXPECT_EQ(Bytes8(arm.begin() + 7, arm.end() - 2), (Bytes8{8, 1, 0, 0, 0, 4, 8, 1, 0, 5}));
}

TEST(CommandEncoder, TakesParametersByName) {
  VERIFIES("LASSO-GND-021~2");
  const PacketRow& row = command_row("report_parameter");
  EXPECT_EQ(encode_command(row, {{"parameter", "sensor.sigma_k_per_m"}}, 0), encode_command(row, {{"parameter", "1"}}, 0));
  const nlohmann::json dictionary = nlohmann::json::parse(dictionary_json());
  for (const nlohmann::json& parameter : dictionary.at("parameters")) {
    const std::string name = parameter.at("name"), id = parameter.at("id").dump();
    EXPECT_EQ(encode_command(row, {{"parameter", name}}, 0), encode_command(row, {{"parameter", id}}, 0)) << name;
  }
  EXPECT_NE(refusal_of("report_parameter", {{"parameter", "sensor.size"}}).find("not an integer"), std::string::npos);
}

TEST(CommandEncoder, WhatIsWrongIsNamedWithItsPlaceAndRemedy) {
  VERIFIES("LASSO-GND-021~2");
  EXPECT_THROW(command_row("pose"), InputError) << "telemetry";
  try {
    command_row("mode");
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "mode: no command of the dictionary; there is set_mode; mdat command --list shows all");
  }
  EXPECT_EQ(refusal_of("set_mode", {}).substr(0, 25), "set_mode: mode is missing");
  EXPECT_EQ(refusal_of("set_mode", {{"colour", "red"}, {"mode", "0"}}).substr(0, 28), "set_mode: has no item colour");
  EXPECT_EQ(refusal_of("set_mode", {{"mode", "fast"}}), "set_mode: mode=fast: not an integer, and no name of mode");
  EXPECT_NE(refusal_of("set_hold", {{"held", "2"}}).find("out of range, which is yes_no (u8)"), std::string::npos);
  EXPECT_NE(refusal_of("arm", {{"service", "256"}, {"subservice", "0"}, {"number", "0"}}).find("out of range"), std::string::npos);
  EXPECT_NE(refusal_of("correlate_time", {{"component_us", "1.5"}, {"spacecraft_us", "0"}}).find("not an integer"), std::string::npos);
  EXPECT_THROW(split_argument("mode"), InputError);
  EXPECT_EQ(split_argument("a=b=c").second, "b=c");
  std::map<std::string, std::string> start{{"start_source", "uplink"},   {"t_us", "0"},
                                           {"q_sensor_target", "0,0,0"}, {"p_sensor_target_m", "0,0,1"},
                                           {"omega_radps", "0,0,0"},     {"v_mps", "0,0,0"}};
  EXPECT_NE(refusal_of("offer_start", start).find("q_sensor_target=0,0,0: has 3 values, and needs 4"), std::string::npos);
}

TEST(CommandEncoder, HelpNamesEveryItemAndChoice) {
  VERIFIES("LASSO-GND-021~2");
  const std::string list = command_list(), help = command_help(command_row("set_mode"));
  for (const PacketRow& row : kPackets)
    EXPECT_EQ(list.find(std::string("\n") + row.name + " ") != std::string::npos || list.find(std::string(row.name) + " ") == 0,
              row.type == PacketType::kCommand)
        << row.name;
  EXPECT_NE(list.find("(hazardous: --arm)"), std::string::npos);
  EXPECT_NE(help.find("reacquiring"), std::string::npos);
}

// A load with a command at a place of its data; one of its bits is wrong, or none.
std::map<std::string, std::string> load_with_command_at(std::size_t place, std::uint8_t wrong = 0) {
  Bytes8 data(kMemoryBlockBytes, 0x18);
  Bytes8 held = encode_command(command_row("enable_laser"), {}, 3);
  held.back() ^= wrong;
  std::copy(held.begin(), held.end(), data.begin() + static_cast<std::ptrdiff_t>(place));
  std::string text;
  for (const std::uint8_t byte : data) text += (text.empty() ? "" : ",") + std::to_string(byte);
  return {{"area", "other_image"}, {"offset", "0"}, {"bytes", std::to_string(kMemoryBlockBytes)}, {"data", text}};
}

TEST(CommandEncoder, ACommandThatHoldsAnotherIsRefused) {
  VERIFIES("LASSO-LNK-038~2");
  for (const std::size_t place : {0U, 1U, 50U, 113U}) {
    const std::string said = refusal_of("load_memory", load_with_command_at(place));
    EXPECT_NE(said.find("load_memory: holds another command (enable_laser)"), std::string::npos) << place << said;
  }
  EXPECT_EQ(refusal_of("load_memory", load_with_command_at(50, 1)), "");
}

}  // namespace
}  // namespace lasso::mdat
