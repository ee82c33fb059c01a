#include "fsw/core/crc.hpp"

namespace lasso {
namespace {

constexpr unsigned kTableSize = 256;
constexpr std::uint16_t kPolynomial16 = 0x1021;
constexpr std::uint32_t kPolynomial32cReflected = 0x82F63B78;

struct Table16 {
  std::uint16_t entry[kTableSize];
};
struct Table32 {
  std::uint32_t entry[kTableSize];
};

constexpr Table16 make_table16() {
  Table16 table{};
  for (unsigned byte = 0; byte < kTableSize; ++byte) {
    std::uint32_t crc = byte << 8;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 0x8000U) != 0 ? (crc << 1) ^ kPolynomial16 : crc << 1;
    table.entry[byte] = static_cast<std::uint16_t>(crc & 0xFFFFU);
  }
  return table;
}

constexpr Table32 make_table32c() {
  Table32 table{};
  for (unsigned byte = 0; byte < kTableSize; ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? (crc >> 1) ^ kPolynomial32cReflected : crc >> 1;
    table.entry[byte] = crc;
  }
  return table;
}

constexpr Table16 kTable16 = make_table16();
constexpr Table32 kTable32c = make_table32c();

}  // namespace

std::uint16_t crc16_ccitt(ConstBytes data, std::uint16_t seed) {
  std::uint32_t crc = seed;
  for (const std::uint8_t byte : data) crc = ((crc << 8) & 0xFFFFU) ^ kTable16.entry[(crc >> 8) ^ byte];
  return static_cast<std::uint16_t>(crc);
}

std::uint32_t crc32c(ConstBytes data, std::uint32_t seed) {
  std::uint32_t crc = ~seed;  // the complement at both ends makes results chain
  for (const std::uint8_t byte : data) crc = (crc >> 8) ^ kTable32c.entry[(crc ^ byte) & 0xFFU];
  return ~crc;
}

}  // namespace lasso
