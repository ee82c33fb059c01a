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

constexpr TimeUs kForeverUs = 1'000'000'000;

LcsFault always(LcsFaultKind kind, double value) { return {kind, 0, kForeverUs, value}; }

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
  explicit Flight(const LcsFaults& faults) : Flight(with(faults), 0.15, 0.2) {}

  Flight(const LcsCamera& camera, double half_x, double half_y)
      : half_x_(half_x),
        half_y_(half_y),
        camera_(camera),
        device_(*caster_, motion_, ScannerModel{}, 5, camera_),
        line_(device_, optics_of(camera_), camera_.bits_per_s) {
    line_.permit_laser(true);
  }

  Tally fly(int scans = kScans) {
    for (int scan = 0; scan < scans; ++scan) this->scan(kBegin + scan * kPeriodUs, static_cast<std::uint32_t>(scan));
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
    plan.half_x = half_x_;
    plan.half_y = half_y_;
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
  double half_x_, half_y_;
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
  VERIFIES("LASSO-LCS-003~1 LASSO-LCS-007~2");
  const Tally tally = fly({});
  EXPECT_EQ(tally.whole, kScans);
  EXPECT_EQ(tally.wrong_points, 0U);
  EXPECT_GT(tally.hits, 300U * kScans);
  EXPECT_EQ(all_lost(tally.health), 0U);
  EXPECT_EQ(tally.health.sequence_gaps + tally.health.bad_messages + tally.health.bad_times + tally.health.off_plan + tally.line.skipped,
            0U);
}

// The numbers of a plan are rounded to 32 bits on the line, and half of them upwards.
TEST(LcsDevice, AScanOfTheMirrorsWholeRangeIsTaken) {
  VERIFIES("LASSO-LCS-003~1");
  for (int degrees = 3; degrees <= 40; ++degrees) {
    LcsCamera wide = camera();
    wide.truth.angle_max_rad = degrees * kRadPerDeg;
    const double half = std::tan(wide.truth.angle_max_rad);
    const Tally tally = Flight(wide, half, half).fly(2);
    EXPECT_EQ(tally.whole, 2) << degrees << " deg: lost " << tally.lost << ", short of samples " << tally.short_of_samples;
    EXPECT_EQ(Flight(wide, 1.0001 * half, half).fly(2).lost_by(lcs::Loss::kRefused), 2U) << degrees;
  }
}

TEST(LcsDevice, DroppedFramesCostTheirSamples) {
  VERIFIES("LASSO-LCS-002~1 LASSO-LCS-011~1 LASSO-LCS-012~1");
  const Tally tally = fly({always(LcsFaultKind::kDrop, 0.02)});
  EXPECT_EQ(tally.wrong_points, 0U);
  EXPECT_GT(tally.short_of_samples, kScans / 2);
  EXPECT_GT(tally.health.samples_lost, 100U);
  EXPECT_GT(tally.health.sequence_gaps, 50U);
  EXPECT_GT(tally.hits, 280U * kScans);
}

TEST(LcsDevice, RepeatedFramesChangeNothing) {
  VERIFIES("LASSO-LCS-011~1");
  const Tally tally = fly({always(LcsFaultKind::kRepeat, 0.1)});
  EXPECT_EQ(tally.whole, kScans);
  EXPECT_EQ(tally.wrong_points, 0U);
  EXPECT_GT(tally.health.strayed, 100U);
  EXPECT_GT(tally.health.repeated, 500U);
  EXPECT_EQ(tally.health.sequence_gaps, 0U);
}

TEST(LcsDevice, CorruptFramesAndALineOfManyBitErrorsGiveNoWrongPoint) {
  VERIFIES("LASSO-LCS-002~1 LASSO-LCS-011~1 LASSO-LCS-012~1");
  for (const LcsFault& fault : {always(LcsFaultKind::kCorrupt, 0.05), always(LcsFaultKind::kBitErrors, 1e-4)}) {
    const Tally tally = fly({fault});
    EXPECT_EQ(tally.wrong_points, 0U);
    EXPECT_GT(tally.line.bad_crc, 100U);
    EXPECT_GT(tally.health.samples_lost, 100U);
    EXPECT_GE(tally.whole + tally.short_of_samples, kScans * 9 / 10);
    EXPECT_EQ(all_lost(tally.health), static_cast<std::uint32_t>(tally.lost));
  }
}

TEST(LcsDevice, ASilentCameraLosesItsScansAndComesBack) {
  VERIFIES("LASSO-LCS-011~1 LASSO-LCS-012~1");
  const Tally tally = fly({{LcsFaultKind::kSilent, kBegin + 10 * kPeriodUs - 10'000, kBegin + 15 * kPeriodUs - 10'000, 0}});
  EXPECT_EQ(tally.lost_by(lcs::Loss::kSilent), 5U);
  EXPECT_EQ(tally.lost, 5);
  EXPECT_EQ(tally.whole, kScans - 5);
  EXPECT_EQ(tally.wrong_points, 0U);
}

TEST(LcsDevice, AStuckMirrorLosesItsScans) {
  VERIFIES("LASSO-LCS-011~1 LASSO-LCS-012~1");
  const Tally tally = fly({{LcsFaultKind::kStuckMirror, kBegin + 10 * kPeriodUs, kBegin + 15 * kPeriodUs, 0}});
  EXPECT_EQ(tally.lost_by(lcs::Loss::kOffPlan), 5U);
  EXPECT_EQ(tally.whole, kScans - 5);
  EXPECT_EQ(tally.wrong_points, 0U);  // the mirrors' own angles are right
}

TEST(LcsDevice, ASaturatedDetectorMakesNoPoints) {
  VERIFIES("LASSO-LCS-011~1");
  const Tally tally = fly({always(LcsFaultKind::kSaturated, 0)});
  EXPECT_EQ(tally.hits, 0U);
  EXPECT_GT(tally.health.fates[static_cast<std::size_t>(lcs::Fate::kNoStatement)], 300U * kScans);
}

TEST(LcsDevice, ABootCostsTheScanAndTheNextOnes) {
  VERIFIES("LASSO-LCS-006~1 LASSO-LCS-011~1 LASSO-LCS-012~1");
  const Tally tally = fly({{LcsFaultKind::kReset, kBegin + 10 * kPeriodUs + 50'000, kForeverUs, 0}});
  EXPECT_EQ(tally.health.boots, 1U);
  EXPECT_GE(tally.whole, kScans - 4);
  EXPECT_GE(tally.lost_by(lcs::Loss::kBooted) + tally.lost_by(lcs::Loss::kSilent), 1U);
  EXPECT_EQ(tally.wrong_points, 0U);
}

TEST(LcsDevice, AClockThatJumpsOrRunsFastCostsNoScan) {
  VERIFIES("LASSO-LCS-011~1");
  const Tally tally =
      fly({{LcsFaultKind::kClockJump, kBegin + 10 * kPeriodUs + 90'000, kForeverUs, -1.7}, always(LcsFaultKind::kClockRate, 1e-3)});
  EXPECT_EQ(tally.health.clock_jumps, 1U);
  EXPECT_GE(tally.whole, kScans - 1);
  EXPECT_EQ(tally.wrong_points, 0U);
  EXPECT_GT(tally.health.bad_times, 0U);  // of the scan in which it jumped
}

TEST(LcsDevice, LateFramesLeaveTheScanShort) {
  VERIFIES("LASSO-LCS-011~1");
  const Tally tally = fly({always(LcsFaultKind::kLate, 0.04)});
  EXPECT_EQ(tally.wrong_points, 0U);
  EXPECT_EQ(tally.lost, 0);
  EXPECT_EQ(tally.short_of_samples, kScans);  // the boundary comes before the last samples
  EXPECT_GT(tally.hits, 280U * kScans);
}

// A camera that is spoken to by hand.
class SpokenTo {
 public:
  explicit SpokenTo(const LcsFaults& faults = {}) : device_(*caster_, motion_, ScannerModel{}, 5, with(faults)) {}

  // What it says until `for_us` after a frame is on the line.
  std::vector<lcs::Frame> say(const lcs::FrameBytes& frame, DurationUs for_us = 10'000) {
    EXPECT_EQ(line_.to_camera.write(frame.span()), frame.size);
    device_.listen(now_us, line_);
    return wait(for_us);
  }
  std::vector<lcs::Frame> wait(DurationUs for_us) {
    now_us += for_us;
    device_.run(now_us, line_);
    std::vector<lcs::Frame> frames;
    lcs::Frame frame;
    std::uint8_t byte = 0;
    while (line_.from_camera.read(Bytes(&byte, 1)) == 1) {
      if (decoder_.step(ConstBytes(&byte, 1), frame).found) frames.push_back(frame);
    }
    return frames;
  }
  lcs::Result ask(const lcs::FrameBytes& frame) {
    lcs::Answer answer;
    const std::vector<lcs::Frame> frames = say(frame);
    EXPECT_FALSE(frames.empty());
    for (const lcs::Frame& one : frames) {
      if (one.type != static_cast<std::uint8_t>(lcs::Type::kAnswer)) continue;
      EXPECT_EQ(decode(one, answer), Status::kOk);
    }
    return answer.result;
  }
  lcs::CameraStatus status() {
    lcs::CameraStatus status;
    const std::vector<lcs::Frame> frames = say(lcs::encode(0, lcs::Type::kAskStatus), 1'000);
    EXPECT_TRUE(!frames.empty() && decode(frames.back(), status) == Status::kOk);
    return status;
  }
  void light() {
    EXPECT_EQ(ask(lcs::encode(0, lcs::LaserCommand::kArm)), lcs::Result::kDone);
    EXPECT_EQ(ask(lcs::encode(0, lcs::LaserCommand::kFire)), lcs::Result::kDone);
  }
  const lcs::Line& line() const { return line_; }

  TimeUs now_us = 0;

 private:
  static LcsCamera with(const LcsFaults& faults) {
    LcsCamera one = camera();
    one.faults = faults;
    return one;
  }
  test::ShapeMesh mesh_ = test::box_mesh(kHalf);
  std::unique_ptr<RayCaster> caster_ = make_ray_caster(mesh_.vertices, mesh_.triangles);
  ConstantTwist motion_{{{upright_attitude(0.26, 0.09), Vec3(0, 0, 4)}, {}}, 0};
  LcsDevice device_;
  lcs::Line line_;
  lcs::FrameDecoder decoder_;
};

TEST(LcsDevice, FireWithoutArmIsRefused) {
  VERIFIES("LASSO-LCS-006~1");
  using lcs::LaserCommand;
  using lcs::Result;
  SpokenTo device;
  lcs::StartCommand start;
  EXPECT_EQ(device.ask(lcs::encode(0, start)), Result::kInhibited);
  EXPECT_EQ(device.ask(lcs::encode(1, LaserCommand::kFire)), Result::kNotArmed);
  EXPECT_EQ(device.ask(lcs::encode(2, LaserCommand::kArm)), Result::kDone);
  device.wait(lcs::kArmedUs);
  EXPECT_EQ(device.ask(lcs::encode(3, LaserCommand::kFire)), Result::kNotArmed);
  EXPECT_EQ(device.ask(lcs::encode(4, LaserCommand::kArm)), Result::kDone);
  EXPECT_EQ(device.ask(lcs::encode(5, LaserCommand::kInhibit)), Result::kDone);
  EXPECT_EQ(device.ask(lcs::encode(6, LaserCommand::kFire)), Result::kNotArmed);
  device.light();
  EXPECT_EQ(device.ask(lcs::encode(9, lcs::Type::kStatus)), Result::kUnknown);  // no command
}

TEST(LcsDevice, PutsItsLaserOutWhenItHasHeardNothingForTwoSeconds) {
  VERIFIES("LASSO-LCS-018~1");
  SpokenTo device;
  device.light();
  device.wait(lcs::kUnheardUs - 100'000);
  EXPECT_TRUE(device.status().laser_lit);
  device.wait(lcs::kUnheardUs - 100'000);
  EXPECT_TRUE(device.status().laser_lit) << "a right frame of any kind is enough";
  device.wait(lcs::kUnheardUs + 1'000);
  EXPECT_FALSE(device.status().laser_lit);

  device.light();
  lcs::StartCommand start;
  start.plan.duration_us = 10'000'000;
  ASSERT_EQ(device.ask(lcs::encode(0, start)), lcs::Result::kDone);
  EXPECT_FALSE(device.wait(lcs::kUnheardUs).empty());
  EXPECT_TRUE(device.wait(8'000'000).empty()) << "the scan has ended with the light";
  EXPECT_FALSE(device.status().scanning);
}

TEST(LcsDevice, HearsNothingWhileItBoots) {
  VERIFIES("LASSO-SIM-032~1");
  SpokenTo device({{LcsFaultKind::kReset, 1'000'000, kForeverUs, 0}});
  EXPECT_EQ(device.status().boots, 1U);
  device.wait(1'100'000);
  EXPECT_TRUE(device.say(lcs::encode(0, lcs::Type::kAskStatus), 100'000).empty());
  const std::vector<lcs::Frame> frames = device.wait(200'000);
  ASSERT_EQ(frames.size(), 1U) << "its own status after the boot, no answer to what came during it";
  EXPECT_EQ(frames[0].sequence, 0);
  EXPECT_EQ(device.status().boots, 2U);
}

TEST(LcsDevice, TakesBytesAsFastAsTheLineCarriesThem) {
  VERIFIES("LASSO-LCS-003~1");
  SpokenTo device;
  lcs::FrameBytes two = lcs::encode(0, lcs::Type::kAskStatus);  // 7 bytes are 17.5 us
  EXPECT_TRUE(device.say(two, 10).empty());
  EXPECT_EQ(device.line().to_camera.room(), lcs::kLineBytes - 3) << "the fourth byte is under way";
  EXPECT_TRUE(device.wait(8).empty()) << "the answer is under way";
  EXPECT_EQ(device.line().to_camera.room(), lcs::kLineBytes);
  EXPECT_EQ(device.wait(200).size(), 1U);
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
