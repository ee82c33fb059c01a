// Frames from a line's ring of kBytes, as far as a budget of bytes goes: a line that never falls silent keeps no caller for longer.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"
#include "hal_lcs/byte_ring.hpp"
#include "hal_lcs/frame.hpp"

namespace lasso::lcs {

template <std::size_t kBytes>
class FrameReader {
 public:
  // The ring outlives it.
  explicit FrameReader(ByteRing<kBytes>& ring) : ring_(ring) {}

  // From now on so many bytes may be read as the ring holds.
  void renew_budget() { budget_ = kBytes; }
  // The next frame that is whole. False: the bytes, or the budget, have ended. Loop bound: the budget.
  bool read(Frame& frame) {
    for (;;) {
      const FrameDecoder::Step step = decoder_.step(ConstBytes(chunk_ + at_, size_ - at_), frame);
      at_ += step.taken;
      if (step.found) return true;
      const std::size_t most = budget_ < kMaxFrame ? budget_ : kMaxFrame;
      at_ = 0;
      size_ = ring_.read(Bytes(chunk_, most));
      if (size_ == 0) return false;
      budget_ -= size_;
    }
  }
  const FrameDecoder::Counters& counters() const { return decoder_.counters(); }

 private:
  ByteRing<kBytes>& ring_;
  FrameDecoder decoder_;
  std::size_t budget_ = 0;
  std::uint8_t chunk_[kMaxFrame] = {};  // read from the ring, from at_ on not decoded
  std::size_t at_ = 0, size_ = 0;
};

}  // namespace lasso::lcs
