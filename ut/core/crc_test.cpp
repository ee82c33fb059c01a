#include "fsw/core/crc.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

const std::uint8_t kCheck[] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};

std::vector<std::uint8_t> random_bytes(test::Generator& generator, std::size_t n) {
  std::vector<std::uint8_t> bytes(n);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(generator.bits() & 0xFFU);
  return bytes;
}

ConstBytes view(const std::vector<std::uint8_t>& bytes) { return {bytes.data(), bytes.size()}; }

// Division of polynomials bit by bit: the definition, without tables.
std::uint32_t crc_by_bits(const std::vector<std::uint8_t>& bytes, int width, std::uint32_t polynomial, std::uint32_t start,
                          bool reflected) {
  const std::uint32_t top = 1U << (width - 1);
  const std::uint32_t mask = top | (top - 1);
  std::uint32_t crc = start;
  for (const std::uint8_t byte : bytes) {
    for (int i = 0; i < 8; ++i) {
      const bool bit = ((byte >> (reflected ? i : 7 - i)) & 1) != 0;
      const bool carry = ((crc & top) != 0) != bit;
      crc = ((crc << 1) & mask) ^ (carry ? polynomial : 0U);
    }
  }
  return crc;
}

std::uint32_t mirrored(std::uint32_t x) {
  std::uint32_t y = 0;
  for (int i = 0; i < 32; ++i) y |= ((x >> i) & 1U) << (31 - i);
  return y;
}

TEST(Crc, CheckValues) {
  VERIFIES("LASSO-COR-002~1");
  EXPECT_EQ(crc16_ccitt(kCheck), 0x29B1);
  EXPECT_EQ(crc32c(kCheck), 0xE3069283U);
  EXPECT_EQ(crc16_ccitt({}), 0xFFFF);
  EXPECT_EQ(crc32c({}), 0U);
}

// RFC 3720, appendix B.4.
TEST(Crc, IscsiExamplesOfCrc32c) {
  VERIFIES("LASSO-COR-002~1");
  std::vector<std::uint8_t> bytes(32, 0);
  EXPECT_EQ(crc32c(view(bytes)), 0x8A9136AAU);
  bytes.assign(32, 0xFF);
  EXPECT_EQ(crc32c(view(bytes)), 0x62A8AB43U);
  for (std::size_t i = 0; i < 32; ++i) bytes[i] = static_cast<std::uint8_t>(i);
  EXPECT_EQ(crc32c(view(bytes)), 0x46DD794EU);
}

TEST(Crc, TablesAgreeWithTheDefinition) {
  VERIFIES("LASSO-COR-002~1");
  test::Generator generator(1);
  for (std::size_t n = 0; n < 300; ++n) {
    const auto bytes = random_bytes(generator, n);
    ASSERT_EQ(crc16_ccitt(view(bytes)), crc_by_bits(bytes, 16, 0x1021, 0xFFFF, false)) << n;
    ASSERT_EQ(crc32c(view(bytes)), ~mirrored(crc_by_bits(bytes, 32, 0x1EDC6F41, 0xFFFFFFFF, true))) << n;
  }
}

TEST(Crc, IsTheDefinitionsAtAnyAddressAndInAnyPieces) {
  VERIFIES("LASSO-COR-002~1");
  test::Generator generator(5);
  const auto bytes = random_bytes(generator, 4096);
  for (int round = 0; round < 500; ++round) {
    const std::size_t from = generator.below(bytes.size()), end = from + generator.below(bytes.size() - from + 1);
    const std::vector<std::uint8_t> part(bytes.begin() + static_cast<std::ptrdiff_t>(from),
                                         bytes.begin() + static_cast<std::ptrdiff_t>(end));
    std::uint16_t crc16 = 0xFFFF;
    std::uint32_t crc32 = 0;
    for (std::size_t at = from; at < end;) {
      const std::size_t piece = std::min<std::size_t>(1 + generator.below(40), end - at);
      crc16 = crc16_ccitt(view(bytes).subspan(at, piece), crc16);
      crc32 = crc32c(view(bytes).subspan(at, piece), crc32);
      at += piece;
    }
    ASSERT_EQ(crc16, crc_by_bits(part, 16, 0x1021, 0xFFFF, false)) << from << ' ' << end;
    ASSERT_EQ(crc32, ~mirrored(crc_by_bits(part, 32, 0x1EDC6F41, 0xFFFFFFFF, true))) << from << ' ' << end;
  }
}

TEST(Crc, CallsChainAtEveryCut) {
  VERIFIES("LASSO-COR-002~1");
  test::Generator generator(2);
  const auto bytes = random_bytes(generator, 257);
  for (std::size_t cut = 0; cut <= bytes.size(); ++cut) {
    const ConstBytes head = view(bytes).first(cut);
    const ConstBytes tail = view(bytes).subspan(cut, bytes.size() - cut);
    ASSERT_EQ(crc16_ccitt(tail, crc16_ccitt(head)), crc16_ccitt(view(bytes)));
    ASSERT_EQ(crc32c(tail, crc32c(head)), crc32c(view(bytes)));
  }
}

TEST(Crc, EverySingleAndDoubleFlipIsSeen) {
  VERIFIES("LASSO-COR-003~2");
  test::Generator generator(3);
  auto bytes = random_bytes(generator, 24);
  const std::uint16_t good16 = crc16_ccitt(view(bytes));
  const std::uint32_t good32 = crc32c(view(bytes));
  const auto flip = [&bytes](std::size_t bit) { bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1U << (bit % 8))); };
  const std::size_t bits = 8 * bytes.size();
  for (std::size_t a = 0; a < bits; ++a) {
    flip(a);
    ASSERT_NE(crc16_ccitt(view(bytes)), good16) << a;
    ASSERT_NE(crc32c(view(bytes)), good32) << a;
    for (std::size_t b = a + 1; b < bits; ++b) {
      flip(b);
      ASSERT_NE(crc16_ccitt(view(bytes)), good16) << a << ' ' << b;
      ASSERT_NE(crc32c(view(bytes)), good32) << a << ' ' << b;
      flip(b);
    }
    flip(a);
  }
}

// From any bit of the message on, which may lie in three bytes.
TEST(Crc, EveryBurstUpToTheWidthIsSeen) {
  VERIFIES("LASSO-COR-003~2");
  test::Generator generator(4);
  for (int trial = 0; trial < 20000; ++trial) {
    auto bytes = random_bytes(generator, 40);
    const std::uint16_t good16 = crc16_ccitt(view(bytes));
    const std::uint32_t good32 = crc32c(view(bytes));
    const std::size_t bit = generator.below(8 * bytes.size() - 15);
    const auto pattern = static_cast<unsigned>(1 + generator.below(0xFFFF));  // never 0
    const unsigned shifted = pattern << (8 - bit % 8);                        // in 24 bits from the byte's first one on
    for (std::size_t i = 0; i < 3 && bit / 8 + i < bytes.size(); ++i) {
      std::uint8_t& byte = bytes[bit / 8 + i];
      byte = static_cast<std::uint8_t>(byte ^ (shifted >> (16 - 8 * i) & 0xFFU));
    }
    ASSERT_NE(crc16_ccitt(view(bytes)), good16);
    ASSERT_NE(crc32c(view(bytes)), good32);
  }
}

}  // namespace
}  // namespace lasso
