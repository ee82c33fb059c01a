#include "fsw/link/telemetry_queue.hpp"

#include "fsw/link/packet.hpp"

namespace lasso {

// At most `most` bytes wait afterwards.
Status TelemetryQueue::push(ConstBytes packet, std::size_t most) {
  if (packet.empty() || packet_size(packet) != packet.size()) return Status::kBadLength;
  if (size_ + packet.size() > most) {
    ++dropped_;
    return Status::kOverCapacity;
  }
  for (const std::uint8_t byte : packet) {
    bytes_[(head_ + size_) % kCapacity] = byte;
    ++size_;
  }
  if (size_ > peak_) peak_ = size_;
  return Status::kOk;
}

std::size_t TelemetryQueue::take(Bytes out) {
  std::size_t taken = 0;
  while (size_ > 0 && front_packet_size() <= out.size() - taken) {
    const std::size_t end = taken + front_packet_size();
    while (taken < end) {
      out[taken] = pop();
      ++taken;
    }
  }
  return taken;
}

std::size_t TelemetryQueue::front_packet_size() const {
  std::uint8_t header[kPrimaryHeaderBytes];
  for (std::size_t i = 0; i < kPrimaryHeaderBytes; ++i) header[i] = bytes_[(head_ + i) % kCapacity];
  return packet_size(ConstBytes(header, kPrimaryHeaderBytes));
}

std::uint8_t TelemetryQueue::pop() {
  const std::uint8_t byte = bytes_[head_];
  head_ = (head_ + 1) % kCapacity;
  --size_;
  return byte;
}

}  // namespace lasso
