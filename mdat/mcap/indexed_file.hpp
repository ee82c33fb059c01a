// An MCAP file by its index: what it holds is known without reading its messages, and each chunk is read when it is asked for.
//
// Where the summary is missing or damaged, as in a file that was cut, the heads of the records are walked instead: no chunk is unpacked for
// that but those that define channels.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mdat/mcap/format.hpp"
#include "mdat/mcap/reader.hpp"

namespace lasso::mdat::mcap {

// Where a chunk's record begins, and what is in it. A run of messages outside of any chunk counts as one, too.
struct ChunkPlace {
  std::uint64_t at = 0, size = 0;  // with the record's head
  std::uint64_t first_ns = 0, last_ns = 0;
  bool loose = false;                   // no chunk: the records themselves
  bool indexed = false;                 // `channels` is all that it has messages of
  std::vector<std::uint16_t> channels;  // ascending
  bool may_have(std::uint16_t channel) const;
};

struct AttachmentPlace {
  std::string name;
  std::uint64_t at = 0, size = 0;  // of the record, with its head
  std::uint64_t data_size = 0;
};

// Safe to be read by several threads at a time once it is made.
class IndexedFile {
 public:
  // Throws InputError as Reader's constructor.
  explicit IndexedFile(const std::filesystem::path& file);
  // Of a file that is still being written: its first `whole` bytes, which end with a record. Throws as above.
  IndexedFile(const std::filesystem::path& file, std::uint64_t whole);
  // The same file later, with more bytes: only what is new is read. Never less than before.
  void grow(std::uint64_t whole);

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const { return size_; }
  const std::string& profile() const { return profile_; }
  const std::string& library() const { return library_; }
  const std::map<std::uint16_t, Schema>& schemas() const { return schemas_; }
  const std::map<std::uint16_t, Channel>& channels() const { return channels_; }
  const std::vector<ChunkPlace>& chunks() const { return chunks_; }  // in the order of the file
  const std::vector<AttachmentPlace>& attachments() const { return attachments_; }
  const std::map<std::string, Text>& metadata() const { return metadata_; }
  const std::map<std::uint16_t, std::uint64_t>& counts() const { return counts_; }  // of messages, by channel; empty: nobody counted
  const std::vector<Damage>& damage() const { return damage_; }                     // that the index shows
  std::optional<std::uint16_t> channel_of(std::string_view topic) const;            // the first such

  // The records of a chunk. Empty, with a reason, where they cannot be read.
  std::string records_of(const ChunkPlace& chunk, std::string& why) const;
  // The content of an attachment; none: there is no such, or it is damaged.
  std::optional<std::string> attachment(std::string_view name) const;

 private:
  bool read_summary();
  bool take_summary(std::string_view summary);
  bool take_definition(Op op, std::string_view content);
  bool take_index(Op op, std::string_view content);
  void take_statistics(std::string_view content);
  void read_header(const std::filesystem::path& file);
  void walk();
  bool walk_on();
  void take_walked(Op op, std::uint64_t at, std::uint64_t size);
  void take_loose(std::uint64_t at, std::uint64_t size);
  void take_message_index(std::uint64_t at, std::uint64_t size);
  void learn_channels(const ChunkPlace& chunk);
  void take_metadata(std::uint64_t at, std::uint64_t size);
  std::string bytes(std::uint64_t at, std::uint64_t size) const;

  std::filesystem::path path_;
  std::uint64_t size_ = 0, begin_ = 0;  // of the file; behind the header
  std::uint64_t walked_ = 0;            // bytes whose records are known, of a file that is walked
  std::string profile_, library_;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  std::vector<ChunkPlace> chunks_;
  std::vector<AttachmentPlace> attachments_;
  std::map<std::string, Text> metadata_;
  std::map<std::uint16_t, std::uint64_t> counts_;
  std::vector<Damage> damage_;
};

// The messages among the records of a chunk, in their order. False: a record ends beyond them.
bool for_each_message(std::string_view records, const std::function<void(const Message&)>& take);

}  // namespace lasso::mdat::mcap
