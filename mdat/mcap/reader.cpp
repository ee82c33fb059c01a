#include "mdat/mcap/reader.hpp"

#include <algorithm>
#include <system_error>

#include "mdat/common/errors.hpp"
#include "mdat/mcap/chunk.hpp"

namespace lasso::mdat::mcap {
namespace {

// A chunk's head from its opcode on, whose lengths agree with each other and with `rest`, the bytes of the file from there on.
bool is_chunk_head(std::string_view head, std::uint64_t rest) {
  ByteReader reader(head);
  if (reader.get<std::uint8_t>() != static_cast<std::uint8_t>(Op::kChunk)) return false;
  const auto length = reader.get<std::uint64_t>();
  (void)reader.take(28);  // times, size, checksum
  const std::string_view compression = reader.text();
  const auto body = reader.get<std::uint64_t>();
  const bool known = compression.empty() || compression == "zstd" || compression == "lz4";
  return reader.ok() && known && body <= rest && length == 40 + compression.size() + body &&
         length <= rest - std::min<std::uint64_t>(rest, kRecordHead);
}
constexpr std::size_t kChunkHead = kRecordHead + 40 + 4;

bool same(const Schema& a, const Schema& b) { return a.name == b.name && a.encoding == b.encoding && a.data == b.data; }
bool same(const Channel& a, const Channel& b) { return a.schema == b.schema && a.topic == b.topic && a.encoding == b.encoding; }

// By its number, which has one meaning in a file.
template <class Record>
bool keep(std::string_view content, std::map<std::uint16_t, Record>& records) {
  Record record;
  if (!get(content, record)) return false;
  return same(records.try_emplace(record.id, record).first->second, record);
}

// A file's profile says how its messages are to be read; it may be left out. What is not printable in a damaged one is shown as ?.
void check_profile(const std::filesystem::path& file, const std::string& profile) {
  if (profile.empty() || profile == "ros2") return;
  std::string shown = profile.substr(0, 20);
  for (char& c : shown) c = c < ' ' || c > '~' ? '?' : c;
  const std::string remedy = profile == "ros1" ? "; rosbags-convert makes one of it" : "";
  throw InputError(file.string() + ": is an MCAP file of profile '" + shown + "': expected 'ros2', or none" + remedy);
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
  crc_ = crc32_of(magic);
  Op op{};
  std::string content;
  if (!next(op, content) || op != Op::kHeader) throw InputError(file.string() + ": is an MCAP file without a header: nothing can be read");
  ByteReader reader(content);
  profile_ = reader.text();
  library_ = reader.text();
  check_profile(file, profile_);
}

bool Reader::next(Op& op, std::string& content) {
  record_at_ = at_;
  record_crc_ = crc_;
  std::string head(kRecordHead, '\0');
  if (size_ - at_ < kRecordHead || !in_.read(head.data(), kRecordHead)) return false;
  ByteReader reader(head);
  op = static_cast<Op>(reader.get<std::uint8_t>());
  const auto length = reader.get<std::uint64_t>();
  if (length > size_ - at_ - kRecordHead) return false;
  content.resize(length);
  if (!in_.read(content.data(), static_cast<std::streamsize>(length))) return false;
  at_ += kRecordHead + length;
  crc_ = crc32_of(content, crc32_of(head, crc_));
  return true;
}

// Kinds of records that the specification has, or keeps for others; a chunk agrees with its own lengths.
bool Reader::is_sound(Op op, std::string_view content) const {
  constexpr std::uint8_t kOthers = 0x80;
  const auto kind = static_cast<std::uint8_t>(op);
  if (op == Op::kDataEnd) return content.size() == 4;
  ChunkParts parts;
  if (op == Op::kChunk) return parts_of(content, parts);
  return (op > Op::kNone && op < Op::kDataEnd) || kind >= kOthers;
}

// The next one behind the last record whose lengths or checksum are right; false: there is none.
bool Reader::find_chunk() {
  constexpr std::uint64_t kBlock = std::uint64_t{1} << 20;
  in_.clear();
  for (std::uint64_t from = search_from_; from + kChunkHead - 4 <= size_; from += kBlock) {
    std::string block(std::min(kBlock + kChunkHead, size_ - from), '\0');
    in_.seekg(static_cast<std::streamoff>(from));
    if (!in_.read(block.data(), static_cast<std::streamsize>(block.size()))) return false;
    for (std::size_t i = 0; i < std::min<std::size_t>(block.size(), kBlock); ++i) {
      if (block[i] != static_cast<char>(Op::kChunk) || !is_chunk_head(std::string_view(block).substr(i, kChunkHead), size_ - from - i))
        continue;
      at_ = from + i;
      in_.seekg(static_cast<std::streamoff>(at_));
      return true;
    }
  }
  return false;
}

void Reader::take_message(std::string_view content, const Visitor& visitor) {
  Message message;
  if (!get(content, message)) return note("a message is shorter than it says");
  const auto channel = channels_.find(message.channel);
  if (channel == channels_.end()) return note("a message is of a channel that nothing says");
  ++messages_;
  for (auto damage = damage_.rbegin(); damage != damage_.rend() && damage->before_ns == 0; ++damage) damage->before_ns = message.log_ns;
  last_ns_ = std::max(last_ns_, message.log_ns);
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
  chunks_ = true;
  search_from_ = at_;
  std::string why;
  const std::string records = unpacked(parts, why);
  if (!why.empty()) return note(why);
  take_records(records, visitor);
}

void Reader::take_attachment(std::string_view content, const Visitor& visitor) {
  Attachment attachment;
  if (!get(content, attachment)) return note("an attachment has another checksum than it says");
  search_from_ = at_;
  visitor.attachment(attachment);
}

void Reader::take_metadata(std::string_view content, const Visitor& visitor) {
  ByteReader reader(content);
  const std::string name(reader.text());
  Text map = reader.map();
  if (!reader.ok()) return note("metadata is shorter than it says");
  const auto crc = map.find(kMetadataCrc);
  if (crc != map.end()) {
    const std::string said = crc->second;
    map.erase(crc);
    if (said != metadata_crc(name, map)) return note("metadata has another checksum than it says");
  }
  visitor.metadata(name, map);
}

// What a chunk may hold, and what stands beside chunks in a file that has none.
void Reader::take_inner(Op op, std::string_view content, const Visitor& visitor) {
  if (op == Op::kSchema && !keep<Schema>(content, schemas_)) return note("a schema is not as long as it says, or another than before");
  if (op == Op::kChannel && !keep<Channel>(content, channels_)) return note("a channel is not as long as it says, or another than before");
  if (op == Op::kMessage) return take_message(content, visitor);
}

void Reader::take(Op op, std::string_view content, const Visitor& visitor) {
  if (op == Op::kChunk) return take_chunk(content, visitor);
  if (op == Op::kAttachment) return take_attachment(content, visitor);
  if (op == Op::kMetadata) return take_metadata(content, visitor);
  if (op == Op::kMessage && chunks_) return note("a message stands outside of chunks, in a file of chunks");
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

void Reader::end_data(std::string_view content) {
  ended_ = true;
  ByteReader reader(content);
  const auto said = reader.get<std::uint32_t>();
  if (said != 0 && damage_.empty() && said != record_crc_)
    note("the data before has another checksum than it says: what has none of its own, such as an index, is damaged");
}

// False: there is no further one.
bool Reader::read_record(const Visitor& visitor) {
  Op op{};
  std::string content;
  const bool whole = next(op, content);
  if (whole && is_sound(op, content)) {
    if (op == Op::kDataEnd) end_data(content);
    take(op, content, visitor);
    return !ended_;
  }
  note(whole ? "what stands here is no record" : "the file ends here, within its data");
  const std::size_t noted = damage_.size() - 1;
  const bool goes_on = find_chunk();
  if (goes_on && !whole) damage_[noted].why = "a record reaches beyond the file";
  return goes_on;
}

std::vector<Damage> Reader::read(const Visitor& visitor) {
  while (read_record(visitor)) {
  }
  if (ended_ && damage_.empty()) count_again();
  return damage_;
}

std::string Reader::message_at(std::uint64_t record_at, std::size_t nth) {
  std::string data;
  std::size_t number = 0;
  bool found = false;
  Visitor visitor;
  visitor.message = [&](const Channel&, const Message& message) {
    if (number++ != nth) return;
    found = true;
    data = message.data;
  };
  Op op{};
  std::string content;
  in_.clear();
  at_ = record_at;
  in_.seekg(static_cast<std::streamoff>(at_));
  if (next(op, content)) op == Op::kMessage ? take_message(content, visitor) : take(op, content, visitor);
  if (!found) throw InputError(path_.string() + ": the record at byte " + std::to_string(record_at) + " cannot be read again");
  return data;
}

}  // namespace lasso::mdat::mcap
