// The walk over memory that must not change: some bytes at a time, each chunk's CRC-32C compared with the one that was taken when the
// memory was known to be right. A chunk that differs stops the walk until somebody has answered it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"

namespace lasso {

// The image and its views in each of the two buffers; the code.
enum class ScrubArea : std::uint8_t { kImage0 = 0, kViews0 = 1, kImage1 = 2, kViews1 = 3, kCode = 4 };
constexpr std::size_t kScrubAreas = 5;

struct ScrubPlace {
  ConstBytes bytes;                // empty: there is nothing
  Span<const std::uint32_t> sums;  // of each kChunkBytes of them
};

class Scrub {
 public:
  // Goes on for `bytes` bytes, over what lies there now. True: a chunk differs, see area() and chunk(); it has been counted, and the walk
  // stands until resume(). Loop bound: the bytes, and kScrubAreas.
  bool step(const ScrubPlace (&places)[kScrubAreas], std::size_t bytes);
  bool found() const { return found_; }
  ScrubArea area() const { return static_cast<ScrubArea>(area_); }
  std::uint32_t chunk() const { return chunk_; }
  // On behind the chunk.
  void resume();
  // What lies in the area is another thing now: a chunk of it that is being looked at counts no more.
  void forget(ScrubArea area);

  std::uint32_t passes() const { return passes_; }  // over everything, completed
  std::uint32_t findings() const { return findings_; }

 private:
  std::size_t walk(const ScrubPlace& place, std::size_t bytes);
  void next_area();

  std::size_t area_ = 0;
  std::uint32_t chunk_ = 0;
  std::size_t summed_ = 0;  // bytes of the chunk
  std::uint32_t sum_ = 0;
  bool found_ = false;
  std::uint32_t passes_ = 0;
  std::uint32_t findings_ = 0;
};

}  // namespace lasso
