#include "fsw/core/crc.hpp"

namespace lasso {
namespace {

constexpr unsigned kTableSize = 256;
constexpr std::uint16_t kPolynomial16 = 0x1021;
constexpr std::uint32_t kPolynomial32cReflected = 0x82F63B78;

// entry[k][b]: of the byte b and k zeros behind it. Four bytes at a time take half of the time that they take one by one.
constexpr std::size_t kSlices = 4;
template <class Crc>
struct Tables {
  Crc entry[kSlices][kTableSize];
};

constexpr Tables<std::uint16_t> make_tables16() {
  Tables<std::uint16_t> tables{};
  for (unsigned byte = 0; byte < kTableSize; ++byte) {
    std::uint32_t crc = byte << 8;
    for (std::size_t k = 0; k < kSlices; ++k) {
      for (int bit = 0; bit < 8; ++bit) crc = (crc & 0x8000U) != 0 ? (crc << 1) ^ kPolynomial16 : crc << 1;
      tables.entry[k][byte] = static_cast<std::uint16_t>(crc & 0xFFFFU);
    }
  }
  return tables;
}

constexpr Tables<std::uint32_t> make_tables32c() {
  Tables<std::uint32_t> tables{};
  for (unsigned byte = 0; byte < kTableSize; ++byte) {
    std::uint32_t crc = byte;
    for (std::size_t k = 0; k < kSlices; ++k) {
      for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? (crc >> 1) ^ kPolynomial32cReflected : crc >> 1;
      tables.entry[k][byte] = crc;
    }
  }
  return tables;
}

constexpr Tables<std::uint16_t> kTables16 = make_tables16();
constexpr Tables<std::uint32_t> kTables32c = make_tables32c();

// Four bytes; one instruction on either order of bytes.
std::uint32_t load_highest_first(const std::uint8_t* from) {
  return std::uint32_t{from[0]} << 24 | std::uint32_t{from[1]} << 16 | std::uint32_t{from[2]} << 8 | from[3];
}
std::uint32_t load_lowest_first(const std::uint8_t* from) {
  return std::uint32_t{from[3]} << 24 | std::uint32_t{from[2]} << 16 | std::uint32_t{from[1]} << 8 | from[0];
}

}  // namespace

std::uint16_t crc16_ccitt(ConstBytes data, std::uint16_t seed) {
  const auto& table = kTables16.entry;
  std::uint32_t crc = seed;
  const std::uint8_t* at = data.begin();
  for (std::size_t words = data.size() / kSlices; words > 0; --words, at += kSlices) {
    const std::uint32_t four = load_highest_first(at) ^ crc << 16;
    crc = table[3][four >> 24] ^ table[2][four >> 16 & 0xFFU] ^ table[1][four >> 8 & 0xFFU] ^ std::uint32_t{table[0][four & 0xFFU]};
  }
  for (; at != data.end(); ++at) crc = ((crc << 8) & 0xFFFFU) ^ table[0][(crc >> 8) ^ *at];
  return static_cast<std::uint16_t>(crc);
}

std::uint32_t crc32c(ConstBytes data, std::uint32_t seed) {
  const auto& table = kTables32c.entry;
  std::uint32_t crc = ~seed;  // the complement at both ends makes results chain
  const std::uint8_t* at = data.begin();
  for (std::size_t words = data.size() / kSlices; words > 0; --words, at += kSlices) {
    crc ^= load_lowest_first(at);
    crc = table[3][crc & 0xFFU] ^ table[2][crc >> 8 & 0xFFU] ^ table[1][crc >> 16 & 0xFFU] ^ table[0][crc >> 24];
  }
  for (; at != data.end(); ++at) crc = (crc >> 8) ^ table[0][(crc ^ *at) & 0xFFU];
  return ~crc;
}

}  // namespace lasso
