#include "fsw/mode/parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "ut/support/box_parts.hpp"
#include "ut/support/box_scan.hpp"
#include "ut/support/dense.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using test::BoxPart;
using test::Generator;

// The halves of the box, as an image says them.
struct Loaded {
  Loaded() {
    MissionParameters p = preset_parameters();
    p.sigma0_m = 1e-3;
    p.sigma_k_per_m = 0;
    image = test::make_image(p, test::with_parts(test::make_box_tables(test::BoxModel{}), test::two_halves(), p));
    EXPECT_EQ(load_image(Bytes(image.data(), image.size), mission, parts).status, Status::kOk);
  }
  test::TestImage image;
  Mission mission;
  Parts parts;
};

class PartsTest : public ::testing::Test {
 protected:
  static const Loaded& loaded() {
    static const Loaded halves;
    return halves;
  }
  PartsTest() : mission_(loaded().mission), parts_(loaded().parts) {
    next_.scan_id = 100;
    next_.predicted.initialised = true;
    next_.predicted.T_sensor_target = test::generic_box_pose();
    next_.predicted.covariance.topLeftCorner<6, 6>() = 1e-8 * Mat6::Identity();
  }

  Mission mission_;
  Parts parts_;
  PartsState state_;
  PartsReport report_;
  NextScan next_;
};

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
    return compare_parts(mission_, parts_, r, predicted_, state_, report_);
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
  EXPECT_EQ(report_.odd, kWhole);
  for (std::size_t part = 1; part <= 3; ++part) EXPECT_FALSE(rests_now(part, 13));
}

TEST_F(ComparePartsTest, TheScannedPartThatDisagreesIsDroppedForTheRest) {
  VERIFIES("LASSO-MOD-162~1");
  see(10, 1, 0);
  see(11, 2, 0);
  EXPECT_EQ(see(12, 3, 6.1e-3), PoseReason::kPartDisagrees);
  EXPECT_EQ(report_.odd, 3);
  EXPECT_NEAR(report_.odd_sigmas, 6.1, 1e-4);
  EXPECT_TRUE(rests_now(3, 13));
  EXPECT_TRUE(rests_now(3, 37));
  EXPECT_FALSE(rests_now(3, 38)) << "short_range.rest_frames";
  EXPECT_FALSE(rests_now(1, 13));
}

// The wrong part comes first: the second one is dropped, being the odd one among two; the third one sides with it.
TEST_F(ComparePartsTest, TheMajorityIsRightWhoeverCameFirst) {
  VERIFIES("LASSO-MOD-162~1");
  see(10, 1, 20e-3);
  EXPECT_EQ(see(11, 2, 0), PoseReason::kPartDisagrees);
  EXPECT_TRUE(rests_now(2, 12));
  EXPECT_EQ(see(12, 3, 1e-3), PoseReason::kValid);
  EXPECT_EQ(report_.odd, 1);
  EXPECT_NEAR(report_.odd_sigmas, 20, 1e-4);
  EXPECT_TRUE(rests_now(1, 13));
  EXPECT_FALSE(rests_now(2, 13)) << "pardoned";
  EXPECT_EQ(see(13, 2, 0), PoseReason::kValid);
  EXPECT_EQ(report_.odd, kWhole) << "the odd one rests already: no news";
}

TEST_F(ComparePartsTest, WhatWasToldOnceIsNoNews) {
  VERIFIES("LASSO-MOD-162~1");
  mission_.parameters.rest_frames = 2;
  see(10, 1, 0);
  see(11, 2, 0);
  EXPECT_EQ(see(12, 3, 20e-3), PoseReason::kPartDisagrees);
  EXPECT_TRUE(rests_now(3, 14));
  EXPECT_EQ(see(16, 1, 0), PoseReason::kValid);
  EXPECT_EQ(report_.odd, kWhole) << "of part 3 nothing new was seen";
  EXPECT_FALSE(rests_now(3, 17));
  EXPECT_EQ(see(17, 3, 20e-3), PoseReason::kPartDisagrees);
  EXPECT_EQ(report_.odd, 3);
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
  refuse_part(mission_.parameters, 10, state_.of[0]);
  EXPECT_TRUE(rests_now(1, 11));
  EXPECT_EQ(see(11, 2, 0), PoseReason::kValid);
  EXPECT_EQ(report_.odd, kWhole);
}

TEST_F(ComparePartsTest, OneThatDisagreesWithOthersTooIsNotPardoned) {
  VERIFIES("LASSO-MOD-162~1");
  see(10, 1, 20e-3);
  see(11, 2, -20e-3);
  EXPECT_TRUE(rests_now(2, 12));
  EXPECT_EQ(see(12, 3, 0), PoseReason::kPartDisagrees);
  EXPECT_EQ(report_.odd, 3) << "all disagree: the scanned one goes";
  EXPECT_TRUE(rests_now(2, 12));
}

TEST_F(ComparePartsTest, AmongTwoTheOneOfLowerPriorityGoes) {
  VERIFIES("LASSO-MOD-162~1");
  parts_[0].priority = 0.5;
  see(10, 1, 10e-3);
  EXPECT_EQ(see(11, 2, 0), PoseReason::kValid);
  EXPECT_EQ(report_.odd, 1);
  EXPECT_TRUE(rests_now(1, 12));
  EXPECT_EQ(see(12, 1, 10e-3), PoseReason::kPartDisagrees) << "a scan that was in flight";
  EXPECT_EQ(report_.odd, 1);
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
  EXPECT_EQ(report_.odd, kWhole);
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

// ---- choosing a part

class ChoosePartTest : public PartsTest {
 protected:
  PartNumber choose() { return choose_part(mission_, parts_, next_, state_); }

  // The truth by brute force: what the pixels of a scan of the part say, by differences of the exact range.
  Mat6 information_of(std::size_t part) const {
    const BoxPart truth = test::two_halves()[part];
    const Pose T = next_.predicted.T_sensor_target;
    Mat6 H = Mat6::Zero();
    constexpr int kSide = 60;
    double rays = 0;
    Vec3 low = Vec3::Constant(1e9), high = -low;
    for (int k = 0; k < 8; ++k) {
      const Vec3 corner = truth.box.half.cwiseProduct(Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1));
      const Vec3 seen = (T * truth.T_target_part) * corner;
      low = low.cwiseMin(seen / seen.z());
      high = high.cwiseMax(seen / seen.z());
    }
    for (int i = 0; i < kSide * kSide; ++i) {
      const double x = low.x() + (i % kSide + 0.5) / kSide * (high.x() - low.x());
      const double y = low.y() + (i / kSide + 0.5) / kSide * (high.y() - low.y());
      ++rays;
      const Vec6 g = gradient(truth, T, Vec3(x, y, 1).normalized());
      H += 1e6 * g * g.transpose();
    }
    return mission_.parameters.points / rays * H;
  }
  static double range(const BoxPart& part, const Pose& T_sensor_target, const Vec3& u) {
    const Pose T = inverse(T_sensor_target * part.T_target_part);
    const double hit = test::cast_box(part.box, T.p, rotate(T.q, u));
    return (T.p + hit * rotate(T.q, u)).x() > -part.box.half.x() + 1e-9 ? hit : -1;  // it is open where it was cut
  }
  static Vec6 gradient(const BoxPart& part, const Pose& T, const Vec3& u) {
    constexpr double kStep = 1e-6;
    Vec6 g = Vec6::Zero();
    for (int i = 0; i < 6 && range(part, T, u) > 0; ++i) {
      double change = 0;
      for (const double sign : {1.0, -1.0}) {
        Vec6 x = Vec6::Zero();
        x[i] = sign * kStep;
        Pose moved = T;
        moved.q = normalized(exp_so3(x.head<3>()) * T.q);
        moved.p += x.tail<3>();
        change += sign * range(part, moved, u);
      }
      g[i] = std::fabs(change) < 1e-3 ? change / (2 * kStep) : 0;
    }
    return g;
  }
  double gain_of(std::size_t part, const Vec6& w, const Mat6& C) const {
    const Mat6 after = test::inverse_of(test::inverse_of(C) + information_of(part));
    return 1 - w.dot(after * w) / w.dot(C * w);
  }
  void believe(const Mat6& C) { next_.predicted.covariance.topLeftCorner<6, 6>() = C; }
  void asked_just_now() {
    for (PartRecord& record : state_.of) record.last_asked_id = next_.scan_id - 1;
  }
};

TEST_F(ChoosePartTest, TakesThePartThatTellsMostOfTheWeakestDirection) {
  VERIFIES("LASSO-MOD-161~1");
  Generator random(3);
  int decided = 0;
  int chosen[3] = {};
  for (int i = 0; i < 8; ++i) {
    Vec6 w;
    for (int k = 0; k < 6; ++k) w[k] = random.uniform(-1, 1);
    w.normalize();
    Vec6 scale;
    scale << 1 / mission_.radius_m, 1 / mission_.radius_m, 1 / mission_.radius_m, 1, 1, 1;
    const Vec6 e = scale.cwiseProduct(w);
    const Mat6 C = 4e-10 * e * e.transpose() + 1e-12 * Mat6(scale.cwiseProduct(scale).asDiagonal());
    believe(C);
    asked_just_now();
    const Vec6 direction = w.cwiseQuotient(scale);
    const double gain[2] = {gain_of(0, direction, C), gain_of(1, direction, C)};
    const PartNumber part = choose();
    ++chosen[part];
    if (std::fabs(gain[0] - gain[1]) < 0.1 * std::max(gain[0], gain[1])) continue;
    ++decided;
    EXPECT_EQ(part, gain[0] > gain[1] ? 1 : 2) << i << " " << gain[0] << " " << gain[1];
  }
  EXPECT_GE(decided, 2);
  EXPECT_EQ(chosen[kWhole], 0);
}

TEST_F(ChoosePartTest, PriorityWeighs) {
  VERIFIES("LASSO-MOD-161~1");
  for (std::size_t part = 0; part < 2; ++part) {
    parts_[part].priority = 100;
    parts_[1 - part].priority = 0.01;
    asked_just_now();
    EXPECT_EQ(choose(), part + 1);
  }
}

TEST_F(ChoosePartTest, WhatIsInFlightCounts) {
  VERIFIES("LASSO-MOD-161~1");
  // As little is known that one scan of a part shows all, after which the other part tells more.
  believe(1e-6 * Mat6::Identity());
  asked_just_now();
  const PartNumber first = choose();
  ASSERT_NE(first, kWhole);
  asked_just_now();
  next_.in_flight = first;
  EXPECT_EQ(choose(), 3 - first);
}

TEST_F(ChoosePartTest, NobodyWaitsForEver) {
  VERIFIES("LASSO-MOD-161~1");
  parts_[0].priority = 1000;
  parts_[1].priority = 0.001;
  asked_just_now();
  std::uint32_t last[3] = {0, next_.scan_id - 1, next_.scan_id - 1};
  int asked[3] = {};
  for (int i = 0; i < 40; ++i, ++next_.scan_id) {
    const PartNumber part = choose();
    ASSERT_NE(part, kWhole);
    EXPECT_LE(next_.scan_id - last[part], kLongestWait + kMaxParts);
    last[part] = next_.scan_id;
    ++asked[part];
  }
  EXPECT_GT(asked[1], 30);
  EXPECT_GE(asked[2], 3);
}

TEST_F(ChoosePartTest, WhoWaitedLongestComesFirst) {
  VERIFIES("LASSO-MOD-161~1");
  state_.of[0].last_asked_id = 50;
  state_.of[1].last_asked_id = 40;
  EXPECT_EQ(choose(), 2);
  EXPECT_EQ(state_.of[1].last_asked_id, 100U);
  ++next_.scan_id;
  EXPECT_EQ(choose(), 1);
  state_.of[0].last_asked_id = 30;
  state_.of[1].last_asked_id = 40;
  EXPECT_EQ(choose(), 1) << "the first of them stays";
}

TEST_F(ChoosePartTest, LooksAtNoPartThatCannotBeSeen) {
  VERIFIES("LASSO-MOD-161~1");
  const Vec3 to_sensor = inverse(next_.predicted.T_sensor_target * parts_[0].T_target_part).p;
  const double range_m = to_sensor.norm();
  EXPECT_TRUE(parts_.size() == 2);
  parts_.shrink(1);
  EXPECT_EQ(choose(), 1);
  parts_[0].range_max_m = range_m - 0.01;
  EXPECT_EQ(choose(), kWhole);
  parts_[0].range_max_m = range_m + 0.01;
  EXPECT_EQ(choose(), 1);
  parts_[0].range_min_m = range_m + 0.005;
  EXPECT_EQ(choose(), kWhole);
  parts_[0].range_min_m = 0;
  parts_[0].view = to_sensor.normalized();
  parts_[0].cone_cosine = 0.9999;
  EXPECT_EQ(choose(), 1);
  parts_[0].view = -parts_[0].view;
  EXPECT_EQ(choose(), kWhole);
  parts_[0].cone_cosine = -1;
  state_.of[0].rests_until = 101;
  EXPECT_EQ(choose(), kWhole);
  state_.of[0].rests_until = 100;
  EXPECT_EQ(choose(), 1);
  parts_[0].range_max_m = 10;
  parts_[0].range_min_m = 0;
  next_.predicted.T_sensor_target.p.x() += 3;  // out of the field of view
  EXPECT_EQ(choose(), kWhole);
}

TEST_F(ChoosePartTest, LooksAtNoPartWhosePlaceIsUncertain) {
  VERIFIES("LASSO-MOD-161~1");
  const double gate_m = parts_[0].mission.parameters.gate_first_m;
  Mat6 C = 1e-8 * Mat6::Identity();
  C(3, 3) = gate_m * gate_m;
  believe(C);
  EXPECT_EQ(choose(), kWhole);
  C(3, 3) = 0.5 * gate_m * gate_m;
  believe(C);
  EXPECT_NE(choose(), kWhole);
}

TEST_F(ChoosePartTest, LooksAtNoPartWithoutAPrediction) {
  VERIFIES("LASSO-MOD-161~1");
  next_.predicted.initialised = false;
  EXPECT_EQ(choose(), kWhole);
  next_.predicted.initialised = true;
  believe(Mat6::Zero());
  EXPECT_EQ(choose(), kWhole);
}

}  // namespace
}  // namespace lasso
