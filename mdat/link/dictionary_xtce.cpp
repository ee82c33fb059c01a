// XTCE 1.2 of the telemetry: header fields and items are parameters; each packet is a container that extends the one of the headers, told
// by its service, subservice and structure.
#include <cmath>
#include <set>

#include "fsw/link/dictionary.hpp"
#include "mdat/common/text.hpp"
#include "mdat/link/dictionary_text.hpp"
#include "mdat/link/number.hpp"

namespace lasso::mdat {
namespace {

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const std::string entity = c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
    result += entity;
  }
  return result;
}

std::string attribute(const char* name, const std::string& value) { return format(" %s=\"%s\"", name, escaped(value).c_str()); }

std::string number(double value) { return text_of(Number(value)); }

std::string integer_encoding(std::size_t bits, bool is_signed) {
  return format("<IntegerDataEncoding sizeInBits=\"%zu\" encoding=\"%s\"/>", bits, is_signed ? "twosComplement" : "unsigned");
}

std::string unit_set(const ItemRow& row) {
  return std::string(row.unit) == "1" ? "<UnitSet/>" : format("<UnitSet><Unit>%s</Unit></UnitSet>", escaped(row.unit).c_str());
}

std::string valid_range(const ItemRow& row) {
  std::string bounds;
  if (!std::isinf(row.range.minimum)) bounds += attribute("minInclusive", number(row.range.minimum));
  if (!std::isinf(row.range.maximum)) bounds += attribute("maxInclusive", number(row.range.maximum));
  return bounds.empty() ? "" : "<ValidRange" + bounds + "/>";
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
std::string element_type(const ItemRow& row, const std::string& name) {
  const std::size_t bits = 8 * wire_size(row.type);
  const std::string begin = attribute("name", name);
  if (row.enumeration != nullptr) {
    return "<EnumeratedParameterType" + begin + "><UnitSet/>" + integer_encoding(bits, false) + enumeration_list(*row.enumeration) +
           "</EnumeratedParameterType>\n";
  }
  if (is_real(row.type)) {
    return "<FloatParameterType" + begin + format(" sizeInBits=\"%zu\">", bits) + unit_set(row) +
           format("<FloatDataEncoding sizeInBits=\"%zu\"/>", bits) + valid_range(row) + "</FloatParameterType>\n";
  }
  const bool is_signed = row.type == WireType::kI64;
  return "<IntegerParameterType" + begin + format(" sizeInBits=\"%zu\" signed=\"%s\">", bits, is_signed ? "true" : "false") +
         unit_set(row) + integer_encoding(bits, is_signed) + valid_range(row) + "</IntegerParameterType>\n";
}

std::string full_name(const PacketRow& packet, const ItemRow& row) { return std::string(packet.name) + "_" + row.name; }

std::string item_types(const PacketRow& packet, const ItemRow& row) {
  const std::string name = full_name(packet, row);
  if (row.count == 1) return element_type(row, name + "_t");
  const std::string last = std::to_string(row.count - 1);
  return element_type(row, name + "_element_t") + "<ArrayParameterType" + attribute("name", name + "_t") +
         attribute("arrayTypeRef", name + "_element_t") +
         "><DimensionList><Dimension><StartingIndex><FixedValue>0</FixedValue></StartingIndex><EndingIndex><FixedValue>" + last +
         "</FixedValue></EndingIndex></Dimension></DimensionList></ArrayParameterType>\n";
}

std::string header_type(const HeaderField& field) {
  return format("<IntegerParameterType name=\"%s_t\" sizeInBits=\"32\" signed=\"false\"><UnitSet/>", field.name) +
         integer_encoding(field.bits, false) + "</IntegerParameterType>\n";
}

std::string parameter(const std::string& name, const std::string& meaning) {
  return "<Parameter" + attribute("name", name) + attribute("parameterTypeRef", name + "_t") + attribute("shortDescription", meaning) +
         "/>\n";
}

std::string entry(const std::string& name) { return "<ParameterRefEntry" + attribute("parameterRef", name) + "/>\n"; }

std::string item_entry(const PacketRow& packet, const ItemRow& row) {
  const std::string name = full_name(packet, row);
  return row.count == 1 ? entry(name) : "<ArrayParameterRefEntry" + attribute("parameterRef", name) + "/>\n";
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

std::string type_comparisons(unsigned service, unsigned subservice) {
  return comparison("apid", kApid) + comparison("service", service) + comparison("subservice", subservice);
}

// Of packets that their number tells apart.
std::string family(const PacketRow& packet) { return format("numbered_%u_%u", packet.service, packet.subservice); }

std::string family_container(const PacketRow& packet) {
  return format("<SequenceContainer name=\"%s\" abstract=\"true\" shortDescription=\"service %u, subservice %u\">\n<EntryList>\n",
                family(packet).c_str(), packet.service, packet.subservice) +
         entry(kNumber.name) + "</EntryList>\n" + extending("telemetry", type_comparisons(packet.service, packet.subservice));
}

std::string container(const PacketRow& packet) {
  std::string text =
      "<SequenceContainer" + attribute("name", packet.name) + attribute("shortDescription", packet.meaning) + ">\n<EntryList>\n";
  for (const ItemRow& row : packet.items) text += item_entry(packet, row);
  text += entry("crc") + "</EntryList>\n";
  if (packet.numbered) return text + extending(family(packet).c_str(), comparison(kNumber.name, packet.number));
  return text + extending("telemetry", type_comparisons(packet.service, packet.subservice));
}

constexpr HeaderField kCrc{"crc", 0, 16, "CRC-16 over all bytes before it"};

}  // namespace

std::string dictionary_xtce() {
  std::string types, parameters, containers = base_container();
  std::set<std::string> families;
  const auto add_field = [&](const HeaderField& field) {
    types += header_type(field);
    parameters += parameter(field.name, field.meaning);
  };
  for (const HeaderField& field : kPrimaryFields) add_field(field);
  for (const HeaderField& field : kTelemetryFields) add_field(field);
  add_field(kNumber);
  add_field(kCrc);
  for (const PacketRow& packet : kPackets) {
    if (packet.type != PacketType::kTelemetry) continue;
    for (const ItemRow& row : packet.items) types += item_types(packet, row);
    for (const ItemRow& row : packet.items) parameters += parameter(full_name(packet, row), row.meaning);
    if (packet.numbered && families.insert(family(packet)).second) containers += family_container(packet);
    containers += container(packet);
  }
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<SpaceSystem xmlns=\"http://www.omg.org/spec/XTCE/20180204\" name=\"lasso\" "
         "shortDescription=\"pose estimation by 3D scans\">\n<TelemetryMetaData>\n<ParameterTypeSet>\n" +
         types + "</ParameterTypeSet>\n<ParameterSet>\n" + parameters + "</ParameterSet>\n<ContainerSet>\n" + containers +
         "</ContainerSet>\n</TelemetryMetaData>\n</SpaceSystem>\n";
}

}  // namespace lasso::mdat
