#include "fsw/link/arming.hpp"

#include <cstring>

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

constexpr CommandName kLaser{8, 1, 5}, kLoad{6, 2, 0};

TEST(Arming, NothingFiresUnarmedOrTwice) {
  VERIFIES("LASSO-LNK-017~1");
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
  VERIFIES("LASSO-LNK-017~1");
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
  VERIFIES("LASSO-LNK-017~1");
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

TEST(Arming, ATimeThatNobodyGaveArmsNothing) {
  VERIFIES("LASSO-HLT-014~1");
  Arming arming;
  arming.arm(kLaser);
  std::uint32_t left = kArmFrames;
  auto* const bytes = reinterpret_cast<std::uint8_t*>(&arming) + sizeof(CommandName);
  ASSERT_EQ(std::memcmp(bytes, &left, sizeof left), 0);
  left |= 1u << 20;
  std::memcpy(bytes, &left, sizeof left);
  EXPECT_FALSE(arming.fire(kLaser, Hazard::kOnce));
  arming.arm(kLaser);
  EXPECT_TRUE(arming.fire(kLaser, Hazard::kOnce));
}

TEST(Arming, ARowOfCommandsRenewsIt) {
  VERIFIES("LASSO-LNK-017~1");
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
