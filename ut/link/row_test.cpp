#include "fsw/link/row.hpp"

#include <algorithm>
#include <string>

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

struct Sample {
  std::uint8_t small = 0;
  std::int64_t large = 0;
  float pair[2] = {};
};

constexpr Choice kFlags[] = {{"no", "it is not"}, {"yes", "it is", "be glad"}, {"maybe", "who knows"}};
constexpr Enumeration kFlag{"flag", Span<const Choice>(kFlags)};
constexpr TypedRow<Sample> kRows[] = {
    make_row<&Sample::large>(7, "large", "us", kAny, "a signed number"),
    make_row<&Sample::small>(3, "small", kFlag, "a flag"),
    make_row<&Sample::pair>(4, "pair", "m", Range{-1, 2}, "two numbers"),
};
constexpr auto kCodec = codec_of(kRows);
constexpr auto kItems = items_of(kRows);

TEST(Row, TakesItsTypeAndCountFromTheMember) {
  VERIFIES("LASSO-LNK-002~1");
  EXPECT_EQ(kRows[0].type, WireType::kI64);
  EXPECT_EQ(kRows[0].count, 1);
  EXPECT_EQ(kRows[1].type, WireType::kU8);
  EXPECT_EQ(kRows[2].type, WireType::kF32);
  EXPECT_EQ(kRows[2].count, 2);
  EXPECT_EQ(kRows[2].size(), 8u);
  EXPECT_EQ(kCodec.bytes, 17u);
}

TEST(Row, AnEnumerationSaysItsRange) {
  VERIFIES("LASSO-LNK-002~1");
  EXPECT_EQ(kItems.rows[0].enumeration, nullptr);
  EXPECT_EQ(kItems.rows[1].enumeration, &kFlag);
  EXPECT_EQ(kItems.rows[1].range.minimum, 0);
  EXPECT_EQ(kItems.rows[1].range.maximum, 2);
  EXPECT_STREQ(kItems.rows[1].unit, "1");
  EXPECT_EQ(kItems.rows[2].range.minimum, -1);
  EXPECT_STREQ(kItems.rows[2].meaning, "two numbers");
}

TEST(Row, IsTheSameWhenTheCompilerHasNotMadeIt) {
  VERIFIES("LASSO-LNK-002~1");
  const char* name = "large";
  const TypedRow<Sample> rows[] = {make_row<&Sample::large>(7, name, "us", kAny, "a signed number"),
                                   make_row<&Sample::small>(3, name, kFlag, ""), make_row<&Sample::pair>(4, name, "m", kAny, "")};
  EXPECT_EQ(rows[0].name, name);
  EXPECT_EQ(rows[0].write, kRows[0].write);
  EXPECT_EQ(codec_of(rows).bytes, kCodec.bytes);
  EXPECT_EQ(items_of(rows).rows[1].enumeration, &kFlag);
}

TEST(Row, KnowsWhatIsWithinItsRange) {
  VERIFIES("LASSO-LNK-002~1");
  constexpr auto kLimits = limits_of(kRows);
  EXPECT_TRUE(kLimits.hold(Sample{2, -5, {-1, 2}}));
  EXPECT_FALSE(kLimits.hold(Sample{3, -5, {0, 0}}));
  EXPECT_FALSE(kLimits.hold(Sample{0, 0, {0, 2.5f}}));
  EXPECT_FALSE(kLimits.hold(Sample{0, 0, {-1.5f, 0}}));
  EXPECT_FALSE(kLimits.hold(Sample{0, 0, {0, std::numeric_limits<float>::quiet_NaN()}}));
  const TypedRow<Sample> rows[] = {make_row<&Sample::small>(3, "small", kFlag, "")};
  EXPECT_FALSE(limits_of(rows).hold(Sample{3, 0, {}})) << "and when the compiler has not made it";
}

TEST(Row, WritesBigEndianInTheOrderOfTheTable) {
  VERIFIES("LASSO-LNK-002~1");
  const Sample sample{0xAB, -2, {1.0f, -0.5f}};
  std::uint8_t bytes[17] = {};
  ByteWriter writer{Bytes(bytes)};
  kCodec.write(sample, writer);
  const std::uint8_t expected[17] = {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFE, 0xAB, 0x3F, 0x80, 0, 0, 0xBF, 0, 0, 0};
  ASSERT_TRUE(writer.ok());
  EXPECT_TRUE(std::equal(bytes, bytes + 17, expected));

  Sample back;
  ByteReader reader{ConstBytes(bytes, 17)};
  kCodec.read(reader, back);
  EXPECT_EQ(back.small, sample.small);
  EXPECT_EQ(back.large, sample.large);
  EXPECT_EQ(back.pair[1], -0.5f);
}

TEST(Row, NamesAndSizesOfTypes) {
  VERIFIES("LASSO-LNK-002~1");
  EXPECT_EQ(std::string(to_string(WireType::kU16)), "u16");
  EXPECT_EQ(std::string(to_string(WireType::kF64)), "f64");
  EXPECT_EQ(wire_size(WireType::kU8), 1u);
  EXPECT_EQ(wire_size(WireType::kU16), 2u);
  EXPECT_EQ(wire_size(WireType::kU32), 4u);
  EXPECT_EQ(wire_size(WireType::kI64), 8u);
  EXPECT_EQ(wire_size(WireType::kF32), 4u);
  EXPECT_EQ(wire_size(WireType::kF64), 8u);
}

TEST(Rows, SayWhetherTheirNumbersAreReal) {
  VERIFIES("LASSO-LNK-002~1");
  const WireType real[] = {WireType::kF32, WireType::kF64};
  const WireType whole[] = {WireType::kU8, WireType::kU16, WireType::kU32, WireType::kI64};
  for (const WireType type : real) EXPECT_TRUE(is_real(type)) << to_string(type);
  for (const WireType type : whole) EXPECT_FALSE(is_real(type)) << to_string(type);
}

TEST(Rows, OfNoStructAreNumbersOrChoices) {
  VERIFIES("LASSO-LNK-002~1");
  const Choice kColours[] = {{"red", "stop"}, {"green", "go"}};
  const Enumeration colour{"colour", Span<const Choice>(kColours)};
  for (std::uint16_t id = 1; id < 4; ++id) {
    const ItemRow number = number_item(id, "depth", WireType::kF32, "m", "how deep");
    EXPECT_EQ(number.id, id);
    EXPECT_EQ(number.type, WireType::kF32);
    EXPECT_EQ(number.size(), 4u);
    EXPECT_EQ(number.enumeration, nullptr);
    const ItemRow choice = choice_item(id, "light", colour, "what it shows");
    EXPECT_EQ(choice.id, id);
    EXPECT_EQ(choice.size(), 1u);
    EXPECT_EQ(choice.range.maximum, 1);
    EXPECT_EQ(choice.enumeration, &colour);
  }
}

}  // namespace
}  // namespace lasso
