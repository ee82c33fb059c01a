#include "mdat/run/statistics.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "ut/support/dense.hpp"
#include "ut/support/generator.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

Pose generic_pose() {
  Pose pose;
  pose.q = exp_so3(Vec3(0.8, -1.1, 0.4));
  pose.p = Vec3(0.1, -0.2, 4);
  return pose;
}

// A covariance as badly scaled as real ones: milliradians beside millimetres, all correlated.
Mat6 generic_covariance(test::Generator& random) {
  Mat6 root;
  for (int i = 0; i < 36; ++i) root(i / 6, i % 6) = random.normal();
  Vec6 scale;
  scale << 3e-4, 1e-4, 5e-4, 1e-3, 2e-4, 4e-5;
  root = scale.asDiagonal() * root;
  return root * root.transpose();
}

Pose disturbed(const Pose& truth, const Vec6& error) {
  Pose pose;
  pose.q = exp_so3(error.head<3>()) * truth.q;
  pose.p = truth.p + error.tail<3>();
  return pose;
}

TEST(PoseError, SplitsIntoSensorAxesAndAnglesAboutTheTargetsAxes) {
  VERIFIES("LASSO-MDT-002~1");
  const Pose truth = generic_pose();
  const double yaw = 0.03, pitch = -0.02, roll = 0.05;
  Pose estimate = truth;
  estimate.q =
      truth.q * (Eigen::AngleAxisd(yaw, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch, Vec3::UnitY()) * Eigen::AngleAxisd(roll, Vec3::UnitX()));
  estimate.p += Vec3(0.001, -0.002, 0.003);
  const PoseError error = pose_error(estimate, truth);
  EXPECT_NEAR((error.translation_m - Vec3(0.001, -0.002, 0.003)).norm(), 0, 1e-15);
  EXPECT_NEAR((error.yaw_pitch_roll - Vec3(yaw, pitch, roll)).norm(), 0, 1e-12);
  EXPECT_NEAR(error.rotation_rad, truth.q.angularDistance(estimate.q), 1e-12);
}

TEST(PoseError, IsLostBeyondFiftyMillimetresOrFiveDegrees) {
  VERIFIES("LASSO-MDT-002~1");
  const Pose truth = generic_pose();
  Vec6 error = Vec6::Zero();
  error[4] = 0.0499;
  EXPECT_FALSE(pose_error(disturbed(truth, error), truth).lost());
  error[4] = 0.0501;
  EXPECT_TRUE(pose_error(disturbed(truth, error), truth).lost());
  error[4] = 0;
  error[1] = 4.99 * kRadPerDeg;
  EXPECT_FALSE(pose_error(disturbed(truth, error), truth).lost());
  error[1] = 5.01 * kRadPerDeg;
  EXPECT_TRUE(pose_error(disturbed(truth, error), truth).lost());
}

TEST(Nees, IsTheMahalanobisDistance) {
  VERIFIES("LASSO-MDT-003~1");
  test::Generator random(3);
  const Pose truth = generic_pose();
  for (int i = 0; i < 50; ++i) {
    const Mat6 covariance = generic_covariance(random);
    Vec6 error;
    for (int k = 0; k < 6; ++k) error[k] = 1e-3 * random.normal();
    const double expected = error.dot(test::solution_of(covariance, error));
    EXPECT_NEAR(nees(disturbed(truth, error), truth, covariance) / expected, 1, 1e-6);
  }
}

TEST(Nees, IsSixOnAverageForErrorsOfThatCovariance) {
  VERIFIES("LASSO-MDT-003~1");
  test::Generator random(4);
  const Pose truth = generic_pose();
  const Mat6 covariance = generic_covariance(random);
  const Mat6 root = test::cholesky_of(covariance);
  double sum = 0;
  constexpr int kDraws = 20000;
  for (int i = 0; i < kDraws; ++i) {
    Vec6 unit;
    for (int k = 0; k < 6; ++k) unit[k] = random.normal();
    sum += nees(disturbed(truth, root * unit), truth, covariance);
  }
  EXPECT_NEAR(sum / kDraws, 6, 5 * std::sqrt(12.0 / kDraws));  // chi^2 of 6 degrees has the variance 12
}

TEST(Nees, IsInfiniteWithoutAProperCovariance) {
  VERIFIES("LASSO-MDT-003~1");
  EXPECT_TRUE(std::isinf(nees(generic_pose(), generic_pose(), Mat6::Zero())));
  Mat6 indefinite = Mat6::Identity();
  indefinite(0, 1) = indefinite(1, 0) = 2;
  EXPECT_TRUE(std::isinf(nees(generic_pose(), generic_pose(), indefinite)));
}

TEST(Statistics, MeansStandardDeviationsAndRoots) {
  VERIFIES("LASSO-MDT-002~1");
  const MeanStd values = mean_std({1, 2, 3, 6});
  EXPECT_DOUBLE_EQ(values.mean, 3);
  EXPECT_DOUBLE_EQ(values.std, std::sqrt(3.5));
  EXPECT_TRUE(std::isnan(mean_std({}).std)) << "of nothing, nothing is known";

  PoseError a, b;
  a.translation_m = Vec3(0.003, 0, 0.004);
  b.translation_m = Vec3(0, 0, -0.001);
  a.yaw_pitch_roll = Vec3(0.1, 0.2, 0.3) * kRadPerDeg;
  b.yaw_pitch_roll = Vec3(0.3, 0.2, 0.1) * kRadPerDeg;
  a.rotation_rad = 3 * kRadPerDeg;
  b.rotation_rad = 4 * kRadPerDeg;
  const ErrorStatistics errors = error_statistics({a, b});
  EXPECT_NEAR(errors.x_mm.mean, 1.5, 1e-12);
  EXPECT_NEAR(errors.z_mm.std, 2.5, 1e-12);
  EXPECT_NEAR(errors.yaw_deg.mean, 0.2, 1e-12);
  EXPECT_NEAR(errors.roll_deg.std, 0.1, 1e-12);
  EXPECT_NEAR(errors.rms_mm, std::sqrt((25 + 1) / 2.0), 1e-12);
  EXPECT_NEAR(errors.rms_deg, std::sqrt((9 + 16) / 2.0), 1e-12);
}

TEST(Statistics, PercentilesByNearestRank) {
  VERIFIES("LASSO-MDT-002~1");
  std::vector<double> times;
  for (int i = 200; i >= 1; --i) times.push_back(i);
  const TimeStatistics result = time_statistics(times);
  EXPECT_EQ(result.median_us, 100);
  EXPECT_EQ(result.p99_us, 198);
  EXPECT_EQ(result.max_us, 200);
  EXPECT_EQ(time_statistics({}).max_us, 0);
}

TEST(Statistics, LostFramesAreCountedAndLeftOutOfErrors) {
  VERIFIES("LASSO-MDT-002~1");
  FrameError good, lost;
  good.reported = lost.reported = true;
  good.valid = true;
  good.registration.translation_m = Vec3(0.001, 0, 0);
  good.bound = {true, 4e-6, 9e-6};
  good.nees = 5;
  good.estimate_us = 100;
  lost.registration.translation_m = Vec3(0.2, 0, 0);
  lost.nees = 1e6;
  lost.estimate_us = 300;
  const FrameError missing;  // no telemetry of it
  const RunStatistics run = run_statistics({good, lost, missing});
  EXPECT_EQ(run.frames, 3U);
  EXPECT_EQ(run.lost, 2U);
  EXPECT_EQ(run.invalid, 2U);
  EXPECT_NEAR(run.registration.rms_mm, 1, 1e-12);
  EXPECT_NEAR(run.crlb_mm, 2, 1e-12);
  EXPECT_NEAR(run.crlb_deg, 0.003 / kRadPerDeg, 1e-12);
  EXPECT_EQ(run.nees, 5);
  EXPECT_EQ(run.time.max_us, 300);
}

TEST(Statistics, TheCovarianceOfARefusedPoseIsNobodysToTrust) {
  VERIFIES("LASSO-MDT-002~1");
  FrameError good, refused;
  good.reported = refused.reported = good.valid = true;
  good.nees = 5;
  refused.nees = 1e6;
  refused.registration.translation_m = Vec3(0.002, 0, 0);
  const RunStatistics run = run_statistics({good, refused});
  EXPECT_EQ(run.invalid, 1U);
  EXPECT_EQ(run.nees, 5);
  EXPECT_NEAR(run.registration.rms_mm, 2 / std::sqrt(2), 1e-12);
}

TEST(Statistics, ErrorsOfFramesWithoutABoundStandOverNoOthers) {
  VERIFIES("LASSO-MDT-002~1");
  FrameError bounded, open;
  bounded.reported = open.reported = true;
  bounded.bound = {true, 4e-6, 9e-6};
  EXPECT_NEAR(run_statistics({bounded, bounded}).crlb_mm, 2, 1e-12);
  EXPECT_TRUE(std::isnan(run_statistics({bounded, open}).crlb_mm));
}

FrameError frame_off(double off_m, double turned_rad, const ProtectionLevels& level) {
  FrameError frame;
  frame.reported = frame.valid = true;
  frame.registration.translation_m = Vec3(0, 0.6, -0.8) * off_m;
  frame.registration.rotation_rad = turned_rad;
  frame.level = level;
  return frame;
}

TEST(Statistics, APoseFartherOffThanItsLevelIsMisleading) {
  VERIFIES("LASSO-GND-131~1");
  const double deg = kRadPerDeg;
  std::vector<FrameError> frames = {frame_off(0.001, 0.1 * deg, {0.004, 0.3 * deg}), frame_off(0.009, 0.1 * deg, {0.008, 0.2 * deg}),
                                    frame_off(0.001, 0.5 * deg, {0.002, 0.4 * deg}), frame_off(0.009, 0.5 * deg, {0.006, 0.1 * deg}),
                                    frame_off(0.5, 9 * deg, {0.001, 0.01 * deg})};
  frames.back().valid = false;  // it says so: nobody is misled
  const ProtectionStatistics protection = protection_statistics(frames);
  EXPECT_EQ(protection.poses, 4U);
  EXPECT_EQ(protection.misleading, 3U);
  EXPECT_EQ(protection.position_mm.misleading, 2U);
  EXPECT_EQ(protection.attitude_deg.misleading, 2U);
  EXPECT_NEAR(protection.position_mm.median, 4, 1e-12);
  EXPECT_NEAR(protection.position_mm.worst, 8, 1e-12);
  EXPECT_NEAR(protection.attitude_deg.median, 0.2, 1e-12);
  EXPECT_NEAR(protection.attitude_deg.worst, 0.4, 1e-12);
  EXPECT_TRUE(std::isnan(protection_statistics({}).position_mm.median)) << "of nothing, nothing is known";
  EXPECT_EQ(run_statistics(frames).protection.misleading, 3U);
}

TEST(Statistics, ARunsTimesToAlertAreThoseOfItsFrames) {
  VERIFIES("LASSO-GND-130~1");
  std::vector<FrameError> run(5);
  for (std::size_t i = 0; i < run.size(); ++i) run[i].t_s = 0.1 + 0.2 * static_cast<double>(i);
  run[1].wrong = run[2].wrong = run[4].wrong = true;
  EXPECT_EQ(alert_times(run, 1).text(), "100+ 400");
}

TEST(Statistics, OnceSettledAllThatIsReportedCountsForTheRates) {
  VERIFIES("LASSO-MDT-002~1");
  std::vector<FrameError> run(23);
  for (FrameError& frame : run) {
    frame.reported = frame.valid = true;
    frame.omega_error_radps = 9;  // not settled
    frame.v_error_mps = 9;
  }
  run[20].omega_error_radps = 0.03 * kRadPerDeg;
  run[20].v_error_mps = 0.004;
  run[21].omega_error_radps = 0.04 * kRadPerDeg;
  run[21].v_error_mps = 0.003;
  run[21].registration.rotation_rad = 0.2;  // lost
  run[22] = {};                             // no telemetry of it
  const SettledStatistics settled = settled_statistics(settled_frames(run));
  EXPECT_EQ(settled.frames, 3U);
  EXPECT_EQ(settled.lost, 2U);
  EXPECT_EQ(settled.invalid, 1U);
  EXPECT_NEAR(settled.rms_degps, 0.05 / std::sqrt(2), 1e-12);
  EXPECT_NEAR(settled.rms_mmps, 5 / std::sqrt(2), 1e-12);
  EXPECT_NEAR(settled.worst_degps, 0.04, 1e-12);
  EXPECT_NEAR(settled.worst_mmps, 4, 1e-12);
  EXPECT_TRUE(settled_frames({run.begin(), run.begin() + 5}).empty());
  EXPECT_TRUE(std::isnan(settled_statistics({}).rms_mmps)) << "of nothing, nothing is known";
  EXPECT_TRUE(std::isnan(run_statistics({{}}).nees)) << "and 0 would be a claim";
}

}  // namespace
}  // namespace lasso::mdat
