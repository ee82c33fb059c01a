// What the fuzz harnesses have in common.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "fsw/core/span.hpp"

namespace lasso::fuzz {

// A copy on the heap of exactly these bytes, aligned to 8: the sanitizer sees the first read or write beyond them.
class ExactCopy {
 public:
  explicit ExactCopy(ConstBytes bytes) : memory_(std::make_unique<std::uint8_t[]>(bytes.size())), size_(bytes.size()) {
    if (size_ > 0) std::memcpy(memory_.get(), bytes.data(), size_);
  }
  Bytes bytes() { return {memory_.get(), size_}; }
  bool equals(ConstBytes other) const {
    return size_ == other.size() && (size_ == 0 || std::memcmp(memory_.get(), other.data(), size_) == 0);
  }

 private:
  std::unique_ptr<std::uint8_t[]> memory_;
  std::size_t size_;
};

// A finding that no sanitizer sees.
inline void expect(bool holds, const char* what) {
  if (holds) return;
  (void)std::fprintf(stderr, "fuzz: expected: %s\n", what);
  std::abort();
}

inline void put_u32(std::uint8_t* place, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) place[i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
}
inline std::uint32_t get_u32(const std::uint8_t* place) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8 | place[i];
  return value;
}

}  // namespace lasso::fuzz
