#include "fsw/link/packet_finder.hpp"

#include <cstring>

#include "fsw/core/crc.hpp"

namespace lasso {
namespace {

constexpr std::size_t kIdentificationBytes = 2, kFlagsEnd = 3;
constexpr std::size_t kLeastBytes = kPrimaryHeaderBytes + kPacketTrailerBytes;

std::uint8_t identification(PacketType type, std::uint16_t apid, std::size_t byte) {
  const std::uint32_t word = static_cast<std::uint32_t>(type) << 12 | 1U << 11 | apid;
  return static_cast<std::uint8_t>(byte == 0 ? word >> 8 : word);
}

}  // namespace

std::size_t PacketFinder::take(ConstBytes input) {
  drop(found_);
  found_ = 0;
  std::size_t taken = 0;
  while (!search() && taken < input.size()) {
    buffer_[size_] = input[taken];
    ++size_;
    ++taken;
  }
  return taken;
}

bool PacketFinder::give_up() {
  drop(found_);
  found_ = 0;
  if (size_ == 0) return false;
  drop(1);
  ++skipped_;
  return true;
}

// Leaves at the buffer's start what is a packet, or may still become one; true when it is one. Loop bound: the buffer.
bool PacketFinder::search() {
  std::size_t at = 0;
  Candidate here = Candidate::kNone;
  while (here == Candidate::kNone && at < size_) {
    here = candidate(at);
    if (here == Candidate::kNone) ++at;
  }
  drop(at);
  skipped_ += static_cast<std::uint32_t>(at);
  if (here == Candidate::kPacket) found_ = packet_size({buffer_.data(), size_});
  return here == Candidate::kPacket;
}

PacketFinder::Candidate PacketFinder::candidate(std::size_t at) const {
  const ConstBytes bytes(buffer_.data() + at, size_ - at);
  if (!may_begin(bytes)) return Candidate::kNone;
  const std::size_t stated = packet_size(bytes);
  if (stated == 0 || stated > bytes.size()) return Candidate::kOpen;
  return crc16_ccitt(bytes.first(stated)) == 0 ? Candidate::kPacket : Candidate::kNone;
}

// As far as the bytes go that are there.
bool PacketFinder::may_begin(ConstBytes bytes) const {
  for (std::size_t i = 0; i < bytes.size() && i < kIdentificationBytes; ++i) {
    if (bytes[i] != identification(type_, apid_, i)) return false;
  }
  if (bytes.size() >= kFlagsEnd && bytes[kIdentificationBytes] >> 6 != kUnsegmented) return false;
  if (bytes.size() < kPrimaryHeaderBytes) return true;
  const std::size_t stated = packet_size(bytes);
  return stated >= kLeastBytes && stated <= buffer_.size();
}

void PacketFinder::drop(std::size_t bytes) {
  size_ -= bytes;
  if (bytes > 0) std::memmove(buffer_.data(), buffer_.data() + bytes, size_);
}

}  // namespace lasso
