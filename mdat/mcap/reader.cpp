#include "mdat/mcap/reader.hpp"

#include <zstd.h>

#include <system_error>

#include "mdat/common/errors.hpp"
#include "mdat/mcap/chunk.hpp"

namespace lasso::mdat::mcap {
namespace {

constexpr std::uint64_t kLargestChunk = std::uint64_t{1} << 30;  // unpacked: a length that is damaged asks for no memory beyond

}  // namespace

bool parts_of(std::string_view content, ChunkParts& parts) {
  ByteReader reader(content);
  parts.first_ns = reader.get<std::uint64_t>();
  parts.last_ns = reader.get<std::uint64_t>();
  parts.size = reader.get<std::uint64_t>();
  parts.crc = reader.get<std::uint32_t>();
  parts.compression = reader.text();
  parts.body = reader.take(reader.get<std::uint64_t>());
  return reader.ok() && reader.rest().empty();
}

// Empty, with a reason, where it cannot be unpacked.
std::string unpacked(const ChunkParts& parts, std::string& why) {
  std::string records;
  if (parts.size > kLargestChunk) {
    why = "a chunk says that it holds " + std::to_string(parts.size) + " bytes: more than any has";
  } else if (parts.compression.empty()) {
    records = parts.body;
  } else if (parts.compression != "zstd") {
    why = "a chunk is compressed by '" + std::string(parts.compression.substr(0, 20)) + "': zstd, or none, is read here";
  } else {
    records.resize(parts.size);
    const std::size_t size = ZSTD_decompress(records.data(), records.size(), parts.body.data(), parts.body.size());
    if (ZSTD_isError(size) != 0U || size != parts.size) why = "a chunk cannot be unpacked";
  }
  if (why.empty() && (records.size() != parts.size || (parts.crc != 0 && crc32_of(records) != parts.crc)))
    why = "a chunk has another check sum than it says";
  return why.empty() ? records : std::string();
}

namespace {

// By its number.
template <class Record>
bool keep(std::string_view content, std::map<std::uint16_t, Record>& records) {
  Record record;
  if (!get(content, record)) return false;
  records[record.id] = record;
  return true;
}

}  // namespace

Reader::Reader(const std::filesystem::path& file) : path_(file), in_(file, std::ios::binary) {
  std::error_code error;
  size_ = std::filesystem::file_size(file, error);
  if (!in_ || error) throw InputError(file.string() + ": cannot be read: expected a recording (.mcap)");
  std::string magic(kMagic.size(), '\0');
  in_.read(magic.data(), static_cast<std::streamsize>(magic.size()));
  if (magic.substr(0, 5) != kMagic.substr(0, 5)) throw InputError(file.string() + ": is no MCAP file: it does not begin with its mark");
  if (magic != kMagic) throw InputError(file.string() + ": is an MCAP file of another version than 0, which is read here");
  at_ = magic.size();
  Op op{};
  std::string content;
  if (!next(op, content) || op != Op::kHeader) throw InputError(file.string() + ": is an MCAP file without a header: nothing can be read");
  ByteReader reader(content);
  profile_ = reader.text();
  library_ = reader.text();
}

bool Reader::next(Op& op, std::string& content) {
  record_at_ = at_;
  std::string head(kRecordHead, '\0');
  if (size_ - at_ < kRecordHead || !in_.read(head.data(), kRecordHead)) return false;
  ByteReader reader(head);
  op = static_cast<Op>(reader.get<std::uint8_t>());
  const auto length = reader.get<std::uint64_t>();
  if (length > size_ - at_ - kRecordHead) return false;
  content.resize(length);
  if (!in_.read(content.data(), static_cast<std::streamsize>(length))) return false;
  at_ += kRecordHead + length;
  return true;
}

void Reader::take_message(std::string_view content, const Visitor& visitor) {
  Message message;
  if (!get(content, message)) return note("a message is shorter than it says");
  const auto channel = channels_.find(message.channel);
  if (channel == channels_.end()) return note("a message is of a channel that nothing says");
  ++messages_;
  visitor.message(channel->second, message);
}

void Reader::take_records(std::string_view records, const Visitor& visitor) {
  ByteReader reader(records);
  while (reader.ok() && !reader.rest().empty()) {
    const auto op = static_cast<Op>(reader.get<std::uint8_t>());
    const std::string_view content = reader.take(reader.get<std::uint64_t>());
    if (!reader.ok()) return note("a chunk ends within a record");
    take_inner(op, content, visitor);
  }
}

void Reader::take_chunk(std::string_view content, const Visitor& visitor) {
  ChunkParts parts;
  if (!parts_of(content, parts)) return note("a chunk is shorter than it says");
  std::string why;
  const std::string records = unpacked(parts, why);
  if (!why.empty()) return note(why);
  take_records(records, visitor);
}

void Reader::take_attachment(std::string_view content, const Visitor& visitor) {
  Attachment attachment;
  if (!get(content, attachment)) return note("an attachment has another check sum than it says");
  visitor.attachment(attachment);
}

void Reader::take_metadata(std::string_view content, const Visitor& visitor) {
  ByteReader reader(content);
  const std::string name(reader.text());
  const Text map = reader.map();
  if (!reader.ok()) return note("metadata is shorter than it says");
  visitor.metadata(name, map);
}

// What a chunk may hold, and what stands beside chunks in a file that has none.
void Reader::take_inner(Op op, std::string_view content, const Visitor& visitor) {
  if (op == Op::kSchema && !keep<Schema>(content, schemas_)) return note("a schema is shorter than it says");
  if (op == Op::kChannel && !keep<Channel>(content, channels_)) return note("a channel is shorter than it says");
  if (op == Op::kMessage) return take_message(content, visitor);
}

void Reader::take(Op op, std::string_view content, const Visitor& visitor) {
  if (op == Op::kChunk) return take_chunk(content, visitor);
  if (op == Op::kAttachment) return take_attachment(content, visitor);
  if (op == Op::kMetadata) return take_metadata(content, visitor);
  take_inner(op, content, visitor);
}

// A record whose kind is damaged is passed over as one that is not known: what the summary counts shows it.
void Reader::count_again() {
  Op op{};
  std::string content;
  while (next(op, content) && op != Op::kFooter) {
    if (op != Op::kStatistics) continue;
    ByteReader reader(content);
    const auto counted = reader.get<std::uint64_t>();
    if (counted != messages_)
      note(std::to_string(messages_) + " messages could be read, and its summary counts " + std::to_string(counted));
  }
}

std::vector<Damage> Reader::read(const Visitor& visitor) {
  Op op{};
  std::string content;
  while (!ended_ && next(op, content)) {
    ended_ = op == Op::kDataEnd;
    take(op, content, visitor);
  }
  if (!ended_) note("the file ends here, within its data");
  if (ended_ && damage_.empty()) count_again();
  return damage_;
}

}  // namespace lasso::mdat::mcap
