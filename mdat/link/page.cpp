#include "mdat/link/page.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cfg/capacities.hpp"
#include "fsw/link/dictionary.hpp"
#include "fsw/mission/parameter_area.hpp"
#include "fsw/mission/parameters.hpp"
#include "mdat/common/text.hpp"
#include "mdat/link/number.hpp"

namespace lasso::mdat {
namespace {

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

DocumentSection hazard_section() {
  DocumentSection section{
      2,
      "Hazardous commands",
      {format(
          "A hazardous command is carried out only if the last `arm` has named it, at most %u frames ago; otherwise it fails "
          "(`not_armed`). It uses the arm up, whatever comes of it, but where a row of commands is renewed by each. Any other hazardous "
          "command ends it, and so does time (event `arm_expired`). The laser is inhibited at start; `inhibit_laser` needs no arm and "
          "works at once.",
          kArmFrames)},
      {{"command", "service", "subservice", "number", "armed"}, {}}};
  for (const PacketRow& row : command_rows::kCommands) {
    if (row.hazard == Hazard::kNone) continue;
    section.table.rows.push_back({row.name, std::to_string(row.service), std::to_string(row.subservice), std::to_string(row.number),
                                  row.hazard == Hazard::kOnce ? "each time" : "once for a row"});
  }
  return section;
}

DocumentSection housekeeping_section() {
  return {
      2,
      "Housekeeping and time",
      {"Service 3 sends structures at the end of a frame. Each can be disabled and enabled, be given a period in frames (0: when there is "
       "news), and be asked for once, disabled or not. At first `pose` comes with each scan and `link` and `sensor` when there is news. "
       "The changes of "
       "the mode that a pose which is not sent would have reported are reported by events alone.",
       "Service 9: the headers of telemetry state the component's own time (time_status 0) until `correlate_time` names a moment in both "
       "times; from then on they state spacecraft time (time_status 1). Items always state the component's time, and commands too; `link` "
       "says the difference. The subservice is one of those that PUS-C leaves to missions."},
      {}};
}

std::string throttle_text(const Throttle& throttle) {
  return throttle.most == 0 ? "each" : format("%u in %u frames", throttle.most, throttle.frames);
}

DocumentSection event_section() {
  DocumentSection section{
      2,
      "Events",
      {"Service 5 reports what happened: at the end of its frame, with the time at which it happened. The subservice is the severity: 1 "
       "informative, 2 low (the component deals with it), 3 medium (it costs poses), 4 high (somebody is needed). The source data begin "
       "with the number of the event, 2 bytes.",
       format("Each event can be disabled and enabled; the log that survives a restart keeps it all the same. One that would fill the link "
              "is reported so many times in so many frames; how often it "
              "was not reported follows as `events_suppressed`. A frame holds %zu events; `events_dropped` counts the others.",
              kMaxEventsPerFrame)},
      {{"number", "name", "severity", "reported", "meaning", "cause", "action"}, {}}};
  for (const EventRow& row : event_rows::kRows) {
    section.table.rows.push_back({std::to_string(static_cast<unsigned>(row.id)), row.name,
                                  severity_text(kPackets[kPackets.size() - kEvents + static_cast<std::size_t>(row.id)]),
                                  throttle_text(row.throttle), row.meaning, row.cause, row.action});
  }
  return section;
}

constexpr const char* kOfAnswers =
    "Service 1 answers each command: `refused`, with the reason; or `accepted` and `started`, each if asked for, and then `completed`, if "
    "asked for, or `failed`, always. Progress is not reported: what a command does is done at once, or at the next boundary.";

constexpr const char* kOfAcceptance =
    "A command is accepted once: its sequence count has to be 1 to 8191 after the one of the last accepted command, modulo 16384; the "
    "first may have any. This stops what is sent again by mistake; against intent, commands are authenticated: most spacecraft do "
    "that below this link (CCSDS 355.0-B, space data link security). For those that do not, a board gives the component an "
    "authenticator (`fsw/core/authenticator.hpp`). Each command then has a trailer between its application data and its CRC, counted "
    "in its length; without a right one it is refused as `not_authentic`, before its arguments are looked at. What the trailer is, "
    "the board says. That of `mdat run --link URL --key FILE`: a number that grows from command to command (8 bytes), and the first "
    "16 bytes of the HMAC-SHA-256 over all bytes of the packet before them.";

constexpr const char* kOfKeys =
    "With an authenticator an image needs a signature behind its last byte as well, which `begin_image` counts among its bytes, and which "
    "its CRC-32C does not cover; that of `mdat` is the HMAC-SHA-256 over all bytes of the image, 32 bytes. `change_key` puts a further key "
    "of commands on trial by its number: both keys count until `confirm_key`, signed with the new one, makes that the only one, or until "
    "it is given up after 300 frames. Where the board cannot store it, `confirm_key` fails as `not_kept`, and the trial goes on. Numbers "
    "grow and come to an end: `mdat` takes one that is at most 65,536 beyond that of the key in use (`docs/decisions/keys-by-link.md`).";

constexpr const char* kOfStreams =
    "In a byte stream what has no right CRC belongs to no packet: it is counted as skipped bytes (packet `link`), and not answered. A "
    "datagram is a packet whatever it holds.";

DocumentSection service_section() {
  return {
      2,
      "Commands and their answers",
      {kOfAnswers, kOfAcceptance, kOfKeys,
       format("In a frame %u commands are answered, and %u more that make safe (`inhibit_laser`, `set_mode mode=safe`); the rest waits for "
              "the "
              "next. A command takes effect at the next boundary, at most one frame later. What nobody sent who may command, whatever is "
              "wrong with it, has room of its own: %u such packets are looked at in a frame, %u of them are answered, and %u more whose "
              "sequence count alone is wrong. All are counted in the packet `link`. With an authenticator who may command is known by the "
              "signature, and is always answered; without one each refused packet counts as nobody's. Answers wait for the link in room "
              "of their own, too (%u bytes), so that no other telemetry keeps them from the operator.",
              kMaxCommandsPerFrame, kMaxUrgentPerFrame, kMaxStrangersPerFrame, kMaxRefusalsPerFrame, kMaxRefusalsPerFrame,
              static_cast<unsigned>(kAnswerBytes)),
       kOfStreams},
      {}};
}

std::string kind_text(const ParameterRow& row) {
  const char* names[] = {"real", "integer", "boolean", ""};
  return row.kind == ParameterKind::kChoice ? row.choices : names[static_cast<std::size_t>(row.kind)];
}

DocumentTable parameter_table() {
  DocumentTable table{{"id", "name", "unit", "type", "least", "most", "preset", "set in flight", "meaning"}, {}};
  std::size_t index = 0;
  for (const ParameterRow& row : parameter_rows()) {
    table.rows.push_back({std::to_string(row.id), row.key, row.unit, kind_text(row), real_text(row.minimum), real_text(row.maximum),
                          real_text(row.preset), is_changeable(index++) ? "yes" : "no", row.meaning});
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

std::string severity_text(const PacketRow& event) {
  const char* names[] = {"informative", "low", "medium", "high"};
  return names[event.subservice - 1];
}

std::string range_text(const ItemRow& row) {
  if (row.enumeration != nullptr) return row.enumeration->name;
  const bool low = !std::isinf(row.range.minimum), high = !std::isinf(row.range.maximum);
  if (low && high) return real_text(row.range.minimum) + " to " + real_text(row.range.maximum);
  return low ? "at least " + real_text(row.range.minimum) : "any";
}

// What every packet has.
std::vector<DocumentSection> packet_sections(std::uint16_t apid) {
  return {
      {1,
       "The link",
       {"Written by `mdat dictionary --format md` from the rows that the flight component packs its telemetry by "
        "(`fsw/link/dictionary.hpp`); `--format "
        "html`, `json`, `xtce` and `lua` write the same for browsers, programs, mission control systems and Wireshark. Why it is so: "
        "[packets and dictionary](../decisions/packets.md).",
        "A board without image buffers or a store says so: a command of service 6 that needs them fails, with that reason."},
       {}},
      {2,
       "Packets",
       {"Every packet is a CCSDS 133.0-B-2 space packet with a PUS-C (ECSS-E-ST-70-41C) secondary header, and ends with a CRC-16 over all "
        "bytes before "
        "it (polynomial 0x1021, initial 0xFFFF, nothing reflected: the CRC over packet and CRC is 0). All is big-endian. Byte and bit "
        "count "
        "from the packet's start, the most significant bit first.",
        format("The application process (APID) is %u (0x%X)%s. Time is CUC (301.0-B-4) without P-field: 4 bytes of seconds and 3 bytes of "
               "fraction since the mission's epoch; every microsecond of 2^32 seconds has its own.",
               apid, apid, apid == kApid ? ", the preset: its host may give a component another one, and `--apid` the ground tool" : "")},
       {}},
      {3, "Primary header", {}, header_table(Span<const HeaderField>(kPrimaryFields))},
      {3,
       "Secondary header of telemetry",
       {"The source data of service 3 begin with the number of the structure, those of an event with its number, 2 bytes."},
       header_table(Span<const HeaderField>(kTelemetryFields))},
      {3,
       "Secondary header of commands",
       {"The application data of service 8 begin with the number of the function, 2 bytes."},
       header_table(Span<const HeaderField>(kCommandFields))},
      {3,
       "Why a packet is refused",
       {"Checked in this order; the first that fails is the reason. What is refused changes nothing."},
       choice_table(kPacketFault)}};
}

// How packets travel.
std::vector<DocumentSection> transport_sections() {
  return {
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
      {2,
       "Links",
       {"A board gives the component a link (`fsw/link/byte_link.hpp`): a stream of bytes, or datagrams of one packet each. On Linux these "
        "are "
        "`udp://[HOST]:PORT`, `tcp://[HOST]:PORT` (one ground station gets telemetry at a time) and "
        "`file://PATH` (commands from `PATH.commands`, telemetry to `PATH`); without a host they are bound to the loopback address. `mdat "
        "run "
        "--link` runs a component in real time behind one of them, and `mdat command NAME ITEM=VALUE ... --to` commands it. On the "
        "bare boards it is a serial port (`docs/boards/ppc603e.md`, `docs/boards/cortexa9.md`).",
        "By UDP anybody may send to the port. Telemetry goes to senders of valid commands, with a key of signed ones: the first of them "
        "keeps its place until it is silent for 30 s and another one comes; up to three more get it as well, and the one that was "
        "silent longest makes way. `mdat run --telemetry-to HOST:PORT` names who gets telemetry besides, from the beginning. No other "
        "datagram "
        "moves anything. An answer also goes to who asked.",
        "By TCP up to four may be connected, and each one's commands are taken. The first one gets telemetry, until another one has "
        "sent "
        "a valid command while it has sent none for 30 s, or never; where somebody else waits, one who never sent any is sent away after "
        "30 s. An answer goes to who asked alone."},
       {}},
      {2, "Types", {}, type_table()}};
}

std::vector<DocumentSection> interface_document(std::uint16_t apid) {
  std::vector<DocumentSection> document = packet_sections(apid);
  for (DocumentSection& section : transport_sections()) document.push_back(std::move(section));
  document.push_back(service_section());
  document.push_back(event_section());
  document.push_back(hazard_section());
  document.push_back(housekeeping_section());
  for (const PacketRow& packet : kPackets) document.push_back(packet_section(packet));
  document.push_back({2, "Enumerations", {"Values that are not listed here are of a later version, or damage."}, {}});
  add_enumerations(document);
  document.push_back(
      {2,
       "Parameters",
       {"Of the mission image, in the units of the mission file; the image carries them in SI. Service 20 changes those that may be "
        "changed: "
        "`set_parameter` within the limits below, from the next boundary on; `report_parameter` answers with value and image's value; "
        "`revert_parameters` takes all changes back. Changes are kept apart from the image, in two copies with checksums that are "
        "compared in "
        "each frame (events `parameters_repaired` and `parameters_lost`), and hold for the next image, too. They end with a restart. `mdat "
        "command` takes a parameter by its name. Ids are never used again for another parameter, so a later version changes none of them."},
       parameter_table()});
  return document;
}

}  // namespace lasso::mdat
