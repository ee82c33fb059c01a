// Writes an MCAP file: messages in compressed chunks with indexes, attachments, metadata, and the summary by which readers seek.
//
// A chunk is in the file as soon as it is full: of a run that is killed all but the last chunk can be read (reader.hpp). Each says the
// channels of its messages, so that none needs another one. Memory is that of two chunks, and some 100 bytes for each one written.
//
// Large messages, as scans, have chunks of their own, which end together with those of the small ones: who asks for poses or events of a
// long run unpacks a few percent of it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "mdat/mcap/format.hpp"

struct ZSTD_CCtx_s;  // of <zstd.h>

namespace lasso::mdat::mcap {

constexpr std::size_t kChunkBytes = std::size_t{1} << 20;  // uncompressed, beyond which a chunk ends

enum class Bulk : std::uint8_t { kSmall = 0, kLarge = 1 };  // of a channel's messages

struct FreeCompressor {
  void operator()(ZSTD_CCtx_s* context) const;
};

// All throw InputError that names the file and the reason where it cannot be written, as on a full disk.
class Writer {
 public:
  // `profile`: what the messages follow, as "ros2". A file that is there is replaced.
  Writer(const std::filesystem::path& file, const std::string& profile, const std::string& library);

  std::uint16_t add_schema(const std::string& name, const std::string& encoding, const std::string& data);
  std::uint16_t add_channel(const std::string& topic, std::uint16_t schema, const std::string& encoding, const Text& metadata = {},
                            Bulk bulk = Bulk::kSmall);
  // Sequence numbers count from 0 in each channel.
  void write(std::uint16_t channel, std::uint64_t time_ns, std::string_view data);
  void write(const Message& message);
  void attach(const std::string& name, const std::string& media_type, std::string_view data, std::uint64_t time_ns);
  void add_metadata(const std::string& name, const Text& content);
  // Ends the chunks, so that who reads the file meanwhile finds all messages so far. Returns the bytes of the file, which end with a
  // record.
  std::uint64_t flush();
  // Ends the file. Nothing is written after it.
  void close();

 private:
  struct Chunk {
    std::uint64_t first_ns = 0, last_ns = 0;
    std::string records;
    std::map<std::uint16_t, std::string> index;  // of each channel: time and place of each message
    std::set<std::uint16_t> schemas;             // that stand in it

    // Its memory stays: that of a new one would be asked of the system, and cleared by it, each time.
    void clear() {
      records.clear();
      index.clear();
      schemas.clear();
    }
  };
  struct Counts {
    std::uint64_t first_ns = 0, last_ns = 0;
    std::uint32_t attachments = 0, metadata = 0, chunks = 0;
    std::map<std::uint16_t, std::uint64_t> messages;
  };
  std::string_view compressed(std::string_view bytes);  // until the next call
  void put_out(std::string_view bytes, bool flush = true);
  void begin_in_chunk(std::uint16_t channel, Chunk& chunk) const;
  void end_chunks();
  void end_chunk(Chunk& chunk);
  std::map<std::uint16_t, std::uint64_t> put_indexes(const Chunk& chunk);
  void put_group(Op op, std::string_view records, std::string& summary, std::string& offsets) const;
  std::string statistics() const;

  std::filesystem::path path_;
  std::ofstream out_;
  std::unique_ptr<ZSTD_CCtx_s, FreeCompressor> compressor_;
  std::string packed_;
  std::uint64_t at_ = 0;         // bytes written
  std::uint32_t crc_ = 0;        // of them
  std::array<Chunk, 2> chunks_;  // by Bulk
  Counts counts_;
  std::vector<Schema> schemas_;
  std::vector<Channel> channels_;
  std::vector<Bulk> bulks_;                                            // of the channels
  std::string chunk_indexes_, attachment_indexes_, metadata_indexes_;  // records of the summary
};

}  // namespace lasso::mdat::mcap
