#include "fsw/exec/self_test.hpp"

#include "fsw/core/bits.hpp"
#include "fsw/core/byte_codec.hpp"
#include "fsw/core/crc.hpp"
#include "fsw/geometry/portable_math.hpp"

namespace lasso {
namespace {

constexpr std::uint8_t kCheckText[] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};  // of the catalogue of CRCs

// Through memory, so that the processor computes, not the compiler.
double there(double value) {
  const volatile double held = value;
  return held;
}

std::uint64_t bits_of(double value) { return same_bits<std::uint64_t>(value); }

std::uint64_t coded_and_back() {
  std::uint8_t bytes[8] = {};
  ByteWriter(Bytes(bytes)).f64(there(-118.625));
  return static_cast<std::uint64_t>(bytes[0]) << 56 | bits_of(ByteReader(ConstBytes(bytes)).f64()) >> 8;
}

}  // namespace

std::uint32_t failed_among(Span<const KnownAnswer> answers) {
  std::uint32_t failed = 0;
  for (const KnownAnswer& answer : answers) {
    if (answer.computed != answer.known) failed |= 1u << static_cast<unsigned>(answer.test);
  }
  return failed;
}

std::uint32_t failed_self_tests() {
  const SinCos turn = sin_cos(there(0.40625));
  const ConstBytes text(kCheckText);
  const KnownAnswer answers[] = {
      {SelfTest::kRounding, bits_of(there(1.0) + there(0x1p-53)), bits_of(1.0)},
      {SelfTest::kRounding, bits_of(there(1.0) + there(0x3p-53)), bits_of(1.0 + 0x1p-51)},
      {SelfTest::kSubnormals, bits_of(there(0x1p-1022) / there(8.0)), std::uint64_t{1} << 49},
      {SelfTest::kElementary, bits_of(square_root(there(2.0))), 0x3FF6A09E667F3BCD},
      {SelfTest::kElementary, bits_of(turn.sin), 0x3FD94A6BE9F546C5},
      {SelfTest::kElementary, bits_of(turn.cos), 0x3FED653F073E4040},
      {SelfTest::kElementary, bits_of(arc_tangent2(there(0.40625), there(-2.0))), 0x40078790C5AD64B6},
      {SelfTest::kCrc16, crc16_ccitt(text), 0x29B1},
      {SelfTest::kCrc32c, crc32c(text), 0xE3069283},
      {SelfTest::kCodec, coded_and_back(), 0xC0C05DA800000000},
  };
  return failed_among(Span<const KnownAnswer>(answers));
}

}  // namespace lasso
