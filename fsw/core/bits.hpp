// The bits of a number as another type of the same size (std::bit_cast is C++20).
#pragma once

#include <cstdint>
#include <cstring>
#include <limits>

namespace lasso {

static_assert(std::numeric_limits<float>::is_iec559 && sizeof(float) == sizeof(std::uint32_t), "float is IEEE 754 binary32");
static_assert(std::numeric_limits<double>::is_iec559 && sizeof(double) == sizeof(std::uint64_t), "double is IEEE 754 binary64");

template <class To, class From>
inline To same_bits(From from) {
  static_assert(sizeof(To) == sizeof(From), "bits are neither added nor lost");
  To to;
  std::memcpy(&to, &from, sizeof(to));  // compiles to a move
  return to;
}

}  // namespace lasso
