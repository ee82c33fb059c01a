// A non-owning view of contiguous elements (std::span is C++20). Access is checked as an invariant.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "fsw/core/invariant.hpp"

namespace lasso {

template <class T>
class Span {
 public:
  constexpr Span() = default;
  constexpr Span(T* data, std::size_t size) : data_(data), size_(size) {}
  template <std::size_t N>
  constexpr Span(T (&array)[N]) : data_(array), size_(N) {}
  // Span<T> to Span<const T>.
  template <class U, class = std::enable_if_t<std::is_same_v<const U, T>>>
  constexpr Span(const Span<U>& other) : data_(other.data()), size_(other.size()) {}

  constexpr T* data() const { return data_; }
  constexpr std::size_t size() const { return size_; }
  constexpr bool empty() const { return size_ == 0; }
  constexpr T* begin() const { return data_; }
  constexpr T* end() const { return data_ + size_; }

  T& operator[](std::size_t i) const {
    invariant(i < size_, "Span index");
    return data_[i];
  }
  Span first(std::size_t n) const {
    invariant(n <= size_, "Span first");
    return Span(data_, n);
  }
  Span subspan(std::size_t offset, std::size_t n) const {
    invariant(offset <= size_ && n <= size_ - offset, "Span subspan");
    return Span(data_ + offset, n);
  }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

using ConstBytes = Span<const std::uint8_t>;
using Bytes = Span<std::uint8_t>;

}  // namespace lasso
