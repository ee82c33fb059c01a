#include "fsw/link/arming.hpp"

#include <algorithm>

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

constexpr CommandName kLaser{8, 1, 5}, kLoad{6, 2, 0};

TEST(Arming, NothingFiresUnarmedOrTwice) {
  VERIFIES("LASSO-LNK-017~2");
  Arming arming;
  EXPECT_FALSE(arming.fire(kLaser, Hazard::kOnce));
  arming.arm(kLaser);
  EXPECT_TRUE(arming.armed());
  EXPECT_TRUE(arming.fire(kLaser, Hazard::kOnce));
  EXPECT_FALSE(arming.armed());
  EXPECT_FALSE(arming.fire(kLaser, Hazard::kOnce));
  arming.arm(kLaser);
  arming.disarm();
  EXPECT_FALSE(arming.fire(kLaser, Hazard::kOnce));
}

TEST(Arming, AnotherHazardousCommandEndsIt) {
  VERIFIES("LASSO-LNK-017~2");
  for (const CommandName& other : {CommandName{9, 1, 5}, CommandName{8, 2, 5}, CommandName{8, 1, 6}}) {
    Arming arming;
    arming.arm(kLaser);
    EXPECT_FALSE(arming.fire(other, Hazard::kOnce));
    EXPECT_FALSE(arming.fire(kLaser, Hazard::kOnce));
    arming.arm(other);
    arming.arm(kLaser);
    EXPECT_FALSE(arming.fire(other, Hazard::kRenewed)) << "the last arm counts";
  }
}

TEST(Arming, ExpiresAfterItsFrames) {
  VERIFIES("LASSO-LNK-017~2");
  Arming arming;
  EXPECT_FALSE(arming.pass_boundary());
  arming.arm(kLaser);
  for (std::uint32_t frame = 1; frame < kArmFrames; ++frame) ASSERT_FALSE(arming.pass_boundary());
  EXPECT_TRUE(arming.armed());
  EXPECT_TRUE(arming.pass_boundary());
  EXPECT_FALSE(arming.fire(kLaser, Hazard::kOnce));
  EXPECT_TRUE(arming.name() == kLaser);
  EXPECT_FALSE(arming.pass_boundary());
}

// Where in its memory the time lies in its copies.
std::uint32_t* copies_of_time(Arming& arming, std::uint32_t left) {
  const std::uint32_t copies[] = {left, ~left, left};
  auto* const words = reinterpret_cast<std::uint32_t*>(&arming);
  auto* const end = words + sizeof(Arming) / sizeof(std::uint32_t);
  auto* const found = std::search(words, end, copies, copies + 3);
  EXPECT_NE(found, end);
  return found;
}

// Any bit, in any frame: the arm ends when its frames are over, as without the flip.
TEST(Arming, AFlippedBitOfItsTimeMakesItNoLonger) {
  VERIFIES("LASSO-HLT-014~3");
  for (std::uint32_t bit = 0; bit < 96; ++bit) {
    for (std::uint32_t before = 0; before < kArmFrames; ++before) {
      Arming arming;
      arming.arm(kLaser);
      for (std::uint32_t frame = 0; frame < before; ++frame) ASSERT_FALSE(arming.pass_boundary());
      copies_of_time(arming, kArmFrames - before)[bit / 32] ^= 1u << bit % 32;
      for (std::uint32_t frame = before + 1; frame < kArmFrames; ++frame) ASSERT_FALSE(arming.pass_boundary()) << bit << " " << before;
      ASSERT_TRUE(arming.armed()) << bit << " " << before;
      ASSERT_TRUE(arming.pass_boundary()) << bit << " " << before;
      ASSERT_FALSE(arming.fire(kLaser, Hazard::kOnce)) << bit << " " << before;
    }
  }
}

// A command that was armed once, and whose time is over, is not armed again by a flip; nor by a second one, after a boundary.
TEST(Arming, AFlippedBitArmsNothing) {
  VERIFIES("LASSO-HLT-014~3");
  for (std::uint32_t bit = 0; bit < 96; ++bit) {
    Arming arming;
    arming.arm(kLaser);
    arming.disarm();
    std::uint32_t* const copies = copies_of_time(arming, 0);
    for (std::uint32_t word = 0; word < 3; ++word) {
      copies[word] ^= 1u << bit % 32;
      EXPECT_FALSE(arming.armed()) << bit;
      EXPECT_FALSE(arming.pass_boundary()) << "nothing expires: " << bit;
    }
    copies[bit / 32] ^= 1u << bit % 32;
    EXPECT_FALSE(arming.fire(kLaser, Hazard::kOnce)) << bit;
  }
}

TEST(Arming, ATimeThatNoTwoCopiesSayIsOver) {
  VERIFIES("LASSO-HLT-014~3");
  Arming arming;
  arming.arm(kLaser);
  std::uint32_t* const copies = copies_of_time(arming, kArmFrames);
  copies[0] = 7;
  copies[2] = 9;
  EXPECT_FALSE(arming.fire(kLaser, Hazard::kOnce));
  arming.arm(kLaser);
  EXPECT_TRUE(arming.fire(kLaser, Hazard::kOnce));
}

TEST(Arming, ARowOfCommandsRenewsIt) {
  VERIFIES("LASSO-LNK-017~2");
  Arming arming;
  arming.arm(kLoad);
  for (int part = 0; part < 3; ++part) {
    for (std::uint32_t frame = 1; frame < kArmFrames; ++frame) ASSERT_FALSE(arming.pass_boundary());
    ASSERT_TRUE(arming.fire(kLoad, Hazard::kRenewed));
  }
  for (std::uint32_t frame = 1; frame < kArmFrames; ++frame) ASSERT_FALSE(arming.pass_boundary());
  EXPECT_TRUE(arming.pass_boundary());
  EXPECT_FALSE(arming.fire(kLoad, Hazard::kRenewed));
}

}  // namespace
}  // namespace lasso
