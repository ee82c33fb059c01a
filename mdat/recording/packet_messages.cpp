#include "mdat/recording/packet_messages.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

#include "mdat/mcap/cdr.hpp"
#include "mdat/recording/ros_messages.hpp"

namespace lasso::mdat {
namespace {

std::string capital(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

// "mode_changed": "ModeChanged", as ROS has names of types.
std::string type_name(std::string_view name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] == '_') continue;
    const bool first = i == 0 || name[i - 1] == '_';
    text += first ? static_cast<char>(std::toupper(static_cast<unsigned char>(name[i]))) : name[i];
  }
  return text;
}

const char* ros_type(WireType type) {
  constexpr const char* kNames[] = {"uint8", "uint16", "uint32", "int64", "float32", "float64"};
  return kNames[static_cast<std::size_t>(type)];
}

std::string constants_of(const ItemRow& row) {
  std::string text;
  std::size_t value = 0;
  if (row.enumeration == nullptr) return text;
  for (const Choice& choice : row.enumeration->choices)
    text += std::string(ros_type(row.type)) + " " + capital(row.name) + "_" + capital(choice.name) + "=" + std::to_string(value++) + "\n";
  return text;
}

// With its unit and meaning, as a comment behind it.
std::string field_of(const ItemRow& row) {
  const std::string many = row.count > 1 ? "[" + std::to_string(row.count) + "]" : "";
  const std::string unit = std::string(row.unit) == "1" ? "" : std::string(row.unit) + "; ";
  return constants_of(row) + ros_type(row.type) + many + " " + row.name + " # " + unit + row.meaning + "\n";
}

void put_number(WireType type, const Number& number, mcap::CdrWriter& out) {
  if (type == WireType::kF32) return void(out.put(std::get<float>(number)));
  if (type == WireType::kF64) return void(out.put(std::get<double>(number)));
  const std::int64_t value = std::get<std::int64_t>(number);
  if (type == WireType::kU8) out.put(static_cast<std::uint8_t>(value));
  if (type == WireType::kU16) out.put(static_cast<std::uint16_t>(value));
  if (type == WireType::kU32) out.put(static_cast<std::uint32_t>(value));
  if (type == WireType::kI64) out.put(value);
}

std::uint16_t sequence_count_of(const DecodedPacket& packet) {
  constexpr std::size_t kField = 5;  // of kPrimaryFields
  static_assert(std::string_view(kPrimaryFields[kField].name) == "sequence_count");
  return static_cast<std::uint16_t>(packet.header.at(kField));
}

}  // namespace

const std::vector<const PacketRow*>& told_packets() {
  static const std::vector<const PacketRow*> kTold = [] {
    std::vector<const PacketRow*> told;
    for (const PacketRow& row : kPackets) {
      if (row.type == PacketType::kTelemetry) told.push_back(&row);
    }
    return told;
  }();
  return kTold;
}

std::string packet_topic(const PacketRow& packet) { return std::string("/telemetry/") + packet.name; }

RosSchema packet_schema(const PacketRow& packet) {
  std::string fields = "std_msgs/Header header\nuint16 sequence_count\n";
  for (const ItemRow& row : packet.items) fields += field_of(row);
  return ros::schema_with("lasso_msgs/" + type_name(packet.name), fields);
}

std::string packet_message(TimeUs boundary_us, const DecodedPacket& packet) {
  mcap::CdrWriter out;
  ros::put_header({boundary_us, ""}, out);
  out.put(sequence_count_of(packet));
  for (const DecodedItem& item : packet.items) {
    for (const Number& number : item.values) put_number(item.row->type, number, out);
  }
  return out.bytes();
}

}  // namespace lasso::mdat
