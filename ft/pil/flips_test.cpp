#include "ft/pil/flips.hpp"

#include <gtest/gtest.h>

#include <bitset>
#include <set>

namespace lasso::pil {
namespace {

constexpr Range kCode{0x00100000, 0x7CA5C};

std::size_t bits_between(const std::string& a, const std::string& b) {
  std::size_t bits = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    bits += std::bitset<8>(std::stoul(a.substr(i, 1), nullptr, 16) ^ std::stoul(b.substr(i, 1), nullptr, 16)).count();
  return bits;
}

TEST(Flips, SeedAndNumberSayWhereAndWhen) {
  std::set<double> places;
  for (std::uint32_t trial = 0; trial < 200; ++trial) {
    const Flip flip = draw_flip(7, trial, kCode), again = draw_flip(7, trial, kCode);
    EXPECT_EQ(flip.place, again.place);
    EXPECT_EQ(flip.instructions, again.instructions);
    EXPECT_EQ(flip.boundary(), again.boundary());
    EXPECT_EQ(flip.region, static_cast<Region>(trial % kRegions));
    EXPECT_NE(flip.place, draw_flip(8, trial, kCode).place);
    EXPECT_LT(flip.bit, 8);
    for (const std::uint32_t address : flip.instructions) EXPECT_TRUE(address % 4 == 0 && address - kCode.address < kCode.bytes);
    places.insert(flip.place);
  }
  EXPECT_EQ(places.size(), 200U);
}

TEST(Flips, AShareOfSeveralRangesIsInOneOfThem) {
  const std::vector<Range> ranges{{0x100, 0x10}, {0x400, 0x30}};
  EXPECT_EQ(address_in(ranges, 0.0), 0x100U);
  EXPECT_EQ(address_in(ranges, 0.25), 0x400U);
  EXPECT_EQ(address_in(ranges, 0.9999), 0x42FU);
}

TEST(Flips, OneBitOfOneRegisterIsTurnedOver) {
  std::set<std::string> names;
  const std::string before(2 * std::size_t{kRegisterBytes}, '5');
  for (int i = 0; i < 4000; ++i) {
    std::string after = before;
    std::uint32_t bit = 0;
    const std::string name = flip_register(after, i / 4000.0, static_cast<std::uint8_t>(i % 8), bit);
    EXPECT_EQ(bits_between(before, after), 1U) << name;
    EXPECT_LT(bit, name[0] == 'f' && name != "fpscr" ? 64U : 32U) << name;
    names.insert(name);
  }
  EXPECT_EQ(names.size(), 71U);
}

TEST(Flips, TheLowestBitIsTheLastOfTheRegistersDigits) {
  std::string digits(2 * std::size_t{kRegisterBytes}, '0');
  std::uint32_t bit = 1;
  EXPECT_EQ(flip_register(digits, 1.0 / 71 + 1e-9, 0, bit), "r1");
  EXPECT_EQ(bit, 0U);
  EXPECT_EQ(register_word(digits, 4), 1U);
}

TEST(Flips, LiveStacksAreThoseOfTheRunningContextAndOfTheOneBelow) {
  const Range acquisition{0x04000000, 0x8000}, estimation{0x00400000, 0x8000};
  const std::vector<Range> both = live_stacks(0x04007000, acquisition, estimation, 0x00407800);
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].address + both[0].bytes, 0x04008000U);
  EXPECT_EQ(both[0].bytes, 0x1000U);
  EXPECT_EQ(both[1].bytes, 0x800U);
  const std::vector<Range> one = live_stacks(0x00407F00, acquisition, estimation, 0x00407800);
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].bytes, 0x100U);
}

}  // namespace
}  // namespace lasso::pil
