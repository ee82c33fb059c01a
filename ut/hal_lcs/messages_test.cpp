#include "hal_lcs/messages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fsw/sense/pattern.hpp"
#include "ut/hal_lcs/received.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::lcs {
namespace {

// The same bytes again from what was understood.
template <class Message>
void expect_same_again(const FrameBytes& bytes) {
  const Frame frame = received(bytes);
  Message message{};
  ASSERT_EQ(decode(frame, message), Status::kOk);
  const FrameBytes again = encode(frame.sequence, message);
  EXPECT_EQ(std::vector<std::uint8_t>(bytes.bytes, bytes.bytes + bytes.size),
            std::vector<std::uint8_t>(again.bytes, again.bytes + again.size));
}

// A payload of each other length is refused.
template <class Message>
void expect_other_lengths_refused(const FrameBytes& bytes) {
  for (std::uint8_t length = 0; length <= kMaxPayload; ++length) {
    Frame frame = received(bytes);
    if (length == frame.length) continue;
    frame.length = length;
    Message message{};
    EXPECT_EQ(decode(frame, message), Status::kBadLength) << int{length};
  }
}

RawSample random_sample(test::Generator& chance, std::uint32_t base_us) {
  RawSample sample;
  sample.clock_us = base_us + static_cast<std::uint32_t>(chance.bits() % 65536);
  sample.angle_x_rad = chance.uniform(-1, 1);
  sample.angle_y_rad = chance.uniform(-1, 1);
  sample.peak = chance.uniform(-1, 1);
  sample.intensity = static_cast<std::uint8_t>(chance.below(16));
  sample.flight_us = chance.uniform(0, kMaxFlightUs);
  sample.kind = static_cast<SampleKind>(chance.bits() % 5);
  return sample;
}

Samples random_samples(test::Generator& chance, std::size_t count) {
  Samples samples;
  samples.tag = static_cast<std::uint8_t>(chance.bits());
  samples.first = static_cast<std::uint16_t>(chance.bits());
  samples.count = count;
  const auto base_us = static_cast<std::uint32_t>(chance.bits());
  for (std::size_t i = 0; i < count; ++i) samples.samples[i] = random_sample(chance, base_us);
  samples.samples[0].clock_us = base_us;
  return samples;
}

ScanPlan random_plan(test::Generator& chance) {
  ScanPlan plan;
  plan.scan_id = static_cast<std::uint32_t>(chance.bits());
  plan.kind = static_cast<PatternKind>(chance.bits() % 3);
  plan.points = static_cast<std::uint16_t>(chance.bits() % kMaxRays);
  plan.cycles_a = static_cast<std::uint16_t>(chance.bits());
  plan.cycles_b = static_cast<std::uint16_t>(chance.bits());
  plan.phase_turns = chance.uniform(0, 1);
  plan.center_x = chance.uniform(-1, 1);
  plan.center_y = chance.uniform(-1, 1);
  plan.half_x = chance.uniform(0, 1);
  plan.half_y = chance.uniform(0, 1);
  plan.duration_us = static_cast<DurationUs>(chance.bits() % static_cast<std::uint64_t>(kMaxScanDurationUs));
  return plan;
}

using Wire = std::vector<std::uint8_t>;
Wire payload(const FrameBytes& bytes) {
  const Frame frame = received(bytes);
  return Wire(frame.payload, frame.payload + frame.length);
}

// Worked out by hand from docs/icd/lcs.md; 0.5 is 3F000000, -2 is C0000000 in binary32.
TEST(LcsMessages, CommandsAreTheBytesOfTheInterfaceDocument) {
  VERIFIES("LASSO-LCS-001~1");
  EXPECT_EQ(encode(0, Type::kSelfTest).bytes[3], 0x01);
  EXPECT_EQ(encode(0, Type::kAskStatus).bytes[3], 0x02);
  EXPECT_EQ(encode(0, LaserCommand::kArm).bytes[3], 0x03);
  EXPECT_EQ(payload(encode(0, LaserCommand::kInhibit)), Wire{0x00});
  EXPECT_EQ(payload(encode(0, LaserCommand::kArm)), Wire{0x5A});
  EXPECT_EQ(payload(encode(0, LaserCommand::kFire)), Wire{0xA5});
  AimCommand aim;
  aim.first = 0x0102;
  aim.count = 2;
  aim.rays[0] = {0.5F, -2.0F};
  aim.rays[1] = {-2.0F, 0.5F};
  EXPECT_EQ(encode(0, aim).bytes[3], 0x10);
  EXPECT_EQ(payload(encode(0, aim)), (Wire{1, 2, 0x3F, 0, 0, 0, 0xC0, 0, 0, 0, 0xC0, 0, 0, 0, 0x3F, 0, 0, 0}));
  StartCommand start;
  start.plan.scan_id = 0x01020304;
  start.plan.kind = PatternKind::kLissajous;
  start.plan.points = 0x0506;
  start.plan.cycles_a = 0x0708;
  start.plan.cycles_b = 0x090A;
  start.plan.phase_turns = 0.75;
  start.plan.center_x = 0.5;
  start.plan.center_y = -2;
  start.plan.half_x = 0.25;
  start.plan.half_y = 1;
  start.plan.duration_us = 0x0B0C0D;
  start.delay_us = 0x0E0F;
  start.aimed = 0x1011;
  EXPECT_EQ(encode(0, start).bytes[3], 0x11);
  EXPECT_EQ(payload(encode(0, start)), (Wire{1, 2, 3,    4,    1, 5, 6,    7,    8, 9, 10, 0xC0, 0,  0,  0, 0x3F, 0,  0,  0,  0xC0, 0,
                                             0, 0, 0x3E, 0x80, 0, 0, 0x3F, 0x80, 0, 0, 0,  11,   12, 13, 0, 0,    14, 15, 16, 17}));
}

TEST(LcsMessages, WhatTheCameraSaysIsTheBytesOfTheInterfaceDocument) {
  VERIFIES("LASSO-LCS-001~1");
  const Answer answer{Type::kStart, 0x42, Result::kBadPlan, 0x01020304};
  EXPECT_EQ(encode(0, answer).bytes[3], 0x81);
  EXPECT_EQ(payload(encode(0, answer)), (Wire{0x11, 0x42, 5, 1, 2, 3, 4}));
  CameraStatus status;
  status.serial = 0x01020304;
  status.boots = 0x05060708;
  status.clock_us = 0x090A0B0C;
  status.temperature_degC = -1.5F;  // -150 = FF6A
  status.laser_lit = true;
  status.scanning = true;
  status.faults = 0x14;
  status.device = Device::kTridar;
  EXPECT_EQ(encode(0, status).bytes[3], 0x82);
  EXPECT_EQ(payload(encode(0, status)), (Wire{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0xFF, 0x6A, 3, 0x14, 2, 2}));
  Samples samples;
  samples.tag = 0x77;
  samples.first = 0x0102;
  samples.count = 2;
  samples.samples[0] = {0xFFFFFFFE, 0.5, -0.5, 1.0 / 8388608, 0, 15, SampleKind::kReturn};
  samples.samples[1] = {0x00000001, -1.0 / 8388608, 0, -1, 0, 3, SampleKind::kSaturated};  // 3 us later
  EXPECT_EQ(encode(0, samples).bytes[3], 0x91);
  EXPECT_EQ(payload(encode(0, samples)), (Wire{0x77, 1, 2,    0xFF, 0xFF, 0xFF, 0xFE, 0,    0, 0x40, 0, 0,    0xC0, 0, 0,   0,
                                               0,    1, 0x0F, 0,    3,    0xFF, 0xFF, 0xFF, 0, 0,    0, 0x80, 0,    0, 0x23}));
  samples.count = 1;
  samples.samples[0] = {0xFFFFFFFE, 0.5, -0.5, 0, 4 + 3.0 / 2097152, 15, SampleKind::kEcho};
  EXPECT_EQ(payload(encode(0, samples)), (Wire{0x77, 1, 2, 0xFF, 0xFF, 0xFF, 0xFE, 0, 0, 0x40, 0, 0, 0xC0, 0, 0, 0x80, 0, 3, 0x4F}));
  const ScanEnd end{0x77, 0x0102, true};
  EXPECT_EQ(encode(0, end).bytes[3], 0x92);
  EXPECT_EQ(payload(encode(0, end)), (Wire{0x77, 1, 2, 1}));
}

TEST(LcsMessages, ComeBackToTheByte) {
  VERIFIES("LASSO-LCS-001~1");
  test::Generator chance(99);
  for (int round = 0; round < 100; ++round) {
    const auto sequence = static_cast<std::uint8_t>(chance.bits());
    for (const LaserCommand laser : {LaserCommand::kInhibit, LaserCommand::kArm, LaserCommand::kFire})
      expect_same_again<LaserCommand>(encode(sequence, laser));
    AimCommand aim;
    aim.first = static_cast<std::uint16_t>(chance.bits());
    aim.count = 1 + chance.below(kAimedPerFrame);
    for (AimedRay& ray : aim.rays) ray = {static_cast<float>(chance.uniform(-1, 1)), static_cast<float>(chance.uniform(-1, 1))};
    expect_same_again<AimCommand>(encode(sequence, aim));
    expect_same_again<StartCommand>(encode(
        sequence, StartCommand{static_cast<std::uint32_t>(chance.bits()), static_cast<std::uint16_t>(chance.bits()), random_plan(chance)}));
    expect_same_again<Answer>(encode(sequence, Answer{static_cast<Type>(chance.bits() & 0xFF), static_cast<std::uint8_t>(chance.bits()),
                                                      static_cast<Result>(chance.bits() % 7), static_cast<std::uint32_t>(chance.bits())}));
    expect_same_again<CameraStatus>(
        encode(sequence, CameraStatus{static_cast<std::uint32_t>(chance.bits()), static_cast<std::uint32_t>(chance.bits()),
                                      static_cast<std::uint32_t>(chance.bits()), static_cast<float>(chance.uniform(-300, 300)),
                                      chance.bits() % 2 == 0, chance.bits() % 2 == 0, static_cast<std::uint8_t>(chance.bits()),
                                      static_cast<std::uint8_t>(chance.bits()), static_cast<Device>(chance.bits() % 3)}));
    expect_same_again<Samples>(encode(sequence, random_samples(chance, 1 + chance.bits() % kSamplesPerFrame)));
    expect_same_again<ScanEnd>(encode(
        sequence, ScanEnd{static_cast<std::uint8_t>(chance.bits()), static_cast<std::uint16_t>(chance.bits()), chance.bits() % 2 == 0}));
  }
}

TEST(LcsMessages, SamplesKeepTheirValuesToHalfAStep) {
  VERIFIES("LASSO-LCS-001~1");
  test::Generator chance(7);
  for (int round = 0; round < 200; ++round) {
    const Samples sent = random_samples(chance, kSamplesPerFrame);
    Samples got;
    ASSERT_EQ(decode(received(encode(0, sent)), got), Status::kOk);
    EXPECT_EQ(got.tag, sent.tag);
    EXPECT_EQ(got.first, sent.first);
    ASSERT_EQ(got.count, sent.count);
    for (std::size_t i = 0; i < sent.count; ++i) {
      EXPECT_EQ(got.samples[i].clock_us, sent.samples[i].clock_us);
      EXPECT_NEAR(got.samples[i].angle_x_rad, sent.samples[i].angle_x_rad, 1.01 * std::ldexp(1, -24));
      EXPECT_NEAR(got.samples[i].angle_y_rad, sent.samples[i].angle_y_rad, 1.01 * std::ldexp(1, -24));
      const bool echo = sent.samples[i].kind == SampleKind::kEcho;
      EXPECT_NEAR(got.samples[i].peak, echo ? 0 : sent.samples[i].peak, 1.01 * std::ldexp(1, -24));
      EXPECT_NEAR(got.samples[i].flight_us, echo ? sent.samples[i].flight_us : 0, 1.01 * std::ldexp(1, -22));
      EXPECT_EQ(got.samples[i].intensity, sent.samples[i].intensity);
      EXPECT_EQ(got.samples[i].kind, sent.samples[i].kind);
    }
  }
}

TEST(LcsMessages, WhatIsOffTheScaleStaysAtItsEnd) {
  VERIFIES("LASSO-LCS-014~2");
  Samples sent = {};
  sent.count = 2;
  sent.samples[0].angle_x_rad = 3;
  sent.samples[0].peak = -3;
  sent.samples[1].angle_x_rad = -3;
  sent.samples[1].angle_y_rad = std::nan("");
  sent.samples[1].peak = 3;
  Samples got;
  ASSERT_EQ(decode(received(encode(0, sent)), got), Status::kOk);
  EXPECT_NEAR(got.samples[0].angle_x_rad, 1, 2e-7);
  EXPECT_EQ(got.samples[0].peak, -1);
  EXPECT_EQ(got.samples[1].angle_x_rad, -1);
  EXPECT_EQ(got.samples[1].angle_y_rad, -1);
  EXPECT_NEAR(got.samples[1].peak, 1, 2e-7);
  for (RawSample& sample : sent.samples) sample.kind = SampleKind::kEcho;
  sent.samples[0].flight_us = -1;
  sent.samples[1].flight_us = 9;
  ASSERT_EQ(decode(received(encode(0, sent)), got), Status::kOk);
  EXPECT_EQ(got.samples[0].flight_us, 0);
  EXPECT_EQ(got.samples[1].flight_us, kMaxFlightUs);
}

TEST(LcsMessages, APhaseBelowOneTurnStaysBelow) {
  StartCommand sent;
  sent.plan.phase_turns = std::nextafter(1.0, 0.0);
  StartCommand got;
  ASSERT_EQ(decode(received(encode(0, sent)), got), Status::kOk);
  EXPECT_LT(got.plan.phase_turns, 1);
  EXPECT_EQ(validate(got.plan), Status::kOk);
}

TEST(LcsMessages, OtherLengthsAreRefused) {
  VERIFIES("LASSO-LCS-014~2");
  expect_other_lengths_refused<LaserCommand>(encode(0, LaserCommand::kArm));
  expect_other_lengths_refused<StartCommand>(encode(0, StartCommand{}));
  expect_other_lengths_refused<Answer>(encode(0, Answer{}));
  expect_other_lengths_refused<CameraStatus>(encode(0, CameraStatus{}));
  expect_other_lengths_refused<ScanEnd>(encode(0, ScanEnd{}));
  for (std::uint8_t length = 0; length <= kMaxPayload; ++length) {
    Frame frame;
    frame.length = length;
    Samples samples;
    AimCommand aim;
    EXPECT_EQ(decode(frame, samples) == Status::kOk, length > 7 && length <= 7 + 4 * 12 && (length - 7) % 12 == 0) << int{length};
    EXPECT_EQ(decode(frame, aim) == Status::kOk, length > 2 && length <= 2 + 6 * 8 && (length - 2) % 8 == 0) << int{length};
  }
}

TEST(LcsMessages, CodesThatAreNotDefinedAreRefused) {
  VERIFIES("LASSO-LCS-014~2");
  const auto refuses = [](Frame frame, std::size_t place, std::uint8_t code, auto message) {
    frame.payload[place] = code;
    return decode(frame, message) == Status::kBadValue;
  };
  EXPECT_TRUE(refuses(received(encode(0, LaserCommand::kArm)), 0, 1, LaserCommand{}));
  EXPECT_TRUE(refuses(received(encode(0, Answer{})), 2, 8, Answer{}));
  EXPECT_TRUE(refuses(received(encode(0, ScanEnd{})), 3, 2, ScanEnd{}));
  Samples samples;
  samples.count = 2;
  EXPECT_TRUE(refuses(received(encode(0, samples)), 7 + 11, 0x50, Samples{}));  // the first 4 bits of the first sample's last byte
}

TEST(LcsMessages, AKindOfHeadThatIsNotDefinedIsUnknown) {
  VERIFIES("LASSO-LCS-014~2");
  for (const std::uint8_t device : {std::uint8_t{3}, std::uint8_t{0xFE}, std::uint8_t{0xFF}}) {
    Frame frame = received(encode(0, CameraStatus{}));
    frame.payload[17] = device;
    CameraStatus status;
    EXPECT_EQ(decode(frame, status), Status::kOk);
    EXPECT_EQ(status.device, Device::kUnknown);
  }
}

TEST(LcsMessages, CommandsWithoutPayloadAreHeadersAlone) {
  const Frame frame = received(encode(9, Type::kAbort));
  EXPECT_EQ(frame.type, 0x12);
  EXPECT_EQ(frame.sequence, 9);
  EXPECT_EQ(frame.length, 0);
}

TEST(LcsMessagesDeath, CountsThatNoFrameHolds) {
  Samples samples;
  EXPECT_DEATH(encode(0, samples), "lcs samples");
  samples.count = kSamplesPerFrame + 1;
  EXPECT_DEATH(encode(0, samples), "lcs samples");
  samples.count = 2;
  samples.samples[1].clock_us = 65'536;
  EXPECT_DEATH(encode(0, samples), "lcs sample time");
  AimCommand aim;
  aim.count = kAimedPerFrame + 1;
  EXPECT_DEATH(encode(0, aim), "lcs aimed rays");
}

}  // namespace
}  // namespace lasso::lcs
