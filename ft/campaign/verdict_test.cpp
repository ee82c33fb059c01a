// What campaigns call wrong, silent, detected: on telemetry made for the purpose.
#include "ft/campaign/verdict.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lasso::campaign {
namespace {

class StillTarget final : public sim::Trajectory {
 public:
  sim::TruthState at(TimeUs) const override { return {}; }
};
const StillTarget kTruth;  // at the origin, untilted

Mat6 covariance_of(double sigma_rad, double sigma_m) {
  Mat6 covariance = Mat6::Identity();
  covariance.topLeftCorner<3, 3>() *= sigma_rad * sigma_rad;
  covariance.bottomRightCorner<3, 3>() *= sigma_m * sigma_m;
  return covariance;
}

Pose off_by(double x_m, double turn_rad) {
  Pose pose;
  pose.p = Vec3(x_m, 0, 0);
  pose.q = exp_so3(Vec3(0, turn_rad, 0));
  return pose;
}

PoseTelemetry report(bool valid, double x_m, double sigma_m = 1e-3) {
  PoseTelemetry pose;
  pose.valid = valid ? 1 : 0;
  pose.p_sensor_target_m[0] = x_m;
  pose.covariance[15] = pose.covariance[18] = pose.covariance[20] = sigma_m * sigma_m;
  return pose;
}

std::vector<std::uint8_t> packets(const std::vector<PoseTelemetry>& poses) {
  std::vector<std::uint8_t> bytes;
  for (const PoseTelemetry& pose : poses) {
    std::uint8_t packet[kMaxPosePacketBytes];
    const std::size_t size = encode_pose(pose, {}, Bytes(packet));
    bytes.insert(bytes.end(), packet, packet + size);
  }
  return bytes;
}

Outcome outcome_of(const std::vector<PoseTelemetry>& poses, End end = End::kDone) {
  const auto sent = packets(poses);
  const auto golden = packets({report(true, 0), report(true, 0)});
  return outcome({sent.data(), sent.size()}, {golden.data(), golden.size()}, kTruth, end);
}

TEST(Verdict, a_pose_is_wrong_beyond_both_its_sigma_and_the_limit) {
  EXPECT_EQ(judge(off_by(0.019, 0), {}, covariance_of(1e-4, 1e-4)), PoseVerdict::kRight);
  EXPECT_EQ(judge(off_by(0.021, 0), {}, covariance_of(1e-4, 0.0041)), PoseVerdict::kWrong);
  EXPECT_EQ(judge(off_by(0.021, 0), {}, covariance_of(1e-4, 0.0043)), PoseVerdict::kCovered);
  EXPECT_EQ(judge(off_by(0, 0.9 * kRadPerDeg), {}, covariance_of(1e-4, 1e-4)), PoseVerdict::kRight);
  EXPECT_EQ(judge(off_by(0, 1.1 * kRadPerDeg), {}, covariance_of(0.21 * kRadPerDeg, 1e-4)), PoseVerdict::kWrong);
  EXPECT_EQ(judge(off_by(0, 1.1 * kRadPerDeg), {}, covariance_of(0.23 * kRadPerDeg, 1e-4)), PoseVerdict::kCovered);
}

TEST(Verdict, only_the_sigma_along_the_error_excuses_it) {
  Mat6 covariance = covariance_of(1e-4, 1e-3);
  covariance(4, 4) = 1;  // y is unknown, x is off
  EXPECT_EQ(judge(off_by(0.03, 0), {}, covariance), PoseVerdict::kWrong);
  covariance(3, 3) = 1;
  EXPECT_EQ(judge(off_by(0.03, 0), {}, covariance), PoseVerdict::kCovered);
}

TEST(Verdict, what_is_not_finite_is_wrong) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(judge(off_by(kNan, 0), {}, covariance_of(1, 1)), PoseVerdict::kWrong);
  EXPECT_EQ(judge(off_by(kInfinity, 0), {}, covariance_of(1, kInfinity)), PoseVerdict::kWrong);
  EXPECT_EQ(judge(off_by(0.03, 0), {}, covariance_of(1, kNan)), PoseVerdict::kWrong);
}

TEST(Verdict, the_filter_is_judged_too) {
  PoseTelemetry pose = report(true, 0);
  pose.filter_p_sensor_target_m[1] = 0.05;
  pose.filter_sigma_pose[4] = 0.001F;
  EXPECT_EQ(judge_valid(pose, {}), PoseVerdict::kWrong);
  pose.filter_sigma_pose[4] = 0.02F;
  EXPECT_EQ(judge_valid(pose, {}), PoseVerdict::kCovered);
  pose.valid = 0;
  pose.filter_sigma_pose[4] = 0.001F;
  EXPECT_EQ(judge_valid(pose, {}), PoseVerdict::kRight) << "it does not ask to be trusted";
}

TEST(Outcome, from_masked_to_detected) {
  EXPECT_EQ(outcome_of({report(true, 0), report(true, 0)}), Outcome::kMasked);
  EXPECT_EQ(outcome_of({report(true, 0), report(true, 0.001)}), Outcome::kHarmless);
  EXPECT_EQ(outcome_of({report(true, 0), report(true, 0.03, 0.01)}), Outcome::kCovered);
  EXPECT_EQ(outcome_of({report(true, 0), report(false, 9)}), Outcome::kDetected);
  EXPECT_EQ(outcome_of({report(true, 0)}), Outcome::kDetected) << "a report is missing";
}

TEST(Outcome, a_wrong_pose_is_silent_whatever_follows) {
  EXPECT_EQ(outcome_of({report(true, 0.03), report(true, 0)}), Outcome::kSilent);
  EXPECT_EQ(outcome_of({report(true, 0.03), report(false, 0)}), Outcome::kSilent);
  EXPECT_EQ(outcome_of({report(true, 0.03)}, End::kCrash), Outcome::kSilent);
}

TEST(Outcome, the_end_of_the_process_counts) {
  EXPECT_EQ(outcome_of({report(true, 0)}, End::kInvariant), Outcome::kInvariant);
  EXPECT_EQ(outcome_of({report(true, 0)}, End::kCrash), Outcome::kCrash);
  EXPECT_EQ(outcome_of({report(true, 0)}, End::kHang), Outcome::kHang);
}

TEST(Outcome, telemetry_that_cannot_be_decoded_is_detected) {
  auto sent = packets({report(true, 0), report(true, 0)});
  const auto golden = sent;
  sent[30] ^= 1;
  EXPECT_EQ(outcome({sent.data(), sent.size()}, {golden.data(), golden.size()}, kTruth, End::kDone), Outcome::kDetected);
  sent[30] ^= 1;
  sent.pop_back();
  EXPECT_EQ(outcome({sent.data(), sent.size()}, {golden.data(), golden.size()}, kTruth, End::kDone), Outcome::kDetected);
}

}  // namespace
}  // namespace lasso::campaign
