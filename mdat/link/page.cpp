#include "mdat/link/page.hpp"

#include <algorithm>
#include <cmath>

#include "cfg/capacities.hpp"
#include "fsw/link/dictionary.hpp"
#include "fsw/mission/parameters.hpp"
#include "mdat/common/text.hpp"
#include "mdat/link/number.hpp"

namespace lasso::mdat {
namespace {

std::string number(double value) { return text_of(Number(value)); }

DocumentTable header_table(Span<const HeaderField> fields) {
  DocumentTable table{{"byte", "bit", "bits", "name", "meaning"}, {}};
  for (const HeaderField& field : fields) {
    table.rows.push_back(
        {std::to_string(field.bit / 8), std::to_string(field.bit % 8), std::to_string(field.bits), field.name, field.meaning});
  }
  return table;
}

DocumentTable type_table() {
  DocumentTable table{{"type", "bytes", "meaning"}, {}};
  const char* meanings[] = {"unsigned", "unsigned", "unsigned", "two's complement", "IEEE 754 binary32", "IEEE 754 binary64"};
  for (std::size_t i = 0; i < std::size(meanings); ++i) {
    const auto type = static_cast<WireType>(i);
    table.rows.push_back({to_string(type), std::to_string(wire_size(type)), meanings[i]});
  }
  return table;
}

DocumentTable choice_table(const Enumeration& enumeration) {
  DocumentTable table{{"value", "name", "meaning or cause", "action"}, {}};
  std::size_t value = 0;
  for (const Choice& choice : enumeration.choices)
    table.rows.push_back({std::to_string(value++), choice.name, choice.meaning, choice.action});
  return table;
}

DocumentSection packet_section(const PacketRow& packet) {
  DocumentSection section;
  section.title = std::string("Packet ") + packet.name;
  const std::string number = packet.numbered ? format(", number %u", packet.number) : "";
  section.paragraphs = {format("%s: %s. Service %u, subservice %u%s; %zu bytes.",
                               packet.type == PacketType::kTelemetry ? "Telemetry" : "Command", packet.meaning, packet.service,
                               packet.subservice, number.c_str(), item_offset(packet, packet.items.size()) + kPacketTrailerBytes)};
  if (packet.items.empty()) return section;
  section.table.head = {"id", "byte", "name", "type", "unit", "range", "meaning"};
  for (std::size_t i = 0; i < packet.items.size(); ++i) {
    const ItemRow& row = packet.items[i];
    const std::string type = std::string(to_string(row.type)) + (row.count > 1 ? format("[%u]", row.count) : "");
    section.table.rows.push_back(
        {std::to_string(row.id), std::to_string(item_offset(packet, i)), row.name, type, row.unit, range_text(row), row.meaning});
  }
  return section;
}

DocumentSection service_section() {
  return {2,
          "Commands and their answers",
          {"Service 1 answers each command: `refused`, with the reason and always; or `accepted`, if asked for, and then `completed`, if "
           "asked for, or "
           "`failed`, always. Progress and start are not reported: what a command does is done at once, or at the next boundary.",
           "A command is accepted once: its sequence count has to be 1 to 8191 after the one of the last accepted command, modulo 16384; "
           "the first may "
           "have any. This stops what is sent again by mistake; against intent, authenticate below this link.",
           format("In a frame %u commands are answered, the refused ones too; the rest waits for the next. A command takes effect at the "
                  "next boundary, at "
                  "most one frame later. In a byte stream what has no right CRC belongs to no packet: it is counted as skipped bytes "
                  "(packet `link`), and not "
                  "answered. A datagram is a packet whatever it holds, and is answered.",
                  kMaxCommandsPerFrame)},
          {}};
}

std::string kind_text(const ParameterRow& row) {
  const char* names[] = {"real", "integer", "boolean", ""};
  return row.kind == ParameterKind::kChoice ? row.choices : names[static_cast<std::size_t>(row.kind)];
}

DocumentTable parameter_table() {
  DocumentTable table{{"name", "unit", "type", "least", "most", "preset", "meaning"}, {}};
  for (const ParameterRow& row : parameter_rows()) {
    table.rows.push_back({row.key, row.unit, kind_text(row), number(row.minimum), number(row.maximum), number(row.preset), row.meaning});
  }
  return table;
}

void add_enumerations(std::vector<DocumentSection>& document) {
  std::vector<const Enumeration*> said;
  for (const PacketRow& packet : kPackets) {
    for (const ItemRow& row : packet.items) {
      if (row.enumeration == nullptr || std::find(said.begin(), said.end(), row.enumeration) != said.end()) continue;
      said.push_back(row.enumeration);
      document.push_back({3, row.enumeration->name, {}, choice_table(*row.enumeration)});
    }
  }
}

}  // namespace

std::string range_text(const ItemRow& row) {
  if (row.enumeration != nullptr) return row.enumeration->name;
  const bool low = !std::isinf(row.range.minimum), high = !std::isinf(row.range.maximum);
  if (low && high) return number(row.range.minimum) + " to " + number(row.range.maximum);
  return low ? "at least " + number(row.range.minimum) : "any";
}

std::vector<DocumentSection> interface_document() {
  std::vector<DocumentSection> document = {
      {1,
       "The link",
       {"Written by `mdat dictionary --format md` from the rows that the flight component packs its telemetry by "
        "(`fsw/link/dictionary.hpp`); `--format "
        "html`, `json`, `xtce` and `lua` write the same for browsers, programs, mission control systems and Wireshark (the last two of "
        "telemetry alone). Why it is so: "
        "[packets and dictionary](../decisions/packets.md).",
        "**Not there yet**: of service 3 the commands (structures are not enabled, disabled or given a period), and services 5 (events: "
        "the pose packet "
        "tells what changes, and why), 6 (memory), 9 (time) and 20 (parameters); hazardous commands and their arming; authentication."},
       {}},
      {2,
       "Packets",
       {"Every packet is a CCSDS 133.0-B-2 space packet with a PUS-C (ECSS-E-ST-70-41C) secondary header, and ends with a CRC-16 over all "
        "bytes before "
        "it (polynomial 0x1021, initial 0xFFFF, nothing reflected: the CRC over packet and CRC is 0). All is big-endian. Byte and bit "
        "count "
        "from the packet's start, the most significant bit first.",
        format("The application process (APID) is %u (0x%X). Time is CUC (301.0-B-4) without P-field: 4 bytes of seconds and 3 bytes of "
               "fraction since the mission's epoch; every microsecond of 2^32 seconds has its own.",
               kApid, kApid)},
       {}},
      {3, "Primary header", {}, header_table(Span<const HeaderField>(kPrimaryFields))},
      {3,
       "Secondary header of telemetry",
       {"The source data of service 3 begin with the number of the structure, 2 bytes."},
       header_table(Span<const HeaderField>(kTelemetryFields))},
      {3,
       "Secondary header of commands",
       {"The application data of service 8 begin with the number of the function, 2 bytes."},
       header_table(Span<const HeaderField>(kCommandFields))},
      {3,
       "Why a packet is refused",
       {"Checked in this order; the first that fails is the reason. What is refused changes nothing."},
       choice_table(kPacketFault)},
      {2,
       "Framing",
       {"Packets follow each other without anything between them, in files, datagrams and byte streams alike: a recorded stream is what "
        "was sent. "
        "In a byte stream a packet may begin where version, type, secondary header flag, APID and sequence flags are those of this link, "
        "with a "
        "length that the reader has room for; it is a packet when its CRC is right. Otherwise the search goes on with the next byte, so "
        "that no "
        "packet is lost behind garbage of any length. What looks like a header but is none holds up the packets behind it until as many "
        "bytes "
        "have come as it states, or the reader gives it up (`fsw/link/packet_finder.hpp`)."},
       {}},
      {2, "Types", {}, type_table()}};
  document.push_back(service_section());
  for (const PacketRow& packet : kPackets) document.push_back(packet_section(packet));
  document.push_back({2, "Enumerations", {"Values that are not listed here are of a later version, or damage."}, {}});
  add_enumerations(document);
  document.push_back(
      {2,
       "Parameters",
       {"Of the mission image, in the units of the mission file; the image carries them in SI. They cannot be changed over the link yet."},
       parameter_table()});
  return document;
}

}  // namespace lasso::mdat
