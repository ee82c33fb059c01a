#include "fsw/mode/parts.hpp"

#include <algorithm>
#include <memory>

#include "ut/mode/parts_fixture.hpp"
#include "ut/support/dense.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using test::Generator;
using test::PartsTest;

TEST_F(PartsTest, ACovarianceIsPackedAndUnpacked) {
  VERIFIES("LASSO-MOD-162~1");
  Mat6 C;
  for (int i = 0; i < 36; ++i) C(i / 6, i % 6) = 10 * std::min(i / 6, i % 6) + std::max(i / 6, i % 6);
  EXPECT_EQ(unpack(pack(C)), C);
}

// ---- measuring a part

class RegisterPartTest : public PartsTest {
 protected:
  Registration measure(const test::BoxScan& scan, std::size_t part, const Vec6& off) {
    Generator random(5);
    image_ = test::scan_box(scan, random);
    FilterState predicted;
    predicted.T_sensor_target = scan.T_sensor_target;
    predicted.T_sensor_target.q = normalized(exp_so3(off.head<3>()) * scan.T_sensor_target.q);
    predicted.T_sensor_target.p += off.tail<3>();
    predicted.rates = scan.rates;
    return register_part(mission_, parts_[part], *estimator_, *image_, predicted);
  }

  std::unique_ptr<Estimator> estimator_ = std::make_unique<Estimator>();
  std::unique_ptr<RangeImage> image_;
};

test::BoxScan noisy_scan() {
  test::BoxScan scan;
  scan.T_sensor_target = test::generic_box_pose();
  scan.sigma_m = 1e-3;
  return scan;
}

TEST_F(RegisterPartTest, APartOfAMovingTargetGivesTheTargetsPose) {
  VERIFIES("LASSO-MOD-162~1");
  test::BoxScan scan = noisy_scan();
  scan.rates.omega_radps = Vec3(0.05, -0.1, 0.15);
  scan.rates.v_mps = Vec3(0.02, 0.01, -0.05);
  Vec6 off;
  off << 4e-3, -3e-3, 2e-3, 2e-3, -1e-3, 3e-3;
  for (std::size_t part = 0; part < 2; ++part) {
    const Registration r = measure(scan, part, off);
    ASSERT_TRUE(r.valid()) << to_string(r.reason);
    const Vec6 e = pose_difference(r.T_sensor_target, scan.T_sensor_target);
    EXPECT_LT(e.head<3>().norm(), 3e-3) << part;
    EXPECT_LT(e.tail<3>().norm(), 4e-3) << part;
    EXPECT_LT(e.dot(test::inverse_of(r.covariance) * e), 30) << part;
    EXPECT_LT(r.inliers, 0.8 * r.returns) << "the other half does not count";
    EXPECT_GT(r.inlier_share, 0.95);
  }
}

// The target's covariance says of the part's pose what the part's own estimate said.
TEST_F(RegisterPartTest, TheCovarianceIsThatOfThePartSeenFromTheTargetsOrigin) {
  VERIFIES("LASSO-MOD-162~1");
  const test::BoxScan scan = noisy_scan();
  const Registration r = measure(scan, 1, Vec6::Zero());
  StartPoint start;
  const Pose& T_target_part = parts_[1].T_target_part;
  start.T_sensor_target = scan.T_sensor_target * T_target_part;
  start.partial = true;
  const Registration direct = estimator_->estimate(parts_[1].mission, *image_, start);
  Mat6 J;  // of the part's step by the target's, by differences
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 6; ++i) {
    Vec6 x = Vec6::Zero();
    x[i] = kStep;
    Pose moved = r.T_sensor_target;
    moved.q = normalized(exp_so3(x.head<3>()) * moved.q);
    moved.p += x.tail<3>();
    J.col(i) = pose_difference(moved * T_target_part, r.T_sensor_target * T_target_part) / kStep;
  }
  EXPECT_LT((J * r.covariance * J.transpose() - direct.covariance).norm(), 1e-4 * direct.covariance.norm());
  EXPECT_LT(pose_difference(r.T_sensor_target * T_target_part, direct.T_sensor_target).norm(), 1e-9);
}

TEST_F(RegisterPartTest, WeakDirectionsAreTheTargetsWhetherThePoseIsValidOrNot) {
  VERIFIES("LASSO-MOD-162~1");
  const Registration valid = measure(noisy_scan(), 1, Vec6::Zero());
  parts_[1].mission.parameters.agreement_min = 1.5;  // no scan reaches it
  const Registration refused = measure(noisy_scan(), 1, Vec6::Zero());
  ASSERT_TRUE(valid.valid());
  EXPECT_EQ(refused.reason, PoseReason::kModelMismatch);
  EXPECT_EQ(refused.weak, valid.weak);
  EXPECT_EQ(refused.weakest_sigma_m, valid.weakest_sigma_m);
  EXPECT_EQ(refused.weakest_direction, valid.weakest_direction);
}

TEST_F(RegisterPartTest, WhatGivesNoPoseSaysWhy) {
  VERIFIES("LASSO-MOD-162~1");
  test::BoxScan scan = noisy_scan();
  scan.dropouts = 1;
  EXPECT_EQ(measure(scan, 0, Vec6::Zero()).reason, PoseReason::kTooFewReturns);
}

// ---- comparing parts

class ComparePartsTest : public PartsTest {
 protected:
  ComparePartsTest() {
    parts_.clear();
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(parts_.push_back(loaded().parts[0]));
    predicted_.T_sensor_target = test::generic_box_pose();
    predicted_.covariance.topLeftCorner<6, 6>() = 5e-7 * Mat6::Identity();
  }
  // A scan of the part (from 1) that sees the target `off_m` metres farther to the right than predicted; 1 mm is a sigma of two of them.
  PoseReason see(std::uint32_t scan_id, PartNumber part, double off_m, PoseReason reason = PoseReason::kValid) {
    Registration r;
    r.scan_id = scan_id;
    r.reason = reason;
    r.T_sensor_target = predicted_.T_sensor_target;
    r.T_sensor_target.p.x() += off_m;
    r.covariance = sigma2_ * Mat6::Identity();
    report_ = PartsReport{};
    report_.scanned = part;
    return compare_parts(parts_, r, predicted_, state_, report_);
  }
  bool rests_now(std::size_t part, std::uint32_t scan_id) const { return rests(state_.of[part - 1], scan_id); }

  FilterState predicted_;
  double sigma2_ = 0;
};

TEST_F(ComparePartsTest, PartsThatAgreeJoin) {
  VERIFIES("LASSO-MOD-162~1");
  EXPECT_EQ(see(10, 1, 0), PoseReason::kValid);
  EXPECT_EQ(see(11, 2, 5.9e-3), PoseReason::kValid);
  EXPECT_EQ(see(12, 3, 3e-3), PoseReason::kValid);
  EXPECT_EQ(report_.inconsistent, kWhole);
  for (std::size_t part = 1; part <= 3; ++part) EXPECT_FALSE(rests_now(part, 13));
}

TEST_F(ComparePartsTest, TheScannedPartThatDisagreesIsDroppedForTheRest) {
  VERIFIES("LASSO-MOD-162~1");
  see(10, 1, 0);
  see(11, 2, 0);
  EXPECT_EQ(see(12, 3, 6.1e-3), PoseReason::kPartDisagrees);
  EXPECT_EQ(report_.inconsistent, 3);
  EXPECT_NEAR(report_.inconsistency_sigmas, 6.1, 1e-4);
  EXPECT_TRUE(rests_now(3, 13));
  EXPECT_TRUE(rests_now(3, 37));
  EXPECT_FALSE(rests_now(3, 38)) << "25 scans later";
  EXPECT_FALSE(rests_now(1, 13));
}

// The wrong part comes first: the second one is dropped, being the inconsistent one of two; the third one sides with it.
TEST_F(ComparePartsTest, TheMajorityIsRightWhoeverCameFirst) {
  VERIFIES("LASSO-MOD-162~1");
  see(10, 1, 20e-3);
  EXPECT_EQ(see(11, 2, 0), PoseReason::kPartDisagrees);
  EXPECT_TRUE(rests_now(2, 12));
  EXPECT_EQ(see(12, 3, 1e-3), PoseReason::kValid);
  EXPECT_EQ(report_.inconsistent, 1);
  EXPECT_NEAR(report_.inconsistency_sigmas, 20, 1e-4);
  EXPECT_TRUE(rests_now(1, 13));
  EXPECT_FALSE(rests_now(2, 13)) << "reinstated";
  EXPECT_EQ(see(13, 2, 0), PoseReason::kValid);
  EXPECT_EQ(report_.inconsistent, kWhole) << "the inconsistent one rests already: no news";
}

TEST_F(ComparePartsTest, WhatWasToldOnceIsNoNews) {
  VERIFIES("LASSO-MOD-162~1");
  see(10, 1, 0);
  see(11, 2, 0);
  EXPECT_EQ(see(12, 3, 20e-3), PoseReason::kPartDisagrees);
  EXPECT_TRUE(rests_now(3, 37));
  for (const std::uint32_t scan_id : {16U, 30U}) {
    EXPECT_EQ(see(scan_id, 1, 0), PoseReason::kValid);
    EXPECT_EQ(report_.inconsistent, kWhole) << "of part 3 nothing new was seen";
  }
  EXPECT_FALSE(rests_now(3, 38));
  EXPECT_EQ(see(38, 3, 20e-3), PoseReason::kPartDisagrees);
  EXPECT_EQ(report_.inconsistent, 3);
}

TEST_F(ComparePartsTest, APartThatRestsForItsOwnSakeIsNotPardoned) {
  VERIFIES("LASSO-MOD-162~1");
  see(10, 1, 0);
  see(11, 1, 0, PoseReason::kTooFewInliers);
  EXPECT_EQ(see(12, 2, 20e-3), PoseReason::kPartDisagrees);
  EXPECT_TRUE(rests_now(1, 13));
}

TEST_F(ComparePartsTest, ARefusedPoseSpeaksOfNoOtherPart) {
  VERIFIES("LASSO-MOD-162~1");
  see(10, 1, 20e-3);
  refuse_part(10, state_.of[0]);
  EXPECT_TRUE(rests_now(1, 11));
  EXPECT_EQ(see(11, 2, 0), PoseReason::kValid);
  EXPECT_EQ(report_.inconsistent, kWhole);
}

TEST_F(ComparePartsTest, OneThatDisagreesWithOthersTooIsNotPardoned) {
  VERIFIES("LASSO-MOD-162~1");
  see(10, 1, 20e-3);
  see(11, 2, -20e-3);
  EXPECT_TRUE(rests_now(2, 12));
  EXPECT_EQ(see(12, 3, 0), PoseReason::kPartDisagrees);
  EXPECT_EQ(report_.inconsistent, 3) << "all disagree: the scanned one goes";
  EXPECT_TRUE(rests_now(2, 12));
}

TEST_F(ComparePartsTest, AmongTwoTheOneOfLowerPriorityGoes) {
  VERIFIES("LASSO-MOD-162~1");
  parts_[0].priority = 0.5;
  see(10, 1, 10e-3);
  EXPECT_EQ(see(11, 2, 0), PoseReason::kValid);
  EXPECT_EQ(report_.inconsistent, 1);
  EXPECT_TRUE(rests_now(1, 12));
  EXPECT_EQ(see(12, 1, 10e-3), PoseReason::kPartDisagrees) << "a scan that was in flight";
  EXPECT_EQ(report_.inconsistent, 1);
}

TEST_F(ComparePartsTest, OldPosesDoNotCount) {
  VERIFIES("LASSO-MOD-162~1");
  see(10, 1, 10e-3);
  EXPECT_EQ(see(10 + kFreshScans + 1, 2, 0), PoseReason::kValid);
  EXPECT_EQ(see(10 + kFreshScans + 2, 3, 0), PoseReason::kValid);
  state_ = PartsState{};
  see(10, 1, 10e-3);
  EXPECT_EQ(see(10 + kFreshScans, 2, 0), PoseReason::kPartDisagrees);
}

TEST_F(ComparePartsTest, APartWithoutAPoseRestsAndIsNotCompared) {
  VERIFIES("LASSO-MOD-162~1");
  see(10, 1, 0);
  EXPECT_EQ(see(11, 2, 1, PoseReason::kTooFewInliers), PoseReason::kTooFewInliers);
  EXPECT_EQ(report_.inconsistent, kWhole);
  EXPECT_TRUE(rests_now(2, 12));
  EXPECT_FALSE(rests_now(1, 12));
}

TEST_F(ComparePartsTest, WithoutACovarianceNothingCanBeSaid) {
  VERIFIES("LASSO-MOD-162~1");
  predicted_.covariance.setZero();
  see(10, 1, 0);
  EXPECT_EQ(see(11, 2, 1), PoseReason::kValid);
  sigma2_ = 1e-6;
  EXPECT_EQ(see(12, 3, 1), PoseReason::kPartDisagrees);
}

}  // namespace
}  // namespace lasso
