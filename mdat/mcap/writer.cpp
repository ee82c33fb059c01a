#include "mdat/mcap/writer.hpp"

#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "mdat/common/errors.hpp"

namespace lasso::mdat::mcap {
namespace {

constexpr int kZstdLevel = -1;  // 1 takes twice as long and saves 3 % of these bytes

std::string chunk_head(std::uint64_t first_ns, std::uint64_t last_ns, std::string_view records, std::size_t compressed_size) {
  std::string head;
  put(first_ns, head);
  put(last_ns, head);
  put<std::uint64_t>(records.size(), head);
  put(crc32_of(records), head);
  put_text("zstd", head);
  put<std::uint64_t>(compressed_size, head);
  return head;
}

}  // namespace

void FreeCompressor::operator()(ZSTD_CCtx_s* context) const { (void)ZSTD_freeCCtx(context); }

Writer::Writer(const std::filesystem::path& file, const std::string& profile, const std::string& library)
    : path_(file), out_(file, std::ios::binary), compressor_(ZSTD_createCCtx()) {
  std::string content;
  put_text(profile, content);
  put_text(library, content);
  std::string bytes(kMagic);
  put_record(Op::kHeader, content, bytes);
  put_out(bytes);
}

// Room for what is compressed stays from chunk to chunk.
std::string_view Writer::compressed(std::string_view bytes) {
  packed_.resize(std::max(packed_.size(), ZSTD_compressBound(bytes.size())));
  return {packed_.data(), ZSTD_compressCCtx(compressor_.get(), packed_.data(), packed_.size(), bytes.data(), bytes.size(), kZstdLevel)};
}

void Writer::put_out(std::string_view bytes, bool flush) {
  errno = 0;
  // cppcheck-suppress invalidLifetime ; the callers' bytes live until it returns
  out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (flush) out_.flush();
  if (!out_) throw InputError(path_.string() + ": cannot be written: " + (errno != 0 ? std::strerror(errno) : "the disk may be full"));
  at_ += bytes.size();
  crc_ = crc32_of(bytes, crc_);
}

std::uint16_t Writer::add_schema(const std::string& name, const std::string& encoding, const std::string& data) {
  schemas_.push_back({static_cast<std::uint16_t>(schemas_.size() + 1), name, encoding, data});
  return schemas_.back().id;
}

std::uint16_t Writer::add_channel(const std::string& topic, std::uint16_t schema, const std::string& encoding, const Text& metadata,
                                  Bulk bulk) {
  channels_.push_back({static_cast<std::uint16_t>(channels_.size()), schema, topic, encoding, metadata});
  bulks_.push_back(bulk);
  return channels_.back().id;
}

void Writer::write(std::uint16_t channel, std::uint64_t time_ns, std::string_view data) {
  const auto counted = counts_.messages.find(channel);
  const std::uint64_t before = counted != counts_.messages.end() ? counted->second : 0;
  write({channel, static_cast<std::uint32_t>(before), time_ns, time_ns, data});
}

// A channel's first message in a chunk comes behind what says the channel.
void Writer::begin_in_chunk(std::uint16_t channel, Chunk& chunk) const {
  const Channel& said = channels_.at(channel);
  if (said.schema != 0 && chunk.schemas.insert(said.schema).second) put_schema(schemas_.at(said.schema - 1U), chunk.records);
  put_channel(said, chunk.records);
}

void Writer::write(const Message& message) {
  const std::uint64_t time_ns = message.log_ns;
  Chunk& chunk = chunks_.at(static_cast<std::size_t>(bulks_.at(message.channel)));
  const bool first_of_chunk = chunk.index.empty(), first = counts_.messages.empty();
  chunk.first_ns = first_of_chunk ? time_ns : std::min(chunk.first_ns, time_ns);
  chunk.last_ns = first_of_chunk ? time_ns : std::max(chunk.last_ns, time_ns);
  counts_.first_ns = first ? time_ns : std::min(counts_.first_ns, time_ns);
  counts_.last_ns = std::max(counts_.last_ns, time_ns);
  std::string& index = chunk.index[message.channel];
  if (index.empty()) begin_in_chunk(message.channel, chunk);
  put(time_ns, index);
  put<std::uint64_t>(chunk.records.size(), index);
  ++counts_.messages[message.channel];
  put_message(message, chunk.records);
  if (chunk.records.size() >= kChunkBytes) end_chunks();
}

// Of the chunk that was just written: one record a channel, and where each begins.
std::map<std::uint16_t, std::uint64_t> Writer::put_indexes(const Chunk& chunk) {
  std::map<std::uint16_t, std::uint64_t> places;
  std::string bytes;
  for (const auto& [channel, entries] : chunk.index) {
    places[channel] = at_ + bytes.size();
    std::string content;
    put(channel, content);
    put_text(entries, content);
    put_record(Op::kMessageIndex, content, bytes);
  }
  put_out(bytes);
  return places;
}

void Writer::end_chunks() {
  for (Chunk& chunk : chunks_) end_chunk(chunk);
}

std::uint64_t Writer::flush() {
  end_chunks();
  return at_;
}

void Writer::end_chunk(Chunk& chunk) {
  if (chunk.records.empty()) return;
  const std::string_view body = compressed(chunk.records);
  const std::uint64_t begin = at_;
  const std::string head = chunk_head(chunk.first_ns, chunk.last_ns, chunk.records, body.size());
  std::string record;
  put(static_cast<std::uint8_t>(Op::kChunk), record);
  put<std::uint64_t>(head.size() + body.size(), record);
  put_out(record.append(head), false);
  put_out(body);
  const std::uint64_t end = at_;
  std::string places;
  for (const auto& [channel, place] : put_indexes(chunk)) {
    put(channel, places);
    put(place, places);
  }
  std::string content;
  for (const std::uint64_t value : {chunk.first_ns, chunk.last_ns, begin, end - begin}) put(value, content);
  put_text(places, content);
  put(at_ - end, content);
  put_text("zstd", content);
  put<std::uint64_t>(body.size(), content);
  put<std::uint64_t>(chunk.records.size(), content);
  put_record(Op::kChunkIndex, content, chunk_indexes_);
  ++counts_.chunks;
  chunk.clear();
}

void Writer::attach(const std::string& name, const std::string& media_type, std::string_view data, std::uint64_t time_ns) {
  end_chunks();
  std::string record, content;
  put_attachment({time_ns, time_ns, name, media_type, data}, record);
  for (const std::uint64_t value : {at_, std::uint64_t{record.size()}, time_ns, time_ns, std::uint64_t{data.size()}}) put(value, content);
  put_text(name, content);
  put_text(media_type, content);
  put_record(Op::kAttachmentIndex, content, attachment_indexes_);
  put_out(record);
  ++counts_.attachments;
}

void Writer::add_metadata(const std::string& name, const Text& map) {
  end_chunks();
  std::string record, content;
  Text checked = map;
  checked[kMetadataCrc] = metadata_crc(name, map);
  put_text(name, content);
  put_map(checked, content);
  put_record(Op::kMetadata, content, record);
  std::string index;
  put(at_, index);
  put<std::uint64_t>(record.size(), index);
  put_text(name, index);
  put_record(Op::kMetadataIndex, index, metadata_indexes_);
  put_out(record);
  ++counts_.metadata;
}

std::string Writer::statistics() const {
  std::string counts, content, record;
  std::uint64_t messages = 0;
  for (const auto& [channel, count] : counts_.messages) {
    put(channel, counts);
    put(count, counts);
    messages += count;
  }
  put(messages, content);
  put(static_cast<std::uint16_t>(schemas_.size()), content);
  put(static_cast<std::uint32_t>(channels_.size()), content);
  for (const std::uint32_t count : {counts_.attachments, counts_.metadata, counts_.chunks}) put(count, content);
  put(counts_.first_ns, content);
  put(counts_.last_ns, content);
  put_text(counts, content);
  put_record(Op::kStatistics, content, record);
  return record;
}

// Records of one kind into the summary, and where they are.
void Writer::put_group(Op op, std::string_view records, std::string& summary, std::string& offsets) const {
  if (records.empty()) return;
  std::string content;
  put(static_cast<std::uint8_t>(op), content);
  put(at_ + summary.size(), content);
  put<std::uint64_t>(records.size(), content);
  put_record(Op::kSummaryOffset, content, offsets);
  summary.append(records);
}

void Writer::close() {
  end_chunks();
  std::string end;
  std::string crc;
  put(crc_, crc);
  put_record(Op::kDataEnd, crc, end);
  put_out(end);
  std::string schemas, channels, summary, offsets;
  for (const Schema& schema : schemas_) put_schema(schema, schemas);
  for (const Channel& channel : channels_) put_channel(channel, channels);
  put_group(Op::kSchema, schemas, summary, offsets);
  put_group(Op::kChannel, channels, summary, offsets);
  put_group(Op::kStatistics, statistics(), summary, offsets);
  put_group(Op::kChunkIndex, chunk_indexes_, summary, offsets);
  put_group(Op::kAttachmentIndex, attachment_indexes_, summary, offsets);
  put_group(Op::kMetadataIndex, metadata_indexes_, summary, offsets);
  const std::uint64_t begin = at_;
  std::string tail = summary + offsets;
  put(static_cast<std::uint8_t>(Op::kFooter), tail);
  put(std::uint64_t{20}, tail);
  put(begin, tail);
  put(begin + summary.size(), tail);
  put(crc32_of(tail), tail);
  put_out(tail.append(kMagic));
  out_.close();
}

}  // namespace lasso::mdat::mcap
