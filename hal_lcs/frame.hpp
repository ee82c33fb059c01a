// Frames on the line to a scanner (docs/icd/lcs.md): at most 64 bytes each, so that a damaged one takes little with it.
//
//   0  2  sync, 0x5A 0xC3
//   2  1  length of the payload, 0..57
//   3  1  type
//   4  1  sequence: counts the frames of its direction, modulo 256
//   5  n  payload
//   +  2  CRC-16/CCITT-FALSE of length, type, sequence and payload; big-endian, as everything
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"

namespace lasso::lcs {

constexpr std::size_t kMaxPayload = 57;
constexpr std::size_t kFrameOverhead = 7;
constexpr std::size_t kMaxFrame = kMaxPayload + kFrameOverhead;

struct Frame {
  std::uint8_t type = 0;
  std::uint8_t sequence = 0;
  std::uint8_t length = 0;  // of the payload
  std::uint8_t payload[kMaxPayload] = {};

  ConstBytes bytes() const { return {payload, length}; }
};

struct FrameBytes {
  std::uint8_t bytes[kMaxFrame] = {};
  std::size_t size = 0;

  ConstBytes span() const { return {bytes, size}; }
};

// A payload longer than kMaxPayload is an invariant's failure.
FrameBytes encode_frame(std::uint8_t type, std::uint8_t sequence, ConstBytes payload);

// Finds frames in whatever a line brings. It holds at most one frame's bytes. After a damaged frame it looks for the next sync within the
// bytes it has, so that what follows garbage is not lost with it.
class FrameDecoder {
 public:
  struct Counters {
    std::uint32_t frames = 0;      // whole and right
    std::uint32_t bad_crc = 0;     // a sync and a length, but not a frame
    std::uint32_t bad_length = 0;  // a sync with a length above kMaxPayload
    std::uint32_t skipped = 0;     // bytes that belong to no frame
  };

  // Takes bytes from the front of `bytes` until a frame is whole: how many, and whether there is a frame. Takes none while the bytes that
  // it holds still have a whole frame. Bound: for each byte taken at most kMaxFrame positions are tried.
  struct Step {
    std::size_t taken = 0;
    bool found = false;
  };
  Step step(ConstBytes bytes, Frame& frame);

  const Counters& counters() const { return counters_; }
  void clear();  // forgets the bytes it holds, not the counters

 private:
  enum class Verdict : std::uint8_t { kWait, kSkip, kFrame };
  Verdict judge();
  std::size_t awaited() const;
  void drop(std::size_t count);
  bool take_frame(Frame& frame);

  std::uint8_t held_[kMaxFrame] = {};
  std::size_t size_ = 0;
  Counters counters_;
};

}  // namespace lasso::lcs
