#include "fsw/pose/registration/observability.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fsw/geometry/symmetric6.hpp"
#include "ut/pose/pose_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

constexpr double kRadius_m = 0.7;

// Information with known directions: the columns of `axes`, unit vectors over (rotation * radius, translation).
class UnseenTest : public ::testing::Test {
 protected:
  UnseenTest() {
    Mat6 A = Mat6::Zero();
    for (int i = 0; i < 6; ++i) A.col(i) = test::random_vec6(random_, 1);
    axes_ = eigen6(A * A.transpose()).vectors;
  }

  Vec6 scale() const {
    Vec6 scale;
    scale << kRadius_m, kRadius_m, kRadius_m, 1, 1, 1;
    return scale;
  }

  // Of the hits alone, 1/m^2 along each of the axes.
  Mat6 information(const Vec6& values) const {
    return scale().asDiagonal() * axes_ * values.asDiagonal() * axes_.transpose() * scale().asDiagonal();
  }

  static Mat6 with_prior(const Mat6& hits) {
    const double prior = prior_information(kRadius_m, hits.bottomRightCorner<3, 3>().trace());
    Mat6 H = hits;
    for (int i = 0; i < 6; ++i) H(i, i) += prior * (i < 3 ? kRadius_m * kRadius_m : 1);
    return H;
  }

  double variance_along(const Mat6& covariance, int axis) const {
    const Vec6 row = scale().cwiseProduct(Vec6(axes_.col(axis)));
    return row.dot(covariance * row);
  }

  // Of the prior beside hits of these values.
  double prior_beside(const Vec6& values) const {
    return prior_information(kRadius_m, information(values).bottomRightCorner<3, 3>().trace());
  }

  test::Generator random_{501};
  Mat6 axes_;
  Vec6 strong_ = (Vec6() << 1e8, 3e7, 2e9, 5e6, 7e8, 4e7).finished();
  Directions unseen_;
};

TEST(PriorInformation, IsThatOfARadiusAndWhatSumsMayHaveLost) {
  VERIFIES("LASSO-REG-021~1");
  EXPECT_NEAR(prior_information(0.5, 0), 4, 1e-12);
  EXPECT_NEAR(prior_information(0.5, 3e7), 7, 1e-6);
}

TEST_F(UnseenTest, WhereAllIsSeenTheCovarianceIsTheInverse) {
  VERIFIES("LASSO-REG-021~1");
  const Mat6 H = with_prior(information(strong_));
  Mat6 inverse;
  ASSERT_EQ(invert6(H, inverse), Status::kOk);
  unseen_.count = 3;
  EXPECT_EQ(covariance_of_hits(kRadius_m, H, 0.5, unseen_), Mat6(0.5 * inverse));
  EXPECT_EQ(unseen_.count, 0);
}

TEST_F(UnseenTest, WhatNoHitShowsIsAnywhereWhateverTheNoise) {
  VERIFIES("LASSO-REG-021~1");
  for (const double noise : {1e-6, 1.0, 25.0}) {
    Vec6 values = strong_;
    values[2] = 0;
    const Mat6 covariance = covariance_of_hits(kRadius_m, with_prior(information(values)), noise, unseen_);
    ASSERT_EQ(unseen_.count, 1);
    EXPECT_NEAR(std::abs(unseen_.vectors.col(0).dot(axes_.col(2))), 1, 1e-9);
    for (int i = 0; i < 6; ++i) {
      const double truth = i == 2 ? std::pow(kUnobservableSigma * kRadius_m, 2) : noise / values[i];
      EXPECT_NEAR(variance_along(covariance, i), truth, 1e-3 * truth + 1e-15) << i;  // rounding of the large beside the small
    }
  }
}

TEST_F(UnseenTest, WhatIsHardlySeenIsAsUncertainAsItsHitsAlone) {
  VERIFIES("LASSO-REG-021~1");
  Vec6 values = strong_;
  values[4] = 0;
  const double prior = prior_beside(values);
  for (const double share : {1.5, 4.0, 60.0}) {
    values[4] = share * prior;
    const Mat6 covariance = covariance_of_hits(kRadius_m, with_prior(information(values)), 2, unseen_);
    EXPECT_EQ(unseen_.count, 0);
    EXPECT_NEAR(variance_along(covariance, 4), 2 / values[4], 1e-3 * 2 / values[4]) << share;
  }
  values[4] = 0.7 * prior;
  (void)covariance_of_hits(kRadius_m, with_prior(information(values)), 2, unseen_);
  EXPECT_EQ(unseen_.count, 1) << "less is known of it than the prior says";
}

TEST_F(UnseenTest, ALabelSaysNothingOfWhatIsUnseen) {
  VERIFIES("LASSO-REG-021~1");
  Vec6 values = strong_;
  values[1] = values[3] = 0;
  (void)covariance_of_hits(kRadius_m, with_prior(information(values)), 1, unseen_);
  ASSERT_EQ(unseen_.count, 2);
  Label label{};
  const Vec6 kept = 0.8 * axes_.col(0) + 0.3 * axes_.col(5);
  label.a = scale().cwiseProduct(Vec6(kept + 0.04 * axes_.col(1) - 0.03 * axes_.col(3)));
  ASSERT_TRUE(remove_unobservable(kRadius_m, unseen_, label));
  EXPECT_LT((label.a - scale().cwiseProduct(kept)).norm(), 1e-8);
}

TEST_F(UnseenTest, ALabelThatHangsOnWhatIsUnseenHasNoMeaning) {
  VERIFIES("LASSO-REG-021~1");
  Vec6 values = strong_;
  values[1] = 0;
  (void)covariance_of_hits(kRadius_m, with_prior(information(values)), 1, unseen_);
  for (const double sign : {-1.0, 1.0}) {
    Label label{};
    label.a = scale().cwiseProduct(Vec6(axes_.col(0) + sign * 0.06 * axes_.col(1)));
    const Vec6 before = label.a;
    EXPECT_FALSE(remove_unobservable(kRadius_m, unseen_, label));
    EXPECT_EQ(label.a, before);
  }
  Label label{};
  label.a = test::random_vec6(random_, 1);
  const Vec6 before = label.a;
  ASSERT_TRUE(remove_unobservable(kRadius_m, Directions{}, label));
  EXPECT_LT((label.a - before).norm(), 1e-15);
}

}  // namespace
}  // namespace lasso
