#include "mdat/link/command_encoder.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "fsw/mission/parameters.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/text.hpp"
#include "mdat/link/decode.hpp"
#include "mdat/link/number.hpp"
#include "mdat/link/page.hpp"
#include "mdat/source/nearest.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kLargestCommand = 65542;

bool is_command(const PacketRow& row) { return row.type == PacketType::kCommand; }

std::string of(const PacketRow& row, const ItemRow& item) { return std::string(row.name) + ": " + item.name; }

// The number of a choice, or the id of a parameter; -1 where the text is no such name.
std::int64_t named(const ItemRow& item, const std::string& text) {
  std::int64_t value = 0;
  if (item.enumeration != nullptr) {
    for (const Choice& choice : item.enumeration->choices) {
      if (text == choice.name) return value;
      ++value;
    }
  }
  if (item.name != std::string("parameter")) return -1;
  for (const ParameterRow& row : parameter_rows()) {
    if (text == row.key) return row.id;
  }
  return -1;
}

// Of the names that the item takes.
std::string meant(const ItemRow& item, const std::string& text) {
  std::vector<std::string> names;
  if (item.enumeration != nullptr) {
    for (const Choice& choice : item.enumeration->choices) names.emplace_back(choice.name);
  }
  if (item.name == std::string("parameter")) {
    for (const ParameterRow& row : parameter_rows()) names.emplace_back(row.key);
  }
  return did_you_mean(text, names);
}

// A choice by its name, or a number.
Number number_of(const PacketRow& row, const ItemRow& item, const std::string& text) {
  const std::int64_t by_name = named(item, text);
  if (by_name >= 0) return by_name;
  const char* end = text.data() + text.size();
  std::int64_t whole = 0;
  double real = 0;
  const auto [stop, error] = is_real(item.type) ? std::from_chars(text.data(), end, real) : std::from_chars(text.data(), end, whole);
  if (error != std::errc() || stop != end)
    throw InputError(of(row, item) + "=" + text + ": not " + (is_real(item.type) ? "a number" : "an integer") +
                     (item.enumeration != nullptr ? ", and no name of " + std::string(item.enumeration->name) : "") + meant(item, text));
  return is_real(item.type) ? Number(real) : Number(whole);
}

void check_range(const PacketRow& row, const ItemRow& item, const Number& number) {
  const double value = value_of(number);
  const bool fits = is_real(item.type) || item.type == WireType::kI64 ||
                    (value >= 0 && value < static_cast<double>(std::uint64_t{1} << 8 * wire_size(item.type)));
  if (!(value >= item.range.minimum && value <= item.range.maximum) || !fits)
    throw InputError(of(row, item) + "=" + text_of(number) + ": out of range, which is " + range_text(item) + " (" + to_string(item.type) +
                     ")");
}

void write_number(WireType type, const Number& number, ByteWriter& out) {
  const std::int64_t whole = std::holds_alternative<std::int64_t>(number) ? std::get<std::int64_t>(number) : 0;
  switch (type) {
    case WireType::kU8:
      return out.u8(static_cast<std::uint8_t>(whole));
    case WireType::kU16:
      return out.u16(static_cast<std::uint16_t>(whole));
    case WireType::kU32:
      return out.u32(static_cast<std::uint32_t>(whole));
    case WireType::kI64:
      return out.i64(whole);
    case WireType::kF32:
      return out.f32(static_cast<float>(value_of(number)));
    case WireType::kF64:
      break;
  }
  out.f64(value_of(number));
}

void write_item(const PacketRow& row, const ItemRow& item, const std::string& text, ByteWriter& out) {
  std::vector<std::string> elements;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) elements.push_back(word);
  if (elements.size() != item.count)
    throw InputError(of(row, item) + "=" + text + ": has " + std::to_string(elements.size()) + " values, and needs " +
                     std::to_string(item.count) + ", separated by commas");
  for (const std::string& element : elements) {
    const Number number = number_of(row, item, element);
    check_range(row, item, number);
    write_number(item.type, number, out);
  }
}

void begin(const PacketRow& row, std::uint16_t count, std::uint16_t apid, ByteWriter& writer) {
  CommandHeader header;
  header.apid = apid;
  header.sequence_count = count & kSequenceCountMask;
  header.service = row.service;
  header.subservice = row.subservice;
  begin_command(header, writer);
  if (row.numbered) writer.u16(row.number);
}

void finish(ByteWriter& writer, std::vector<std::uint8_t>& packet) {
  packet.resize(finish_packet(writer, Bytes(packet.data(), packet.size())));
}

void check_alone(const PacketRow& row, const std::vector<std::uint8_t>& packet) {
  const HeldCommand held = held_command(ConstBytes(packet.data() + 1, packet.size() - 1), apid_of({packet.data(), packet.size()}));
  if (held.name == nullptr) return;
  throw InputError(
      format("%s: holds another command (%s) at its byte %zu: were it damaged on its way, the component would carry that out. "
             "Send the data in other parts",
             row.name, held.name, held.offset + 1));
}

}  // namespace

const PacketRow& command_row(const std::string& name) {
  std::string similar;
  std::vector<std::string> names;
  for (const PacketRow& row : kPackets) {
    if (!is_command(row)) continue;
    names.emplace_back(row.name);
    if (name == row.name) return row;
    const std::string known = row.name;
    if (!name.empty() && (known.find(name) != std::string::npos || name.find(known) != std::string::npos))
      similar += (similar.empty() ? "; there is " : " ") + known;
  }
  if (similar.empty()) similar = did_you_mean(name, names);
  throw InputError(name + ": no command of the dictionary" + similar + "; mdat command --list shows all");
}

std::pair<std::string, std::string> split_argument(const std::string& argument) {
  const std::size_t equals = argument.find('=');
  if (equals == std::string::npos) throw InputError("'" + argument + "': an item and its value are written NAME=VALUE");
  return {argument.substr(0, equals), argument.substr(equals + 1)};
}

HeldCommand held_command(ConstBytes bytes, std::uint16_t apid) {
  const DecodedStream found = decode_stream(bytes, PacketType::kCommand, apid);
  if (found.packets.empty()) return {};
  return {found.packets.front().name(), found.packets.front().offset};
}

std::vector<std::uint8_t> encode_command(const PacketRow& row, const std::map<std::string, std::string>& values, std::uint16_t count,
                                         std::uint16_t apid) {
  std::vector<std::string> names;
  for (const ItemRow& item : row.items) names.emplace_back(item.name);
  for (const auto& [name, value] : values) {
    const auto is_it = [&](const ItemRow& item) { return name == item.name; };
    if (std::none_of(row.items.begin(), row.items.end(), is_it))
      throw InputError(std::string(row.name) + ": has no item " + name + did_you_mean(name, names) + "\n" + command_help(row));
  }
  std::vector<std::uint8_t> packet(kLargestCommand);
  ByteWriter writer{Bytes(packet.data(), packet.size())};
  begin(row, count, apid, writer);
  for (const ItemRow& item : row.items) {
    const auto value = values.find(item.name);
    if (value == values.end()) throw InputError(of(row, item) + " is missing\n" + command_help(row));
    write_item(row, item, value->second, writer);
  }
  finish(writer, packet);
  check_alone(row, packet);
  return packet;
}

std::vector<std::uint8_t> arm_for(const PacketRow& row, std::uint16_t count, std::uint16_t apid) {
  return encode_command(
      command_row("arm"),
      {{"service", std::to_string(row.service)}, {"subservice", std::to_string(row.subservice)}, {"number", std::to_string(row.number)}},
      count, apid);
}

std::string command_list() {
  std::string text;
  for (const PacketRow& row : kPackets) {
    if (is_command(row)) text += format("%-24s %s%s\n", row.name, row.meaning, row.hazard == Hazard::kNone ? "" : " (hazardous: --arm)");
  }
  return text;
}

std::string command_help(const PacketRow& row) {
  std::string text = format("%s: %s\n", row.name, row.meaning);
  for (const ItemRow& item : row.items) {
    const std::string type = std::string(to_string(item.type)) + (item.count > 1 ? format("[%u]", item.count) : "");
    text += format("  %-20s %-8s %-6s %s: %s\n", item.name, type.c_str(), item.unit, range_text(item).c_str(), item.meaning);
    if (item.enumeration == nullptr) continue;
    for (const Choice& choice : item.enumeration->choices) text += format("  %20s   %-20s %s\n", "", choice.name, choice.meaning);
  }
  return text;
}

}  // namespace lasso::mdat
