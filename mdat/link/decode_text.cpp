#include "mdat/link/decode_text.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <nlohmann/json.hpp>

#include "mdat/common/errors.hpp"
#include "mdat/common/text.hpp"
#include "mdat/source/nearest.hpp"

namespace lasso::mdat {
namespace {

using Json = nlohmann::ordered_json;

bool shows(const Selection& selection, const ItemRow& row) {
  return selection.items.empty() || std::find(selection.items.begin(), selection.items.end(), row.name) != selection.items.end();
}

bool shows(const Selection& selection, const DecodedPacket& packet) {
  if (!selection.packet.empty() && selection.packet != packet.name()) return false;
  if (selection.items.empty()) return true;
  return std::any_of(packet.items.begin(), packet.items.end(), [&](const DecodedItem& item) { return shows(selection, *item.row); });
}

// The name of an enumeration's value, or the number.
std::string shown(const ItemRow& row, const Number& number) {
  const Choice* choice = choice_of(row, number);
  return choice != nullptr ? choice->name : text_of(number);
}

std::string shown(const DecodedItem& item) {
  std::string text;
  bool valid = true;
  for (const Number& number : item.values) {
    text += (text.empty() ? "" : " ") + shown(*item.row, number);
    valid = valid && in_range(*item.row, number);
  }
  return valid ? text : text + " (!)";
}

PacketType type_of(const DecodedPacket& packet) { return read_primary_header(packet.bytes).type; }

std::uint64_t header_value(const DecodedPacket& packet, const char* name) {
  const std::vector<HeaderField> fields = header_fields(type_of(packet));
  for (std::size_t i = 0; i < packet.header.size(); ++i) {
    if (std::string(fields[i].name) == name) return packet.header[i];
  }
  return 0;
}

double time_s(const DecodedPacket& packet) {
  return static_cast<double>(header_value(packet, "time_seconds")) + static_cast<double>(header_value(packet, "time_fraction")) * 0x1p-24;
}

std::string title(const DecodedPacket& packet) {
  const unsigned long long count = header_value(packet, "sequence_count");
  if (type_of(packet) == PacketType::kCommand) return format("%-10s #%llu", packet.name(), count);
  return format("%-10s #%llu %.6f s", packet.name(), count, time_s(packet));
}

std::string block(const DecodedPacket& packet) {
  std::string text = title(packet) + format(" (%zu bytes at %zu)\n", packet.bytes.size(), packet.offset);
  for (const DecodedItem& item : packet.items) {
    const std::string unit = std::string(item.row->unit) == "1" ? "" : std::string(" ") + item.row->unit;
    text += format("  %-26s %s%s\n", item.row->name, shown(item).c_str(), unit.c_str());
  }
  return text;
}

std::string line(const DecodedPacket& packet, const Selection& selection) {
  std::string text = title(packet);
  for (const DecodedItem& item : packet.items) {
    if (shows(selection, *item.row)) text += "  " + shown(item);
  }
  return text + "\n";
}

Json json_of(const ItemRow& row, const Number& number) {
  const Choice* choice = choice_of(row, number);
  if (choice != nullptr) return choice->name;
  if (const auto* whole = std::get_if<std::int64_t>(&number)) return *whole;
  std::string text = text_of(number);
  if (text.find_first_of("ni") != std::string::npos) return text;
  double value = 0;  // that is written as the shortest text of a float
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

Json json_of(const DecodedItem& item) {
  if (item.row->count == 1) return json_of(*item.row, item.values.front());
  Json list = Json::array();
  for (const Number& number : item.values) list.push_back(json_of(*item.row, number));
  return list;
}

Json json_of(const DecodedPacket& packet, const Selection& selection) {
  Json json = {{"packet", packet.name()}, {"offset", packet.offset}, {"size", packet.bytes.size()}, {"header", Json::object()}};
  const std::vector<HeaderField> fields = header_fields(type_of(packet));
  for (std::size_t i = 0; i < packet.header.size(); ++i) json["header"][fields[i].name] = packet.header[i];
  json["items"] = Json::object();
  for (const DecodedItem& item : packet.items) {
    if (shows(selection, *item.row)) json["items"][item.row->name] = json_of(item);
  }
  return json;
}

std::string csv_head(const PacketRow& packet, const Selection& selection) {
  std::string text = "offset,sequence_count,time_s";
  for (const ItemRow& row : packet.items) {
    if (!shows(selection, row)) continue;
    for (std::size_t i = 0; i < row.count; ++i) text += std::string(",") + row.name + (row.count > 1 ? format("_%zu", i) : "");
  }
  return text + "\n";
}

std::string csv_line(const DecodedPacket& packet, const Selection& selection) {
  std::string text =
      format("%zu,%llu,%.7f", packet.offset, static_cast<unsigned long long>(header_value(packet, "sequence_count")), time_s(packet));
  for (const DecodedItem& item : packet.items) {
    if (!shows(selection, *item.row)) continue;
    for (const Number& number : item.values) text += "," + shown(*item.row, number);
  }
  return text + "\n";
}

// Of the packets that are shown; of equally many, the first in the dictionary. Null: there is none.
const PacketRow* commonest(const DecodedStream& stream, const Selection& selection) {
  std::map<const PacketRow*, std::size_t> counts;
  for (const DecodedPacket& packet : stream.packets) {
    if (packet.row != nullptr && shows(selection, packet)) ++counts[packet.row];
  }
  const auto fewer = [](const auto& a, const auto& b) { return a.second < b.second; };
  const auto most = std::max_element(counts.begin(), counts.end(), fewer);
  return most == counts.end() ? nullptr : most->first;
}

void put_u32(std::string& out, std::uint64_t value) {  // little-endian, as the magic number says
  for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 0xFF);
}

}  // namespace

std::string items_text(const DecodedPacket& packet) {
  std::string text;
  for (const DecodedItem& item : packet.items) {
    text += (text.empty() ? "" : ", ") + std::string(item.row->name);
    for (const Number& number : item.values) {
      const Choice* choice = choice_of(*item.row, number);
      text += " " + (choice != nullptr ? std::string(choice->name) : text_of(number));
    }
  }
  return text;
}

void check_selection(const Selection& selection) {
  std::vector<std::string> packets, items;
  for (const PacketRow& packet : kPackets) {
    packets.emplace_back(packet.name);
    for (const ItemRow& row : packet.items) items.emplace_back(row.name);
  }
  const auto has = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (!selection.packet.empty() && !has(packets, selection.packet)) {
    throw InputError("--packet " + selection.packet + ": not in the dictionary" + did_you_mean(selection.packet, packets) +
                     "; mdat dictionary lists the packets");
  }
  for (const std::string& name : selection.items) {
    if (!has(items, name))
      throw InputError("--items " + name + ": no packet has it" + did_you_mean(name, items) + "; mdat dictionary lists the items");
  }
}

std::string table_text(const DecodedStream& stream, const Selection& selection) {
  std::string text;
  for (const DecodedPacket& packet : stream.packets) {
    if (shows(selection, packet)) text += selection.items.empty() ? block(packet) : line(packet, selection);
  }
  return text;
}

std::string csv_text(const DecodedStream& stream, const Selection& selection) {
  const PacketRow* kind = commonest(stream, selection);
  if (kind == nullptr) return "";
  std::string text = csv_head(*kind, selection);
  for (const DecodedPacket& packet : stream.packets) {
    if (packet.row == kind) text += csv_line(packet, selection);
  }
  return text;
}

std::string json_text(const DecodedStream& stream, const Selection& selection) {
  Json json = {{"other_bytes", stream.other_bytes}, {"packets", Json::array()}};
  for (const DecodedPacket& packet : stream.packets) {
    if (shows(selection, packet)) json["packets"].push_back(json_of(packet, selection));
  }
  return json.dump(1) + "\n";
}

std::string pcap_bytes(const DecodedStream& stream) {
  std::string out;
  // Microseconds, version 2.4, UTC, no accuracy, 256 kB a record, USER0.
  for (const std::uint64_t word : {0xA1B2C3D4U, 0x00040002U, 0U, 0U, 0x40000U, 147U}) put_u32(out, word);
  for (const DecodedPacket& packet : stream.packets) {
    const TimeUs t_us = from_cuc({static_cast<std::uint32_t>(header_value(packet, "time_seconds")),
                                  static_cast<std::uint32_t>(header_value(packet, "time_fraction"))});
    put_u32(out, static_cast<std::uint64_t>(t_us / 1000000));
    put_u32(out, static_cast<std::uint64_t>(t_us % 1000000));
    put_u32(out, packet.bytes.size());
    put_u32(out, packet.bytes.size());
    out.append(reinterpret_cast<const char*>(packet.bytes.data()), packet.bytes.size());
  }
  return out;
}

}  // namespace lasso::mdat
