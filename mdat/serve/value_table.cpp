#include "mdat/serve/value_table.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "mdat/link/number.hpp"

namespace lasso::mdat::serve {
namespace {

constexpr std::size_t kServiceByte = 7, kSubserviceByte = 8;  // of a packet of telemetry

constexpr const char* kAxes[] = {"x", "y", "z", "w"};
constexpr const char* kSix[] = {"rotation x", "rotation y", "rotation z", "translation x", "translation y", "translation z"};
constexpr const char* kBearingNames[] = {"azimuth", "elevation", "range", "azimuth rate", "elevation rate", "range rate"};

// Row and column of an upper triangle's element, by rows.
struct Corner {
  std::size_t row = 0, column = 0;
};
Corner corner_of(std::size_t element) {
  constexpr std::size_t kSize = 6;
  Corner corner;
  for (std::size_t left = element, length = kSize; left >= length; --length) {
    left -= length;
    ++corner.row;
    corner.column = corner.row;
    element = left;
  }
  corner.column = corner.row + element;
  return corner;
}

bool begins_with(std::string_view text, std::string_view begin) { return text.substr(0, begin.size()) == begin; }

std::string element_name(const ItemRow& item, std::size_t element) {
  const std::string_view name = item.name;
  if (item.count == 1) return "";
  if (begins_with(name, "bearing")) return kBearingNames[element % 6];
  if (item.count == kPoseCovarianceTerms) {
    const Corner corner = corner_of(element);
    return std::string(kSix[corner.row]) + " with " + kSix[corner.column];
  }
  if (item.count == 6) return kSix[element];
  if (item.count <= 4 && item.enumeration == nullptr && is_real(item.type)) return kAxes[element];
  return std::to_string(element + 1);
}

// "rad,m" of six, or of the corner of a matrix, is one of them, or their product.
std::string element_unit(const ItemRow& item, std::size_t element) {
  std::string unit = item.unit;
  const std::size_t comma = unit.find(',');
  if (comma == std::string::npos) return unit;
  const std::array<std::string, 2> units = {unit.substr(0, comma), unit.substr(comma + 1)};
  if (begins_with(item.name, "bearing")) return units[element % 3 / 2] + (element < 3 ? "" : "/s");
  if (item.count != kPoseCovarianceTerms) return units[element < 3 ? 0 : 1];
  const Corner corner = corner_of(element);
  const std::string& row = units[corner.row / 3];
  const std::string& column = units[corner.column / 3];
  return row == column ? row + "^2" : row + " " + column;
}

struct Group {
  const char* begin;  // of an item's name
  const char* group;
};
// Of the packet `pose`; the first that fits.
constexpr Group kGroups[] = {{"valid", "mode"},
                             {"reason", "mode"},
                             {"stop", "registration"},
                             {"mode", "mode"},
                             {"q_", "pose"},
                             {"p_", "pose"},
                             {"covariance", "uncertainty"},
                             {"filter_omega", "rates"},
                             {"filter_v", "rates"},
                             {"filter_sigma", "uncertainty"},
                             {"filter_", "pose"},
                             {"weakest", "uncertainty"},
                             {"weak", "uncertainty"},
                             {"plan_", "scan"},
                             {"rays", "scan"},
                             {"returns", "scan"},
                             {"scan_id", "scan"},
                             {"inlier", "registration"},
                             {"labels", "registration"},
                             {"iterations", "registration"},
                             {"rms_m", "registration"},
                             {"normalized_residual", "registration"},
                             {"agreement", "registration"},
                             {"age_us", "processing"},
                             {"t_", "processing"},
                             {"overruns", "processing"},
                             {"slot_slips", "processing"},
                             {"software", "processing"},
                             {"image_crc", "processing"},
                             {"bearing", "bearing"},
                             {"search", "search"},
                             {"candidate", "search"},
                             {"part", "parts"},
                             {"inconsisten", "parts"},
                             {"sensor", "sensors"},
                             {"held", "mode"},
                             {"change", "mode"},
                             {"start", "mode"},
                             {"refus", "mode"}};

std::string group_of(const PacketRow& packet, std::string_view item) {
  if (std::string_view(packet.name) != "pose") return packet.name;
  const auto* found = std::find_if(std::begin(kGroups), std::end(kGroups), [&](const Group& row) { return begins_with(item, row.begin); });
  return found != std::end(kGroups) ? found->group : "counters";
}

}  // namespace

const PacketRow* telemetry_row(ConstBytes packet) {
  if (packet.size() <= kSubserviceByte) return nullptr;
  for (const PacketRow& row : kPackets) {
    if (row.type != PacketType::kTelemetry || row.service != packet[kServiceByte] || row.subservice != packet[kSubserviceByte]) continue;
    if (packet.size() != item_offset(row, row.items.size()) + kPacketTrailerBytes) continue;
    if (!row.numbered || row.number == read_bits(packet, 8 * (data_offset(row) - kPacketNumberBytes), 8 * kPacketNumberBytes)) return &row;
  }
  return nullptr;
}

PacketColumns::PacketColumns(const PacketRow& packet, std::size_t table) : packet_(packet) {
  std::size_t offset = data_offset(packet);
  for (const ItemRow& item : packet.items) {
    add_item(item, offset, table);
    offset += item.size();
  }
}

void PacketColumns::add_item(const ItemRow& item, std::size_t offset, std::size_t table) {
  for (std::size_t element = 0; element < item.count; ++element) {
    const std::string name = element_name(item, element);
    Value value;
    value.id = std::string(packet_.name) + "." + item.name + (item.count > 1 ? "." + std::to_string(element) : "");
    value.label = std::string(item.name) + (name.empty() ? "" : " " + name) + ": " + item.meaning;
    value.unit = element_unit(item, element);
    value.topic = "/packets";
    value.group = group_of(packet_, item.name);
    value.table = table;
    value.column = places_.size();
    value.choices = item.enumeration;
    values_.push_back(std::move(value));
    places_.push_back({offset + element * wire_size(item.type), item.type});
  }
}

void PacketColumns::add(double time_s, ConstBytes bytes, ValueTable& table) const {
  if (table.columns.empty()) table.columns.resize(places_.size());
  table.time_s.push_back(time_s);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const ConstBytes rest = bytes.subspan(places_[i].offset, bytes.size() - places_[i].offset);
    table.columns[i].push_back(static_cast<float>(value_of(read_number(places_[i].type, rest))));
  }
}

}  // namespace lasso::mdat::serve
