// Which blocks of an image that comes in parts, in any order, have come.
#pragma once

#include <cstddef>
#include <cstdint>

#include "cfg/capacities.hpp"

namespace lasso {

constexpr std::uint32_t kLoadBlockBytes = 128;
constexpr std::uint32_t kMaxLoadBlocks = static_cast<std::uint32_t>(kMaxImageBytes / kLoadBlockBytes);

struct BlockRun {
  std::uint32_t first = 0;
  std::uint32_t count = 0;  // 0: there is none
};

class LoadMap {
 public:
  // `blocks` (at most kMaxLoadBlocks) are to come, none has. Loop bound: kMaxLoadBlocks / 32.
  void begin(std::uint32_t blocks);
  void mark(std::uint32_t block);
  std::uint32_t blocks() const { return blocks_; }
  std::uint32_t loaded() const { return loaded_; }
  bool complete() const { return loaded_ == blocks_; }
  // The first blocks at or after `from` that have not come. Loop bound: kMaxLoadBlocks / 32, and two words.
  BlockRun missing(std::uint32_t from) const;

 private:
  bool has(std::uint32_t block) const { return (words_[block / 32] >> (block % 32) & 1U) != 0; }
  std::uint32_t next(std::uint32_t from, bool loaded) const;

  std::uint32_t blocks_ = 0;
  std::uint32_t loaded_ = 0;
  std::uint32_t words_[kMaxLoadBlocks / 32] = {};  // a bit a block
};

}  // namespace lasso
