#include "mdat/link/number.hpp"

#include <limits>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

ItemRow row_of(WireType type, Range range) { return {1, "x", type, 1, "1", range, nullptr, "a number"}; }

TEST(Number, IsWrittenAsTheShortestTextThatReadsBack) {
  VERIFIES("LASSO-GND-021~2");
  EXPECT_EQ(text_of(Number(std::int64_t{-9223372036854775807})), "-9223372036854775807");
  EXPECT_EQ(text_of(Number(0.1F)), "0.1");
  EXPECT_EQ(text_of(Number(0.1)), "0.1");
  EXPECT_EQ(text_of(Number(1.0 / 3)), "0.3333333333333333");
  EXPECT_EQ(text_of(Number(std::numeric_limits<double>::quiet_NaN())), "nan");
  EXPECT_EQ(text_of(Number(-std::numeric_limits<float>::infinity())), "-inf");
}

TEST(Number, ReadsEachTypeOfTheWire) {
  VERIFIES("LASSO-GND-021~2");
  const std::uint8_t bytes[] = {0xFF, 0xFE, 0xFD, 0xFC, 0xFB, 0xFA, 0xF9, 0xF8};
  const ConstBytes view(bytes, sizeof bytes);
  EXPECT_EQ(std::get<std::int64_t>(read_number(WireType::kU8, view)), 0xFF);
  EXPECT_EQ(std::get<std::int64_t>(read_number(WireType::kU16, view)), 0xFFFE);
  EXPECT_EQ(std::get<std::int64_t>(read_number(WireType::kU32, view)), 0xFFFEFDFC);
  EXPECT_EQ(std::get<std::int64_t>(read_number(WireType::kI64, view)), -0x01020304050608);
  const std::uint8_t one[] = {0x3F, 0x80, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(std::get<float>(read_number(WireType::kF32, ConstBytes(one, 4))), 1.0F);
  EXPECT_EQ(std::get<double>(read_number(WireType::kF64, ConstBytes(one, 8))), 0.0078125);
}

TEST(Number, ReadsBitsOfAHeader) {
  VERIFIES("LASSO-GND-021~2");
  const std::uint8_t bytes[] = {0x1B, 0xD1, 0xE5, 0x67};
  const ConstBytes view(bytes, sizeof bytes);
  EXPECT_EQ(read_bits(view, 0, 3), 0U);
  EXPECT_EQ(read_bits(view, 3, 1), 1U);
  EXPECT_EQ(read_bits(view, 5, 11), 0x3D1U);
  EXPECT_EQ(read_bits(view, 18, 14), 0x2567U);
}

TEST(Number, KnowsWhatIsInRange) {
  VERIFIES("LASSO-GND-021~2");
  EXPECT_TRUE(in_range(row_of(WireType::kF64, kShare), Number(1.0000000001))) << "rounding";
  EXPECT_FALSE(in_range(row_of(WireType::kF64, kShare), Number(1.001)));
  EXPECT_FALSE(in_range(row_of(WireType::kF64, kShare), Number(-0.001)));
  EXPECT_FALSE(in_range(row_of(WireType::kF64, kAny), Number(std::numeric_limits<double>::quiet_NaN())));
  EXPECT_TRUE(in_range(row_of(WireType::kF64, kAny), Number(std::numeric_limits<double>::infinity())));
  EXPECT_TRUE(in_range(row_of(WireType::kU8, Range{0, 4}), Number(std::int64_t{4})));
  EXPECT_FALSE(in_range(row_of(WireType::kU8, Range{0, 4}), Number(std::int64_t{5})));
}

TEST(Number, NamesTheValuesOfAnEnumeration) {
  VERIFIES("LASSO-GND-021~2");
  const Choice choices[] = {{"no", "it is not"}, {"yes", "it is"}};
  const Enumeration enumeration{"flag", Span<const Choice>(choices)};
  ItemRow row = row_of(WireType::kU8, Range{0, 1});
  EXPECT_EQ(choice_of(row, Number(std::int64_t{1})), nullptr);
  row.enumeration = &enumeration;
  EXPECT_EQ(choice_of(row, Number(std::int64_t{1})), &choices[1]);
  EXPECT_EQ(choice_of(row, Number(std::int64_t{2})), nullptr);
  EXPECT_EQ(choice_of(row, Number(1.0)), nullptr);
}

}  // namespace
}  // namespace lasso::mdat
