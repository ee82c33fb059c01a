#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "hal_lcs/driver.hpp"
#include "ut/hal_lcs/driver_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::lcs {
namespace {

// Commands to the laser among the frames.
std::vector<LaserCommand> laser_commands(const std::vector<Frame>& frames) {
  std::vector<LaserCommand> commands;
  for (const Frame& frame : frames) {
    LaserCommand command{};
    if (frame.type == static_cast<std::uint8_t>(Type::kLaser) && decode(frame, command) == Status::kOk) commands.push_back(command);
  }
  return commands;
}
const std::vector<LaserCommand> kNone, kInhibit = {LaserCommand::kInhibit}, kLight = {LaserCommand::kArm, LaserCommand::kFire};

class DarkDriver : public LcsDriver {
 protected:
  DarkDriver() { driver.permit_laser(false); }
  std::vector<LaserCommand> heard() {
    frames = camera.heard();
    return laser_commands(frames);
  }
  std::vector<Frame> frames;
};

TEST_F(DarkDriver, LightsTheLaserOnlyWithPermission) {
  VERIFIES("LASSO-LCS-006~1");
  EXPECT_EQ(driver.start(small_plan(), kStartUs), Status::kMissing);
  for (const LaserCommand command : heard()) EXPECT_EQ(command, LaserCommand::kInhibit);
  EXPECT_EQ(lost(Loss::kInhibited), 1U);
  driver.permit_laser(true);
  EXPECT_EQ(heard(), kNone);
  EXPECT_EQ(driver.start(small_plan(), kStartUs), Status::kOk);
  EXPECT_EQ(heard(), kLight);
}

// Where in the driver's memory the permission lies in its copies.
std::uint32_t* copies_of_permission(Driver& driver, std::uint32_t permitted) {
  const std::uint32_t copies[] = {permitted, ~permitted, permitted};
  auto* words = reinterpret_cast<std::uint32_t*>(&driver);
  auto* end = words + sizeof(Driver) / sizeof(std::uint32_t);
  auto* found = std::search(words, end, copies, copies + 3);
  EXPECT_NE(found, end);
  return found;
}

TEST_F(DarkDriver, AFlippedBitPermitsNothing) {
  VERIFIES("LASSO-HLT-012~1");
  std::uint32_t* const copies = copies_of_permission(driver, 0);
  heard();
  for (std::uint32_t bit = 0; bit < 96; ++bit) {
    copies[bit / 32] ^= 1u << bit % 32;
    poll();
    EXPECT_EQ(heard(), kInhibit) << bit;
    EXPECT_EQ(driver.start(small_plan(), kStartUs), Status::kMissing) << bit;
    EXPECT_EQ(heard(), kInhibit) << bit;
    EXPECT_TRUE(copies[0] == 0 && copies[1] == ~0u && copies[2] == 0) << "repaired: " << bit;
  }
}

TEST_F(DarkDriver, AFlippedBitForbidsNothing) {
  VERIFIES("LASSO-HLT-012~1");
  std::uint32_t* const copies = copies_of_permission(driver, 0);
  driver.permit_laser(true);
  ASSERT_EQ(copies[0], 1u) << "this is the permission";
  heard();
  for (std::uint32_t bit = 0; bit < 96; ++bit) {
    copies[bit / 32] ^= 1u << bit % 32;
    poll();
    EXPECT_EQ(heard(), kNone) << bit;
    EXPECT_EQ(driver.start(small_plan(), kStartUs), Status::kOk) << bit;
    EXPECT_EQ(heard(), kLight) << bit;
    EXPECT_TRUE(copies[0] == 1 && copies[1] == ~1u && copies[2] == 1) << "repaired: " << bit;
    driver.abort();
  }
}

TEST_F(DarkDriver, WhatNoTwoCopiesSayIsNoPermission) {
  VERIFIES("LASSO-HLT-012~1");
  std::uint32_t* const copies = copies_of_permission(driver, 0);
  driver.permit_laser(true);
  heard();
  constexpr std::uint32_t kDiffering[][3] = {{5, 7, 9}, {7, 0, 1}, {0, 1, 3}, {1, 3, 0}};
  for (const auto& said : kDiffering) {
    copies[0] = said[0];
    copies[1] = ~said[1];
    copies[2] = said[2];
    poll();
    EXPECT_EQ(heard(), kInhibit);
    EXPECT_EQ(driver.start(small_plan(), kStartUs), Status::kMissing);
    EXPECT_EQ(heard(), kInhibit);
    EXPECT_TRUE(copies[0] == 0 && copies[1] == ~0u && copies[2] == 0) << "from now on there is none";
  }
}

TEST_F(DarkDriver, InhibitsWithEachCallUntilTheCameraConfirmsIt) {
  VERIFIES("LASSO-LCS-006~1");
  heard();
  poll();
  EXPECT_EQ(heard(), kInhibit);
  driver.abort();
  EXPECT_EQ(heard(), kInhibit);
  EXPECT_EQ(driver.start(small_plan(), kStartUs), Status::kMissing);
  EXPECT_EQ(heard(), kInhibit);
  const std::uint8_t sequence = frames.back().sequence;
  camera.say(Answer{Type::kLaser, static_cast<std::uint8_t>(sequence - 1), Result::kDone, 0});  // to another one
  camera.say(Answer{Type::kLaser, sequence, Result::kUnknown, 0});
  poll();
  EXPECT_EQ(heard(), kInhibit);
  const Answer confirmed{Type::kLaser, frames.back().sequence, Result::kDone, 0};
  for (int said = 0; said < 2; ++said) {
    camera.say(confirmed);
    poll();
    EXPECT_EQ(heard(), kNone);
  }
  camera.status(1, kSerial, false);
  poll();
  EXPECT_EQ(heard(), kNone);
  camera.status();  // and yet it is lit
  poll();
  EXPECT_EQ(heard(), kInhibit);
}

TEST_F(DarkDriver, IsLitAnewByTheFirstStartThatIsPermitted) {
  driver.permit_laser(true);
  begin(small_plan());
  poll();
  driver.permit_laser(false);
  driver.permit_laser(true);
  heard();
  ASSERT_EQ(driver.start(small_plan(2), kStartUs + 200'000), Status::kOk);
  EXPECT_EQ(heard(), kLight);
}

TEST(LcsDriverAnew, InhibitsACameraThatMayBeLit) {
  VERIFIES("LASSO-LCS-006~1");
  Line line;
  Camera camera(line);
  const Driver driver(line, Optics(calibration()));
  EXPECT_EQ(laser_commands(camera.heard()), kInhibit);
}

TEST_F(LcsDriver, IsNotLitTwice) {
  begin(small_plan());
  poll();
  driver.abort();
  ASSERT_EQ(driver.start(small_plan(2), kStartUs), Status::kOk);
  for (const Frame& frame : camera.heard()) EXPECT_NE(frame.type, static_cast<std::uint8_t>(Type::kLaser));
}

TEST_F(LcsDriver, ACameraThatHasHeardNothingForASecondIsLitAnew) {
  VERIFIES("LASSO-LCS-018~1");
  begin(small_plan());
  poll();
  driver.abort();
  camera.heard();
  ASSERT_EQ(driver.start(small_plan(2), kStartUs + kUnheardUs / 2 + 1), Status::kOk);
  EXPECT_EQ(laser_commands(camera.heard()), kLight);
}

TEST_F(LcsDriver, ALongScanIsKeptLitBySpeaking) {
  VERIFIES("LASSO-LCS-018~1");
  ScanPlan plan = small_plan();
  plan.duration_us = 10'000'000;
  begin(plan);
  for (DurationUs after_us = 0; after_us < 10'000'000; after_us += 200'000) {
    poll(kStartUs + after_us);
    const std::vector<Frame> frames = camera.heard();
    const bool due = after_us > 0 && after_us % 1'200'000 == 0;  // the first poll after a second
    ASSERT_EQ(frames.size(), due ? 1U : 0U) << after_us;
    if (due) {
      EXPECT_EQ(frames[0].type, static_cast<std::uint8_t>(Type::kAskStatus));
    }
  }
  const std::vector<std::uint8_t> block(kLineBytes, 0);
  line.to_camera.write(ConstBytes(block.data(), block.size()));
  EXPECT_EQ(poll(kStartUs + 20'000'000).status, Status::kOk);  // a line that is full is left to what it holds
}

TEST_F(LcsDriver, InhibitingEndsTheScanAndReachesTheCamera) {
  VERIFIES("LASSO-LCS-006~1");
  begin(small_plan());
  poll();
  driver.permit_laser(false);
  EXPECT_EQ(laser_commands(camera.heard()), kInhibit);
  EXPECT_EQ(poll().status, Status::kMissing);
  EXPECT_EQ(lost(Loss::kInhibited), 1U);
  EXPECT_EQ(driver.start(small_plan(2), kStartUs), Status::kMissing);
}

TEST_F(LcsDriver, InhibitingWaitsForALineThatIsFull) {
  VERIFIES("LASSO-LCS-004~1 LASSO-LCS-006~1");
  const std::vector<std::uint8_t> block(kLineBytes, 0);
  line.to_camera.write(ConstBytes(block.data(), block.size()));
  EXPECT_EQ(driver.start(small_plan(), kStartUs), Status::kOverCapacity);
  EXPECT_EQ(lost(Loss::kLineFull), 1U);
  driver.permit_laser(false);
  driver.abort();
  EXPECT_TRUE(camera.heard().empty());
  driver.abort();
  EXPECT_EQ(laser_commands(camera.heard()), kInhibit);
}

TEST_F(LcsDriver, ALineThatIsNearlyFullKeepsRoomForAnInhibit) {
  VERIFIES("LASSO-LCS-006~1");
  begin(small_plan());
  poll();
  const std::vector<std::uint8_t> block(kLineBytes - 2 * kMaxFrame + 1, 0);
  line.to_camera.write(ConstBytes(block.data(), block.size()));
  driver.permit_laser(false);
  const std::vector<Frame> frames = camera.heard();
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(laser_commands(frames), kInhibit);
}

TEST_F(LcsDriver, AScanIsRefusedWhoseAimedRaysHaveNoRoom) {
  VERIFIES("LASSO-LCS-006~1");
  AimedRays aimed;
  for (std::size_t i = 0; i < kAimedPerFrame + 1; ++i) ASSERT_TRUE(aimed.push_back({0.01F, -0.02F}));
  ScanPlan plan = small_plan();
  const std::vector<std::uint8_t> block(line.to_camera.room() - 4 * kMaxFrame,
                                        0);  // room for an inhibit and three frames, of which two have the rays
  line.to_camera.write(ConstBytes(block.data(), block.size()));
  plan.aimed = aimed.span();
  EXPECT_EQ(driver.start(plan, kStartUs), Status::kOverCapacity);
  EXPECT_EQ(lost(Loss::kLineFull), 1U);
  plan.aimed = {};
  EXPECT_EQ(driver.start(plan, kStartUs), Status::kOk);
}

}  // namespace
}  // namespace lasso::lcs
