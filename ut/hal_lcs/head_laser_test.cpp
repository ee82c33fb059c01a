// What the driver of a head at memory tells of the laser.
#include "ut/hal_lcs/head_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::lcs {
namespace {

TEST_F(LcsHeadDriver, LetsTheLaserShineOnlyWithPermission) {
  VERIFIES("LASSO-LCS-006~1 LASSO-LCS-024~1");
  EXPECT_EQ(memory.laser.load(), kLaserMayShine);
  begin(plan);
  head.measure(plan, 10);
  driver.permit_laser(false);
  EXPECT_NE(memory.laser.load(), kLaserMayShine);
  expect_lost(Status::kMissing);
  EXPECT_TRUE(samples.empty());
  memory.laser.store(kLaserMayShine);  // by a disturbance
  EXPECT_EQ(driver.start(plan, kStartUs), Status::kMissing);
  EXPECT_NE(memory.laser.load(), kLaserMayShine);
  memory.laser.store(kLaserMayShine);
  poll();
  EXPECT_NE(memory.laser.load(), kLaserMayShine);
}

// Either way: dark where it may not, and lit where it may.
TEST_F(LcsHeadDriver, AWordThatADisturbanceHasChangedIsRightAgainAfterEachCall) {
  VERIFIES("LASSO-LCS-024~1");
  constexpr std::uint32_t kOther = 0x12345678;
  const auto is_right_after = [&](bool permitted, auto call) {
    memory.laser.store(permitted ? kOther : kLaserMayShine);
    call();
    return (memory.laser.load() == kLaserMayShine) == permitted;
  };
  for (const bool permitted : {true, false}) {
    EXPECT_TRUE(is_right_after(permitted, [&] { driver.permit_laser(permitted); }));
    EXPECT_TRUE(is_right_after(permitted, [&] { static_cast<void>(driver.start(plan, kStartUs)); }));
    EXPECT_TRUE(is_right_after(permitted, [&] { static_cast<void>(driver.start(plan, kStartUs)); })) << "a start that is refused";
    EXPECT_TRUE(is_right_after(permitted, [&] { poll(); }));
    EXPECT_TRUE(is_right_after(permitted, [&] { driver.abort(); }));
  }
}

TEST_F(LcsHeadDriver, AScanIsLostThoughPermissionIsBackBeforeItIsMissed) {
  VERIFIES("LASSO-LCS-006~1");
  begin(plan);
  head.measure(plan, plan.points);
  driver.permit_laser(false);
  driver.permit_laser(true);
  expect_lost(Status::kMissing);
  begin(plan);
  driver.permit_laser(true);
  head.measure(plan, plan.points);
  EXPECT_TRUE(poll().complete) << "the next one is not";
}

TEST_F(LcsHeadDriver, InhibitsAHeadThatSaysItIsLitWithoutPermission) {
  VERIFIES("LASSO-LCS-024~1");
  std::uint16_t given = head.number();
  const auto inhibited = [&] {
    const bool some = head.number() != given;
    given = head.number();
    return some && head.is_inhibited();
  };
  head.status.laser_lit = true;
  head.say(false);
  poll();
  EXPECT_FALSE(inhibited()) << "it may";
  driver.permit_laser(false);
  EXPECT_TRUE(inhibited());
  poll();
  EXPECT_TRUE(inhibited()) << "with each call";
  EXPECT_EQ(driver.start(plan, kStartUs), Status::kMissing);
  EXPECT_TRUE(inhibited());
  driver.abort();
  EXPECT_TRUE(inhibited());
  head.status.laser_lit = false;
  head.say(false);
  poll();
  EXPECT_FALSE(inhibited()) << "it is dark";
  head.status.laser_lit = true;
  head.say(false);
  reinterpret_cast<std::uint8_t*>(&memory.status)[7] ^= 1;
  poll();
  EXPECT_TRUE(inhibited()) << "nobody knows";
  head.say(false);
  head.status.laser_lit = false;
  head.say(false);
  driver.permit_laser(false);
  EXPECT_TRUE(inhibited()) << "whatever it says";
}

TEST_F(LcsHeadDriver, TheLastWordOfAScanWithoutPermissionIsAnInhibit) {
  VERIFIES("LASSO-LCS-024~1");
  head.status.laser_lit = true;
  begin(plan);
  driver.permit_laser(false);
  EXPECT_EQ(poll().status, Status::kMissing);
  EXPECT_TRUE(head.is_inhibited());
}

TEST_F(LcsHeadDriver, IsHeardWithEachCall) {
  VERIFIES("LASSO-LCS-024~1");
  std::uint32_t beats = memory.beats.load();
  const auto beaten = [&] {
    const std::uint32_t before = beats;
    beats = memory.beats.load();
    return beats != before;
  };
  begin(plan);
  EXPECT_TRUE(beaten());
  poll();
  EXPECT_TRUE(beaten());
  driver.abort();
  EXPECT_TRUE(beaten());
  for (const bool permitted : {true, false}) {
    driver.permit_laser(permitted);
    EXPECT_TRUE(beaten());
  }
  EXPECT_EQ(driver.start(plan, kStartUs), Status::kMissing);
  EXPECT_TRUE(beaten()) << "one that is refused, too";
}

TEST_F(LcsHeadDriver, AFlippedBitOfThePermissionChangesNothing) {
  VERIFIES("LASSO-HLT-012~1");
  const std::uint32_t copies[] = {1, ~1u, 1};
  auto* words = reinterpret_cast<std::uint32_t*>(&driver);
  auto* end = words + sizeof(HeadDriver) / sizeof(std::uint32_t);
  auto* found = std::search(words, end, copies, copies + 3);
  ASSERT_NE(found, end);
  for (std::uint32_t bit = 0; bit < 96; ++bit) {
    found[bit / 32] ^= 1u << bit % 32;
    EXPECT_EQ(driver.start(plan, kStartUs), Status::kOk) << bit;
    EXPECT_EQ(memory.laser.load(), kLaserMayShine);
    EXPECT_TRUE(std::equal(copies, copies + 3, found)) << "repaired: " << bit;
    driver.abort();
  }
  begin(plan);
  found[0] = 5;
  found[1] = ~7u;
  EXPECT_EQ(poll().status, Status::kMissing);
  EXPECT_NE(memory.laser.load(), kLaserMayShine) << "what no two copies say is no permission";
  EXPECT_EQ(driver.start(plan, kStartUs), Status::kMissing);
}

}  // namespace
}  // namespace lasso::lcs
