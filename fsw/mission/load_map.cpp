#include "fsw/mission/load_map.hpp"

#include "fsw/core/invariant.hpp"

namespace lasso {

void LoadMap::begin(std::uint32_t blocks) {
  invariant(blocks <= kMaxLoadBlocks, "more blocks than an image has");
  *this = LoadMap{};
  blocks_ = blocks;
}

void LoadMap::mark(std::uint32_t block) {
  invariant(block < blocks_, "a block behind the image");
  if (has(block)) return;
  words_[block / 32] |= 1U << block % 32;
  ++loaded_;
}

// The first block at or after `from` that has come, or has not; blocks_ where there is none. Words that hold none are passed at once.
std::uint32_t LoadMap::next(std::uint32_t from, bool loaded) const {
  const std::uint32_t none = loaded ? 0 : ~0U;
  std::uint32_t block = from;
  while (block < blocks_ && has(block) != loaded) block = words_[block / 32] == none ? (block / 32 + 1) * 32 : block + 1;
  return block < blocks_ ? block : blocks_;
}

BlockRun LoadMap::missing(std::uint32_t from) const {
  const std::uint32_t first = next(from, false);
  return {first, next(first, true) - first};
}

}  // namespace lasso
