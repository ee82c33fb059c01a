// Numbers as binary mesh files hold them. Inside of missiondb.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace lasso::mdat {

enum class NumberType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

constexpr std::size_t size_of(NumberType type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

template <typename T>
double raw_number_as(const char* bytes, std::endian order) {
  char own[sizeof(T)];
  std::memcpy(own, bytes, sizeof(T));
  if (order != std::endian::native) std::reverse(own, own + sizeof(T));
  T value;
  std::memcpy(&value, own, sizeof(T));
  return static_cast<double>(value);
}

// Exact: a double holds each of them.
inline double raw_number(NumberType type, const char* bytes, std::endian order = std::endian::little) {
  switch (type) {
    case NumberType::kInt8:
      return raw_number_as<std::int8_t>(bytes, order);
    case NumberType::kUint8:
      return raw_number_as<std::uint8_t>(bytes, order);
    case NumberType::kInt16:
      return raw_number_as<std::int16_t>(bytes, order);
    case NumberType::kUint16:
      return raw_number_as<std::uint16_t>(bytes, order);
    case NumberType::kInt32:
      return raw_number_as<std::int32_t>(bytes, order);
    case NumberType::kUint32:
      return raw_number_as<std::uint32_t>(bytes, order);
    case NumberType::kFloat:
      return raw_number_as<float>(bytes, order);
    case NumberType::kDouble:
      return raw_number_as<double>(bytes, order);
  }
  return 0;
}

}  // namespace lasso::mdat
