// Unpacked chunks of one file, the last ones that were asked for.
#pragma once

#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "mdat/mcap/indexed_file.hpp"

namespace lasso::mdat::serve {

constexpr std::size_t kCachedBytes = std::size_t{48} << 20;

// Safe for several threads.
class ChunkCache {
 public:
  // `file` outlives it.
  explicit ChunkCache(const mcap::IndexedFile& file) : file_(file) {}

  // Of chunk number `index`; empty where it cannot be read.
  std::shared_ptr<const std::string> records(std::size_t index);
  // The first message of the channel at this time; empty, where there is none. The bytes are a copy.
  std::string message(std::uint16_t channel, std::uint64_t time_ns);
  // The first one of the file.
  std::string first_message(std::uint16_t channel);

 private:
  std::string find(std::size_t chunk, std::uint16_t channel, const std::uint64_t* time_ns);
  const mcap::IndexedFile& file_;
  std::mutex mutex_;
  std::list<std::pair<std::size_t, std::shared_ptr<const std::string>>> last_;  // the newest first
  std::size_t bytes_ = 0;
};

}  // namespace lasso::mdat::serve
