#include "fsw/link/row.hpp"

#include <string>

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

struct Sample {
  std::uint8_t small = 0;
  std::int64_t large = 0;
  float pair[2] = {};
};

constexpr TelemetryRow<Sample> kRows[] = {
    make_row<&Sample::large>(7, "large", "us", "", "a signed number"),
    make_row<&Sample::small>(3, "small", "1", "0=no|1=yes", "a flag"),
    make_row<&Sample::pair>(4, "pair", "m", "", "two numbers"),
};

TEST(Row, TakesItsTypeAndCountFromTheMember) {
  VERIFIES("LASSO-LNK-002~1");
  EXPECT_EQ(kRows[0].type, WireType::kI64);
  EXPECT_EQ(kRows[0].count, 1);
  EXPECT_EQ(kRows[1].type, WireType::kU8);
  EXPECT_EQ(kRows[2].type, WireType::kF32);
  EXPECT_EQ(kRows[2].count, 2);
  EXPECT_EQ(rows_size(Span<const TelemetryRow<Sample>>(kRows), 2), 9u);
  EXPECT_EQ(rows_size(Span<const TelemetryRow<Sample>>(kRows), 3), 17u);
}

TEST(Row, IsTheSameWhenTheCompilerHasNotMadeIt) {
  VERIFIES("LASSO-LNK-002~1");
  const char* name = "large";
  TelemetryRow<Sample> row = make_row<&Sample::large>(7, name, "us", "", "a signed number");
  EXPECT_EQ(row.name, name);
  EXPECT_EQ(row.type, kRows[0].type);
  EXPECT_EQ(row.count, kRows[0].count);
  const Sample sample{0, -5, {}};
  EXPECT_EQ(row.value(sample, 0), kRows[0].value(sample, 0));
}

TEST(Row, WritesBigEndianInTheOrderOfTheTable) {
  VERIFIES("LASSO-LNK-002~1");
  const Sample sample{0xAB, -2, {1.0f, -0.5f}};
  std::uint8_t bytes[17] = {};
  ByteWriter writer{Bytes(bytes)};
  for (const auto& row : kRows) row.write(sample, writer);
  const std::uint8_t expected[17] = {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFE, 0xAB, 0x3F, 0x80, 0, 0, 0xBF, 0, 0, 0};
  ASSERT_TRUE(writer.ok());
  EXPECT_TRUE(std::equal(bytes, bytes + 17, expected));

  Sample back;
  ByteReader reader{ConstBytes(bytes, 17)};
  for (const auto& row : kRows) row.read(reader, back);
  EXPECT_EQ(back.small, sample.small);
  EXPECT_EQ(back.large, sample.large);
  EXPECT_EQ(back.pair[1], -0.5f);
  EXPECT_EQ(kRows[2].value(back, 1), -0.5);
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

}  // namespace
}  // namespace lasso
