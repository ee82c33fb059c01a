#include "mdat/mcap/indexed_file.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <system_error>

#include "mdat/common/errors.hpp"
#include "mdat/mcap/chunk.hpp"

namespace lasso::mdat::mcap {
namespace {

constexpr std::uint64_t kFooterContent = 20;
constexpr std::uint64_t kTail = kRecordHead + kFooterContent + kMagic.size();
constexpr std::uint64_t kLargestSummary = std::uint64_t{1} << 28;
constexpr std::uint64_t kLargestLoose = std::uint64_t{1} << 20;

struct RecordHead {
  Op op = Op::kNone;
  std::uint64_t length = 0;
};

RecordHead head_of(std::string_view bytes) {
  ByteReader reader(bytes);
  RecordHead head;
  head.op = static_cast<Op>(reader.get<std::uint8_t>());
  head.length = reader.get<std::uint64_t>();
  return head;
}

bool chunk_of(std::string_view content, ChunkPlace& chunk) {
  ByteReader reader(content);
  chunk.first_ns = reader.get<std::uint64_t>();
  chunk.last_ns = reader.get<std::uint64_t>();
  chunk.at = reader.get<std::uint64_t>();
  chunk.size = reader.get<std::uint64_t>();
  ByteReader places(reader.text());
  while (places.ok() && !places.rest().empty()) {
    chunk.channels.push_back(places.get<std::uint16_t>());
    (void)places.get<std::uint64_t>();
  }
  (void)reader.get<std::uint64_t>();
  (void)reader.text();
  std::sort(chunk.channels.begin(), chunk.channels.end());
  chunk.indexed = !chunk.channels.empty();
  return reader.ok() && places.ok();
}

bool attachment_of(std::string_view content, AttachmentPlace& place) {
  ByteReader reader(content);
  place.at = reader.get<std::uint64_t>();
  place.size = reader.get<std::uint64_t>();
  (void)reader.take(2 * sizeof(std::uint64_t));
  place.data_size = reader.get<std::uint64_t>();
  place.name = reader.text();
  return reader.ok();
}

bool fits(std::uint64_t at, std::uint64_t size, std::uint64_t whole) { return at <= whole && size <= whole - at; }

bool is_loose(Op op) { return op == Op::kSchema || op == Op::kChannel || op == Op::kMessage; }

}  // namespace

bool ChunkPlace::may_have(std::uint16_t channel) const { return !indexed || std::binary_search(channels.begin(), channels.end(), channel); }

bool for_each_message(std::string_view records, const std::function<void(const Message&)>& take) {
  ByteReader reader(records);
  while (reader.ok() && !reader.rest().empty()) {
    const auto op = static_cast<Op>(reader.get<std::uint8_t>());
    const std::string_view content = reader.take(reader.get<std::uint64_t>());
    Message message;
    if (reader.ok() && op == Op::kMessage && get(content, message)) take(message);
  }
  return reader.ok();
}

void IndexedFile::read_header(const std::filesystem::path& file) {
  const Reader head(file);  // says what is wrong with a file that is none
  profile_ = head.profile();
  library_ = head.library();
  begin_ = walked_ = kMagic.size() + kRecordHead + head_of(bytes(kMagic.size(), kRecordHead)).length;
}

IndexedFile::IndexedFile(const std::filesystem::path& file, std::uint64_t whole) : path_(file) {
  read_header(file);
  grow(whole);
}

void IndexedFile::grow(std::uint64_t whole) {
  size_ = std::max(size_, whole);
  walk_on();
}

IndexedFile::IndexedFile(const std::filesystem::path& file) : path_(file) {
  read_header(file);
  std::error_code error;
  size_ = std::filesystem::file_size(file, error);
  if (read_summary()) return;
  schemas_.clear();
  channels_.clear();
  chunks_.clear();
  attachments_.clear();
  metadata_.clear();
  counts_.clear();
  walk();
}

std::optional<std::uint16_t> IndexedFile::channel_of(std::string_view topic) const {
  for (const auto& [id, channel] : channels_) {
    if (channel.topic == topic) return id;
  }
  return std::nullopt;
}

// Shorter where the file is.
std::string IndexedFile::bytes(std::uint64_t at, std::uint64_t size) const {
  std::string result(size, '\0');
  std::ifstream in(path_, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(at));
  in.read(result.data(), static_cast<std::streamsize>(size));
  result.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return result;
}

// By the footer. False: there is none that is right, or it says less than the file has.
bool IndexedFile::read_summary() {
  if (size_ < begin_ + kTail) return false;
  const std::string tail = bytes(size_ - kTail, kTail);
  ByteReader footer(std::string_view(tail).substr(0, kRecordHead + kFooterContent));
  if (head_of(footer.take(kRecordHead)).op != Op::kFooter || tail.substr(tail.size() - kMagic.size()) != kMagic) return false;
  const auto at = footer.get<std::uint64_t>(), offsets = footer.get<std::uint64_t>();
  const auto crc = footer.get<std::uint32_t>();
  const std::uint64_t end = size_ - kTail;
  if (at < begin_ || at > end || end - at > kLargestSummary) return false;
  const std::string summary = bytes(at, end - at);
  const std::string_view checked = std::string_view(tail).substr(0, kRecordHead + kFooterContent - sizeof crc);
  if (crc != 0 && crc != crc32_of(checked, crc32_of(summary))) return false;
  const std::uint64_t groups = offsets >= at && offsets <= end ? offsets - at : summary.size();
  return take_summary(std::string_view(summary).substr(0, groups)) && (!chunks_.empty() || counts_.empty());
}

bool IndexedFile::take_summary(std::string_view summary) {
  ByteReader reader(summary);
  while (reader.ok() && !reader.rest().empty()) {
    const auto op = static_cast<Op>(reader.get<std::uint8_t>());
    const std::string_view content = reader.take(reader.get<std::uint64_t>());
    if (!reader.ok() || !take_index(op, content)) return false;
  }
  std::sort(chunks_.begin(), chunks_.end(), [](const ChunkPlace& a, const ChunkPlace& b) { return a.at < b.at; });
  return reader.ok();
}

bool IndexedFile::take_definition(Op op, std::string_view content) {
  if (op == Op::kSchema) {
    Schema schema;
    return get(content, schema) && schemas_.insert_or_assign(schema.id, schema).second;
  }
  Channel channel;
  return get(content, channel) && channels_.insert_or_assign(channel.id, channel).second;
}

// A record of the summary. False: it is shorter than it says, or leads beyond the file.
bool IndexedFile::take_index(Op op, std::string_view content) {
  if (op == Op::kSchema || op == Op::kChannel) return take_definition(op, content);
  if (op == Op::kStatistics) take_statistics(content);
  if (op == Op::kChunkIndex) {
    chunks_.emplace_back();
    return chunk_of(content, chunks_.back()) && fits(chunks_.back().at, chunks_.back().size, size_);
  }
  if (op == Op::kAttachmentIndex) {
    attachments_.emplace_back();
    return attachment_of(content, attachments_.back()) && fits(attachments_.back().at, attachments_.back().size, size_);
  }
  if (op != Op::kMetadataIndex) return true;
  ByteReader reader(content);
  const auto at = reader.get<std::uint64_t>(), size = reader.get<std::uint64_t>();
  if (!reader.ok() || !fits(at, size, size_)) return false;
  take_metadata(at, size);
  return true;
}

void IndexedFile::take_statistics(std::string_view content) {
  ByteReader reader(content);
  (void)reader.take(8 + 2 + 4 * 4 + 8 + 8);  // messages, schemas, channels, attachments, metadata, chunks, first and last time
  ByteReader counts(reader.text());
  while (counts.ok() && !counts.rest().empty()) {
    const auto channel = counts.get<std::uint16_t>();
    const auto count = counts.get<std::uint64_t>();
    if (counts.ok()) counts_[channel] = count;
  }
}

void IndexedFile::take_metadata(std::uint64_t at, std::uint64_t size) {
  const std::string record = bytes(at, size);
  ByteReader reader(record);
  const RecordHead head = head_of(reader.take(kRecordHead));
  const std::string name(reader.text());
  const Text map = reader.map();
  if (head.op == Op::kMetadata && reader.ok()) metadata_[name] = map;
}

// Record by record, by their heads, from where it was before. Whether the data end.
bool IndexedFile::walk_on() {
  bool ended = false;
  while (!ended && fits(walked_, kRecordHead, size_)) {
    const RecordHead head = head_of(bytes(walked_, kRecordHead));
    if (!fits(walked_ + kRecordHead, head.length, size_)) break;
    ended = head.op == Op::kDataEnd;
    take_walked(head.op, walked_, kRecordHead + head.length);
    walked_ += kRecordHead + head.length;
  }
  return ended;
}

void IndexedFile::walk() {
  const bool ended = walk_on();
  Damage damage{walked_, "the file ends here, within its data: what is whole before is shown"};
  if (ended) damage.why = "its summary is missing or damaged: what it holds was found record by record";
  damage_.push_back(std::move(damage));
}

void IndexedFile::take_walked(Op op, std::uint64_t at, std::uint64_t size) {
  if (is_loose(op)) take_loose(at, size);
  if (op == Op::kMessageIndex) take_message_index(at, size);
  if (op == Op::kMetadata) take_metadata(at, size);
  if (op == Op::kAttachment) {
    const std::string record = bytes(at, std::min<std::uint64_t>(size, 70000));
    ByteReader reader(record);
    (void)reader.take(kRecordHead + 2 * sizeof(std::uint64_t));
    AttachmentPlace place{std::string(reader.text()), at, size, 0};
    (void)reader.text();
    place.data_size = reader.get<std::uint64_t>();
    if (reader.ok()) attachments_.push_back(std::move(place));
  }
  if (op != Op::kChunk) return;
  ChunkPlace chunk;
  chunk.at = at;
  chunk.size = size;
  const std::string head = bytes(at + kRecordHead, 2 * sizeof(std::uint64_t));
  ByteReader reader(head);
  chunk.first_ns = reader.get<std::uint64_t>();
  chunk.last_ns = reader.get<std::uint64_t>();
  if (channels_.empty()) learn_channels(chunk);
  chunks_.push_back(std::move(chunk));
}

// Messages outside of chunks, a megabyte or so together.
void IndexedFile::take_loose(std::uint64_t at, std::uint64_t size) {
  const bool follows = !chunks_.empty() && chunks_.back().loose && chunks_.back().at + chunks_.back().size == at;
  if (!follows || chunks_.back().size > kLargestLoose) {
    chunks_.emplace_back();
    chunks_.back().at = at;
    chunks_.back().loose = true;
    chunks_.back().first_ns = std::numeric_limits<std::uint64_t>::max();
  }
  ChunkPlace& chunk = chunks_.back();
  chunk.size += size;
  const std::string record = bytes(at, size);
  const std::string_view content = std::string_view(record).substr(std::min<std::size_t>(kRecordHead, record.size()));
  Message message;
  if (head_of(record).op != Op::kMessage) return learn_channels({at, size, 0, 0, true, false, {}});
  if (!get(content, message)) return;
  chunk.first_ns = std::min(chunk.first_ns, message.log_ns);
  chunk.last_ns = std::max(chunk.last_ns, message.log_ns);
}

// It follows its chunk.
void IndexedFile::take_message_index(std::uint64_t at, std::uint64_t size) {
  if (chunks_.empty() || chunks_.back().loose || size < kRecordHead + sizeof(std::uint16_t)) return;
  const std::string content = bytes(at + kRecordHead, sizeof(std::uint16_t));
  ByteReader reader(content);
  const auto channel = reader.get<std::uint16_t>();
  ChunkPlace& chunk = chunks_.back();
  chunk.indexed = true;
  chunk.channels.insert(std::lower_bound(chunk.channels.begin(), chunk.channels.end(), channel), channel);
  if (channels_.count(channel) == 0) learn_channels(chunk);
}

void IndexedFile::learn_channels(const ChunkPlace& chunk) {
  std::string why;
  const std::string records = records_of(chunk, why);
  ByteReader reader(records);
  while (reader.ok() && !reader.rest().empty()) {
    const auto op = static_cast<Op>(reader.get<std::uint8_t>());
    const std::string_view content = reader.take(reader.get<std::uint64_t>());
    Schema schema;
    Channel channel;
    if (reader.ok() && op == Op::kSchema && get(content, schema)) schemas_[schema.id] = schema;
    if (reader.ok() && op == Op::kChannel && get(content, channel)) channels_[channel.id] = channel;
  }
}

std::string IndexedFile::records_of(const ChunkPlace& chunk, std::string& why) const {
  std::string record = bytes(chunk.at, chunk.size);
  if (record.size() != chunk.size || (!chunk.loose && record.size() < kRecordHead)) {
    why = "a chunk reaches beyond the file";
    return {};
  }
  if (chunk.loose) return record;
  ChunkParts parts;
  if (head_of(record).op != Op::kChunk || !parts_of(std::string_view(record).substr(kRecordHead), parts)) {
    why = "a chunk is not where the index says, or shorter than it says";
    return {};
  }
  return unpacked(parts, why);
}

std::optional<std::string> IndexedFile::attachment(std::string_view name) const {
  for (const AttachmentPlace& place : attachments_) {
    if (place.name != name) continue;
    const std::string record = bytes(place.at, place.size);
    Attachment attachment;
    if (record.size() < kRecordHead || head_of(record).op != Op::kAttachment) return std::nullopt;
    if (!get(std::string_view(record).substr(kRecordHead), attachment)) return std::nullopt;
    return std::string(attachment.data);
  }
  return std::nullopt;
}

}  // namespace lasso::mdat::mcap
