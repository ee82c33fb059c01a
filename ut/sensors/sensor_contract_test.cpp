// What every implementation of the Sensor interface owes the acquisition task, asked of each of them.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fsw/sense/pattern.hpp"
#include "hal_sim/lcs_device.hpp"
#include "hal_sim/lcs_direct.hpp"
#include "hal_sim/memory_head.hpp"
#include "hal_sim/ray_caster.hpp"
#include "hal_sim/replay_sensor.hpp"
#include "hal_sim/scanner.hpp"
#include "ut/hal_sim/shapes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

const Vec3 kHalf(0.66, 0.21, 0.3);
constexpr TimeUs kStartUs = 3'000'000;
constexpr DurationUs kLatestUs = 2'000;  // from the start to the first sample, beyond the plan's times

// The box by its equations, so that the suite runs where there is no library of ray casting.
class BoxCaster final : public RayCaster {
 public:
  RayHit cast(const Vec3& origin_m, const Vec3& direction) const override {
    RayHit hit;
    hit.range_m = test::box_range(kHalf, origin_m, direction);
    hit.hit = hit.range_m < test::kNoHit;
    if (!hit.hit) return hit;
    const Vec3 place = (origin_m + hit.range_m * direction).cwiseQuotient(kHalf);
    Eigen::Index axis = 0;
    place.cwiseAbs().maxCoeff(&axis);
    hit.normal = Vec3::Unit(axis) * (place[axis] < 0 ? -1 : 1);
    return hit;
  }
};

struct Target {
  std::unique_ptr<RayCaster> caster = std::make_unique<BoxCaster>();
  ConstantTwist motion{{{upright_attitude(0.26, 0.09) * exp_so3(Vec3(0.7, 0, 0)), Vec3(0.02, -0.01, 4)}, {}}, 0};

  double range_m(const Vec3& direction) const {
    const Pose T_target_sensor = inverse(motion.at(0).T_sensor_target);
    return test::box_range(kHalf, T_target_sensor.p, rotate(T_target_sensor.q, direction));
  }
};

struct LcsSensor {
  LcsDevice device;
  LcsOverLine line;
  LcsSensor(const Target& target, const LcsCamera& camera)
      : device(*target.caster, target.motion, ScannerModel{}, 5, camera), line(device, optics_of(camera), camera.bits_per_s) {
    line.permit_laser(true);
  }
};

ScanPlan plan_of(std::uint16_t points = 1024) {
  ScanPlan plan;
  plan.scan_id = 41;
  plan.points = points;
  plan.phase_turns = 0.381966;
  plan.center_x = 0.01;
  plan.half_x = 0.15;
  plan.half_y = 0.2;
  return plan;
}

// A sensor in front of the target, and what keeps it alive.
struct Rig {
  std::shared_ptr<void> owner;
  Sensor* sensor;
};
struct Kind {
  const char* name;
  double step_m;  // how far off a range may be
  std::function<Rig(const Target&)> make;
};

Rig simulated(const Target& target) {
  const auto scanner = std::make_shared<SimulatedScanner>(*target.caster, target.motion, ScannerModel{}, 5);
  return {scanner, scanner.get()};
}

LcsCamera head(lcs::Device device) {
  LcsCamera camera;
  camera.device = device;
  camera.truth.serial = camera.clock.serial = 3;
  camera.truth.residual[3] = 1e-3;
  camera.clock.delay_us = 0.01;
  camera.clock.clock_error = 1e-5;
  camera.hand_over_m = 3.8;  // the box has both sides of it
  return camera;
}

Rig over_the_line(const Target& target, double bits_per_s, lcs::Device device = lcs::Device::kLaserCamera) {
  LcsCamera camera = head(device);
  camera.bits_per_s = bits_per_s;
  const auto lcs = std::make_shared<LcsSensor>(target, camera);
  return {lcs, &lcs->line};
}

struct HeadSensor {
  MemoryHead head;
  SensorInMemory sensor;
  HeadSensor(const Target& target, const LcsCamera& camera)
      : head(*target.caster, target.motion, ScannerModel{}, 5, camera), sensor(head, optics_of(camera)) {
    sensor.permit_laser(true);
  }
};

Rig in_memory(const Target& target) {
  const auto own = std::make_shared<HeadSensor>(target, head(lcs::Device::kTridar));
  return {own, &own->sensor};
}

Rig direct(const Target& target) {
  const auto lcs = std::make_shared<LcsDirect>(*target.caster, target.motion, ScannerModel{}, 5, head(lcs::Device::kTridar));
  return {lcs, lcs.get()};
}

AimedRays aimed_rays() {
  AimedRays rays;
  for (int i = 0; i < 300; ++i) static_cast<void>(rays.push_back({0.0004F * static_cast<float>(i) - 0.06F, 0.02F}));
  return rays;
}

ScanPlan slow_plan() {
  ScanPlan plan = plan_of(16);
  plan.duration_us = 1'000'000;  // 67 ms from ray to ray
  plan.cycles_a = 5;
  plan.cycles_b = 3;
  return plan;
}

// What the suite asks for, recorded from the simulated scanner and played back.
struct Replay {
  SensorRecording recording;
  ReplaySensor sensor{recording, 0};
  explicit Replay(const Target& target) {
    const AimedRays rays = aimed_rays();
    ScanPlan aimed = plan_of();
    aimed.aimed = rays.span();
    SimulatedScanner scanner(*target.caster, target.motion, ScannerModel{}, 5);
    SensorRecorder recorder(scanner, 0, recording);
    for (const ScanPlan& plan : {plan_of(), slow_plan(), plan_of(200), aimed, plan_of(100), plan_of(300)}) record(recorder, plan);
    const std::vector<std::uint8_t> bytes = to_bytes(recording);
    recording = recording_of(ConstBytes(bytes.data(), bytes.size()));
  }

 private:
  static void record(Sensor& recorder, const ScanPlan& plan) {
    std::vector<RangeSample> out(plan.points);
    EXPECT_EQ(recorder.start(plan, 5), Status::kOk);
    EXPECT_TRUE(recorder.poll(plan.duration_us + 5, {out.data(), out.size()}).complete);
  }
};

Rig replayed(const Target& target) {
  const auto replay = std::make_shared<Replay>(target);
  return {replay, &replay->sensor};
}

class SensorContract : public ::testing::TestWithParam<Kind> {
 protected:
  // Polls every `step_us` until the scan's end or `until_us`.
  std::vector<RangeSample> collect(const ScanPlan& plan, TimeUs t_start_us, DurationUs step_us = 10'000,
                                   std::size_t room = kMaxSamplesPerPoll) {
    std::vector<RangeSample> samples, buffer(room);
    bool complete = false;
    for (TimeUs now_us = t_start_us; !complete && now_us <= t_start_us + plan.duration_us + 20'000; now_us += step_us) {
      std::size_t count = room;
      while (count == room && !complete) {
        const SensorPoll poll = sensor.poll(now_us, {buffer.data(), room});
        EXPECT_EQ(poll.status, Status::kOk);
        count = poll.count;
        complete = poll.complete;
        for (std::size_t i = 0; i < count; ++i) EXPECT_LE(buffer[i].t_us, now_us);
        samples.insert(samples.end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(count));
      }
    }
    EXPECT_TRUE(complete);
    return samples;
  }

  Status poll_status(TimeUs now_us) {
    RangeSample out[kMaxSamplesPerPoll];
    return sensor.poll(now_us, Span<RangeSample>(out)).status;
  }

  void expect_the_box(const ScanPlan& plan, const std::vector<RangeSample>& samples, TimeUs t_start_us) const {
    ASSERT_EQ(samples.size(), plan.points);
    for (std::uint16_t ray = 0; ray < plan.points; ++ray) {
      const RangeSample& sample = samples[ray];
      const Vec3 u = pattern_direction(plan, ray);
      for (int k = 0; k < 3; ++k) ASSERT_NEAR(static_cast<double>(sample.direction[k]), u[k], 1e-6) << ray;
      const DurationUs late_us = sample.t_us - t_start_us - pattern_time_us(plan, ray);
      ASSERT_TRUE(late_us >= 0 && late_us <= kLatestUs) << late_us;
      const double range_m = target.range_m(u);
      ASSERT_EQ(sample.state, range_m < test::kNoHit ? RayState::kHit : RayState::kMiss) << ray;
      if (sample.state != RayState::kHit) continue;
      ASSERT_NEAR(static_cast<double>(sample.range_m), range_m, GetParam().step_m) << ray;
    }
  }

  Target target;
  Rig rig = GetParam().make(target);
  Sensor& sensor = *rig.sensor;
};

TEST_P(SensorContract, ScansThePlanRayByRay) {
  VERIFIES("LASSO-SNS-031~1 LASSO-SYS-018~2 LASSO-LCS-003~1 LASSO-LCS-007~2 LASSO-LCS-016~2 LASSO-LCS-022~2");
  const ScanPlan plan = plan_of();
  ASSERT_EQ(sensor.start(plan, kStartUs), Status::kOk);
  expect_the_box(plan, collect(plan, kStartUs), kStartUs);
}

TEST_P(SensorContract, ScansSlowly) {
  const ScanPlan plan = slow_plan();
  ASSERT_EQ(sensor.start(plan, kStartUs), Status::kOk);
  expect_the_box(plan, collect(plan, kStartUs), kStartUs);
}

TEST_P(SensorContract, KeepsWhatIsNotTaken) {
  const ScanPlan plan = plan_of(200);
  ASSERT_EQ(sensor.start(plan, kStartUs), Status::kOk);
  expect_the_box(plan, collect(plan, kStartUs, 50'000, 7), kStartUs);
}

TEST_P(SensorContract, AimsTheRaysThatLeaveThePattern) {
  const AimedRays aimed = aimed_rays();
  ScanPlan plan = plan_of();
  plan.aimed = aimed.span();
  ASSERT_EQ(sensor.start(plan, kStartUs), Status::kOk);
  expect_the_box(plan, collect(plan, kStartUs), kStartUs);
}

TEST_P(SensorContract, RefusesASecondStartAndGoesOn) {
  const ScanPlan plan = plan_of(100);
  ASSERT_EQ(sensor.start(plan, kStartUs), Status::kOk);
  EXPECT_EQ(sensor.start(plan_of(50), kStartUs), Status::kBusy);
  expect_the_box(plan, collect(plan, kStartUs), kStartUs);
}

TEST_P(SensorContract, RefusesPlansThatAreNotValid) {
  ScanPlan bad = plan_of();
  bad.half_x = -1;
  EXPECT_EQ(sensor.start(bad, kStartUs), validate(bad));
  EXPECT_EQ(poll_status(kStartUs), Status::kNoData);
}

TEST_P(SensorContract, APlanOutsideItsFieldGivesNoScan) {
  ScanPlan wide = plan_of();
  wide.half_x = 1;
  Status status = sensor.start(wide, kStartUs);
  for (TimeUs now_us = kStartUs; status == Status::kOk && now_us < kStartUs + 20'000; now_us += 5'000) status = poll_status(now_us);
  EXPECT_EQ(status, Status::kBadValue);
  ASSERT_EQ(sensor.start(plan_of(100), kStartUs + 200'000), Status::kOk);
  expect_the_box(plan_of(100), collect(plan_of(100), kStartUs + 200'000), kStartUs + 200'000);
}

TEST_P(SensorContract, AnAbortedScanLeavesNothingBehind) {
  ASSERT_EQ(sensor.start(plan_of(), kStartUs), Status::kOk);
  EXPECT_EQ(poll_status(kStartUs + 20'000), Status::kOk);
  sensor.abort();
  EXPECT_EQ(poll_status(kStartUs + 30'000), Status::kNoData);
  sensor.abort();
  ScanPlan next = plan_of(300);
  next.scan_id = 42;
  ASSERT_EQ(sensor.start(next, kStartUs + 200'000), Status::kOk);
  expect_the_box(next, collect(next, kStartUs + 200'000), kStartUs + 200'000);
}

TEST_P(SensorContract, IdleHasNoData) {
  EXPECT_EQ(poll_status(kStartUs), Status::kNoData);
  const ScanPlan plan = plan_of(100);
  ASSERT_EQ(sensor.start(plan, kStartUs), Status::kOk);
  collect(plan, kStartUs);
  EXPECT_EQ(poll_status(kStartUs + 300'000), Status::kNoData);
}

TEST_P(SensorContract, TheSameScanHasTheSameBits) {
  const ScanPlan plan = plan_of(300);
  const auto run = [&](Sensor& of) {
    std::vector<RangeSample> samples, buffer(kMaxSamplesPerPoll);
    EXPECT_EQ(of.start(plan, kStartUs), Status::kOk);
    for (bool complete = false; !complete;) {
      const SensorPoll poll = of.poll(kStartUs + 190'000, {buffer.data(), buffer.size()});
      EXPECT_EQ(poll.status, Status::kOk);
      samples.insert(samples.end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(poll.count));
      complete = poll.complete || poll.status != Status::kOk;
    }
    return samples;
  };
  const Rig other = GetParam().make(target);
  const std::vector<RangeSample> a = run(sensor), b = run(*other.sensor);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].range_m, b[i].range_m);
    EXPECT_EQ(a[i].t_us, b[i].t_us);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(a[i].direction[k], b[i].direction[k]);
  }
}

constexpr double kSpotStepM = 3e-5, kFlightStepM = 5e-5;

INSTANTIATE_TEST_SUITE_P(
    All, SensorContract,
    ::testing::Values(Kind{"simulated", kSpotStepM, simulated},
                      Kind{"lcs_4Mbit", kSpotStepM, [](const Target& target) { return over_the_line(target, 4e6); }},
                      Kind{"lcs_1Mbit", kSpotStepM, [](const Target& target) { return over_the_line(target, 1e6); }},
                      Kind{"lidar", kFlightStepM, [](const Target& target) { return over_the_line(target, 4e6, lcs::Device::kLidar); }},
                      Kind{"tridar", kFlightStepM, [](const Target& target) { return over_the_line(target, 4e6, lcs::Device::kTridar); }},
                      Kind{"direct", kFlightStepM, direct}, Kind{"in_memory", kFlightStepM, in_memory},
                      Kind{"replay", kSpotStepM, replayed}),
    [](const auto& kind) { return std::string(kind.param.name); });

}  // namespace
}  // namespace lasso::sim
