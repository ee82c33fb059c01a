#include "hal_lcs/table.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "ut/hal_lcs/received.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::lcs {
namespace {

TriangulationCalibration random_table(test::Generator& chance) {
  TriangulationCalibration c;
  for (const CalibrationReal& real : kCalibrationReals) c.*real.member = chance.uniform(real.minimum, real.maximum);
  for (double& term : c.residual) term = chance.uniform(-kMaxResidual, kMaxResidual);
  return c;
}

// 0.5 is 3FE0000000000000, -2 is C000000000000000 in binary64.
TEST(LcsTable, APartIsTheBytesOfTheInterfaceDocument) {
  VERIFIES("LASSO-LCS-019~1");
  TriangulationCalibration c;
  c.focal_length_m = 0.5;
  c.baseline_m = -2;
  const Frame first = received(encode(9, part_of(c, 0)));
  EXPECT_EQ(first.type, 0x83);
  EXPECT_EQ(first.length, 2 + 6 * 8);
  const std::vector<std::uint8_t> expected = {0, 25, 0x3F, 0xE0, 0, 0, 0, 0, 0, 0, 0xC0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(std::vector<std::uint8_t>(first.payload, first.payload + expected.size()), expected);
  const Frame last = received(encode(9, part_of(c, 24)));
  EXPECT_EQ(last.length, 2 + 8);
  EXPECT_EQ(last.payload[0], 24);
}

TEST(LcsTable, ComesBackFromItsPartsInAnyOrderToTheBit) {
  VERIFIES("LASSO-LCS-019~1");
  test::Generator chance(11);
  for (int trial = 0; trial < 200; ++trial) {
    const TriangulationCalibration sent = random_table(chance);
    TriangulationCalibration back;
    for (const std::size_t first : {18U, 0U, 24U, 6U, 12U}) {
      TablePart part;
      ASSERT_EQ(decode(received(encode(1, part_of(sent, first))), part), Status::kOk);
      ASSERT_EQ(take(part, back), Status::kOk);
    }
    for (const CalibrationReal& real : kCalibrationReals) EXPECT_EQ(back.*real.member, sent.*real.member);
    for (std::size_t k = 0; k < kResidualTerms; ++k) EXPECT_EQ(back.residual[k], sent.residual[k]);
  }
  EXPECT_EQ(part_of(TriangulationCalibration{}, kTableNumbers).count, 0U);
}

TEST(LcsTable, PartsThatAreNoneAreRefused) {
  VERIFIES("LASSO-LCS-019~1");
  const Frame right = received(encode(1, part_of(TriangulationCalibration{}, 0)));
  TablePart part;
  for (std::uint8_t length = 0; length <= kMaxPayload; ++length) {
    Frame frame = right;
    frame.length = length;
    const bool whole = length > 2 && (length - 2) % 8 == 0 && length <= 50;
    EXPECT_EQ(decode(frame, part), whole ? Status::kOk : Status::kBadLength) << int{length};
  }
  Frame beyond = right;
  beyond.payload[0] = 20;  // six from 20 on, of 25
  EXPECT_EQ(decode(beyond, part), Status::kBadValue);
}

TEST(LcsTable, ATableOfAnotherKindIsNotTaken) {
  VERIFIES("LASSO-LCS-019~1");
  TriangulationCalibration kept;
  TablePart other = part_of(kept, 0);
  other.all = 11;
  other.numbers[0] = 77;
  EXPECT_EQ(take(other, kept), Status::kBadValue);
  other.all = kTableNumbers;
  other.first = 20;
  EXPECT_EQ(take(other, kept), Status::kBadValue);
  EXPECT_EQ(kept.focal_length_m, TriangulationCalibration{}.focal_length_m);
}

}  // namespace
}  // namespace lasso::lcs
