#include "hal_sim/scan_text.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>

#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

TEST(ScanText, LinesKeepTheirNumbersWhateverEndsThem) {
  VERIFIES("LASSO-SIM-021~1");
  Lines lines("f", "a\r\n\nb\r\nrest");
  std::string_view line;
  ASSERT_TRUE(lines.next(line));
  EXPECT_EQ(line, "a");
  ASSERT_TRUE(lines.next(line));
  EXPECT_EQ(line, "");
  ASSERT_TRUE(lines.next(line));
  EXPECT_EQ(line, "b");
  EXPECT_EQ(lines.place(), "f:3");
  EXPECT_EQ(lines.rest(), "rest");
  ASSERT_TRUE(lines.next(line));
  EXPECT_EQ(line, "rest");
  EXPECT_FALSE(lines.next(line));
  EXPECT_FALSE(lines.next(line));
  EXPECT_EQ(lines.number(), 4u);
}

TEST(ScanText, FieldsAreTrimmedAndEmptyOnesKept) {
  VERIFIES("LASSO-SIM-021~1");
  EXPECT_EQ(split(" a ,,b\t,", ','), (std::vector<std::string_view>{"a", "", "b", ""}));
  EXPECT_EQ(split("", ','), (std::vector<std::string_view>{""}));
  EXPECT_EQ(words("  a \t b c  "), (std::vector<std::string_view>{"a", "b", "c"}));
  EXPECT_TRUE(words(" \t ").empty());
}

TEST(ScanText, NumbersFillTheirField) {
  VERIFIES("LASSO-SIM-021~1");
  EXPECT_EQ(number("-1.5e3", "x", "f:1"), -1500);
  EXPECT_EQ(number("+.5", "x", "f:1"), 0.5);
  for (const char* bad : {"", "+", "1,5", "0x10", " 1", "1 ", "--1", "1e", "infinity", "NaN"}) {
    EXPECT_THROW(number(bad, "x", "f:1"), ScanFileError) << bad;
  }
  EXPECT_EQ(count("18446744073709551615", "n", "f:1"), ~std::uint64_t{0});
  for (const char* bad : {"", "-1", "+1", "1.0", "18446744073709551616"}) EXPECT_THROW(count(bad, "n", "f:1"), ScanFileError) << bad;
}

TEST(ScanText, ScalarsReadInBothByteOrders) {
  VERIFIES("LASSO-SIM-020~2");
  test::Generator generator(6);
  for (int i = 0; i < 1000; ++i) {
    const double wide = generator.normal() * 1e3;
    const float narrow = static_cast<float>(wide);
    char bytes[8];
    std::memcpy(bytes, &wide, 8);  // the host's order
    EXPECT_EQ(scalar_at(bytes, {ScalarType::Kind::kReal, 8}, std::endian::native == std::endian::big), wide);
    std::reverse(bytes, bytes + 8);
    EXPECT_EQ(scalar_at(bytes, {ScalarType::Kind::kReal, 8}, std::endian::native == std::endian::little), wide);
    std::memcpy(bytes, &narrow, 4);
    EXPECT_EQ(scalar_at(bytes, {ScalarType::Kind::kReal, 4}, std::endian::native == std::endian::big), static_cast<double>(narrow));
    std::reverse(bytes, bytes + 4);
    EXPECT_EQ(scalar_at(bytes, {ScalarType::Kind::kReal, 4}, std::endian::native == std::endian::little), static_cast<double>(narrow));
  }
}

TEST(ScanText, WholeNumbersReadWithTheirSign) {
  VERIFIES("LASSO-SIM-020~2");
  const char bytes[] = "\xFE\xFF\xFF\xFF";
  EXPECT_EQ(scalar_at(bytes, {ScalarType::Kind::kSigned, 1}, false), -2);
  EXPECT_EQ(scalar_at(bytes, {ScalarType::Kind::kUnsigned, 1}, false), 254);
  EXPECT_EQ(scalar_at(bytes, {ScalarType::Kind::kSigned, 4}, false), -2);
  EXPECT_EQ(scalar_at(bytes, {ScalarType::Kind::kUnsigned, 2}, true), 0xFEFF);
}

}  // namespace
}  // namespace lasso::sim
