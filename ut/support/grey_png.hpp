// A PNG of 16-bit greyscale, written by its specification (ISO/IEC 15948): stored blocks, no filter.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lasso::test {

inline std::string big_endian(std::uint32_t value) {
  return {static_cast<char>(value >> 24), static_cast<char>(value >> 16 & 255), static_cast<char>(value >> 8 & 255),
          static_cast<char>(value & 255)};
}

inline std::uint32_t crc32(const std::string& bytes) {
  std::uint32_t crc = 0xFFFFFFFF;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc % 2 != 0 ? 0xEDB88320 : 0);
  }
  return ~crc;
}

inline std::string png_chunk(const std::string& type, const std::string& data) {
  return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(crc32(type + data));
}

// zlib's format: each block holds at most 65,535 bytes as they are.
inline std::string stored(const std::string& bytes) {
  std::string result = "\x78\x01";
  for (std::size_t begin = 0; begin < bytes.size(); begin += 65535) {
    const std::string block = bytes.substr(begin, 65535);
    const auto size = static_cast<std::uint16_t>(block.size());
    result += begin + 65535 >= bytes.size() ? '\1' : '\0';
    for (const std::uint16_t word : {size, static_cast<std::uint16_t>(~size)}) {
      result += static_cast<char>(word & 255);
      result += static_cast<char>(word >> 8);
    }
    result += block;
  }
  std::uint32_t a = 1, b = 0;
  for (const char c : bytes) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  return result + big_endian(b << 16 | a);
}

inline std::string grey_png(std::uint32_t width, const std::vector<std::uint16_t>& values, char bit_depth = 16) {
  std::string rows;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i % width == 0) rows += '\0';
    rows += static_cast<char>(values[i] >> 8);
    rows += static_cast<char>(values[i] & 255);
  }
  const std::string header =
      big_endian(width) + big_endian(static_cast<std::uint32_t>(values.size()) / width) + bit_depth + std::string(4, '\0');
  return "\x89PNG\r\n\x1A\n" + png_chunk("IHDR", header) + png_chunk("IDAT", stored(rows)) + png_chunk("IEND", "");
}

}  // namespace lasso::test
