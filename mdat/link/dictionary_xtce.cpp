// XTCE 1.2. Telemetry: header fields and items are parameters; each packet is a container that extends the one of the headers, told by its
// service, subservice and structure. Commands: items are arguments; each command extends the abstract one of the headers, and says their
// values. Sequence count and checksum are for whoever sends it to fill in.
#include <cmath>
#include <set>
#include <vector>

#include "fsw/link/dictionary.hpp"
#include "mdat/common/text.hpp"
#include "mdat/link/dictionary_text.hpp"
#include "mdat/link/number.hpp"

namespace lasso::mdat {
namespace {

std::string attribute(const char* name, const std::string& value) { return format(" %s=\"%s\"", name, escape(value).c_str()); }

std::string integer_encoding(std::size_t bits, bool is_signed) {
  return format("<IntegerDataEncoding sizeInBits=\"%zu\" encoding=\"%s\"/>", bits, is_signed ? "twosComplement" : "unsigned");
}

std::string unit_set(const ItemRow& row) {
  return std::string(row.unit) == "1" ? "<UnitSet/>" : format("<UnitSet><Unit>%s</Unit></UnitSet>", escape(row.unit).c_str());
}

// What is written alike for parameters of telemetry and arguments of commands.
enum class Kind { kParameter, kArgument };
const char* word(Kind kind) { return kind == Kind::kParameter ? "Parameter" : "Argument"; }

// A range of integers has bounds without an exponent.
std::string bound(const ItemRow& row, double value) { return is_real(row.type) ? real_text(value) : format("%.0f", value); }

std::string valid_range(const ItemRow& row, Kind kind) {
  std::string bounds;
  if (!std::isinf(row.range.minimum)) bounds += attribute("minInclusive", bound(row, row.range.minimum));
  if (!std::isinf(row.range.maximum)) bounds += attribute("maxInclusive", bound(row, row.range.maximum));
  if (bounds.empty()) return "";
  const std::string range = "<ValidRange" + bounds + "/>";
  return kind == Kind::kParameter ? range : "<ValidRangeSet>" + range + "</ValidRangeSet>";
}

std::string enumeration_list(const Enumeration& enumeration) {
  std::string list = "<EnumerationList>";
  std::size_t value = 0;
  for (const Choice& choice : enumeration.choices) {
    list += format("<Enumeration value=\"%zu\"", value++) + attribute("label", choice.name) +
            attribute("shortDescription", choice.meaning) + "/>";
  }
  return list + "</EnumerationList>";
}

// The type of one element.
std::string element_type(const ItemRow& row, const std::string& name, Kind kind) {
  const std::size_t bits = 8 * wire_size(row.type);
  const auto element = [&](const char* type, const std::string& attributes, const std::string& content) {
    const std::string tag = std::string(type) + word(kind) + "Type";
    return "<" + tag + attribute("name", name) + attributes + ">" + content + "</" + tag + ">\n";
  };
  if (row.enumeration != nullptr) {
    return element("Enumerated", "", "<UnitSet/>" + integer_encoding(bits, false) + enumeration_list(*row.enumeration));
  }
  const std::string size = format(" sizeInBits=\"%zu\"", bits);
  if (is_real(row.type)) return element("Float", size, unit_set(row) + "<FloatDataEncoding" + size + "/>" + valid_range(row, kind));
  const bool is_signed = row.type == WireType::kI64;
  return element("Integer", size + attribute("signed", is_signed ? "true" : "false"),
                 unit_set(row) + integer_encoding(bits, is_signed) + valid_range(row, kind));
}

std::string full_name(const PacketRow& packet, const ItemRow& row) { return std::string(packet.name) + "_" + row.name; }

std::string dimensions(const ItemRow& row) {
  return format(
      "<DimensionList><Dimension><StartingIndex><FixedValue>0</FixedValue></StartingIndex><EndingIndex><FixedValue>%u</FixedValue>"
      "</EndingIndex></Dimension></DimensionList>",
      row.count - 1U);
}

// What the readers know that the document is for.
bool is_array(const ItemRow& row, XtceArrays arrays) { return row.count > 1 && arrays == XtceArrays::kAsArrays; }

// Of an item; where arrays are written out, of each of its elements: NAME_0, NAME_1, ...
std::vector<std::string> element_names(const PacketRow& packet, const ItemRow& row, XtceArrays arrays) {
  const std::string name = full_name(packet, row);
  if (row.count == 1 || arrays == XtceArrays::kAsArrays) return {name};
  std::vector<std::string> names;
  for (unsigned i = 0; i < row.count; ++i) names.push_back(name + format("_%u", i));
  return names;
}

std::string item_types(const PacketRow& packet, const ItemRow& row, Kind kind, XtceArrays arrays) {
  const std::string name = full_name(packet, row);
  if (!is_array(row, arrays)) return element_type(row, name + "_t", kind);
  const std::string tag = std::string("Array") + word(kind) + "Type";
  return element_type(row, name + "_element_t", kind) + "<" + tag + attribute("name", name + "_t") +
         attribute("arrayTypeRef", name + "_element_t") + ">" + dimensions(row) + "</" + tag + ">\n";
}

std::string header_type(const HeaderField& field, Kind kind) {
  return format("<Integer%sType name=\"%s_t\" sizeInBits=\"32\" signed=\"false\"><UnitSet/>", word(kind), field.name) +
         integer_encoding(field.bits, false) + format("</Integer%sType>\n", word(kind));
}

std::string parameter(const std::string& name, const std::string& type, const std::string& meaning) {
  return "<Parameter" + attribute("name", name) + attribute("parameterTypeRef", type) + attribute("shortDescription", meaning) + "/>\n";
}

std::string item_parameters(const PacketRow& packet, const ItemRow& row, XtceArrays arrays) {
  std::string text;
  for (const std::string& name : element_names(packet, row, arrays)) text += parameter(name, full_name(packet, row) + "_t", row.meaning);
  return text;
}

std::string entry(const std::string& name) { return "<ParameterRefEntry" + attribute("parameterRef", name) + "/>\n"; }

std::string item_entries(const PacketRow& packet, const ItemRow& row, XtceArrays arrays) {
  if (is_array(row, arrays)) return "<ArrayParameterRefEntry" + attribute("parameterRef", full_name(packet, row)) + "/>\n";
  std::string text;
  for (const std::string& name : element_names(packet, row, arrays)) text += entry(name);
  return text;
}

std::string comparison(const char* name, unsigned value) { return format("<Comparison parameterRef=\"%s\" value=\"%u\"/>", name, value); }

constexpr HeaderField kNumber{"number", 160, 16, "number of the structure or event"};

std::string base_container() {
  std::string text =
      "<SequenceContainer name=\"telemetry\" abstract=\"true\" shortDescription=\"what all telemetry packets have in "
      "common\">\n<EntryList>\n";
  for (const HeaderField& field : kPrimaryFields) text += entry(field.name);
  for (const HeaderField& field : kTelemetryFields) text += entry(field.name);
  return text + "</EntryList>\n</SequenceContainer>\n";
}

std::string extending(const char* base, const std::string& comparisons) {
  return format("<BaseContainer containerRef=\"%s\"><RestrictionCriteria><ComparisonList>", base) + comparisons +
         "</ComparisonList></RestrictionCriteria></BaseContainer>\n</SequenceContainer>\n";
}

std::string type_comparisons(unsigned apid, unsigned service, unsigned subservice) {
  return comparison("apid", apid) + comparison("service", service) + comparison("subservice", subservice);
}

// Of packets that their number tells apart.
std::string family(const PacketRow& packet) { return format("numbered_%u_%u", packet.service, packet.subservice); }

std::string family_container(const PacketRow& packet, unsigned apid) {
  return format("<SequenceContainer name=\"%s\" abstract=\"true\" shortDescription=\"service %u, subservice %u\">\n<EntryList>\n",
                family(packet).c_str(), packet.service, packet.subservice) +
         entry(kNumber.name) + "</EntryList>\n" + extending("telemetry", type_comparisons(apid, packet.service, packet.subservice));
}

std::string container(const PacketRow& packet, XtceArrays arrays, unsigned apid) {
  std::string text =
      "<SequenceContainer" + attribute("name", packet.name) + attribute("shortDescription", packet.meaning) + ">\n<EntryList>\n";
  for (const ItemRow& row : packet.items) text += item_entries(packet, row, arrays);
  text += entry("crc") + "</EntryList>\n";
  if (packet.numbered) return text + extending(family(packet).c_str(), comparison(kNumber.name, packet.number));
  return text + extending("telemetry", type_comparisons(apid, packet.service, packet.subservice));
}

constexpr HeaderField kCrc{"crc", 0, 16, "CRC-16 over all bytes before it"};

// Of the fields of a command's headers: who says its value.
enum class Filled { kFixed, kApid, kByCommand, kBySender };
struct CommandField {
  const HeaderField* field;
  Filled filled;
  unsigned value;  // kFixed
};
const CommandField kCommandFieldValues[] = {
    {&kPrimaryFields[0], Filled::kFixed, 0},
    {&kPrimaryFields[1], Filled::kFixed, static_cast<unsigned>(PacketType::kCommand)},
    {&kPrimaryFields[2], Filled::kFixed, 1},
    {&kPrimaryFields[3], Filled::kApid, 0},
    {&kPrimaryFields[4], Filled::kFixed, kUnsegmented},
    {&kPrimaryFields[5], Filled::kBySender, 0},
    {&kPrimaryFields[6], Filled::kByCommand, 0},
    {&kCommandFields[0], Filled::kFixed, kPusVersion},
    {&kCommandFields[1], Filled::kBySender, 0},
    {&kCommandFields[2], Filled::kByCommand, 0},
    {&kCommandFields[3], Filled::kByCommand, 0},
    {&kCommandFields[4], Filled::kBySender, 0},
};

std::string fixed_value(const char* name, unsigned value, unsigned bits) {
  return format("<FixedValueEntry name=\"%s\" binaryValue=\"%0*X\" sizeInBits=\"%u\"/>\n", name, static_cast<int>((bits + 7) / 8 * 2),
                value, bits);
}

std::string argument(const std::string& name, const std::string& type, const std::string& meaning) {
  return "<Argument" + attribute("name", name) + attribute("argumentTypeRef", type) + attribute("shortDescription", meaning) + "/>\n";
}

std::string argument_entry(const std::string& name) { return "<ArgumentRefEntry" + attribute("argumentRef", name) + "/>\n"; }

bool is_fixed(const CommandField& header) { return header.filled == Filled::kFixed || header.filled == Filled::kApid; }

std::string command_types(XtceArrays arrays) {
  std::string text;
  for (const CommandField& header : kCommandFieldValues) {
    if (!is_fixed(header)) text += header_type(*header.field, Kind::kArgument);
  }
  for (const PacketRow& packet : command_rows::kCommands) {
    for (const ItemRow& row : packet.items) text += item_types(packet, row, Kind::kArgument, arrays);
  }
  return text;
}

std::string base_command(unsigned apid) {
  std::string arguments, entries;
  for (const CommandField& header : kCommandFieldValues) {
    const HeaderField& field = *header.field;
    const bool fixed = is_fixed(header);
    const unsigned value = header.filled == Filled::kApid ? apid : header.value;
    if (!fixed) arguments += argument(field.name, std::string(field.name) + "_t", field.meaning);
    entries += fixed ? fixed_value(field.name, value, field.bits) : argument_entry(field.name);
  }
  return "<MetaCommand name=\"command\" abstract=\"true\" shortDescription=\"what all commands have in common\">\n<ArgumentList>\n" +
         arguments + "</ArgumentList>\n<CommandContainer name=\"command\">\n<EntryList>\n" + entries +
         "</EntryList>\n</CommandContainer>\n</MetaCommand>\n";
}

std::string assignment(const char* name, std::size_t value) {
  return format("<ArgumentAssignment argumentName=\"%s\" argumentValue=\"%zu\"/>", name, value);
}

std::string argument_entries(const PacketRow& packet, const ItemRow& row, XtceArrays arrays) {
  if (is_array(row, arrays)) return "<ArrayArgumentRefEntry" + attribute("argumentRef", full_name(packet, row)) + "/>\n";
  std::string text;
  for (const std::string& name : element_names(packet, row, arrays)) text += argument_entry(name);
  return text;
}

std::string command_entries(const PacketRow& packet, XtceArrays arrays) {
  std::string text = packet.numbered ? fixed_value("number", packet.number, 16) : "";
  for (const ItemRow& row : packet.items) text += argument_entries(packet, row, arrays);
  return text + fixed_value("crc", 0, 16);
}

std::string item_arguments(const PacketRow& packet, XtceArrays arrays) {
  std::string text;
  for (const ItemRow& row : packet.items) {
    for (const std::string& name : element_names(packet, row, arrays)) text += argument(name, full_name(packet, row) + "_t", row.meaning);
  }
  return text;
}

std::string meta_command(const PacketRow& packet, XtceArrays arrays) {
  const std::size_t length = item_offset(packet, packet.items.size()) + kPacketTrailerBytes - kPrimaryHeaderBytes - 1;
  const std::string arguments = item_arguments(packet, arrays);
  return "<MetaCommand" + attribute("name", packet.name) + attribute("shortDescription", packet.meaning) +
         ">\n<BaseMetaCommand metaCommandRef=\"command\"><ArgumentAssignmentList>" + assignment("data_length", length) +
         assignment("service", packet.service) + assignment("subservice", packet.subservice) +
         "</ArgumentAssignmentList></BaseMetaCommand>\n" + (arguments.empty() ? "" : "<ArgumentList>\n" + arguments + "</ArgumentList>\n") +
         "<CommandContainer" + attribute("name", packet.name) + ">\n<EntryList>\n" + command_entries(packet, arrays) +
         "</EntryList>\n<BaseContainer containerRef=\"command\"/>\n</CommandContainer>\n" +
         (packet.hazard == Hazard::kNone ? "" : "<DefaultSignificance consequenceLevel=\"critical\" reasonForWarning=\"armed first\"/>\n") +
         "</MetaCommand>\n";
}

std::string command_meta_data(XtceArrays arrays, unsigned apid) {
  std::string commands = base_command(apid);
  for (const PacketRow& packet : command_rows::kCommands) commands += meta_command(packet, arrays);
  return "<CommandMetaData>\n<ArgumentTypeSet>\n" + command_types(arrays) + "</ArgumentTypeSet>\n<MetaCommandSet>\n" + commands +
         "</MetaCommandSet>\n</CommandMetaData>\n";
}

}  // namespace

std::string dictionary_xtce(XtceArrays arrays, std::uint16_t apid) {
  std::string types, parameters, containers = base_container();
  std::set<std::string> families;
  const auto add_field = [&](const HeaderField& field) {
    types += header_type(field, Kind::kParameter);
    parameters += parameter(field.name, std::string(field.name) + "_t", field.meaning);
  };
  for (const HeaderField& field : kPrimaryFields) add_field(field);
  for (const HeaderField& field : kTelemetryFields) add_field(field);
  add_field(kNumber);
  add_field(kCrc);
  for (const PacketRow& packet : kPackets) {
    if (packet.type != PacketType::kTelemetry) continue;
    for (const ItemRow& row : packet.items) types += item_types(packet, row, Kind::kParameter, arrays);
    for (const ItemRow& row : packet.items) parameters += item_parameters(packet, row, arrays);
    if (packet.numbered && families.insert(family(packet)).second) containers += family_container(packet, apid);
    containers += container(packet, arrays, apid);
  }
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<SpaceSystem xmlns=\"http://www.omg.org/spec/XTCE/20180204\" name=\"lasso\" "
         "shortDescription=\"pose estimation by 3D scans\">\n<TelemetryMetaData>\n<ParameterTypeSet>\n" +
         types + "</ParameterTypeSet>\n<ParameterSet>\n" + parameters + "</ParameterSet>\n<ContainerSet>\n" + containers +
         "</ContainerSet>\n</TelemetryMetaData>\n" + command_meta_data(arrays, apid) + "</SpaceSystem>\n";
}

}  // namespace lasso::mdat
