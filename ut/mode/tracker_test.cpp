#include <cmath>
#include <limits>

#include "ut/mode/tracker_fixture.hpp"
#include "ut/support/dense.hpp"

namespace lasso {
namespace {

using test::kPeriodUs;
using test::small_error;
using test::TrackerTest;

TEST_F(TrackerTest, FollowsTheTargetAndLearnsItsRates) {
  VERIFIES("LASSO-MOD-003~3 LASSO-MOD-002~2");
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

TEST_F(TrackerTest, CoastsOnThePredictionAndTakesUpTheTrackAgain) {
  VERIFIES("LASSO-MOD-005~2 LASSO-MOD-002~2");
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
  VERIFIES("LASSO-MOD-007~2 LASSO-MOD-002~2 LASSO-MOD-005~2 LASSO-MOD-171~3");
  MissionParameters p = test::box_parameters(scene_);
  p.coast_frames = 3;
  load(p);
  start(small_error());
  track(0);
  for (std::uint32_t k = 1; k <= 3; ++k) EXPECT_EQ(miss(k).after.mode, TrackingMode::kCoasting);
  EXPECT_EQ(miss(4).after.mode, TrackingMode::kLost);
}

TEST_F(TrackerTest, EmptySpaceIsNoPose) {
  VERIFIES("LASSO-MOD-005~2");
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

// The target steps aside farther than the filter thinks possible: the registration finds it, yet nobody can tell it from a wrong minimum.
TEST_F(TrackerTest, AJumpThatTheFilterExcludesIsImplausible) {
  VERIFIES("LASSO-MOD-009~2");
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
  state_ = before;
  state_.filter.accepted = 5;
  EXPECT_EQ(track(20).registration.reason, PoseReason::kImplausible);
  MissionParameters lenient = test::box_parameters(scene_);
  lenient.innovation_max = 1000;
  load(lenient);
  state_ = before;
  const Registration found = track(20).registration;
  EXPECT_TRUE(found.valid());
  FilterState then = before.filter;
  ASSERT_EQ(predict_filter(then, found.t_us, filter_noise(lenient)), Status::kOk);
  const Vec6 innovation = pose_difference(found.T_sensor_target, then.T_sensor_target);
  const Mat6 S = then.covariance.topLeftCorner<6, 6>() + found.covariance;
  const double sigmas = std::sqrt(innovation.dot(test::solution_of(S, innovation)));
  for (const double share : {0.999, 1.001}) {
    mission_.parameters.innovation_max = share * sigmas;
    state_ = before;
    EXPECT_EQ(track(20).registration.reason, share < 1 ? PoseReason::kImplausible : PoseReason::kValid) << share;
  }
}

TEST_F(TrackerTest, AnUncertainPredictionIsARoughStart) {
  VERIFIES("LASSO-MOD-010~2");
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
  // Of the limit of one axis alone, on both sides; and where the mission asks for none.
  const auto finds = [&](double share) {
    state_ = sure;
    state_.filter.covariance = 1e-12 * Mat12::Identity();
    state_.filter.covariance(4, 4) = share * share * mission_.parameters.gate_first_m * mission_.parameters.gate_first_m;
    const Registration found = track(5).registration;
    return error(found.T_sensor_target, found.t_us).norm() < 5e-3;
  };
  EXPECT_FALSE(finds(0.95));
  EXPECT_TRUE(finds(1.05));
  mission_.parameters.wide_start = 0;
  EXPECT_FALSE(finds(1.05));
}

// A covariance that says of two directions that they are one has no inverse with the scan's.
TEST_F(TrackerTest, AScanThatTheFilterCannotJoinStartsItAnew) {
  VERIFIES("LASSO-MOD-003~3");
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
  VERIFIES("LASSO-MOD-003~3");
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
  VERIFIES("LASSO-MOD-003~3");
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
  VERIFIES("LASSO-MOD-007~2");
  start(small_error());
  track(0);
  const TrackStep step = no_track(44, state_);
  EXPECT_EQ(step.registration.reason, PoseReason::kNoTrack);
  EXPECT_EQ(step.registration.scan_id, 44u);
  EXPECT_EQ(step.registration.t_us, state_.filter.t_us);
  EXPECT_EQ(step.registration.T_sensor_target.p, state_.filter.T_sensor_target.p);
}

TEST_F(TrackerTest, LooksNearThePredictionThenForTheBearing) {
  VERIFIES("LASSO-MOD-138~1 LASSO-MOD-003~3 LASSO-MOD-171~3");
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

// Of a mission that asks for no recovery: which event ends a start that no scan confirms.
TEST_F(TrackerTest, AStartThatIsNotConfirmedLeavesASearchThatIsInTheOrder) {
  VERIFIES("LASSO-MOD-133~4");
  for (const bool ordered : {true, false}) {
    for (const InitialPoseSource source : {InitialPoseSource::kUplink, InitialPoseSource::kSearch}) {
      MissionParameters p = test::box_parameters(scene_);
      p.start_frames = 0;
      p.coast_frames = 0;
      if (ordered) p.start_fifth = static_cast<double>(InitialPoseSource::kSearch);
      load(p);
      state_ = TrackState();
      start(small_error());
      state_.source = source;
      const bool searched = ordered && source != InitialPoseSource::kSearch;
      EXPECT_EQ(miss(0).event, searched ? ModeEvent::kRecover : ModeEvent::kExhausted);
      EXPECT_EQ(state_.mode, searched ? TrackingMode::kBearing : TrackingMode::kLost);
      state_ = TrackState();
      start(small_error());
      state_.mode = TrackingMode::kTracking;
      EXPECT_EQ(miss(0).after.mode, TrackingMode::kLost) << "it was confirmed";
    }
  }
}

TEST_F(TrackerTest, AHeldModeDoesNotEndByItself) {
  VERIFIES("LASSO-MOD-136~4");
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
  VERIFIES("LASSO-MOD-101~3 LASSO-MOD-104~1");
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

TEST_F(TrackerTest, AValidStepSaysWhereToLookNext) {
  VERIFIES("LASSO-SNS-014~2 LASSO-SNS-016~1");
  mission_.parameters.aimed_share = 0.3;
  mission_.parameters.silhouette_band_m = 0.01;
  start(small_error());
  AimedRays rays;
  TrackStep step;
  for (std::uint32_t k = 0; k < 12; ++k) step = track(k);
  const TimeUs t_us = step.registration.t_us + 2 * kPeriodUs;
  aim_next(mission_, *estimator_, step, 13, t_us, rays);
  EXPECT_EQ(rays.size(), 306u);
  // About the box as it will be seen then.
  Vec3 middle = Vec3::Zero();
  for (const AimedRay& ray : rays) middle += Vec3(static_cast<double>(ray.x), static_cast<double>(ray.y), 1) / 306;
  const Vec3 expected = scene_.pose_at(t_us).p;
  EXPECT_LT((middle - expected / expected.z()).norm(), 0.05);
  aim_next(mission_, *estimator_, step, 13, step.registration.t_us - 1, rays);  // no prediction
  EXPECT_TRUE(rays.empty());
  aim_next(mission_, *estimator_, miss(13), 15, t_us + 2 * kPeriodUs, rays);
  EXPECT_TRUE(rays.empty());
}

// Mean distance between neighbouring rays of one place, on the tangent plane.
double mean_spacing(const AimedRays& rays) {
  double sum = 0;
  for (std::size_t i = 1; i < rays.size(); ++i) {
    const double dx = static_cast<double>(rays[i].x - rays[i - 1].x), dy = static_cast<double>(rays[i].y - rays[i - 1].y);
    if (i % kRaysPerPlace != 0) sum += std::sqrt(dx * dx + dy * dy);
  }
  return sum * kRaysPerPlace / (kRaysPerPlace - 1) / static_cast<double>(rays.size());
}

TEST_F(TrackerTest, RaysAreSpreadAsFarAsPredictionsHaveBeenOff) {
  VERIFIES("LASSO-SNS-017~1");
  mission_.parameters.aimed_share = 0.3;
  mission_.parameters.silhouette_band_m = 0.1;
  mission_.parameters.silhouette_sigma_m = 1e-6;
  start(small_error());
  TrackStep step;
  for (std::uint32_t k = 0; k < 6; ++k) step = track(k);
  const auto spacing = [&](double innovation_ratio) {
    AimedRays rays;
    step.after.filter.innovation_ratio.setConstant(innovation_ratio);
    aim_next(mission_, *estimator_, step, 13, step.registration.t_us + 2 * kPeriodUs, rays);
    EXPECT_GT(rays.size(), 200u);
    return mean_spacing(rays);
  };
  const double whole = spacing(1);
  EXPECT_NEAR(spacing(0.25) / whole, 0.5, 0.1);
  EXPECT_NEAR(spacing(kLeastInnovationRatio) / whole, 0.125, 0.04);
  EXPECT_EQ(spacing(0), spacing(kLeastInnovationRatio)) << "never less";
  EXPECT_EQ(spacing(5), whole) << "never more";
}

}  // namespace
}  // namespace lasso
