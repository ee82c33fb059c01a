#include "mdat/mcap/format.hpp"

#include <zlib.h>

namespace lasso::mdat::mcap {

std::uint32_t crc32_of(std::string_view bytes, std::uint32_t seed) {
  return static_cast<std::uint32_t>(crc32_z(seed, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

std::string metadata_crc(std::string_view name, const Text& map) {
  std::string content;
  put_text(name, content);
  put_map(map, content);
  return std::to_string(crc32_of(content));
}

void put_record(Op op, std::string_view content, std::string& bytes) {
  put(static_cast<std::uint8_t>(op), bytes);
  put<std::uint64_t>(content.size(), bytes);
  bytes.append(content);
}

void put_schema(const Schema& schema, std::string& bytes) {
  std::string content;
  put(schema.id, content);
  put_text(schema.name, content);
  put_text(schema.encoding, content);
  put_text(schema.data, content);
  put_record(Op::kSchema, content, bytes);
}

void put_channel(const Channel& channel, std::string& bytes) {
  std::string content;
  put(channel.id, content);
  put(channel.schema, content);
  put_text(channel.topic, content);
  put_text(channel.encoding, content);
  put_map(channel.metadata, content);
  put_record(Op::kChannel, content, bytes);
}

// In place: most of a recording's bytes pass here.
void put_message(const Message& message, std::string& bytes) {
  constexpr std::uint64_t kHeadBytes = 2 + 4 + 8 + 8;
  put(static_cast<std::uint8_t>(Op::kMessage), bytes);
  put<std::uint64_t>(kHeadBytes + message.data.size(), bytes);
  put(message.channel, bytes);
  put(message.sequence, bytes);
  put(message.log_ns, bytes);
  put(message.publish_ns, bytes);
  bytes.append(message.data);
}

void put_attachment(const Attachment& attachment, std::string& bytes) {
  std::string content;
  put(attachment.log_ns, content);
  put(attachment.create_ns, content);
  put_text(attachment.name, content);
  put_text(attachment.media_type, content);
  put<std::uint64_t>(attachment.data.size(), content);
  content.append(attachment.data);
  put(crc32_of(content), content);
  put_record(Op::kAttachment, content, bytes);
}

bool get(std::string_view content, Schema& schema) {
  ByteReader reader(content);
  schema.id = reader.get<std::uint16_t>();
  schema.name = reader.text();
  schema.encoding = reader.text();
  schema.data = reader.text();
  return reader.ok() && reader.rest().empty() && schema.id != 0;
}

bool get(std::string_view content, Channel& channel) {
  ByteReader reader(content);
  channel.id = reader.get<std::uint16_t>();
  channel.schema = reader.get<std::uint16_t>();
  channel.topic = reader.text();
  channel.encoding = reader.text();
  channel.metadata = reader.map();
  return reader.ok() && reader.rest().empty();
}

bool get(std::string_view content, Message& message) {
  ByteReader reader(content);
  message.channel = reader.get<std::uint16_t>();
  message.sequence = reader.get<std::uint32_t>();
  message.log_ns = reader.get<std::uint64_t>();
  message.publish_ns = reader.get<std::uint64_t>();
  message.data = reader.rest();
  return reader.ok();
}

bool get(std::string_view content, Attachment& attachment) {
  ByteReader reader(content);
  attachment.log_ns = reader.get<std::uint64_t>();
  attachment.create_ns = reader.get<std::uint64_t>();
  attachment.name = reader.text();
  attachment.media_type = reader.text();
  attachment.data = reader.take(reader.get<std::uint64_t>());
  const std::size_t checked = content.size() - reader.rest().size();
  const auto crc = reader.get<std::uint32_t>();
  return reader.ok() && (crc == 0 || crc == crc32_of(content.substr(0, checked)));
}

}  // namespace lasso::mdat::mcap
