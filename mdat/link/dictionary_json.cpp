#include <cmath>
#include <nlohmann/json.hpp>

#include "fsw/link/dictionary.hpp"
#include "fsw/mission/parameters.hpp"
#include "mdat/link/dictionary_text.hpp"
#include "mdat/link/page.hpp"

namespace lasso::mdat {
namespace {

using Json = nlohmann::ordered_json;

Json bound(double value) { return std::isinf(value) ? Json(nullptr) : Json(value); }

Json choices(const Enumeration& enumeration) {
  Json list = Json::array();
  for (const Choice& choice : enumeration.choices) {
    list.push_back({{"value", list.size()}, {"name", choice.name}, {"meaning", choice.meaning}, {"action", choice.action}});
  }
  return list;
}

Json item(const PacketRow& packet, std::size_t index) {
  const ItemRow& row = packet.items[index];
  Json json = {{"id", row.id},       {"name", row.name}, {"byte", item_offset(packet, index)},  {"type", to_string(row.type)},
               {"count", row.count}, {"unit", row.unit}, {"minimum", bound(row.range.minimum)}, {"maximum", bound(row.range.maximum)}};
  if (row.enumeration != nullptr) json["enumeration"] = row.enumeration->name;
  json["meaning"] = row.meaning;
  return json;
}

Json fields(Span<const HeaderField> header) {
  Json list = Json::array();
  for (const HeaderField& field : header)
    list.push_back({{"name", field.name}, {"bit", field.bit}, {"bits", field.bits}, {"meaning", field.meaning}});
  return list;
}

Json packet(const PacketRow& row) {
  Json json = {{"name", row.name},
               {"type", row.type == PacketType::kTelemetry ? "telemetry" : "command"},
               {"service", row.service},
               {"subservice", row.subservice},
               {"number", row.numbered ? Json(row.number) : Json(nullptr)},
               {"size", item_offset(row, row.items.size()) + kPacketTrailerBytes},
               {"meaning", row.meaning},
               {"items", Json::array()}};
  for (std::size_t i = 0; i < row.items.size(); ++i) json["items"].push_back(item(row, i));
  if (row.service != kServiceEvent || !row.numbered) return json;
  json["severity"] = severity_text(row);
  json["cause"] = row.cause;
  json["action"] = row.action;
  return json;
}

Json parameters() {
  const char* kinds[] = {"real", "integer", "boolean", "choice"};
  Json list = Json::array();
  for (const ParameterRow& row : parameter_rows()) {
    list.push_back({{"id", row.id},
                    {"name", row.key},
                    {"unit", row.unit},
                    {"type", kinds[static_cast<std::size_t>(row.kind)]},
                    {"minimum", row.minimum},
                    {"maximum", row.maximum},
                    {"preset", row.preset},
                    {"choices", row.choices},
                    {"meaning", row.meaning}});
  }
  return list;
}

}  // namespace

std::string dictionary_json(std::uint16_t apid) {
  Json json = {{"apid", apid},
               {"headers",
                {{"primary", fields(Span<const HeaderField>(kPrimaryFields))},
                 {"telemetry", fields(Span<const HeaderField>(kTelemetryFields))},
                 {"command", fields(Span<const HeaderField>(kCommandFields))}}},
               {"packets", Json::array()},
               {"enumerations", {{kPacketFault.name, choices(kPacketFault)}}},
               {"parameters", parameters()}};
  for (const PacketRow& row : kPackets) {
    json["packets"].push_back(packet(row));
    for (const ItemRow& item : row.items) {
      if (item.enumeration != nullptr) json["enumerations"][item.enumeration->name] = choices(*item.enumeration);
    }
  }
  return json.dump(1) + "\n";
}

}  // namespace lasso::mdat
