// A vector with its storage inside. It never allocates, refuses what does not fit, and remembers its high-water mark.
#pragma once

#include <cstddef>

#include "fsw/core/invariant.hpp"
#include "fsw/core/span.hpp"

namespace lasso {

template <class T, std::size_t kMax>
class FixedVector {
 public:
  // False, and nothing changes, when full.
  [[nodiscard]] bool push_back(const T& value) {
    if (size_ == kMax) return false;
    items_[size_++] = value;
    if (size_ > peak_) peak_ = size_;
    return true;
  }
  void clear() { size_ = 0; }
  // Keeps the first `size` elements.
  void shrink(std::size_t size) {
    invariant(size <= size_, "FixedVector shrink");
    size_ = size;
  }

  T& operator[](std::size_t i) {
    invariant(i < size_, "FixedVector index");
    return items_[i];
  }
  const T& operator[](std::size_t i) const {
    invariant(i < size_, "FixedVector index");
    return items_[i];
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  bool full() const { return size_ == kMax; }
  // The most elements ever held: telemetry of how close the capacity is.
  std::size_t peak() const { return peak_; }
  static constexpr std::size_t capacity() { return kMax; }

  T* begin() { return items_; }
  T* end() { return items_ + size_; }
  const T* begin() const { return items_; }
  const T* end() const { return items_ + size_; }
  Span<const T> span() const { return {items_, size_}; }

 private:
  T items_[kMax] = {};
  std::size_t size_ = 0;
  std::size_t peak_ = 0;
};

}  // namespace lasso
