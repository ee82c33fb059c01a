// Bytes between an interrupt (or a pump) and the driver: one side writes, the other reads, neither waits. What does not fit is refused and
// counted by the writer.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"

namespace lasso::lcs {

template <std::size_t kSize>
class ByteRing {
  static_assert(kSize != 0 && (kSize & (kSize - 1)) == 0, "a power of 2");

 public:
  // The writer's: how many of the bytes were taken, the first ones.
  std::size_t write(ConstBytes bytes) {
    const std::uint32_t head = head_.load(std::memory_order_relaxed);
    const std::size_t room = kSize - (head - tail_.load(std::memory_order_acquire));
    const std::size_t count = bytes.size() < room ? bytes.size() : room;
    for (std::size_t i = 0; i < count; ++i) bytes_[(head + i) % kSize] = bytes.data()[i];
    head_.store(head + static_cast<std::uint32_t>(count), std::memory_order_release);
    return count;
  }

  // The reader's: fills `out` from the front, as far as there is something.
  std::size_t read(Bytes out) {
    const std::uint32_t tail = tail_.load(std::memory_order_relaxed);
    const std::size_t there = head_.load(std::memory_order_acquire) - tail;
    const std::size_t count = out.size() < there ? out.size() : there;
    for (std::size_t i = 0; i < count; ++i) out.data()[i] = bytes_[(tail + i) % kSize];
    tail_.store(tail + static_cast<std::uint32_t>(count), std::memory_order_release);
    return count;
  }

  std::size_t room() const { return kSize - (head_.load(std::memory_order_relaxed) - tail_.load(std::memory_order_acquire)); }

 private:
  std::uint8_t bytes_[kSize] = {};
  std::atomic<std::uint32_t> head_{0};  // bytes ever written, modulo 2^32
  std::atomic<std::uint32_t> tail_{0};  // bytes ever read
};

}  // namespace lasso::lcs
