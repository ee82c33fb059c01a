// The records of an MCAP file, version 0 (mcap.dev/spec), as far as recordings have them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "mdat/mcap/bytes.hpp"

namespace lasso::mdat::mcap {

constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);
constexpr std::size_t kRecordHead = 9;  // opcode, and the length of what follows

enum class Op : std::uint8_t {
  kNone = 0,  // of no record
  kHeader,
  kFooter,
  kSchema,
  kChannel,
  kMessage,
  kChunk,
  kMessageIndex,
  kChunkIndex,
  kAttachment,
  kAttachmentIndex,
  kStatistics,
  kMetadata,
  kMetadataIndex,
  kSummaryOffset,
  kDataEnd,
};

struct Schema {
  std::uint16_t id = 0;
  std::string name, encoding, data;
};

struct Channel {
  std::uint16_t id = 0, schema = 0;
  std::string topic, encoding;
  Text metadata;
};

// Times are nanoseconds.
struct Message {
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_ns = 0, publish_ns = 0;
  std::string_view data;
};

struct Attachment {
  std::uint64_t log_ns = 0, create_ns = 0;
  std::string name, media_type;
  std::string_view data;
};

// One record at the end of `bytes`.
void put_record(Op op, std::string_view content, std::string& bytes);
void put_schema(const Schema& schema, std::string& bytes);
void put_channel(const Channel& channel, std::string& bytes);
void put_message(const Message& message, std::string& bytes);
void put_attachment(const Attachment& attachment, std::string& bytes);

// The content of a record; false where it is shorter than it says, or where a checksum says that it is another.
bool get(std::string_view content, Schema& schema);
bool get(std::string_view content, Channel& channel);
bool get(std::string_view content, Message& message);
bool get(std::string_view content, Attachment& attachment);

// The format has no checksum for metadata: ours is an entry under this key, of all others.
constexpr char kMetadataCrc[] = "crc32";
std::string metadata_crc(std::string_view name, const Text& map);

// CRC-32 of IEEE 802.3, as MCAP asks for.
std::uint32_t crc32_of(std::string_view bytes, std::uint32_t seed = 0);

}  // namespace lasso::mdat::mcap
