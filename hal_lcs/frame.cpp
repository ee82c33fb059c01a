#include "hal_lcs/frame.hpp"

#include <cstring>

#include "fsw/core/byte_codec.hpp"
#include "fsw/core/crc.hpp"
#include "fsw/core/invariant.hpp"

namespace lasso::lcs {
namespace {

constexpr std::uint8_t kSync0 = 0x5A;
constexpr std::uint8_t kSync1 = 0xC3;
constexpr std::size_t kSyncBytes = 2;
constexpr std::size_t kHeaderBytes = 5;  // with the sync
constexpr std::size_t kCrcBytes = 2;

}  // namespace

FrameBytes encode_frame(std::uint8_t type, std::uint8_t sequence, ConstBytes payload) {
  invariant(payload.size() <= kMaxPayload, "lcs payload");
  FrameBytes frame;
  ByteWriter out{Bytes(frame.bytes)};
  out.u8(kSync0);
  out.u8(kSync1);
  out.u8(static_cast<std::uint8_t>(payload.size()));
  out.u8(type);
  out.u8(sequence);
  out.bytes(payload);
  out.u16(crc16_ccitt(ConstBytes(frame.bytes + kSyncBytes, out.size() - kSyncBytes)));
  frame.size = out.size();
  return frame;
}

// What the bytes from held_[0] are.
FrameDecoder::Verdict FrameDecoder::judge() {
  if (size_ == 0) return Verdict::kWait;
  if (held_[0] != kSync0) return Verdict::kSkip;
  if (size_ == 1) return Verdict::kWait;
  if (held_[1] != kSync1) return Verdict::kSkip;
  if (size_ == kSyncBytes) return Verdict::kWait;
  const std::size_t length = held_[kSyncBytes];
  if (length > kMaxPayload) {
    ++counters_.bad_length;
    return Verdict::kSkip;
  }
  const std::size_t covered = length + kHeaderBytes - kSyncBytes;
  if (size_ < kSyncBytes + covered + kCrcBytes) return Verdict::kWait;
  ByteReader crc{ConstBytes(held_ + kSyncBytes + covered, kCrcBytes)};
  if (crc.u16() == crc16_ccitt(ConstBytes(held_ + kSyncBytes, covered))) return Verdict::kFrame;
  ++counters_.bad_crc;
  return Verdict::kSkip;
}

// How many bytes from held_[0] on can be a frame, as far as those that are there tell; more than are held while judge() waits.
std::size_t FrameDecoder::awaited() const {
  return size_ < kFrameOverhead ? kFrameOverhead : std::size_t{held_[kSyncBytes]} + kFrameOverhead;
}

void FrameDecoder::drop(std::size_t count) {
  size_ -= count;
  for (std::size_t i = 0; i < size_; ++i) held_[i] = held_[i + count];
}

// Whether the bytes held begin with a frame, once all that is none has been skipped.
bool FrameDecoder::take_frame(Frame& frame) {
  Verdict verdict = judge();
  while (verdict == Verdict::kSkip) {  // at most size_ times
    drop(1);
    ++counters_.skipped;
    verdict = judge();
  }
  if (verdict == Verdict::kWait) return false;
  ByteReader in{ConstBytes(held_ + kSyncBytes, kHeaderBytes - kSyncBytes)};
  frame.length = in.u8();
  frame.type = in.u8();
  frame.sequence = in.u8();
  std::memcpy(frame.payload, held_ + kHeaderBytes, frame.length);
  drop(frame.length + kFrameOverhead);
  ++counters_.frames;
  return true;
}

FrameDecoder::Step FrameDecoder::step(ConstBytes bytes, Frame& frame) {
  Step step;
  step.found = take_frame(frame);
  while (!step.found && step.taken < bytes.size()) {
    const std::size_t left = bytes.size() - step.taken, missing = awaited() - size_;
    const std::size_t count = missing < left ? missing : left;
    std::memcpy(held_ + size_, bytes.data() + step.taken, count);
    size_ += count;
    step.taken += count;
    step.found = take_frame(frame);
  }
  return step;
}

void FrameDecoder::clear() { size_ = 0; }

}  // namespace lasso::lcs
