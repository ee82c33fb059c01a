#include "mdat/link/stream_crc.hpp"

#include "fsw/core/crc.hpp"
#include "fsw/link/space_packet.hpp"

namespace lasso::mdat {
namespace {

constexpr std::uint16_t kSeed = 0xFFFF;
constexpr std::size_t kLargest = kPrimaryHeaderBytes + 0x10000;

std::uint16_t times_x(std::uint16_t value) {
  constexpr std::uint32_t kPolynomial = 0x1021;
  return static_cast<std::uint16_t>((std::uint32_t{value} << 1U) ^ ((value & 0x8000U) != 0 ? kPolynomial : 0U));
}

std::uint16_t product(std::uint16_t a, std::uint16_t b) {
  std::uint16_t sum = 0;
  for (int bit = 15; bit >= 0; --bit) {
    sum = times_x(sum);
    if ((b >> bit & 1) != 0) sum ^= a;
  }
  return sum;
}

// x^(8n) for the sizes of all packets.
const std::vector<std::uint16_t>& powers() {
  static const std::vector<std::uint16_t> table = [] {
    std::vector<std::uint16_t> values(kLargest + 1, 1);
    for (std::size_t n = 1; n < values.size(); ++n) {
      values[n] = values[n - 1];
      for (int bit = 0; bit < 8; ++bit) values[n] = times_x(values[n]);
    }
    return values;
  }();
  return table;
}

}  // namespace

StreamCrc::StreamCrc(ConstBytes stream) : registers_(stream.size() + 1, 0) {
  for (std::size_t i = 0; i < stream.size(); ++i) registers_[i + 1] = crc16_ccitt(stream.subspan(i, 1), registers_[i]);
}

bool StreamCrc::right(std::size_t offset, std::size_t size) const {
  const auto begun = static_cast<std::uint16_t>(registers_[offset] ^ kSeed);
  return registers_[offset + size] == product(begun, powers()[size]);
}

}  // namespace lasso::mdat
