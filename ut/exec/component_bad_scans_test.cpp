// Scans that broken sensors deliver: each has a named reason and a defined next mode, and no pose is published as valid.
#include <cmath>
#include <functional>
#include <limits>

#include "ut/exec/component_operator.hpp"

namespace lasso {
namespace {

using M = TrackingMode;
using R = PoseReason;
using L = ScanLoss;

constexpr int kGood = 7, kBad = 3, kAfter = 3;  // frames

// Its samples are as the box's, spoiled on the way.
class SpoiledSensor final : public Sensor {
 public:
  explicit SpoiledSensor(const test::BoxScene& scene) : inner_(scene) {}
  Status start(const ScanPlan& plan, TimeUs t_start_us) override {
    if (!spoil) last_.clear();
    taken_ = 0;
    return inner_.start(plan, t_start_us);
  }
  SensorPoll poll(TimeUs now_us, Span<RangeSample> out) override {
    const SensorPoll poll = inner_.poll(now_us, out);
    for (std::size_t i = 0; i < poll.count; ++i, ++taken_) {
      if (!spoil) last_.push_back(out[i]);
      if (spoil) spoil(out[i], taken_);
    }
    return poll;
  }
  void abort() override { inner_.abort(); }
  void permit_laser(bool permitted) override { inner_.permit_laser(permitted); }

  // The sample of this number in the last scan that was not spoiled.
  const RangeSample& before(std::size_t i) const { return last_.at(i < last_.size() ? i : last_.size() - 1); }
  std::function<void(RangeSample&, std::size_t)> spoil;

 private:
  test::BoxSensor inner_;
  std::vector<RangeSample> last_;
  std::size_t taken_ = 0;
};

// Does what a driver written in haste might do: answers anything.
class StrangeSensor final : public Sensor {
 public:
  explicit StrangeSensor(const test::BoxScene& scene) : inner_(scene) {}
  Status start(const ScanPlan& plan, TimeUs t_start_us) override {
    return at_start != Status::kOk ? at_start : inner_.start(plan, t_start_us);
  }
  SensorPoll poll(TimeUs now_us, Span<RangeSample> out) override {
    SensorPoll poll;
    poll.status = at_poll;
    return at_poll != Status::kOk ? poll : inner_.poll(now_us, out);
  }
  void abort() override { inner_.abort(); }
  void permit_laser(bool permitted) override { inner_.permit_laser(permitted); }

  Status at_start = Status::kOk, at_poll = Status::kOk;

 private:
  test::BoxSensor inner_;
};

// The table of fsw/sense/sensor.hpp, all statuses. kSensors: no fault.
struct Meaning {
  Status status;
  L loss;
  Fault fault;
};
constexpr Fault kNoFault = static_cast<Fault>(kFaults);
constexpr Meaning kMeanings[] = {{Status::kMissing, L::kInhibited, kNoFault},
                                 {Status::kBadValue, L::kRefused, kNoFault},
                                 {Status::kOverCapacity, L::kNoRoom, kNoFault},
                                 {Status::kBusy, L::kBusy, Fault::kSensorLate},
                                 {Status::kTimeout, L::kSilent, Fault::kSensorSilent},
                                 {Status::kNoData, L::kSilent, Fault::kSensorSilent},
                                 {Status::kTruncated, L::kStopped, Fault::kScanIncomplete},
                                 {Status::kBadOrder, L::kRestarted, Fault::kScanIncomplete},
                                 {Status::kBadVersion, L::kForeign, Fault::kSensorCorrupt},
                                 {Status::kOffPlan, L::kOffPlan, Fault::kSensorCorrupt},
                                 {Status::kBadMagic, L::kOther, Fault::kSensorCorrupt},
                                 {Status::kBadLength, L::kOther, Fault::kSensorCorrupt},
                                 {Status::kBadCrc, L::kOther, Fault::kSensorCorrupt},
                                 {Status::kBadIndex, L::kOther, Fault::kSensorCorrupt},
                                 {Status::kNotFinite, L::kOther, Fault::kSensorCorrupt},
                                 {Status::kSingular, L::kOther, Fault::kSensorCorrupt}};
static_assert(sizeof(kMeanings) / sizeof(kMeanings[0]) == static_cast<std::size_t>(Status::kOffPlan), "each but kOk");

// Runs until a fault that lasts is confirmed, and says what was lost, and which faults there are.
void expect_meaning(const Meaning& meaning, StrangeSensor& sensor, const char* call) {
  static const test::BoxTables tables = test::make_box_tables(test::default_scene().boxes());
  const std::string where = std::string(to_string(meaning.status)) + " of " + call;
  test::TestImage image = test::make_image(test::box_parameters(test::default_scene()), tables);
  const auto component = std::make_unique<Component>(sensor);
  ASSERT_EQ(component->load_image(Bytes(image.data(), image.size)).status, Status::kOk);
  ASSERT_EQ(component->begin(0), Status::kOk);
  std::vector<L> losses;
  for (int frame = 0; frame < 12; ++frame) {
    for (const test::Stream& event : test::events_of(test::packets_of(test::run_frame(*component)))) {
      if (static_cast<EventId>(event[1]) == EventId::kScanLost) losses.push_back(static_cast<L>(event.back()));
    }
  }
  EXPECT_FALSE(losses.empty()) << where;
  for (const L loss : losses) EXPECT_EQ(loss, meaning.loss) << where;
  for (const Fault fault : {Fault::kSensorSilent, Fault::kSensorLate, Fault::kSensorCorrupt, Fault::kSensorStuck, Fault::kSensorSaturated,
                            Fault::kScanIncomplete})
    EXPECT_EQ(component->faults().ever().has(fault), fault == meaning.fault) << where << ", fault " << static_cast<int>(fault);
}

TEST(StrangeSensorTest, WhatItAnswersLosesTheScanAsItsHeaderSays) {
  VERIFIES("LASSO-SNS-058~1");
  for (const Meaning& meaning : kMeanings) {
    StrangeSensor at_start(test::default_scene()), at_poll(test::default_scene());
    at_start.at_start = meaning.status;
    expect_meaning(meaning, at_start, "start");
    at_poll.at_poll = meaning.status;
    expect_meaning(meaning, at_poll, "poll");
  }
}

struct BadScan {
  const char* name;
  std::function<void(RangeSample&, std::size_t)> spoil;
  std::vector<R> reasons;               // of the pose; of a scan that is lost: no_scan
  L loss = L::kNone;                    // and then what for
  std::vector<BearingReason> bearings;  // of the bearing, in mode bearing; none: it is not bad there
};

class BadScanTest : public ::testing::Test {
 protected:
  void SetUp() override {
    scene_ = test::default_scene();
    scene_.rates.omega_radps = Vec3(0.03, -0.02, 0.04);
    MissionParameters p = test::box_parameters(scene_);
    p.points = 400;
    sensor_ = std::make_unique<SpoiledSensor>(scene_);
    static const test::BoxTables tables = test::make_box_tables(scene_.boxes());
    image_ = test::make_image(p, tables);
    component_ = std::make_unique<Component>(*sensor_);
    ASSERT_EQ(component_->load_image(Bytes(image_.data(), image_.size)).status, Status::kOk);
    ASSERT_EQ(component_->begin(0), Status::kOk);
  }

  std::vector<BadScan> cases() const {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    using B = BearingReason;
    return {
        {"no returns", [](RangeSample& s, std::size_t) { s.state = RayState::kMiss; }, {R::kTooFewReturns}, L::kNone, {B::kNothingSeen}},
        {"all returns at one point",
         [this](RangeSample& s, std::size_t) {
           const TimeUs t_us = s.t_us;
           s = sensor_->before(0);
           s.state = RayState::kHit;
           s.range_m = 2.4F;
           s.t_us = t_us;
         },
         {R::kNoScan},
         L::kStuck,
         {B::kNoScan}},
        {"no number", [nan](RangeSample& s, std::size_t) { s.range_m = nan; }, {R::kNoScan}, L::kThin, {B::kNoScan}},
        {"infinity", [infinity](RangeSample& s, std::size_t) { s.direction[0] = infinity; }, {R::kNoScan}, L::kThin, {B::kNoScan}},
        {"beside the field of view",
         [](RangeSample& s, std::size_t) { std::swap(s.direction[0], s.direction[2]); },
         {R::kTooFewInliers, R::kLowInlierShare, R::kImplausible, R::kFarFromStart},
         L::kNone,
         {B::kOutsideField}},
        {"behind the model's field",
         [](RangeSample& s, std::size_t) { s.range_m += 3; },
         {R::kTooFewInliers, R::kLowInlierShare},
         L::kNone,
         {}},
        {"times that go back",
         [](RangeSample& s, std::size_t i) { s.t_us -= i % 2 == 0 ? 100000 : 0; },
         {R::kNoScan},
         L::kThin,
         {B::kNoScan}},
        {"times to come", [](RangeSample& s, std::size_t) { s.t_us += 500000; }, {R::kNoScan}, L::kThin, {B::kNoScan}},
        {"the scan before, again", [this](RangeSample& s, std::size_t i) { s = sensor_->before(i); }, {R::kNoScan}, L::kThin, {B::kNoScan}},
        {"the scan before, again, with new times",
         [this](RangeSample& s, std::size_t i) {
           const TimeUs t_us = s.t_us;
           s = sensor_->before(i);
           s.t_us = t_us;
         },
         {R::kNoScan},
         L::kFrozen,
         {B::kNoScan}}};
  }

  // One frame: its poses, and what scans were lost for.
  std::vector<PoseTelemetry> run_frame(std::vector<L>& losses) {
    const test::Stream bytes = test::run_frame(*component_);
    for (const test::Stream& event : test::events_of(test::packets_of(bytes))) {
      if (static_cast<EventId>(event[1]) == EventId::kScanLost) losses.push_back(static_cast<L>(event.back()));
    }
    std::vector<PoseTelemetry> poses;
    for (const test::Report& report : test::decode_all(test::view(bytes))) poses.push_back(report.pose);
    return poses;
  }
  std::vector<PoseTelemetry> run(int frames, std::vector<L>& losses) {
    std::vector<PoseTelemetry> poses;
    for (int i = 0; i < frames; ++i) {
      for (const PoseTelemetry& pose : run_frame(losses)) poses.push_back(pose);
    }
    return poses;
  }
  // The frames of the spoiled scans, and the two in which the last of these are still under way.
  std::vector<PoseTelemetry> run_bad(const BadScan& bad, std::vector<L>& losses) {
    sensor_->spoil = bad.spoil;
    std::vector<PoseTelemetry> poses = run(kBad, losses);
    sensor_->spoil = nullptr;
    for (const PoseTelemetry& pose : run(2, losses)) poses.push_back(pose);
    const std::uint32_t last = poses.back().scan_id;
    std::vector<PoseTelemetry> spoiled;
    for (const PoseTelemetry& pose : poses) {
      if (pose.scan_id + kBad > last) spoiled.push_back(pose);
    }
    return spoiled;
  }
  Vec6 error(const PoseTelemetry& t) const {
    Pose pose;
    pose.q = Quat(t.q_sensor_target[3], t.q_sensor_target[0], t.q_sensor_target[1], t.q_sensor_target[2]);
    pose.p = Vec3(t.p_sensor_target_m[0], t.p_sensor_target_m[1], t.p_sensor_target_m[2]);
    return pose_difference(pose, scene_.pose_at(t.t_measurement_us));
  }

  test::BoxScene scene_;
  test::TestImage image_;
  std::unique_ptr<SpoiledSensor> sensor_;
  std::unique_ptr<Component> component_;
};

template <class T>
bool contains(const std::vector<T>& values, T value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

// One event at least, if the scans are lost; more of them may come too soon to be reported.
void expect_told(const BadScan& bad, const std::vector<L>& losses) {
  EXPECT_EQ(losses.empty(), bad.loss == L::kNone) << bad.name;
  for (const L loss : losses) EXPECT_EQ(loss, bad.loss) << bad.name;
}

TEST_F(BadScanTest, InTrackingEachIsToldAndTheTrackCoastsAndGoesOn) {
  VERIFIES("LASSO-MOD-181~3");
  for (const BadScan& bad : cases()) {
    SetUp();
    std::vector<L> losses;
    run(kGood, losses);
    const std::vector<PoseTelemetry> spoiled = run_bad(bad, losses);
    ASSERT_EQ(spoiled.size(), std::size_t{kBad}) << bad.name;
    for (const PoseTelemetry& pose : spoiled) {
      EXPECT_EQ(pose.valid, 0) << bad.name;
      EXPECT_TRUE(contains(bad.reasons, static_cast<R>(pose.reason))) << bad.name << ": " << to_string(static_cast<R>(pose.reason));
      EXPECT_EQ(static_cast<M>(pose.mode), M::kCoasting) << bad.name;
    }
    expect_told(bad, losses);
    const std::vector<PoseTelemetry> after = run(kAfter, losses);
    for (const PoseTelemetry& pose : after) {
      EXPECT_EQ(pose.valid, 1) << bad.name << ": " << to_string(static_cast<R>(pose.reason));
      EXPECT_EQ(static_cast<M>(pose.mode), M::kTracking) << bad.name;
      EXPECT_LT(error(pose).norm(), 2e-2) << bad.name;
    }
  }
}

TEST_F(BadScanTest, InBearingEachIsToldAndNoPoseIsPublished) {
  VERIFIES("LASSO-MOD-181~3");
  for (const BadScan& bad : cases()) {
    if (bad.bearings.empty()) continue;
    SetUp();
    std::vector<L> losses;
    run(3, losses);
    ASSERT_EQ(component_->command_mode(M::kBearing), ModeRefusal::kNone);
    run(kGood, losses);
    for (const PoseTelemetry& pose : run_bad(bad, losses)) {
      EXPECT_EQ(pose.valid, 0) << bad.name;
      EXPECT_EQ(static_cast<M>(pose.mode), M::kBearing) << bad.name;
      EXPECT_TRUE(contains(bad.bearings, static_cast<BearingReason>(pose.bearing_reason)))
          << bad.name << ": " << to_string(static_cast<BearingReason>(pose.bearing_reason));
    }
    expect_told(bad, losses);
    const std::vector<PoseTelemetry> after = run(kAfter, losses);
    EXPECT_EQ(static_cast<BearingReason>(after.back().bearing_reason), BearingReason::kValid) << bad.name;
  }
}

TEST_F(BadScanTest, AStartIsNotConfirmedByAny) {
  VERIFIES("LASSO-MOD-181~3");
  for (const BadScan& bad : cases()) {
    SetUp();
    std::vector<L> losses;
    run(1, losses);  // so that there is a scan to give again
    sensor_->spoil = bad.spoil;
    const TimeUs t_us = component_->next_slot_us();
    ASSERT_EQ(component_->start_tracking(scene_.pose_at(t_us), scene_.rates, t_us), Status::kOk);
    for (const PoseTelemetry& pose : run(5, losses)) {
      if (pose.scan_id < 2) continue;  // as it was
      EXPECT_EQ(pose.valid, 0) << bad.name;
      EXPECT_TRUE(contains(bad.reasons, static_cast<R>(pose.reason))) << bad.name << ": " << to_string(static_cast<R>(pose.reason));
      EXPECT_EQ(static_cast<M>(pose.mode), M::kStarting) << bad.name;
    }
  }
}

// Without noise and motion, and with a pattern that does not turn, each scan is as the one before: that is no fault.
TEST(StillScene, ScansThatAreAlikeByRightAreTaken) {
  VERIFIES("LASSO-MOD-181~3");
  test::BoxScene still = test::default_scene();
  still.rates = Twist();
  still.sigma_m = 0;
  MissionParameters p = test::box_parameters(still);
  p.phase_step_turns = 0;
  p.points = 400;
  test::ComponentScene scene(p, still);
  scene.begin();
  for (int frame = 0; frame < 12; ++frame) {
    for (const test::Report& report : scene.run_frame()) {
      EXPECT_EQ(report.pose.valid, 1) << report.pose.scan_id << " " << to_string(static_cast<R>(report.pose.reason));
      EXPECT_EQ(report.pose.lost_scans, 0U);
    }
  }
}

}  // namespace
}  // namespace lasso
