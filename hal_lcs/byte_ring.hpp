// Bytes between an interrupt (or a pump) and the driver: one side writes, the other reads, neither waits. What does not fit is refused and
// counted by the writer.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>

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
    const std::size_t at = head % kSize, straight = until_wrap(at, count);
    copy(bytes_ + at, bytes.data(), straight);
    copy(bytes_, bytes.data() + straight, count - straight);
    head_.store(head + static_cast<std::uint32_t>(count), std::memory_order_release);
    return count;
  }

  // The reader's: fills `out` from the front, as far as there is something.
  std::size_t read(Bytes out) {
    const std::uint32_t tail = tail_.load(std::memory_order_relaxed);
    const std::size_t there = head_.load(std::memory_order_acquire) - tail;
    const std::size_t count = out.size() < there ? out.size() : there;
    const std::size_t at = tail % kSize, straight = until_wrap(at, count);
    copy(out.data(), bytes_ + at, straight);
    copy(out.data() + straight, bytes_, count - straight);
    tail_.store(tail + static_cast<std::uint32_t>(count), std::memory_order_release);
    return count;
  }

  std::size_t room() const { return kSize - (head_.load(std::memory_order_relaxed) - tail_.load(std::memory_order_acquire)); }

 private:
  static std::size_t until_wrap(std::size_t at, std::size_t count) { return count < kSize - at ? count : kSize - at; }
  static void copy(std::uint8_t* to, const std::uint8_t* from, std::size_t count) {
    if (count > 0) std::memcpy(to, from, count);  // of nothing, pointers may be null
  }

  std::uint8_t bytes_[kSize] = {};
  std::atomic<std::uint32_t> head_{0};  // bytes ever written, modulo 2^32
  std::atomic<std::uint32_t> tail_{0};  // bytes ever read
};

}  // namespace lasso::lcs
