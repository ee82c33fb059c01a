#include "hal_sim/memory_head.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "hal_sim/lcs_device.hpp"
#include "ut/hal_sim/head_scene.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

class InMemory : public ::testing::TestWithParam<lcs::Device> {};

TEST_P(InMemory, GivesTheBitsThatTheLineBrings) {
  VERIFIES("LASSO-LCS-022~2");
  const HeadScene scene;
  const LcsCamera camera = head_of(GetParam());
  LcsDevice device(*scene.caster, scene.motion, noisy_head(), kHeadSeed, camera);
  LcsOverLine line(device, optics_of(camera), camera.bits_per_s);
  MemoryHead head(*scene.caster, scene.motion, noisy_head(), kHeadSeed, camera);
  SensorInMemory memory(head, optics_of(camera));
  line.permit_laser(true);
  memory.permit_laser(true);
  const AimedRays aimed = aimed_row();
  for (std::uint32_t k = 0; k < 3; ++k) {
    const TimeUs t_us = kHeadStartUs + k * 200'000;
    expect_same_samples(whole_scan(memory, odd_plan(k, aimed), t_us), whole_scan(line, odd_plan(k, aimed), t_us));
  }
}

INSTANTIATE_TEST_SUITE_P(All, InMemory, ::testing::Values(lcs::Device::kLaserCamera, lcs::Device::kLidar, lcs::Device::kTridar),
                         device_name);

struct HeadRig {
  HeadRig() { head.run(0, memory); }

  HeadScene scene;
  LcsCamera camera = head_of(lcs::Device::kLaserCamera);
  MemoryHead head{*scene.caster, scene.motion, noisy_head(), kHeadSeed, camera};
  lcs::HeadMemory memory;
  lcs::HeadDriver driver{memory, optics_of(camera)};
  std::vector<RangeSample> out = std::vector<RangeSample>(kMaxSamplesPerPoll);

  std::uint8_t next_sequence() const { return lcs::sequence_of(static_cast<std::uint16_t>(lcs::value_of(memory.commands.load()) + 1)); }
  lcs::Result result_of(const lcs::FrameBytes& command, TimeUs now_us = kHeadStartUs) {
    memory.command.store(command);
    memory.commands.store(memory.commands.load() + 1);
    head.run(now_us, memory);
    EXPECT_EQ(lcs::command_of(memory.answer.load()), lcs::value_of(memory.commands.load()));
    return static_cast<lcs::Result>(lcs::value_of(memory.answer.load()));
  }
  bool says_lit() const {
    lcs::Frame frame;
    lcs::CameraStatus status;
    EXPECT_TRUE(memory.status.load(frame));
    EXPECT_EQ(decode(frame, status), Status::kOk);
    return status.laser_lit;
  }
  Status poll(TimeUs now_us) { return driver.poll(now_us, {out.data(), out.size()}).status; }
};

TEST(MemoryHead, IsDarkWithoutPermissionOrAProcessor) {
  VERIFIES("LASSO-LCS-023~1");
  HeadRig rig;
  rig.driver.permit_laser(true);
  const AimedRays none;
  ScanPlan slow = odd_plan(1, none);
  slow.duration_us = 3'000'000;
  ASSERT_EQ(rig.driver.start(slow, kHeadStartUs), Status::kOk);
  rig.head.run(kHeadStartUs, rig.memory);
  rig.head.run(kHeadStartUs + lcs::kUnheardUs, rig.memory);
  const std::uint32_t there = rig.memory.samples.load();
  EXPECT_GT(lcs::value_of(there), 500U);
  rig.head.run(kHeadStartUs + lcs::kUnheardUs + 500'000, rig.memory);
  EXPECT_EQ(rig.memory.samples.load(), there) << "the processor hangs";
  EXPECT_EQ(rig.poll(kHeadStartUs + lcs::kUnheardUs + 500'000), Status::kTruncated);

  rig.driver.permit_laser(false);
  // A start that the driver would not have given.
  EXPECT_EQ(rig.result_of(lcs::encode(rig.next_sequence(), lcs::StartCommand{}), kHeadStartUs + 4'000'000), lcs::Result::kInhibited);
}

TEST(MemoryHead, IsDarkTwoSecondsAfterTheProcessorWasHeard) {
  VERIFIES("LASSO-LCS-023~1");
  HeadRig rig;
  rig.driver.permit_laser(true);
  const AimedRays none;
  ASSERT_EQ(rig.driver.start(odd_plan(1, none), kHeadStartUs), Status::kOk);
  rig.head.run(kHeadStartUs, rig.memory);
  rig.head.run(kHeadStartUs + 2'000'000, rig.memory);
  EXPECT_TRUE(rig.says_lit());
  rig.head.run(kHeadStartUs + 2'000'001, rig.memory);
  EXPECT_FALSE(rig.says_lit());
}

TEST(MemoryHead, IsDarkFromItsBootUntilTheProcessorIsHeard) {
  VERIFIES("LASSO-LCS-023~1");
  HeadRig rig;
  rig.driver.permit_laser(true);
  MemoryHead anew(*rig.scene.caster, rig.scene.motion, noisy_head(), kHeadSeed, rig.camera);
  anew.run(kHeadStartUs, rig.memory);
  EXPECT_FALSE(rig.says_lit()) << "the word is of before";
  anew.run(kHeadStartUs + 1, rig.memory);
  EXPECT_FALSE(rig.says_lit());
  rig.driver.permit_laser(true);
  anew.run(kHeadStartUs + 2, rig.memory);
  EXPECT_FALSE(rig.says_lit()) << "without a start since";
  const AimedRays none;
  ASSERT_EQ(rig.driver.start(odd_plan(1, none), kHeadStartUs), Status::kOk);
  anew.run(kHeadStartUs + 3, rig.memory);
  EXPECT_TRUE(rig.says_lit());
}

TEST(MemoryHead, IsDarkWithAnyOtherWord) {
  VERIFIES("LASSO-LCS-023~1");
  constexpr std::uint32_t kMayShine = 0x5AA5C33C;
  HeadRig rig;
  rig.driver.permit_laser(true);
  TimeUs now_us = kHeadStartUs;
  const auto lit_with = [&](std::uint32_t word) {
    rig.memory.laser.store(word);
    rig.memory.beats.store(rig.memory.beats.load() + 1);
    rig.head.run(++now_us, rig.memory);
    return rig.says_lit();
  };
  EXPECT_EQ(rig.result_of(lcs::encode(rig.next_sequence(), lcs::StartCommand{}), now_us), lcs::Result::kDone);
  for (int bit = 0; bit < 32; ++bit) {
    EXPECT_TRUE(lit_with(kMayShine));
    EXPECT_FALSE(lit_with(kMayShine ^ (std::uint32_t{1} << bit))) << bit;
  }
  for (const std::uint32_t word : {0xA5A5A5A5U, 0xFFFFFFFFU, 0x3CC3A55AU, 1U}) EXPECT_FALSE(lit_with(word)) << word;
}

TEST(MemoryHead, IsDarkFromAnInhibitToTheNextStartWhateverTheWordSays) {
  VERIFIES("LASSO-LCS-023~1");
  HeadRig rig;
  rig.driver.permit_laser(true);
  EXPECT_EQ(rig.result_of(lcs::encode(rig.next_sequence(), lcs::StartCommand{})), lcs::Result::kDone);
  EXPECT_TRUE(rig.says_lit());
  EXPECT_EQ(rig.result_of(lcs::encode(rig.next_sequence(), lcs::LaserCommand::kFire)), lcs::Result::kUnknown);
  EXPECT_TRUE(rig.says_lit());
  EXPECT_EQ(rig.result_of(lcs::encode(rig.next_sequence(), lcs::LaserCommand::kInhibit)), lcs::Result::kDone);
  EXPECT_EQ(rig.memory.laser.load(), lcs::kLaserMayShine);
  EXPECT_FALSE(rig.says_lit());
  EXPECT_EQ(rig.result_of(lcs::encode(rig.next_sequence(), lcs::Type::kAbort)), lcs::Result::kDone);
  EXPECT_FALSE(rig.says_lit());
  EXPECT_EQ(rig.result_of(lcs::encode(rig.next_sequence(), lcs::StartCommand{})), lcs::Result::kDone);
  EXPECT_TRUE(rig.says_lit());
}

TEST(MemoryHead, RefusesWhatItCannotScan) {
  HeadRig rig;
  rig.driver.permit_laser(true);
  lcs::StartCommand wide, crowded;
  wide.plan.half_x = 1;
  crowded.aimed = kMaxAimedRays + 1;
  EXPECT_EQ(rig.result_of(lcs::encode(rig.next_sequence(), wide)), lcs::Result::kBadPlan);
  EXPECT_EQ(rig.result_of(lcs::encode(rig.next_sequence(), crowded)), lcs::Result::kBadPlan);
  EXPECT_EQ(rig.result_of(lcs::encode(rig.next_sequence(), lcs::Type::kSelfTest)), lcs::Result::kUnknown);
  EXPECT_EQ(rig.result_of(lcs::encode(rig.next_sequence(), lcs::StartCommand{})), lcs::Result::kDone);
  EXPECT_EQ(rig.result_of(lcs::encode(static_cast<std::uint8_t>(rig.next_sequence() + 1), lcs::StartCommand{})), lcs::Result::kUnknown)
      << "another command's";
  lcs::FrameBytes damaged = lcs::encode(rig.next_sequence(), lcs::StartCommand{});
  damaged.bytes[9] ^= 1;
  EXPECT_EQ(rig.result_of(damaged), lcs::Result::kUnknown);
}

TEST(MemoryHead, RefusesOpticsThatAreNotValid) {
  const HeadScene scene;
  LcsCamera bad = head_of(lcs::Device::kLaserCamera);
  bad.truth.baseline_m = 0;
  EXPECT_THROW(MemoryHead(*scene.caster, scene.motion, noisy_head(), kHeadSeed, bad), std::invalid_argument);
}

}  // namespace
}  // namespace lasso::sim
