#include "fsw/mode/tracker.hpp"

#include <limits>
#include <memory>

#include "fsw/sense/planner.hpp"
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
    ASSERT_EQ(start_track(mission_, pose, Twist{}, 0, 0, state_), Status::kOk);
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
  VERIFIES("LASSO-MOD-003~1");
  ASSERT_EQ(start_track(mission_, scene_.pose_at(300000), scene_.rates, 300000, 1000000, state_), Status::kOk);
  EXPECT_LT(error(state_.filter.T_sensor_target, 1000000).norm(), 1e-12);
  EXPECT_EQ(state_.filter.t_us, 1000000);
  ASSERT_EQ(start_track(mission_, scene_.pose_at(300000), scene_.rates, 300000, 100000, state_), Status::kOk);
  EXPECT_LT(error(state_.filter.T_sensor_target, 100000).norm(), 1e-12);
}

TEST_F(TrackerTest, RefusesAStartThatMeansNothing) {
  VERIFIES("LASSO-MOD-008~1");
  const Pose good = scene_.at_zero;
  Pose bad = good;
  bad.q.w() += 0.1;
  EXPECT_EQ(start_track(mission_, bad, Twist{}, 0, 0, state_), Status::kBadValue);
  bad = good;
  bad.p.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(start_track(mission_, bad, Twist{}, 0, 0, state_), Status::kOk);
  Twist rates;
  rates.v_mps.z() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(start_track(mission_, good, rates, 0, 0, state_), Status::kNotFinite);
  rates = Twist{};
  rates.omega_radps.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(start_track(mission_, good, rates, 0, 0, state_), Status::kNotFinite);
  rates.omega_radps.y() = 1e7;  // more turns in 1 s than an angle can count
  EXPECT_EQ(start_track(mission_, good, rates, 0, 1000000, state_), Status::kNotFinite);
  EXPECT_EQ(start_track(mission_, good, Twist{}, 0, kMaxPredictionUs + 1, state_), Status::kBadValue);
  EXPECT_EQ(start_track(mission_, good, Twist{}, kMaxPredictionUs + 1, 0, state_), Status::kBadValue);
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

}  // namespace
}  // namespace lasso
