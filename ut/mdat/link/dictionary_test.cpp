#include "fsw/link/dictionary.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "mdat/link/dictionary_cosmos.hpp"
#include "mdat/link/dictionary_text.hpp"
#include "ut/link/pose_packet.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// All values of an attribute of elements with this tag.
std::vector<std::string> attributes(const std::string& xml, const std::string& tag, const std::string& name) {
  std::vector<std::string> values;
  for (std::size_t at = xml.find("<" + tag + " "); at != std::string::npos; at = xml.find("<" + tag + " ", at + 1)) {
    const std::string element = xml.substr(at, xml.find('>', at) - at);
    const std::size_t begin = element.find(" " + name + "=\"");
    if (begin == std::string::npos) continue;
    const std::size_t value = begin + name.size() + 3;
    values.push_back(element.substr(value, element.find('"', value) - value));
  }
  return values;
}

std::set<std::string> names(const std::string& xml, const std::string& tag) {
  const std::vector<std::string> values = attributes(xml, tag, "name");
  return {values.begin(), values.end()};
}

// Every element is closed by its own tag; returns how many there are.
std::size_t count_elements(const std::string& xml) {
  std::vector<std::string> open;
  std::size_t count = 0;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
    const std::size_t end = xml.find('>', at);
    const std::string element = xml.substr(at + 1, end - at - 1);
    if (element[0] == '?') continue;
    const std::string tag = element.substr(element[0] == '/' ? 1 : 0, element.find_first_of(" /", 1) - (element[0] == '/' ? 1 : 0));
    if (element[0] == '/') {
      EXPECT_TRUE(!open.empty() && element == "/" + open.back()) << element;
      if (!open.empty()) open.pop_back();
      continue;
    }
    ++count;
    if (element.back() != '/') open.push_back(tag);
  }
  EXPECT_TRUE(open.empty());
  return count;
}

TEST(Xtce, RefersOnlyToWhatItDefines) {
  VERIFIES("LASSO-GND-022~1");
  const std::string xml = dictionary_xtce();
  EXPECT_GT(count_elements(xml), 500U);
  std::set<std::string> types;
  for (const char* tag : {"IntegerParameterType", "FloatParameterType", "EnumeratedParameterType", "ArrayParameterType"})
    types.merge(names(xml, tag));
  const std::set<std::string> parameters = names(xml, "Parameter");
  std::set<std::string> containers = names(xml, "SequenceContainer");
  containers.merge(names(xml, "CommandContainer"));
  for (const std::string& name : attributes(xml, "Parameter", "parameterTypeRef")) EXPECT_TRUE(types.contains(name)) << name;
  for (const std::string& name : attributes(xml, "ArrayParameterType", "arrayTypeRef")) EXPECT_TRUE(types.contains(name)) << name;
  for (const char* tag : {"ParameterRefEntry", "ArrayParameterRefEntry", "Comparison"}) {
    for (const std::string& name : attributes(xml, tag, "parameterRef")) EXPECT_TRUE(parameters.contains(name)) << name;
  }
  for (const std::string& name : attributes(xml, "BaseContainer", "containerRef")) EXPECT_TRUE(containers.contains(name)) << name;
}

TEST(Xtce, HasEveryItemOnceAndInOrder) {
  VERIFIES("LASSO-GND-022~1");
  const std::string xml = dictionary_xtce();
  for (const PacketRow& packet : kPackets) {
    if (packet.type != PacketType::kTelemetry) continue;
    std::size_t at = xml.find("<SequenceContainer name=\"" + std::string(packet.name) + "\"");
    ASSERT_NE(at, std::string::npos);
    for (const ItemRow& row : packet.items) {
      const std::string entry = "RefEntry parameterRef=\"" + std::string(packet.name) + "_" + row.name + "\"";
      const std::size_t next = xml.find(entry, at);
      ASSERT_NE(next, std::string::npos) << row.name;
      EXPECT_EQ(xml.find(entry, next + 1), std::string::npos) << row.name;
      at = next;
    }
  }
}

TEST(Xtce, SizesAreThoseOfThePackets) {
  VERIFIES("LASSO-GND-022~1");
  const std::string xml = dictionary_xtce();
  const auto bits_of = [&](const std::string& type) {
    const std::size_t at = xml.find("ParameterType name=\"" + type + "\"");
    const std::string before = "DataEncoding sizeInBits=\"";
    return std::stoul(xml.substr(xml.find(before, at) + before.size(), 4));
  };
  std::size_t bits = 0;
  for (const HeaderField& field : kPrimaryFields) bits += bits_of(std::string(field.name) + "_t");
  for (const HeaderField& field : kTelemetryFields) bits += bits_of(std::string(field.name) + "_t");
  bits += bits_of("number_t") + bits_of("crc_t");
  for (const ItemRow& row : kPackets[0].items) {
    bits += row.count * bits_of("pose_" + std::string(row.name) + (row.count > 1 ? "_element_t" : "_t"));
  }
  EXPECT_EQ(bits, 835U * 8);
}

// For readers that know no arrays: what the elements are called, and that nothing else has changed.
TEST(Xtce, WrittenOutHasEachElementOfAnArrayInOrder) {
  VERIFIES("LASSO-GND-144~1");
  const std::string whole = dictionary_xtce(), flat = dictionary_xtce(XtceArrays::kWrittenOut);
  EXPECT_EQ(flat.find("Array"), std::string::npos);
  EXPECT_GT(count_elements(flat), count_elements(whole));
  std::size_t entries = 0, at = flat.find("<SequenceContainer name=\"pose\"");
  for (const ItemRow& row : kPackets[0].items) {
    for (unsigned i = 0; i < row.count; ++i, ++entries) {
      const std::string name = "pose_" + std::string(row.name) + (row.count > 1 ? "_" + std::to_string(i) : "");
      at = flat.find("<ParameterRefEntry parameterRef=\"" + name + "\"/>", at);
      ASSERT_NE(at, std::string::npos) << name;
      const std::string parameter = "<Parameter name=\"" + name + "\" parameterTypeRef=\"pose_" + row.name + "_t\"";
      EXPECT_NE(flat.find(parameter), std::string::npos) << parameter;
    }
  }
  EXPECT_GT(entries, kPackets[0].items.size());
  for (const char* tag : {"IntegerArgumentType", "FloatArgumentType", "EnumeratedArgumentType"}) {
    for (const std::string& name : names(flat, tag)) EXPECT_EQ(name.find("_element_t"), std::string::npos) << name;
  }
}

// The text between a tag that has this name and its end.
std::string element(const std::string& xml, const std::string& tag, const std::string& name) {
  const std::size_t begin = xml.find("<" + tag + " name=\"" + name + "\"");
  return begin == std::string::npos ? "" : xml.substr(begin, xml.find("</" + tag + ">", begin) - begin);
}

// As a mission control system does: the entries of the command every command extends and its own, one behind the other.
TEST(Xtce, CommandsAreAsLongAsTheySay) {
  VERIFIES("LASSO-GND-022~1");
  const std::string xml = dictionary_xtce();
  const auto bits_of = [&](const std::string& argument) {
    const std::string single = element(xml, "IntegerArgumentType", argument) + element(xml, "FloatArgumentType", argument) +
                               element(xml, "EnumeratedArgumentType", argument);
    EXPECT_NE(single, "") << argument;
    const std::string before = "DataEncoding sizeInBits=\"";
    return std::stoul(single.substr(single.find(before) + before.size(), 4));
  };
  const auto entry_bits = [&](const std::string& command) {
    std::size_t bits = 0;
    for (const std::string& size : attributes(command, "FixedValueEntry", "sizeInBits")) bits += std::stoul(size);
    for (const std::string& name : attributes(command, "ArgumentRefEntry", "argumentRef")) bits += bits_of(name + "_t");
    for (const std::string& name : attributes(command, "ArrayArgumentRefEntry", "argumentRef")) {
      const std::string array = element(xml, "ArrayArgumentType", name + "_t");
      const std::size_t last = array.rfind("<FixedValue>") + 12;
      bits += (std::stoul(array.substr(last, 4)) + 1) * bits_of(name + "_element_t");
    }
    return bits;
  };
  const std::string base = element(xml, "MetaCommand", "command");
  EXPECT_EQ(entry_bits(base), kCommandHeaderBytes * 8);
  EXPECT_EQ(attributes(base, "FixedValueEntry", "binaryValue"), (std::vector<std::string>{"00", "01", "01", "03D1", "03", "02"}));
  for (const PacketRow& packet : command_rows::kCommands) {
    const std::string command = element(xml, "MetaCommand", packet.name);
    const std::size_t bytes = (entry_bits(base) + entry_bits(command)) / 8;
    EXPECT_EQ(bytes, item_offset(packet, packet.items.size()) + kPacketTrailerBytes) << packet.name;
    EXPECT_EQ(attributes(command, "ArgumentAssignment", "argumentValue"),
              (std::vector<std::string>{std::to_string(bytes - 7), std::to_string(packet.service), std::to_string(packet.subservice)}));
    for (const std::string& name : attributes(command, "ArgumentRefEntry", "argumentRef")) {
      EXPECT_TRUE(names(command, "Argument").contains(name)) << name;
    }
    EXPECT_EQ(command.find("DefaultSignificance") != std::string::npos, packet.hazard != Hazard::kNone) << packet.name;
  }
}

TEST(DictionaryJson, HasEveryPacketItemAndChoice) {
  VERIFIES("LASSO-GND-022~1");
  const auto json = nlohmann::json::parse(dictionary_json());
  EXPECT_EQ(json.at("apid"), kApid);
  ASSERT_EQ(json.at("packets").size(), std::size(kPackets));
  const auto& pose = json.at("packets").at(0);
  EXPECT_EQ(pose.at("size"), test::pose_packet_bytes());
  ASSERT_EQ(pose.at("items").size(), kPackets[0].items.size());
  EXPECT_EQ(pose.at("items").at(0).at("byte"), 22);
  EXPECT_TRUE(pose.at("items").at(0).at("maximum").is_null()) << "unbounded";
  EXPECT_EQ(pose.at("items").at(5).at("enumeration"), "pose_reason");
  EXPECT_EQ(json.at("enumerations").at("pose_reason").at(11).at("name"), "implausible");
  std::map<int, std::string> parameters;
  for (const auto& parameter : json.at("parameters")) EXPECT_TRUE(parameters.emplace(parameter.at("id"), parameter.at("name")).second);
  EXPECT_GT(parameters.size(), 70U);
  EXPECT_EQ(parameters.at(60), "tracking.coast_frames");
}

// The dictionary of another component is the preset's with another number, in each format where packets are told apart by it.
TEST(Dictionaries, AreOfTheComponentThatIsAskedFor) {
  VERIFIES("LASSO-LNK-044~1");
  constexpr std::uint16_t kOther = 0x2A5;
  EXPECT_EQ(nlohmann::json::parse(dictionary_json(kOther)).at("apid"), kOther);
  const std::string preset[] = {dictionary_xtce(), dictionary_lua(), dictionary_cosmos().at("targets/LASSO/cmd_tlm/cmd.txt"),
                                dictionary_cosmos().at("targets/LASSO/cmd_tlm/tlm.txt")};
  const auto cosmos = dictionary_cosmos(kOther);
  const std::string other[] = {dictionary_xtce(XtceArrays::kAsArrays, kOther), dictionary_lua(kOther),
                               cosmos.at("targets/LASSO/cmd_tlm/cmd.txt"), cosmos.at("targets/LASSO/cmd_tlm/tlm.txt")};
  for (std::size_t i = 0; i < std::size(preset); ++i) {
    std::istringstream a(preset[i]), b(other[i]);
    std::string line, changed;
    std::size_t differ = 0;
    while (std::getline(a, line) && std::getline(b, changed)) {
      if (line == changed) continue;
      ++differ;
      EXPECT_NE(line.find("977") == std::string::npos, line.find("03D1") == std::string::npos) << line;
      EXPECT_NE(changed.find("677") == std::string::npos, changed.find("02A5") == std::string::npos) << changed;
    }
    EXPECT_GT(differ, 0U) << i;
    EXPECT_EQ(other[i].find("977"), std::string::npos) << i;
  }
  EXPECT_NE(dictionary_markdown(kOther).find("(APID) is 677 (0x2A5). Time"), std::string::npos);
  EXPECT_NE(dictionary_html(kOther).find("(APID) is 677 (0x2A5). Time"), std::string::npos);
}

TEST(Documents, HaveEveryItem) {
  VERIFIES("LASSO-GND-022~1");
  const std::string markdown = dictionary_markdown(), html = dictionary_html(), lua = dictionary_lua();
  for (const PacketRow& packet : kPackets) {
    for (const ItemRow& row : packet.items) {
      EXPECT_NE(markdown.find("| " + std::string(row.name) + " |"), std::string::npos) << row.name;
      EXPECT_NE(html.find("<td>" + std::string(row.name) + "</td>"), std::string::npos) << row.name;
      EXPECT_NE(lua.find("{name = \"" + std::string(row.name) + "\""), std::string::npos) << row.name;
    }
  }
  EXPECT_EQ(html.find("http"), std::string::npos) << "it opens offline";
  EXPECT_EQ(html.find('`'), std::string::npos);
  EXPECT_NE(markdown.find("rosette\\|lissajous\\|raster"), std::string::npos) << "a bar within a cell";
}

TEST(Dictionary, IdsAndNamesAreUniqueAndEverythingIsExplained) {
  VERIFIES("LASSO-LNK-002~1");
  for (const PacketRow& packet : kPackets) {
    std::set<std::string> names;
    std::set<std::uint16_t> ids;
    for (const ItemRow& row : packet.items) {
      EXPECT_TRUE(names.insert(row.name).second) << row.name;
      EXPECT_TRUE(ids.insert(row.id).second) << row.name;
      EXPECT_STRNE(row.meaning, "") << row.name;
      EXPECT_LE(row.range.minimum, row.range.maximum) << row.name;
    }
  }
}

// What a name says of its unit at its end; empty: nothing.
std::string unit_of_name(const std::string& name) {
  const std::pair<const char*, const char*> kEnds[] = {{"_radps", "rad/s"}, {"_mps", "m/s"}, {"_rad", "rad"},
                                                       {"_us", "us"},       {"_m", "m"},     {"_s", "s"}};
  for (const auto& [end, unit] : kEnds) {
    if (name.ends_with(end)) return unit;
  }
  return "";
}

bool says_another_unit(const std::string& name) {
  for (const char* end : {"_mm", "_cm", "_km", "_ms", "_ns", "_min", "_h", "_hz", "_mrad", "_rpm", "_percent"}) {
    if (name.ends_with(end)) return true;
  }
  return name.find("deg") != std::string::npos;
}

// The value of a mission's key, whose own row says the unit.
bool is_of_a_parameter(const PacketRow& packet, const ItemRow& row) {
  const std::string name = row.name;
  const bool tells_it =
      std::any_of(packet.items.begin(), packet.items.end(), [](const ItemRow& item) { return std::string(item.name) == "parameter"; });
  return tells_it && (name == "value" || name == "image_value");
}

// By its meaning, or its shape: four real numbers.
bool is_attitude(const ItemRow& row) {
  return std::string(row.meaning).find("quaternion") != std::string::npos || (row.count == 4 && is_real(row.type));
}

TEST(Dictionary, UnitsAreOfOneSystemAndNamesAgreeWithThem) {
  VERIFIES("LASSO-SYS-022~3");
  const std::set<std::string> system = {"1", "m", "rad", "m/s", "rad/s", "s", "us"};
  int named = 0, mixed = 0, attitudes = 0, parameters = 0;
  for (const PacketRow& packet : kPackets) {
    for (const ItemRow& row : packet.items) {
      const std::string place = std::string(packet.name) + "." + row.name, unit = row.unit;
      EXPECT_EQ(unit == "as it says", is_of_a_parameter(packet, row)) << place;
      parameters += is_of_a_parameter(packet, row);
      std::istringstream parts(unit == "as it says" ? "1" : unit);
      for (std::string part; std::getline(parts, part, ',');) EXPECT_TRUE(system.contains(part)) << place << " [" << unit << "]";
      mixed += unit.find(',') != std::string::npos;
      const std::string said = unit_of_name(row.name);
      if (said != "") {
        EXPECT_EQ(said, unit) << place;
      }
      named += said != "";
      EXPECT_FALSE(says_another_unit(row.name)) << place;
      if (!is_attitude(row)) continue;
      ++attitudes;
      EXPECT_TRUE(std::string(row.name).ends_with("q_sensor_target") || std::string(row.name).ends_with("q_in_of")) << place;
    }
  }
  EXPECT_GT(named, 20);
  EXPECT_GT(mixed, 5) << "arrays of two quantities say both units, in their order";
  EXPECT_GE(attitudes, 5);
  EXPECT_EQ(parameters, 4) << "of the command, its report (two) and its event";
}

}  // namespace
}  // namespace lasso::mdat
