// Definitions of OpenC3 COSMOS 6: items one behind the other (APPEND_...), named as the dictionary names them, in capitals. Fields of the
// primary header begin with CCSDS_, those of the secondary with PUS_. A packet is told by its application, service and subservice, and by
// its number where it has one.
#include "mdat/link/dictionary_cosmos.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "fsw/link/dictionary.hpp"
#include "mdat/common/text.hpp"
#include "mdat/common/version.hpp"
#include "mdat/link/number.hpp"

namespace lasso::mdat {
namespace {

constexpr unsigned kAcceptanceAndEnd =
    9;  // the reports that a command asks for unless its sender says otherwise: 1 acceptance, 8 completion
constexpr char kTarget[] = "<%= target_name %>";

std::string capitals(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

// One line in quotes, none within.
std::string quoted(std::string text) {
  std::replace(text.begin(), text.end(), '"', '\'');
  std::replace(text.begin(), text.end(), '\n', ' ');
  return "\"" + text + "\"";
}

const char* cosmos_type(WireType type) {
  if (is_real(type)) return "FLOAT";
  return type == WireType::kI64 ? "INT" : "UINT";
}

std::string range_end(const ItemRow& row, double value, const char* unbounded) {
  if (std::isinf(value)) return unbounded;
  return is_real(row.type) ? real_text(value) : format("%.0f", value);
}

// 0, or what of the range is nearest to it.
std::string first_value(const ItemRow& row) { return range_end(row, std::clamp(0.0, row.range.minimum, row.range.maximum), "0"); }

std::string choices_text(const ItemRow& row) {
  std::string text;
  if (row.enumeration == nullptr) return text;
  std::size_t value = 0;
  for (const Choice& choice : row.enumeration->choices) text += "    STATE " + capitals(choice.name) + format(" %zu\n", value++);
  return text;
}

std::string unit_text(const ItemRow& row) {
  return std::string(row.unit) == "1" ? "" : "    UNITS " + quoted(row.unit) + " " + quoted(row.unit) + "\n";
}

std::string details(const ItemRow& row) { return choices_text(row) + unit_text(row); }

std::string telemetry_item(const ItemRow& row) {
  const std::size_t bits = 8 * wire_size(row.type);
  const std::string array = row.count > 1 ? format(" %zu", bits * row.count) : "";
  return format("  APPEND_%sITEM %s %zu %s%s ", row.count > 1 ? "ARRAY_" : "", capitals(row.name).c_str(), bits, cosmos_type(row.type),
                array.c_str()) +
         quoted(row.meaning) + "\n" + details(row);
}

std::string argument_item(const ItemRow& row) {
  const std::size_t bits = 8 * wire_size(row.type);
  const std::string name = capitals(row.name);
  if (row.count > 1) {
    return format("  APPEND_ARRAY_PARAMETER %s %zu %s %zu ", name.c_str(), bits, cosmos_type(row.type), bits * row.count) +
           quoted(row.meaning) + "\n" + details(row);
  }
  return format("  APPEND_PARAMETER %s %zu %s ", name.c_str(), bits, cosmos_type(row.type)) + range_end(row, row.range.minimum, "MIN") +
         " " + range_end(row, row.range.maximum, "MAX") + " " + first_value(row) + " " + quoted(row.meaning) + "\n    REQUIRED\n" +
         details(row);
}

constexpr HeaderField kNumberField{"number", 0, 16, "number of the structure, event or function"};
constexpr HeaderField kCheckField{"crc", 0, 16, "CRC-16 over all bytes before it"};

std::string header_name(const char* prefix, const HeaderField& field) {
  const std::string name = capitals(field.name);
  return name.rfind(prefix, 0) == 0 ? name : prefix + name;
}

bool tells_apart(const HeaderField& field) {
  const std::string name = field.name;
  return name == "apid" || name == "service" || name == "subservice";
}

// An item of telemetry's headers; one that tells packets apart has the value that it has there.
std::string header_item(const char* prefix, const HeaderField& field, unsigned value) {
  const std::string name = header_name(prefix, field);
  if (tells_apart(field)) return format("  APPEND_ID_ITEM %s %u UINT %u ", name.c_str(), field.bits, value) + quoted(field.meaning) + "\n";
  return format("  APPEND_ITEM %s %u UINT ", name.c_str(), field.bits) + quoted(field.meaning) + "\n";
}

unsigned type_value(const HeaderField& field, const PacketRow& packet, unsigned apid) {
  const std::string name = field.name;
  if (name == "apid") return apid;
  return name == "service" ? packet.service : packet.subservice;
}

std::string telemetry_packet(const PacketRow& packet, unsigned apid) {
  std::string text = format("TELEMETRY %s %s BIG_ENDIAN ", kTarget, capitals(packet.name).c_str()) + quoted(packet.meaning) + "\n";
  for (const HeaderField& field : kPrimaryFields) text += header_item("CCSDS_", field, type_value(field, packet, apid));
  for (const HeaderField& field : kTelemetryFields) text += header_item("PUS_", field, type_value(field, packet, apid));
  if (packet.numbered) text += format("  APPEND_ID_ITEM PUS_NUMBER 16 UINT %u ", packet.number) + quoted(kNumberField.meaning) + "\n";
  for (const ItemRow& row : packet.items) text += telemetry_item(row);
  return text + "  APPEND_ITEM PACKET_CRC 16 UINT " + quoted(kCheckField.meaning) + "\n\n";
}

// What a field of a command's headers says: always this value, or, where `most` is larger, up to it.
struct HeaderValue {
  unsigned least, most, first;
};

HeaderValue fixed(unsigned value) { return {value, value, value}; }

HeaderValue primary_value(const HeaderField& field, const PacketRow& packet, unsigned apid) {
  const std::string name = field.name;
  if (name == "apid") return fixed(apid);
  if (name == "sequence_flags") return fixed(kUnsegmented);
  if (name == "sequence_count") return {0, 16383, 0};
  if (name == "data_length")
    return fixed(static_cast<unsigned>(item_offset(packet, packet.items.size()) + kPacketTrailerBytes - kPrimaryHeaderBytes - 1));
  return fixed(name == "version" ? 0 : 1);  // type: a command; there is a secondary header
}

HeaderValue secondary_value(const HeaderField& field, const PacketRow& packet) {
  const std::string name = field.name;
  if (name == "pus_version") return fixed(kPusVersion);
  if (name == "acknowledge") return {0, 15, kAcceptanceAndEnd};
  if (name == "source") return {0, 65535, 0};
  return fixed(name == "service" ? packet.service : packet.subservice);
}

std::string header_parameter(const char* prefix, const HeaderField& field, HeaderValue value) {
  return format("  APPEND_%sPARAMETER %s %u UINT %u %u %u ", tells_apart(field) ? "ID_" : "", header_name(prefix, field).c_str(),
                field.bits, value.least, value.most, value.first) +
         quoted(field.meaning) + "\n";
}

std::string command_packet(const PacketRow& packet, unsigned apid) {
  std::string text = format("COMMAND %s %s BIG_ENDIAN ", kTarget, capitals(packet.name).c_str()) + quoted(packet.meaning) + "\n";
  if (packet.hazard != Hazard::kNone) text += "  HAZARDOUS " + quoted("it is carried out only after the command arm") + "\n";
  for (const HeaderField& field : kPrimaryFields) text += header_parameter("CCSDS_", field, primary_value(field, packet, apid));
  for (const HeaderField& field : kCommandFields) text += header_parameter("PUS_", field, secondary_value(field, packet));
  if (packet.numbered)
    text += format("  APPEND_ID_PARAMETER PUS_NUMBER 16 UINT %u %u %u ", packet.number, packet.number, packet.number) +
            quoted(kNumberField.meaning) + "\n";
  for (const ItemRow& row : packet.items) text += argument_item(row);
  return text + "  APPEND_PARAMETER PACKET_CRC 16 UINT 0 65535 0 " + quoted(kCheckField.meaning) + "\n\n";
}

std::string head_of(const char* what) {
  return format("# %s of 3DLASSO %s, written by mdat dictionary --format cosmos: change nothing here.\n\n", what, kVersion);
}

std::string telemetry_text(unsigned apid) {
  std::string text = head_of("Telemetry");
  for (const PacketRow& packet : kPackets) {
    if (packet.type == PacketType::kTelemetry) text += telemetry_packet(packet, apid);
  }
  return text;
}

std::string commands_text(unsigned apid) {
  std::string text = head_of("Commands");
  for (const PacketRow& packet : command_rows::kCommands) text += command_packet(packet, apid);
  return text;
}

std::string target_text() {
  std::string text = head_of("The target") + "LANGUAGE ruby\nCMD_UNIQUE_ID_MODE\nTLM_UNIQUE_ID_MODE\n\n";
  std::string items;
  for (const HeaderField& field : kPrimaryFields) {
    text += "IGNORE_PARAMETER " + header_name("CCSDS_", field) + "\n";
    items += "IGNORE_ITEM " + header_name("CCSDS_", field) + "\n";
  }
  for (const HeaderField& field : kCommandFields) text += "IGNORE_PARAMETER " + header_name("PUS_", field) + "\n";
  return text + "IGNORE_PARAMETER PUS_NUMBER\nIGNORE_PARAMETER PACKET_CRC\n\n" + items + "IGNORE_ITEM PACKET_CRC\n";
}

// Length: the value at bit 32 is the packet's bytes less 7. Of protocols that write, the last one is first: counts, then the checksum.
constexpr char kConnection[] = R"(VARIABLE target_name LASSO
VARIABLE host host.docker.internal
VARIABLE port 5300

TARGET LASSO <%= target_name %>
INTERFACE <%= target_name %>_INT tcpip_client_interface.rb <%= host %> <%= port %> <%= port %> 10.0 nil nil
  MAP_TARGET <%= target_name %>
  PROTOCOL READ LengthProtocol 32 16 7 1 BIG_ENDIAN 0 nil nil false
  PROTOCOL READ_WRITE CrcProtocol PACKET_CRC false ERROR -16 16 BIG_ENDIAN 0x1021 0xFFFF false false
  PROTOCOL WRITE lasso_sequence_protocol.rb
)";

constexpr char kSequence[] = R"(require 'openc3/interfaces/protocols/protocol'

module OpenC3
  # Counts the commands: the component refuses one whose count is not 1 to 8191 after that of the last accepted one. The first count follows
  # the clock, so that it is new after a restart within two hours, too.
  class LassoSequenceProtocol < Protocol
    def initialize(allow_empty_data = nil)
      super(allow_empty_data)
      @count = Time.now.to_i
    end

    def write_packet(packet)
      packet.write('CCSDS_SEQUENCE_COUNT', @count & 0x3FFF)
      @count += 1
      return packet
    end
  end
end
)";

constexpr const char* kShownItems[] = {"VALID",
                                       "REASON",
                                       "MODE",
                                       "P_SENSOR_TARGET_M",
                                       "Q_SENSOR_TARGET",
                                       "AGE_US",
                                       "RMS_M",
                                       "INLIERS",
                                       "RETURNS",
                                       "AGREEMENT",
                                       "WEAKEST_SIGMA_M",
                                       "FILTER_P_SENSOR_TARGET_M",
                                       "FILTER_OMEGA_RADPS",
                                       "FILTER_V_MPS"};

std::string screen_text() {
  std::string text = "SCREEN AUTO AUTO 1.0\n\nVERTICAL\n  TITLE \"<%= target_name %> pose\"\n  VERTICALBOX\n";
  for (const char* item : kShownItems) text += format("    LABELVALUE %s POSE %s WITH_UNITS 60\n", kTarget, item);
  return text + "  END\nEND\n";
}

std::string gem_text() {
  return format(
      R"(# Written by mdat dictionary --format cosmos.
Gem::Specification.new do |s|
  s.name = 'openc3-cosmos-lasso'
  s.summary = '3DLASSO: pose of a spacecraft from 3D scans'
  s.description = 'Commands, telemetry and a screen of the 3DLASSO flight component'
  s.licenses = 'Apache-2.0'
  s.authors = ['3DLASSO maintainers']
  s.platform = Gem::Platform::RUBY
  s.version = ENV['VERSION'] || '%s'
  s.files = Dir.glob('targets/**/*') + %%w(README.md plugin.txt)
  s.metadata = { 'openc3_cosmos_minimum_version' => '6.0.0' }
end
)",
      kVersion);
}

constexpr char kReadMe[] = R"(# openc3-cosmos-lasso

A plug-in of OpenC3 COSMOS for the flight component of 3DLASSO: target LASSO, its commands and telemetry, and the screen POSE.

    gem build openc3-cosmos-lasso.gemspec        # then install the .gem in the Admin Tool of COSMOS
    mdat run MISSION --scenario spin --link tcp://0.0.0.0:5300

`host` and `port` of the plug-in say where the component is. Commands are counted and get their checksum on the way out; those of telemetry are compared.
A hazardous command is armed first: send ARM with its service, subservice and number. Commands are not signed: run without `--key`.
)";

}  // namespace

std::map<std::string, std::string> dictionary_cosmos(std::uint16_t apid) {
  return {{"README.md", kReadMe},
          {"openc3-cosmos-lasso.gemspec", gem_text()},
          {"plugin.txt", head_of("The plug-in") + kConnection},
          {"targets/LASSO/cmd_tlm/cmd.txt", commands_text(apid)},
          {"targets/LASSO/cmd_tlm/tlm.txt", telemetry_text(apid)},
          {"targets/LASSO/lib/lasso_sequence_protocol.rb", kSequence},
          {"targets/LASSO/screens/pose.txt", screen_text()},
          {"targets/LASSO/target.txt", target_text()}};
}

}  // namespace lasso::mdat
