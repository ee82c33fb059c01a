// A head at memory, whose end of it a test writes by hand, and the driver at the other end.
#pragma once

#include <vector>

#include "hal_lcs/head_driver.hpp"
#include "ut/hal_lcs/driver_fixture.hpp"

namespace lasso::lcs {

inline constexpr TimeUs kFirstUs = kStartUs + kStartDelayUs, kLaterUs = kStartUs + 45'000;

// The head's end of the memory, by hand: what it does is what a test says.
class Head {
 public:
  explicit Head(HeadMemory& memory) : memory_(memory) {}

  Frame command() const {
    Frame frame;
    EXPECT_TRUE(memory_.command.load(frame));
    return frame;
  }
  bool is_inhibited() const {
    LaserCommand said = LaserCommand::kFire;
    return command().type == static_cast<std::uint8_t>(Type::kLaser) && decode(command(), said) == Status::kOk &&
           said == LaserCommand::kInhibit;
  }
  std::uint16_t number() const { return value_of(memory_.commands.load()); }
  void say(bool scanning) {
    CameraStatus said = status;
    said.scanning = scanning;
    memory_.status.store(encode(sequence_of(number()), said));
  }
  void answer(Result result = Result::kDone) { memory_.answer.store(numbered(number(), static_cast<std::uint16_t>(result))); }
  void count(std::uint16_t samples) { memory_.samples.store(numbered(number(), samples)); }
  // Records of a wall across the boresight, up to ray `end`.
  void measure(const ScanPlan& plan, std::uint16_t end) {
    for (std::uint16_t ray = 0; ray < end; ++ray) {
      RawSample raw = wall_.wall(plan, ray, 1).samples[0];
      record(ray, raw, static_cast<std::uint32_t>(kFirstUs + pattern_time_us(plan, ray)));
    }
    count(end);
  }
  void record(std::uint16_t ray, const RawSample& sample, std::uint32_t clock_us) {
    RawSample raw = sample;
    raw.clock_us = clock_us;
    ByteWriter out{Bytes(memory_.records[ray])};
    out.u32(clock_us);
    write_sample(out, raw, clock_us);
  }

  CameraStatus status;

 private:
  HeadMemory& memory_;
  Line line_;
  Camera wall_{line_};
};

class LcsHeadDriver : public ::testing::Test {
 protected:
  LcsHeadDriver() {
    head.status.serial = kSerial;
    head.status.boots = 1;
    head.status.temperature_degC = 22;
    driver.permit_laser(true);
  }
  void begin(const ScanPlan& of) {
    ASSERT_EQ(driver.start(of, kStartUs), Status::kOk);
    head.say(true);
    head.count(0);
    head.answer();
  }
  SensorPoll poll(TimeUs now_us = kLaterUs) {
    const SensorPoll result = driver.poll(now_us, Span<RangeSample>(out));
    samples.insert(samples.end(), out, out + result.count);
    return result;
  }
  // A scan that ends for a reason that the head gives.
  void expect_lost(Status reason) {
    EXPECT_EQ(poll().status, reason);
    EXPECT_EQ(head.command().type, static_cast<std::uint8_t>(Type::kAbort));
    EXPECT_EQ(poll().status, Status::kNoData);
  }

  HeadMemory memory;
  HeadDriver driver{memory, Optics(calibration())};
  Head head{memory};
  ScanPlan plan = small_plan();
  RangeSample out[kMaxSamplesPerPoll];
  std::vector<RangeSample> samples;
};

}  // namespace lasso::lcs
