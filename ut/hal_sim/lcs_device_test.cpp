#include "hal_sim/lcs_device.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

#include "fsw/sense/pattern.hpp"
#include "ut/hal_sim/shapes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

const Vec3 kHalf(0.66, 0.21, 0.3);
constexpr DurationUs kPeriodUs = 200'000;
constexpr int kScans = 40;
constexpr TimeUs kBegin = kPeriodUs;

LcsCamera camera() {
  LcsCamera camera;
  camera.truth.serial = 3;
  camera.truth.angle_x_offset_rad = 0.001;
  camera.truth.residual[4] = 2e-3;
  camera.temperature_degC = 31;
  camera.truth.focal_length_per_K = 3e-5;
  return camera;
}

struct Tally {
  int whole = 0, lost = 0, short_of_samples = 0;
  std::uint32_t wrong_points = 0, hits = 0;
  lcs::Health health;
  lcs::FrameDecoder::Counters line;

  std::uint32_t lost_by(lcs::Loss loss) const { return health.scans_lost[static_cast<std::size_t>(loss)]; }
};

// Scans of a box by a camera that fails as told; a wrong point is one that is not where the box is along its own ray.
class Flight {
 public:
  explicit Flight(const LcsFaults& faults)
      : camera_(with(faults)), device_(*caster_, motion_, ScannerModel{}, 5, camera_), line_(device_, camera_.truth, camera_.bits_per_s) {}

  Tally fly() {
    for (int scan = 0; scan < kScans; ++scan) this->scan(kBegin + scan * kPeriodUs, static_cast<std::uint32_t>(scan));
    tally_.health = line_.driver().health();
    tally_.line = line_.driver().line_counters();
    return tally_;
  }

 private:
  static LcsCamera with(const LcsFaults& faults) {
    LcsCamera failing = camera();
    failing.faults = faults;
    return failing;
  }

  void scan(TimeUs t_us, std::uint32_t id) {
    ScanPlan plan;
    plan.scan_id = id;
    plan.half_x = 0.15;
    plan.half_y = 0.2;
    bool lost = line_.start(plan, t_us) != Status::kOk;
    bool complete = false;
    std::size_t there = 0;
    std::vector<RangeSample> out(kMaxSamplesPerPoll);
    for (TimeUs now_us = t_us; !lost && !complete && now_us < t_us + kPeriodUs; now_us += 2'000) {
      const SensorPoll poll = line_.poll(now_us, {out.data(), out.size()});
      lost = poll.status != Status::kOk;
      complete = poll.complete;
      for (std::size_t i = 0; i < poll.count && !lost; ++i) there += judge(out[i]);
    }
    if (!complete) line_.abort();
    tally_.lost += lost;
    tally_.whole += !lost && complete && there == plan.points;
    tally_.short_of_samples += !lost && (!complete || there < plan.points);
  }

  std::size_t judge(const RangeSample& sample) {
    if (sample.state == RayState::kHit) {
      const Vec3 u(static_cast<double>(sample.direction[0]), static_cast<double>(sample.direction[1]),
                   static_cast<double>(sample.direction[2]));
      const Pose T_target_sensor = inverse(motion_.at(0).T_sensor_target);
      const double truth_m = test::box_range(kHalf, T_target_sensor.p, rotate(T_target_sensor.q, u.normalized()));
      ++tally_.hits;
      if (!(std::abs(static_cast<double>(sample.range_m) - truth_m) < 5e-5)) ++tally_.wrong_points;
    }
    return sample.state == RayState::kLost ? 0 : 1;
  }

  test::ShapeMesh mesh_ = test::box_mesh(kHalf);
  std::unique_ptr<RayCaster> caster_ = make_ray_caster(mesh_.vertices, mesh_.triangles);
  ConstantTwist motion_{{{upright_attitude(0.26, 0.09) * exp_so3(Vec3(0.7, 0, 0)), Vec3(0.02, -0.01, 4)}, {}}, 0};
  LcsCamera camera_;
  LcsDevice device_;
  LcsOverLine line_;
  Tally tally_;
};

Tally fly(const LcsFaults& faults) { return Flight(faults).fly(); }

std::uint32_t all_lost(const lcs::Health& health) {
  return std::accumulate(std::begin(health.scans_lost), std::end(health.scans_lost), 0U);
}

TEST(LcsDevice, WithoutFaultsEachScanIsWhole) {
  VERIFIES("LASSO-LCS-003~1 LASSO-LCS-007~1");
  const Tally tally = fly({});
  EXPECT_EQ(tally.whole, kScans);
  EXPECT_EQ(tally.wrong_points, 0U);
  EXPECT_GT(tally.hits, 300U * kScans);
  EXPECT_EQ(all_lost(tally.health), 0U);
  EXPECT_EQ(tally.health.sequence_gaps + tally.health.bad_messages + tally.health.bad_times + tally.health.off_plan + tally.line.skipped,
            0U);
}

TEST(LcsDevice, DroppedFramesCostTheirSamples) {
  VERIFIES("LASSO-LCS-002~1 LASSO-LCS-011~1 LASSO-LCS-012~1");
  LcsFaults faults;
  faults.drop_probability = 0.02;
  const Tally tally = fly(faults);
  EXPECT_EQ(tally.wrong_points, 0U);
  EXPECT_GT(tally.short_of_samples, kScans / 2);
  EXPECT_GT(tally.health.samples_lost, 100U);
  EXPECT_GT(tally.health.sequence_gaps, 50U);
  EXPECT_GT(tally.hits, 280U * kScans);
}

TEST(LcsDevice, RepeatedFramesChangeNothing) {
  VERIFIES("LASSO-LCS-011~1");
  LcsFaults faults;
  faults.repeat_probability = 0.1;
  const Tally tally = fly(faults);
  EXPECT_EQ(tally.whole, kScans);
  EXPECT_EQ(tally.wrong_points, 0U);
  EXPECT_GT(tally.health.strayed, 100U);
}

TEST(LcsDevice, CorruptFramesAndALineOfManyBitErrorsGiveNoWrongPoint) {
  VERIFIES("LASSO-LCS-002~1 LASSO-LCS-011~1 LASSO-LCS-012~1");
  LcsFaults corrupt, noisy;
  corrupt.corrupt_probability = 0.05;
  noisy.bit_error_rate = 1e-4;
  for (const LcsFaults& faults : {corrupt, noisy}) {
    const Tally tally = fly(faults);
    EXPECT_EQ(tally.wrong_points, 0U);
    EXPECT_GT(tally.line.bad_crc, 100U);
    EXPECT_GT(tally.health.samples_lost, 100U);
    EXPECT_EQ(tally.whole + tally.short_of_samples + tally.lost, kScans);
    EXPECT_GE(tally.whole + tally.short_of_samples, kScans * 9 / 10);
    EXPECT_GE(all_lost(tally.health), static_cast<std::uint32_t>(tally.lost));
  }
}

TEST(LcsDevice, ASilentCameraLosesItsScansAndComesBack) {
  VERIFIES("LASSO-LCS-011~1 LASSO-LCS-012~1");
  LcsFaults faults;
  faults.silent_from_us = kBegin + 10 * kPeriodUs - 10'000;
  faults.silent_until_us = kBegin + 15 * kPeriodUs - 10'000;
  const Tally tally = fly(faults);
  EXPECT_EQ(tally.lost_by(lcs::Loss::kSilent), 5U);
  EXPECT_EQ(tally.lost, 5);
  EXPECT_EQ(tally.whole, kScans - 5);
  EXPECT_EQ(tally.wrong_points, 0U);
}

TEST(LcsDevice, AStuckMirrorLosesItsScans) {
  VERIFIES("LASSO-LCS-011~1 LASSO-LCS-012~1");
  LcsFaults faults;
  faults.stuck_from_us = kBegin + 10 * kPeriodUs;
  faults.stuck_until_us = kBegin + 15 * kPeriodUs;
  const Tally tally = fly(faults);
  EXPECT_EQ(tally.lost_by(lcs::Loss::kOffPlan), 5U);
  EXPECT_EQ(tally.whole, kScans - 5);
  EXPECT_EQ(tally.wrong_points, 0U);  // the mirrors' own angles are right
}

TEST(LcsDevice, ASaturatedDetectorMakesNoPoints) {
  VERIFIES("LASSO-LCS-011~1");
  LcsFaults faults;
  faults.saturated_from_us = kBegin;
  faults.saturated_until_us = kBegin + 100 * kPeriodUs;
  const Tally tally = fly(faults);
  EXPECT_EQ(tally.hits, 0U);
  EXPECT_GT(tally.health.fates[static_cast<std::size_t>(lcs::Triangulation::Fate::kNoStatement)], 300U * kScans);
}

TEST(LcsDevice, ABootCostsTheScanAndTheNextOnes) {
  VERIFIES("LASSO-LCS-006~1 LASSO-LCS-011~1 LASSO-LCS-012~1");
  LcsFaults faults;
  faults.boot_at_us = kBegin + 10 * kPeriodUs + 50'000;
  const Tally tally = fly(faults);
  EXPECT_EQ(tally.health.boots, 1U);
  EXPECT_GE(tally.whole, kScans - 4);
  EXPECT_EQ(tally.lost + tally.short_of_samples, kScans - tally.whole);
  EXPECT_GE(all_lost(tally.health), static_cast<std::uint32_t>(kScans - tally.whole));
  EXPECT_EQ(tally.wrong_points, 0U);
}

TEST(LcsDevice, AClockThatJumpsOrRunsFastCostsNoScan) {
  VERIFIES("LASSO-LCS-011~1");
  LcsFaults faults;
  faults.clock_jump_at_us = kBegin + 10 * kPeriodUs + 90'000;
  faults.clock_jump_us = -1'700'000;
  faults.clock_rate_error = 1e-3;
  const Tally tally = fly(faults);
  EXPECT_EQ(tally.health.clock_jumps, 1U);
  EXPECT_GE(tally.whole, kScans - 1);
  EXPECT_EQ(tally.wrong_points, 0U);
  EXPECT_GT(tally.health.bad_times, 0U);  // of the scan in which it jumped
}

TEST(LcsDevice, LateFramesLeaveTheScanShort) {
  VERIFIES("LASSO-LCS-011~1");
  LcsFaults faults;
  faults.late_us = 40'000;
  const Tally tally = fly(faults);
  EXPECT_EQ(tally.wrong_points, 0U);
  EXPECT_EQ(tally.lost, 0);
  EXPECT_EQ(tally.short_of_samples, kScans);  // the boundary comes before the last samples
  EXPECT_GT(tally.hits, 280U * kScans);
}

TEST(LcsDevice, FireWithoutArmIsRefused) {
  VERIFIES("LASSO-LCS-006~1");
  const test::ShapeMesh mesh = test::box_mesh(kHalf);
  const std::unique_ptr<RayCaster> caster = make_ray_caster(mesh.vertices, mesh.triangles);
  const ConstantTwist motion({{upright_attitude(0.26, 0.09), Vec3(0, 0, 4)}, {}}, 0);
  LcsDevice device(*caster, motion, ScannerModel{}, 5, camera());
  lcs::Line line;
  TimeUs now_us = 0;
  const auto ask = [&](const lcs::FrameBytes& frame) {
    EXPECT_EQ(line.to_camera.write(frame.span()), frame.size);
    device.listen(now_us, line);
    now_us += 10'000;
    device.run(now_us, line);
    lcs::FrameDecoder decoder;
    lcs::Frame got;
    lcs::Answer answer;
    std::uint8_t byte = 0;
    while (line.from_camera.read(Bytes(&byte, 1)) == 1) {
      if (!decoder.step(ConstBytes(&byte, 1), got).found) continue;
      EXPECT_EQ(lcs::decode(got, answer), Status::kOk);
    }
    return answer.result;
  };
  using lcs::LaserCommand;
  using lcs::Result;
  lcs::StartCommand start;
  EXPECT_EQ(ask(lcs::encode(0, start)), Result::kInhibited);
  EXPECT_EQ(ask(lcs::encode(1, LaserCommand::kFire)), Result::kNotArmed);
  EXPECT_EQ(ask(lcs::encode(2, LaserCommand::kArm)), Result::kDone);
  now_us += lcs::kArmedUs;
  EXPECT_EQ(ask(lcs::encode(3, LaserCommand::kFire)), Result::kNotArmed);
  EXPECT_EQ(ask(lcs::encode(4, LaserCommand::kArm)), Result::kDone);
  EXPECT_EQ(ask(lcs::encode(5, LaserCommand::kInhibit)), Result::kDone);
  EXPECT_EQ(ask(lcs::encode(6, LaserCommand::kFire)), Result::kNotArmed);
  EXPECT_EQ(ask(lcs::encode(7, LaserCommand::kArm)), Result::kDone);
  EXPECT_EQ(ask(lcs::encode(8, LaserCommand::kFire)), Result::kDone);
  EXPECT_EQ(ask(lcs::encode(9, lcs::Type::kStatus)), Result::kUnknown);  // no command
}

TEST(LcsDevice, OpticsThatCannotBeAreRefused) {
  const test::ShapeMesh mesh = test::box_mesh(kHalf);
  const std::unique_ptr<RayCaster> caster = make_ray_caster(mesh.vertices, mesh.triangles);
  const ConstantTwist motion({{upright_attitude(0.26, 0.09), Vec3(0, 0, 4)}, {}}, 0);
  LcsCamera bad = camera();
  bad.truth.baseline_m = 0;
  EXPECT_THROW(LcsDevice(*caster, motion, ScannerModel{}, 5, bad), std::invalid_argument);
}

}  // namespace
}  // namespace lasso::sim
