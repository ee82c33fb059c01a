#include "mdat/mcap/copy.hpp"

namespace lasso::mdat::mcap {

std::uint16_t Copy::schema_of(const Channel& channel) {
  const auto schema = reader_.schemas().find(channel.schema);
  if (schema == reader_.schemas().end()) return 0;
  const auto [place, added] = schemas_.try_emplace(channel.schema, std::uint16_t{0});
  if (added) place->second = writer_.add_schema(schema->second.name, schema->second.encoding, schema->second.data);
  return place->second;
}

void Copy::message(const Channel& channel, const Message& message) {
  const auto [place, added] = channels_.try_emplace(channel.id, std::uint16_t{0});
  if (added) place->second = writer_.add_channel(channel.topic, schema_of(channel), channel.encoding, channel.metadata);
  Message copy = message;
  copy.channel = place->second;
  writer_.write(copy);
}

}  // namespace lasso::mdat::mcap
