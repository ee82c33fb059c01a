// Which part the next scan looks at.
#include <algorithm>
#include <cmath>

#include "ut/mode/parts_fixture.hpp"
#include "ut/support/dense.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using test::BoxPart;
using test::Generator;
using test::PartsTest;

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
  static double gain_of(const Mat6& information, const Vec6& w, const Mat6& C) {
    const Mat6 after = test::inverse_of(test::inverse_of(C) + information);
    return 1 - w.dot(after * w) / w.dot(C * w);
  }
  void believe(const Mat6& C) { next_.predicted.covariance.topLeftCorner<6, 6>() = C; }
  void asked_just_now() {
    for (PartRecord& record : state_.of) record.last_asked_id = next_.scan_id - 1;
  }
};

TEST_F(ChoosePartTest, TakesThePartThatTellsMostOfTheWeakestDirection) {
  VERIFIES("LASSO-MOD-161~3");
  const Mat6 information[2] = {information_of(0), information_of(1)};
  Generator random(3);
  int decided[3] = {};  // by part
  int wrong = 0;
  for (int i = 0; i < 60; ++i) {
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
    const double gain[2] = {gain_of(information[0], direction, C), gain_of(information[1], direction, C)};
    const PartNumber part = choose();
    ASSERT_NE(part, kWhole);
    const double share = gain[part - 1] / std::max(gain[0], gain[1]);
    EXPECT_GT(share, 0.88) << i << " " << gain[0] << " " << gain[1];
    if (std::fabs(gain[0] - gain[1]) < 0.1 * std::max(gain[0], gain[1])) continue;
    ++decided[part];
    if (share < 1) ++wrong;
  }
  EXPECT_LE(wrong, 1) << "of those whose gains differ by a tenth: 96 rays stand for the scan's";
  EXPECT_GE(decided[1], 5);
  EXPECT_GE(decided[2], 5);
}

TEST_F(ChoosePartTest, PriorityWeighs) {
  VERIFIES("LASSO-MOD-161~3");
  for (std::size_t part = 0; part < 2; ++part) {
    parts_[part].priority = 100;
    parts_[1 - part].priority = 0.01;
    asked_just_now();
    EXPECT_EQ(choose(), part + 1);
  }
}

TEST_F(ChoosePartTest, WhatIsInFlightCounts) {
  VERIFIES("LASSO-MOD-161~3");
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
  VERIFIES("LASSO-MOD-161~3");
  parts_[0].priority = 1000;
  parts_[1].priority = 0.001;
  asked_just_now();
  std::uint32_t last[3] = {0, next_.scan_id - 1, next_.scan_id - 1};
  int asked[3] = {};
  for (int i = 0; i < 40; ++i, ++next_.scan_id) {
    const PartNumber part = choose();
    ASSERT_NE(part, kWhole);
    if (part == 2) {
      EXPECT_EQ(next_.scan_id - last[part], 13U) << "as soon as it has waited for more than 12 scans";
    }
    last[part] = next_.scan_id;
    ++asked[part];
  }
  EXPECT_GT(asked[1], 30);
  EXPECT_GE(asked[2], 3);
}

TEST_F(ChoosePartTest, WhoWaitedLongestComesFirst) {
  VERIFIES("LASSO-MOD-161~3");
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
  VERIFIES("LASSO-MOD-161~3");
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
  VERIFIES("LASSO-MOD-161~3");
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
  VERIFIES("LASSO-MOD-161~3");
  next_.predicted.initialised = false;
  EXPECT_EQ(choose(), kWhole);
  next_.predicted.initialised = true;
  believe(Mat6::Zero());
  EXPECT_EQ(choose(), kWhole);
}

}  // namespace
}  // namespace lasso
