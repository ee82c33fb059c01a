#include "mdat/serve/chunk_cache.hpp"

#include <algorithm>

namespace lasso::mdat::serve {

std::shared_ptr<const std::string> ChunkCache::records(std::size_t index) {
  {
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(last_.begin(), last_.end(), [&](const auto& entry) { return entry.first == index; });
    if (found != last_.end()) {
      last_.splice(last_.begin(), last_, found);
      return found->second;
    }
  }
  std::string why;
  auto read = std::make_shared<const std::string>(file_.records_of(file_.chunks().at(index), why));
  const std::lock_guard lock(mutex_);
  last_.emplace_front(index, read);
  bytes_ += read->size();
  while (bytes_ > kCachedBytes && last_.size() > 1) {
    bytes_ -= last_.back().second->size();
    last_.pop_back();
  }
  return read;
}

// In this chunk; at any time, where none is given.
std::string ChunkCache::find(std::size_t chunk, std::uint16_t channel, const std::uint64_t* time_ns) {
  std::string found;
  const std::shared_ptr<const std::string> bytes = records(chunk);
  mcap::for_each_message(*bytes, [&](const mcap::Message& message) {
    if (!found.empty() || message.channel != channel || (time_ns != nullptr && message.log_ns != *time_ns)) return;
    found = message.data;
  });
  return found;
}

std::string ChunkCache::message(std::uint16_t channel, std::uint64_t time_ns) {
  const auto& chunks = file_.chunks();
  std::string found;
  for (std::size_t i = 0; i < chunks.size() && found.empty(); ++i) {
    const mcap::ChunkPlace& chunk = chunks[i];
    if (time_ns >= chunk.first_ns && time_ns <= chunk.last_ns && chunk.may_have(channel)) found = find(i, channel, &time_ns);
  }
  return found;
}

std::string ChunkCache::first_message(std::uint16_t channel) {
  std::string found;
  for (std::size_t i = 0; i < file_.chunks().size() && found.empty(); ++i) {
    if (file_.chunks()[i].may_have(channel)) found = find(i, channel, nullptr);
  }
  return found;
}

}  // namespace lasso::mdat::serve
