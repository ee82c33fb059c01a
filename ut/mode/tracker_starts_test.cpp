#include <limits>

#include "ut/mode/mast_fixture.hpp"
#include "ut/support/dense.hpp"

namespace lasso {
namespace {

using test::kPeriodUs;
using test::MastTest;
using test::small_error;
using test::TrackerTest;

TEST_F(TrackerTest, FirstRegistrationStartsTheFilterAnew) {
  VERIFIES("LASSO-MOD-003~3");
  start(small_error());
  const RangeImage& image = scan(0);
  FilterState known = state_.filter;
  ASSERT_EQ(predict_filter(known, image.reference_time_us(), filter_noise(mission_.parameters)), Status::kOk);
  const TrackStep step = track(0);
  ASSERT_TRUE(step.registration.valid());
  const Mat6 information = test::inverse_of(known.covariance.topLeftCorner<6, 6>()) + test::inverse_of(step.registration.covariance);
  const Mat6 expected = test::inverse_of(information);
  EXPECT_LT((step.after.filter.covariance.topLeftCorner<6, 6>() - expected).norm(), 1e-6 * expected.norm());
  EXPECT_LT((step.after.filter.T_sensor_target.p - step.registration.T_sensor_target.p).norm(), 1e-4);
  EXPECT_EQ((step.after.filter.covariance.topRightCorner<6, 6>().norm()), 0) << "the start says nothing of the rates";
  EXPECT_DOUBLE_EQ(step.after.filter.covariance(11, 11), mission_.parameters.initial_rate_mps * mission_.parameters.initial_rate_mps);
}

// A filter that has no meaning, as a flipped bit leaves it, starts from the scan alone.
TEST_F(TrackerTest, AFirstRegistrationCanStandAlone) {
  VERIFIES("LASSO-MOD-003~3");
  start(small_error());
  state_.filter.covariance(0, 0) = -1;
  const TrackStep step = track(0);
  ASSERT_TRUE(step.registration.valid()) << to_string(step.registration.reason);
  EXPECT_EQ((step.after.filter.T_sensor_target.p - step.registration.T_sensor_target.p).norm(), 0);
  EXPECT_LT((step.after.filter.covariance.topLeftCorner<6, 6>() - step.registration.covariance).norm(), 1e-18);
}

// From where a narrow registration does not find the box.
Vec6 far_off() {
  Vec6 off;
  off << 0.12, -0.1, 0.08, 0.1, 0.08, 0.12;
  return off;
}

TEST_F(TrackerTest, WideStartTakesWhatANarrowOneCannot) {
  VERIFIES("LASSO-MOD-004~2");
  const Vec6 off = far_off();
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

// Of a prediction that is believed to be right, so that the mode alone asks for a wide start, also after a scan that was lost.
TEST_F(TrackerTest, OnlyModesThatLookForTheTargetRegisterFromAWideStart) {
  VERIFIES("LASSO-MOD-004~2");
  const auto finds = [&](TrackingMode mode) {
    state_ = TrackState{};
    start(far_off());
    miss(0);
    state_.mode = mode;
    state_.filter.covariance = 1e-10 * state_.filter.covariance.Identity();
    const Registration found = track(1).registration;
    return error(found.T_sensor_target, found.t_us).norm() < 5e-3;
  };
  for (const double wide : {1.0, 0.0}) {
    MissionParameters p = test::box_parameters(scene_);
    p.wide_start = wide;
    load(p);
    for (const TrackingMode mode : {TrackingMode::kStarting, TrackingMode::kReacquiring})
      EXPECT_EQ(finds(mode), wide > 0) << to_string(mode);
    for (const TrackingMode mode : {TrackingMode::kTracking, TrackingMode::kCoasting, TrackingMode::kVerifying})
      EXPECT_FALSE(finds(mode)) << to_string(mode);
  }
}

TEST_F(TrackerTest, MovesTheStartToItsFrame) {
  VERIFIES("LASSO-MOD-003~3 LASSO-MOD-132~1");
  ASSERT_EQ(start_at(scene_.pose_at(300000), scene_.rates, 300000, 1000000), StartRefusal::kNone);
  EXPECT_LT(error(state_.filter.T_sensor_target, 1000000).norm(), 1e-12);
  EXPECT_EQ(state_.filter.t_us, 1000000);
  EXPECT_EQ(state_.mode, TrackingMode::kStarting);
  EXPECT_EQ(state_.source, InitialPoseSource::kUplink);
}

TEST_F(TrackerTest, RefusesAStartThatMeansNothing) {
  VERIFIES("LASSO-MOD-008~2");
  Pose bad = scene_.at_zero;
  bad.q.w() += 0.1;
  EXPECT_EQ(start_at(bad, Twist{}, 0, 0), StartRefusal::kNotUnit);
  bad = scene_.at_zero;
  bad.p.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(start_at(bad, Twist{}, 0, 0), StartRefusal::kNotFinite);
  EXPECT_EQ(state_.mode, TrackingMode::kStandby);
  EXPECT_FALSE(state_.filter.initialised);
}

// Twelve degrees off with a believed sigma of half a degree: the scan finds the target, but not where the start says.
TEST_F(TrackerTest, AStartFartherOffThanItsCovarianceSaysIsNotConfirmed) {
  VERIFIES("LASSO-MOD-132~1 LASSO-MOD-134~3");
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

TEST_F(MastTest, AStartHalfATurnOffIsNeverTracked) {
  VERIFIES("LASSO-MOD-132~1 LASSO-MOD-134~3 LASSO-MOD-171~3 LASSO-MOD-182~2");
  load_with_others(0.9);
  start(small_error());
  track_view(0);
  ASSERT_EQ(state_.mode, TrackingMode::kTracking) << "the right start is taken";
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0.6, 0.64, 0.48)}) {
    start_turned(axis);
    for (std::uint32_t k = 1; k <= 4; ++k) {
      track_view(k);
      EXPECT_EQ(state_.mode, TrackingMode::kStarting) << axis.transpose();
    }
    track_view(5);
    EXPECT_EQ(state_.mode, TrackingMode::kLost) << axis.transpose();
  }
}

TEST_F(MastTest, AStartThatExplainsTooLittleOfItsScanIsNotConfirmed) {
  VERIFIES("LASSO-MOD-132~1");
  load_with_others(0.9);
  mission_.parameters.agreement_min = 0;  // or its rays would tell already
  int refused = 0;
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
    start_turned(axis);
    refused += track_view(1).registration.reason == PoseReason::kLowInlierShare ? 1 : 0;
    EXPECT_EQ(state_.mode, TrackingMode::kStarting) << axis.transpose();
  }
  EXPECT_GE(refused, 1);
}

// Where a start's share alone would do, its rays tell.
TEST_F(MastTest, AStartThatANearSymmetryTurnedIsRefusedByTheRaysThatContradictIt) {
  VERIFIES("LASSO-MOD-182~2 LASSO-MOD-183~3");
  load_with_others(0);
  start(small_error());
  ASSERT_TRUE(track_view(0).registration.valid()) << "the right start is taken";
  const double agreement_min = mission_.parameters.agreement_min;
  int refused = 0;
  for (std::uint32_t k = 0; k < mission_.search.symmetries.size(); ++k) {
    const Vec3 axis = rotate(scene_.at_zero.q, Vec3::Unit(static_cast<int>(k % 3)));
    start_turned(axis);
    if (track_view(k).registration.reason != PoseReason::kModelMismatch) continue;
    ++refused;
    EXPECT_EQ(state_.mode, TrackingMode::kStarting);
    mission_.parameters.agreement_min = 0;
    start_turned(axis);
    EXPECT_TRUE(track_view(k).registration.valid()) << "by itself it explains enough";
    mission_.parameters.agreement_min = agreement_min;
  }
  EXPECT_GE(refused, 1);
}

// Nothing in a scan can tell the poses of a symmetric target apart: the start decides.
TEST_F(MastTest, AStartOfASymmetricTargetIsTaken) {
  VERIFIES("LASSO-MOD-183~3");
  load(test::box_parameters(scene_));
  others_.clear();
  for (std::uint32_t k = 0; k < 6; ++k) {
    state_ = TrackState{};
    Pose half_turn;  // about the box's middle
    half_turn.q = exp_so3(kPi * Vec3::Unit(static_cast<int>(k % 3)));
    half_turn.p = scene_.box.center - rotate(half_turn.q, scene_.box.center);
    ASSERT_EQ(start_at(scene_.at_zero * half_turn, Twist{}, 0, 0), StartRefusal::kNone);
    const PoseReason reason = track_view(k).registration.reason;
    EXPECT_EQ(reason, PoseReason::kValid) << k << " " << to_string(reason);
  }
}

TEST_F(TrackerTest, BeginningATrackTakesMoreThanKeepingIt) {
  VERIFIES("LASSO-MOD-135~3 LASSO-MOD-171~3");
  MissionParameters p = test::box_parameters(scene_);
  p.inlier_share_min = 0.9;
  p.start_inlier_share_min = p.agreement_min = 0;
  load(p);
  start(small_error());
  ASSERT_TRUE(track(0).registration.valid());
  spoiled_ = true;
  mission_.parameters.hysteresis = 0.2;  // raises the limit to 1, and no farther
  EXPECT_TRUE(track(1).registration.valid()) << "the track holds";
  miss(2);
  EXPECT_EQ(track(3).registration.reason, PoseReason::kLowInlierShare) << "it is not taken up";
  EXPECT_EQ(state_.mode, TrackingMode::kCoasting);
  mission_.parameters.hysteresis = 0.05;
  EXPECT_TRUE(track(4).registration.valid());
  miss(5);
  spoiled_ = false;
  mission_.parameters.hysteresis = 0.2;
  Registration flawless;
  for (std::uint32_t k = 6; k <= 8; ++k) flawless = track(k).registration;  // in those before one ray at an edge is not explained
  EXPECT_EQ(flawless.inlier_share, 1);
  EXPECT_TRUE(flawless.valid()) << "a scan of which all is explained always passes";
}

TEST_F(TrackerTest, BeginningATrackTakesHalfTheContradictionsThatKeepIt) {
  VERIFIES("LASSO-MOD-135~3 LASSO-MOD-171~3");
  MissionParameters p = test::box_parameters(scene_);
  p.start_inlier_share_min = p.agreement_min = p.inlier_share_min = 0;
  p.hysteresis = 0.5;
  load(p);
  start(small_error());
  ASSERT_TRUE(track(0).registration.valid());
  spoiled_ = true;
  const double agreement = track(1).registration.agreement;
  ASSERT_LT(agreement, 0.99);
  mission_.parameters.agreement_min = 2 * agreement - 1 + 0.5 * (1 - agreement);
  EXPECT_TRUE(track(2).registration.valid()) << "the track holds";
  miss(3);
  EXPECT_EQ(track(4).registration.reason, PoseReason::kModelMismatch) << "it is not taken up";
  EXPECT_EQ(state_.mode, TrackingMode::kCoasting);
  mission_.parameters.hysteresis = 0.1 * (1 - agreement);
  EXPECT_TRUE(track(5).registration.valid()) << "raised by less";
  miss(6);
  mission_.parameters.hysteresis = 0.5;
  mission_.parameters.agreement_min = 2 * agreement - 1 - 0.5 * (1 - agreement);
  EXPECT_TRUE(track(7).registration.valid()) << "and by no more than half";
}

// A filter that nobody has heard of for too long has nothing against what a scan finds.
TEST_F(TrackerTest, AStartThatCannotBePredictedIsConfirmedByTheScanAlone) {
  VERIFIES("LASSO-MOD-003~3");
  start(small_error());
  state_.filter.initialised = false;
  EXPECT_TRUE(track(0).registration.valid());
  EXPECT_EQ(state_.mode, TrackingMode::kTracking);
}

}  // namespace
}  // namespace lasso
