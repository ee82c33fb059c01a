#include "fsw/mission/scrub.hpp"

#include "fsw/core/crc.hpp"
#include "fsw/mission/image_slot.hpp"

namespace lasso {

bool Scrub::step(const ScrubPlace (&places)[kScrubAreas], std::size_t bytes) {
  std::size_t left = bytes, areas = 0;
  while (left > 0 && areas <= kScrubAreas && !found_) {
    const ScrubPlace& place = Span<const ScrubPlace>(places)[area_];
    if (std::size_t{chunk_} * kChunkBytes >= place.bytes.size()) {
      next_area();
      ++areas;
      continue;
    }
    left -= walk(place, left);
  }
  return found_;
}

// To the end of the chunk at most; how many bytes.
std::size_t Scrub::walk(const ScrubPlace& place, std::size_t bytes) {
  const ConstBytes chunk = chunk_of(place.bytes, chunk_);
  const std::size_t size = chunk.size() - summed_ < bytes ? chunk.size() - summed_ : bytes;
  sum_ = crc32c(chunk.subspan(summed_, size), sum_);
  summed_ += size;
  if (summed_ < chunk.size()) return size;
  found_ = sum_ != place.sums[chunk_];
  if (found_) {
    ++findings_;
  } else {
    resume();
  }
  return size;
}

void Scrub::resume() {
  found_ = false;
  ++chunk_;
  summed_ = 0;
  sum_ = 0;
}

void Scrub::forget(ScrubArea area) {
  if (area_ != static_cast<std::size_t>(area)) return;
  found_ = false;
  chunk_ = 0;
  summed_ = 0;
  sum_ = 0;
}

void Scrub::next_area() {
  chunk_ = 0;
  if (++area_ < kScrubAreas) return;
  area_ = 0;
  ++passes_;
}

}  // namespace lasso
