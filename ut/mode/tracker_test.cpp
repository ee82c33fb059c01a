#include "fsw/mode/tracker.hpp"

#include <limits>
#include <memory>

#include "fsw/sense/planner.hpp"
#include "ut/support/box_scan.hpp"
#include "ut/support/box_scene.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

constexpr TimeUs kPeriodUs = 200000;

class TrackerTest : public ::testing::Test {
 protected:
  void SetUp() override { load(test::box_parameters(scene_)); }

  void load(const MissionParameters& parameters) {
    image_ = test::make_box_image(parameters, scene_.box);
    ASSERT_EQ(load_image(Bytes(image_.data(), image_.size), mission_).status, Status::kOk);
  }

  // Starts at t = 0 with an error of `off` (rotation, translation).
  void start(const Vec6& off) {
    Pose pose = scene_.at_zero;
    pose.q = normalized(exp_so3(off.head<3>()) * pose.q);
    pose.p += off.tail<3>();
    ASSERT_EQ(start_at(pose, Twist{}, 0, 0), StartRefusal::kNone);
  }

  StartRefusal start_at(const Pose& pose, const Twist& rates, TimeUs stated_us, TimeUs t_us) {
    return start_track(mission_, StartWay::kUplink, rough_offer(mission_.parameters, pose, rates, stated_us), t_us, state_);
  }

  RangeImage& scan(std::uint32_t scan_id) {
    const TimeUs start_us = scan_id * kPeriodUs;
    ScanPlan plan;
    EXPECT_EQ(plan_scan(mission_.parameters, {mission_.hull, mission_.center_m}, scene_.pose_at(start_us), scan_id, plan), Status::kOk);
    test::Generator random(scan_id + 1u);
    image_of_scan_->scan_id = scan_id;
    image_of_scan_->samples.clear();
    for (std::uint16_t i = 0; i < plan.points; ++i) {
      const TimeUs t_us = start_us + pattern_time_us(plan, i);
      EXPECT_TRUE(image_of_scan_->samples.push_back(test::cast_sample(scene_, plan, i, t_us, random)));
      if (spoiled_ && i % 25 == 0) image_of_scan_->samples[i].range_m += 0.4f;
    }
    return *image_of_scan_;
  }

  TrackStep track(std::uint32_t scan_id) {
    const TrackStep step = track_scan(mission_, *estimator_, scan(scan_id), state_);
    state_ = step.after;
    return step;
  }

  TrackStep miss(std::uint32_t scan_id) {
    const TrackStep step = track_without_scan(mission_, PoseReason::kNoScan, scan_id, scan_id * kPeriodUs + 90000, state_);
    state_ = step.after;
    return step;
  }

  Vec6 error(const Pose& estimate, TimeUs t_us) const { return pose_difference(estimate, scene_.pose_at(t_us)); }

  test::BoxScene scene_ = test::default_scene();
  test::TestImage image_;
  Mission mission_;
  TrackState state_;
  bool spoiled_ = false;  // one return of 25 is wrong
  std::unique_ptr<Estimator> estimator_ = std::make_unique<Estimator>();
  std::unique_ptr<RangeImage> image_of_scan_ = std::make_unique<RangeImage>();
};

Vec6 small_error() {
  Vec6 off;
  off << 0.03, -0.02, 0.025, 0.01, -0.015, 0.02;
  return off;
}

TEST_F(TrackerTest, FollowsTheTargetAndLearnsItsRates) {
  VERIFIES("LASSO-MOD-003~1");
  start(small_error());
  EXPECT_EQ(state_.mode, TrackingMode::kStarting);
  for (std::uint32_t k = 0; k < 30; ++k) {
    const TrackStep step = track(k);
    ASSERT_TRUE(step.registration.valid()) << to_string(step.registration.reason);
    EXPECT_EQ(step.registration.scan_id, k);
    EXPECT_EQ(step.after.mode, TrackingMode::kTracking);
    EXPECT_EQ(step.after.filter.t_us, step.registration.t_us);
    const Vec6 e = error(step.registration.T_sensor_target, step.registration.t_us);
    EXPECT_LT(e.head<3>().norm(), 3e-3);
    EXPECT_LT(e.tail<3>().norm(), 1e-3);
  }
  EXPECT_LT((state_.filter.rates.omega_radps - scene_.rates.omega_radps).norm(), 5e-3);
  EXPECT_LT((state_.filter.rates.v_mps - scene_.rates.v_mps).norm(), 2e-3);
}

TEST_F(TrackerTest, FirstRegistrationStartsTheFilterAnew) {
  VERIFIES("LASSO-MOD-003~1");
  start(small_error());
  const TrackStep step = track(0);
  ASSERT_TRUE(step.registration.valid());
  EXPECT_EQ((step.after.filter.T_sensor_target.p - step.registration.T_sensor_target.p).norm(), 0);
  EXPECT_LT((step.after.filter.covariance.topLeftCorner<6, 6>() - step.registration.covariance).norm(), 1e-18);
  EXPECT_DOUBLE_EQ(step.after.filter.covariance(11, 11), mission_.parameters.initial_rate_mps * mission_.parameters.initial_rate_mps);
}

TEST_F(TrackerTest, WideStartTakesWhatANarrowOneCannot) {
  VERIFIES("LASSO-MOD-004~1");
  Vec6 off;
  off << 0.12, -0.1, 0.08, 0.1, 0.08, 0.12;
  start(off);
  const TrackStep wide = track(0);
  ASSERT_TRUE(wide.registration.valid()) << to_string(wide.registration.reason);
  EXPECT_LT(error(wide.registration.T_sensor_target, wide.registration.t_us).norm(), 5e-3);
  MissionParameters narrow = test::box_parameters(scene_);
  narrow.wide_start = 0;
  load(narrow);
  start(off);
  const TrackStep step = track(0);
  EXPECT_GT(error(step.registration.T_sensor_target, step.registration.t_us).norm(), 5e-3);
}

TEST_F(TrackerTest, CoastsOnThePredictionAndTakesUpTheTrackAgain) {
  VERIFIES("LASSO-MOD-005~1");
  start(small_error());
  for (std::uint32_t k = 0; k < 20; ++k) track(k);
  for (std::uint32_t k = 20; k < 25; ++k) {
    const TrackStep step = miss(k);
    EXPECT_EQ(step.registration.reason, PoseReason::kNoScan);
    EXPECT_EQ(step.after.mode, TrackingMode::kCoasting);
    EXPECT_EQ(step.after.missed, k - 19);
    EXPECT_EQ(step.registration.t_us, k * kPeriodUs + 90000);
    EXPECT_LT(error(step.registration.T_sensor_target, step.registration.t_us).norm(), 1e-2);
  }
  const TrackStep step = track(25);
  EXPECT_TRUE(step.registration.valid());
  EXPECT_EQ(step.after.mode, TrackingMode::kTracking);
  EXPECT_EQ(step.after.missed, 0);
}

TEST_F(TrackerTest, IsLostAfterTheFramesOfTheMission) {
  VERIFIES("LASSO-MOD-007~1");
  MissionParameters p = test::box_parameters(scene_);
  p.coast_frames = 3;
  load(p);
  start(small_error());
  track(0);
  for (std::uint32_t k = 1; k <= 3; ++k) EXPECT_EQ(miss(k).after.mode, TrackingMode::kCoasting);
  EXPECT_EQ(miss(4).after.mode, TrackingMode::kLost);
}

TEST_F(TrackerTest, EmptySpaceIsNoPose) {
  VERIFIES("LASSO-MOD-005~1");
  start(small_error());
  track(0);
  RangeImage& empty = scan(1);
  for (RangeSample& sample : empty.samples) {
    sample.state = RayState::kMiss;
    sample.range_m = 0;
  }
  const TrackStep step = track_scan(mission_, *estimator_, empty, state_);
  EXPECT_EQ(step.registration.reason, PoseReason::kTooFewReturns);
  EXPECT_EQ(step.after.mode, TrackingMode::kCoasting);
}

TEST_F(TrackerTest, MovesTheStartToItsFrame) {
  VERIFIES("LASSO-MOD-003~1 LASSO-MOD-132~1");
  ASSERT_EQ(start_at(scene_.pose_at(300000), scene_.rates, 300000, 1000000), StartRefusal::kNone);
  EXPECT_LT(error(state_.filter.T_sensor_target, 1000000).norm(), 1e-12);
  EXPECT_EQ(state_.filter.t_us, 1000000);
  EXPECT_EQ(state_.mode, TrackingMode::kStarting);
  EXPECT_EQ(state_.way, StartWay::kUplink);
}

TEST_F(TrackerTest, RefusesAStartThatMeansNothing) {
  VERIFIES("LASSO-MOD-008~1");
  Pose bad = scene_.at_zero;
  bad.q.w() += 0.1;
  EXPECT_EQ(start_at(bad, Twist{}, 0, 0), StartRefusal::kNotUnit);
  bad = scene_.at_zero;
  bad.p.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(start_at(bad, Twist{}, 0, 0), StartRefusal::kNotFinite);
  EXPECT_EQ(state_.mode, TrackingMode::kStandby);
  EXPECT_FALSE(state_.filter.initialised);
}

// The target steps aside farther than the filter thinks possible: the registration finds it, yet nobody can tell it from a wrong minimum.
TEST_F(TrackerTest, AJumpThatTheFilterExcludesIsImplausible) {
  VERIFIES("LASSO-MOD-009~1");
  start(small_error());
  for (std::uint32_t k = 0; k < 20; ++k) track(k);
  const TrackState before = state_;
  scene_.at_zero.p += Vec3(0.006, -0.004, 0.007);
  const TrackStep step = track(20);
  EXPECT_EQ(step.registration.reason, PoseReason::kImplausible);
  EXPECT_EQ(step.after.mode, TrackingMode::kCoasting);
  PredictedPose predicted;
  ASSERT_EQ(predict_pose(before.filter, step.registration.t_us, predicted), Status::kOk);
  EXPECT_EQ(step.after.filter.T_sensor_target.p, predicted.T_sensor_target.p);
  EXPECT_EQ(step.after.filter.rejected, before.filter.rejected + 1);
  state_ = before;
  state_.filter.accepted = 4;  // a young track may have begun wrongly: the scan corrects it
  EXPECT_TRUE(track(20).registration.valid());
  MissionParameters lenient = test::box_parameters(scene_);
  lenient.innovation_max = 1000;
  load(lenient);
  state_ = before;
  EXPECT_TRUE(track(20).registration.valid());
}

TEST_F(TrackerTest, AnUncertainPredictionIsARoughStart) {
  VERIFIES("LASSO-MOD-010~1");
  start(small_error());
  for (std::uint32_t k = 0; k < 5; ++k) track(k);
  state_.filter.T_sensor_target.q = normalized(exp_so3(Vec3(0.12, -0.1, 0.08)) * state_.filter.T_sensor_target.q);
  state_.filter.T_sensor_target.p += Vec3(0.1, 0.08, 0.12);
  TrackState sure = state_;
  state_.filter.covariance.topLeftCorner<6, 6>() += 0.01 * Mat6::Identity();
  const TrackStep wide = track(5);
  ASSERT_TRUE(wide.registration.valid()) << to_string(wide.registration.reason);
  EXPECT_LT(error(wide.registration.T_sensor_target, wide.registration.t_us).norm(), 5e-3);
  state_ = sure;
  const TrackStep narrow = track(5);
  EXPECT_GT(error(narrow.registration.T_sensor_target, narrow.registration.t_us).norm(), 5e-3);
}

// A covariance that says of two directions that they are one has no inverse with the scan's.
TEST_F(TrackerTest, AScanThatTheFilterCannotJoinStartsItAnew) {
  VERIFIES("LASSO-MOD-003~1");
  start(small_error());
  track(0);
  state_.filter.covariance.topLeftCorner<6, 6>().setConstant(1e9);
  const TrackStep step = track(1);
  ASSERT_TRUE(step.registration.valid());
  EXPECT_EQ(step.after.filter.accepted, 0u);
  EXPECT_LT((step.after.filter.covariance.topLeftCorner<6, 6>() - step.registration.covariance).norm(), 1e-18);
  EXPECT_EQ((step.after.filter.T_sensor_target.p - step.registration.T_sensor_target.p).norm(), 0);
}

TEST_F(TrackerTest, AfterTooLongAPauseAValidScanStartsTheFilterAnew) {
  VERIFIES("LASSO-MOD-003~1");
  start(small_error());
  for (std::uint32_t k = 0; k < 5; ++k) track(k);
  const Pose last = state_.filter.T_sensor_target;
  const TimeUs resumed_us = 5 * kPeriodUs + kMaxPredictionUs;
  const TrackStep pause = track_without_scan(mission_, PoseReason::kNoScan, 5, resumed_us, state_);
  EXPECT_EQ(pause.registration.T_sensor_target.p, last.p);
  EXPECT_EQ(pause.registration.t_us, resumed_us);
  RangeImage& resumed = scan(5);  // the target has stood still since
  for (RangeSample& sample : resumed.samples) sample.t_us += kMaxPredictionUs;
  const TrackStep step = track_scan(mission_, *estimator_, resumed, pause.after);
  ASSERT_TRUE(step.registration.valid());
  EXPECT_EQ(step.after.filter.accepted, 0u);
  EXPECT_LT((step.after.filter.covariance.topLeftCorner<6, 6>() - step.registration.covariance).norm(), 1e-18);
}

// Only memory that was hit can hold such a state: the scan may be good, but no filter stands behind it.
TEST_F(TrackerTest, APoseWithoutAFilterIsNotValid) {
  VERIFIES("LASSO-MOD-003~1");
  MissionParameters p = test::box_parameters(scene_);
  p.deskew = 0;
  load(p);
  start(small_error());
  track(0);
  state_.filter.rates.v_mps.x() = std::numeric_limits<double>::infinity();
  const TrackStep step = track(1);
  EXPECT_EQ(step.registration.reason, PoseReason::kSingular);
  EXPECT_FALSE(step.registration.valid());
  EXPECT_EQ(step.after.mode, TrackingMode::kCoasting);
}

TEST_F(TrackerTest, WithoutATrackTheLastPoseStandsWithItsOwnTime) {
  VERIFIES("LASSO-MOD-007~1");
  start(small_error());
  track(0);
  const TrackStep step = no_track(44, state_);
  EXPECT_EQ(step.registration.reason, PoseReason::kNoTrack);
  EXPECT_EQ(step.registration.scan_id, 44u);
  EXPECT_EQ(step.registration.t_us, state_.filter.t_us);
  EXPECT_EQ(step.registration.T_sensor_target.p, state_.filter.T_sensor_target.p);
}

// Twelve degrees off with a believed sigma of half a degree: the scan finds the target, but not where the start says.
TEST_F(TrackerTest, AStartFartherOffThanItsCovarianceSaysIsNotConfirmed) {
  VERIFIES("LASSO-MOD-132~1 LASSO-MOD-134~1");
  MissionParameters p = test::box_parameters(scene_);
  p.start_sigma_rad = 0.01;
  p.start_sigma_m = 0.005;
  load(p);
  Vec6 off;
  off << 0.12, -0.1, 0.08, 0.02, 0.01, 0.02;
  start(off);
  const TrackStep step = track(0);
  EXPECT_EQ(step.registration.reason, PoseReason::kFarFromStart);
  EXPECT_LT(error(step.registration.T_sensor_target, step.registration.t_us).norm(), 5e-3) << "though it found the target";
  EXPECT_EQ(step.after.mode, TrackingMode::kStarting);
  EXPECT_EQ(step.event, ModeEvent::kPoseInvalid);
}

// Two boxes, which no turn makes look alike.
TEST_F(TrackerTest, AStartHalfATurnOffIsNeverTracked) {
  VERIFIES("LASSO-MOD-132~1 LASSO-MOD-134~1");
  test::BoxModel mast;
  mast.center = Vec3(0.24, 0.15, -0.32);
  mast.half = Vec3(0.05, 0.04, 0.20);
  test::BoxScan view{scene_.box, {mast}, scene_.at_zero, {}, 1e-3};
  view.half_angle = 0.25;
  MissionParameters p = test::box_parameters(scene_);
  p.start_frames = 4;
  p.start_inlier_share_min = 0.9;
  image_ = test::make_image(p, test::make_box_tables(test::Boxes{scene_.box, mast}));
  ASSERT_EQ(load_image(Bytes(image_.data(), image_.size), mission_).status, Status::kOk);
  test::Generator random(5);
  const auto track_view = [&](std::uint32_t k) {
    const auto image = test::scan_box(view, random);
    for (RangeSample& sample : image->samples) sample.t_us += k * kPeriodUs;
    state_ = track_scan(mission_, *estimator_, *image, state_).after;
  };
  start(small_error());
  track_view(0);
  ASSERT_EQ(state_.mode, TrackingMode::kTracking) << "the right start is taken";
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0.6, 0.64, 0.48)}) {
    state_ = TrackState{};
    Vec6 off = Vec6::Zero();
    off.head<3>() = kPi * axis;
    start(off);
    for (std::uint32_t k = 1; k <= 4; ++k) {
      track_view(k);
      EXPECT_EQ(state_.mode, TrackingMode::kStarting) << axis.transpose();
    }
    track_view(5);
    EXPECT_EQ(state_.mode, TrackingMode::kLost) << axis.transpose();
  }
}

TEST_F(TrackerTest, BeginningATrackTakesMoreThanKeepingIt) {
  VERIFIES("LASSO-MOD-135~1");
  for (const PoseReason reason : {PoseReason::kLowInlierShare, PoseReason::kLowAgreement}) {
    MissionParameters p = test::box_parameters(scene_);
    (reason == PoseReason::kLowAgreement ? p.agreement_min : p.inlier_share_min) = 0.9;
    p.start_inlier_share_min = 0;
    load(p);
    state_ = TrackState{};
    start(small_error());
    ASSERT_TRUE(track(0).registration.valid());
    spoiled_ = true;
    mission_.parameters.hysteresis = 0.2;  // raises the limit to 1, and no farther
    EXPECT_TRUE(track(1).registration.valid()) << "the track holds";
    miss(2);
    EXPECT_EQ(track(3).registration.reason, reason) << "it is not taken up";
    EXPECT_EQ(state_.mode, TrackingMode::kCoasting);
    mission_.parameters.hysteresis = 0.05;
    EXPECT_TRUE(track(4).registration.valid());
    miss(5);
    spoiled_ = false;
    mission_.parameters.hysteresis = 0.2;
    EXPECT_TRUE(track(6).registration.valid()) << "a scan without a fault always passes";
  }
}

TEST_F(TrackerTest, LooksNearThePredictionThenForTheBearing) {
  VERIFIES("LASSO-MOD-138~1");
  MissionParameters p = test::box_parameters(scene_);
  p.coast_frames = 2;
  p.reacquire_frames = 3;
  p.recover = 1;
  load(p);
  start(small_error());
  for (std::uint32_t k = 0; k < 15; ++k) track(k);
  for (std::uint32_t k = 15; k < 17; ++k) EXPECT_EQ(miss(k).after.mode, TrackingMode::kCoasting);
  const TrackStep lost = miss(17);
  EXPECT_EQ(lost.event, ModeEvent::kRecover);
  EXPECT_EQ(lost.after.mode, TrackingMode::kReacquiring);
  EXPECT_EQ(lost.after.missed, 0);
  const TrackState reacquiring = state_;
  const TrackStep found = track(18);
  ASSERT_TRUE(found.registration.valid()) << to_string(found.registration.reason);
  EXPECT_EQ(found.after.mode, TrackingMode::kTracking);
  EXPECT_EQ(found.after.filter.accepted, 0u) << "the filter starts anew";
  state_ = reacquiring;
  for (std::uint32_t k = 18; k < 21; ++k) EXPECT_EQ(miss(k).after.mode, TrackingMode::kReacquiring);
  const TrackStep given_up = miss(21);
  EXPECT_EQ(given_up.after.mode, TrackingMode::kBearing);
  EXPECT_FALSE(given_up.after.filter.initialised) << "nothing stale";
}

TEST_F(TrackerTest, AHeldModeDoesNotEndByItself) {
  VERIFIES("LASSO-MOD-136~1");
  MissionParameters p = test::box_parameters(scene_);
  p.coast_frames = 1;
  load(p);
  start(small_error());
  track(0);
  state_.held = true;
  for (std::uint32_t k = 1; k < 8; ++k) EXPECT_EQ(miss(k).after.mode, TrackingMode::kCoasting);
  state_.missed = 65535;  // for hours
  EXPECT_EQ(miss(8).after.missed, 65535);
  state_.held = false;
  EXPECT_EQ(miss(9).after.mode, TrackingMode::kLost);
}

TEST_F(TrackerTest, ABearingScanSaysWhereAndNoPose) {
  VERIFIES("LASSO-MOD-101~1 LASSO-MOD-104~1");
  auto finder = std::make_unique<BearingFinder>();
  change_mode(ModeEvent::kSeek, state_);
  const TrackStep step = bearing_scan(mission_, *finder, scan(0), state_);
  EXPECT_EQ(step.registration.reason, PoseReason::kOnlyBearing);
  EXPECT_EQ(step.registration.t_us, 90000);
  EXPECT_TRUE(step.registration.T_sensor_target.p.isZero(0));
  ASSERT_TRUE(step.bearing.valid());
  EXPECT_NEAR(step.bearing.range_m(), scene_.at_zero.p.norm(), 0.35);
  EXPECT_EQ(step.event, ModeEvent::kBearingKnown);
  EXPECT_EQ(step.after.mode, TrackingMode::kBearing);
  state_ = step.after;
  const TrackStep again = bearing_scan(mission_, *finder, scan(0), state_);
  EXPECT_EQ(again.bearing.reason, BearingReason::kSameScan);
  EXPECT_EQ(again.event, ModeEvent::kBearingUnknown);
  const TrackStep missed = miss(1);
  EXPECT_EQ(missed.registration.reason, PoseReason::kNoScan);
  EXPECT_EQ(missed.bearing.reason, BearingReason::kNoScan);
  EXPECT_TRUE(missed.bearing.value.isZero(0)) << "nothing stale";
  EXPECT_EQ(missed.event, ModeEvent::kBearingUnknown);
  EXPECT_EQ(missed.after.mode, TrackingMode::kBearing);
}

// A filter that nobody has heard of for too long has nothing against what a scan finds.
TEST_F(TrackerTest, AStartThatCannotBePredictedIsConfirmedByTheScanAlone) {
  VERIFIES("LASSO-MOD-003~1");
  start(small_error());
  state_.filter.initialised = false;
  EXPECT_TRUE(track(0).registration.valid());
  EXPECT_EQ(state_.mode, TrackingMode::kTracking);
}

}  // namespace
}  // namespace lasso
