#include "fsw/pose/silhouette/outline_constraint.hpp"

#include <cmath>

#include "fsw/geometry/symmetric6.hpp"
#include "ut/pose/pose_fixture.hpp"
#include "ut/support/dense.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

// Covariances with known axes, unit vectors over (rotation * radius, translation), and sigmas.
class SlackTest : public test::PoseFixture {
 protected:
  SlackTest() {
    mission_.radius_m = 0.7;
    parameters().silhouette_band_m = 4e-3;
    Mat6 A = Mat6::Zero();
    for (int i = 0; i < 6; ++i) A.col(i) = test::random_vec6(random_, 1);
    axes_ = eigen6(A * A.transpose()).vectors;
    sigmas_m_ << 1e-4, 2e-4, 5e-4, 3.9e-3, 4.1e-3, 0.4;
  }

  Vec6 scale() const { return radius_scale(mission_.radius_m); }
  Mat6 unscaled(const Mat6& covariance) const {
    const Vec6 inverse = scale().cwiseInverse();
    return inverse.asDiagonal() * covariance * inverse.asDiagonal();
  }
  Mat6 covariance() const { return unscaled(axes_ * sigmas_m_.cwiseAbs2().asDiagonal() * axes_.transpose()); }
  // Information over (rotation, translation) of a measurement along an axis.
  Mat6 information_along(const Vec6& axis, double sigma_m) const {
    const Vec6 row = scale().cwiseProduct(axis) / sigma_m;
    return row * row.transpose();
  }

  void expect_same(const Mat6& found, const Mat6& truth, double relative) const {
    const Vec6 s = truth.diagonal().cwiseSqrt();
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) EXPECT_NEAR(found(i, j), truth(i, j), relative * s[i] * s[j]) << i << j;
    }
  }

  Mat6 axes_;
  Vec6 sigmas_m_;
};

TEST_F(SlackTest, SlackAreTheAxesThatAreLooserThanAnOutlineHoldsThem) {
  VERIFIES("LASSO-REG-022~3");
  const Directions weakly_observable = find_weakly_observable(mission_, covariance());
  ASSERT_EQ(weakly_observable.count, 2);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(std::abs(weakly_observable.vectors.col(i).dot(axes_.col(4 + i))), 1, 1e-9);
  sigmas_m_[5] = 0.08;
  EXPECT_EQ(find_weakly_observable(mission_, covariance()).count, 2);
  sigmas_m_[5] = 0.06;
  EXPECT_EQ(find_weakly_observable(mission_, covariance()).count, 0) << "a tenth of the radius: none is that loose";
}

TEST_F(SlackTest, TheOutlineHoldsWhatItSaysAndNoHitShowsTheRest) {
  VERIFIES("LASSO-REG-022~3 LASSO-REG-023~1");
  sigmas_m_ << 1e-4, 2e-4, 5e-3, 0.01, 2, 2.05;  // the last ones no hit shows
  OutlineFit outline;
  outline.within_m << 1e-3, 0, 0.02, 0, 0, 0;
  const Directions weakly_observable = find_weakly_observable(mission_, covariance());
  ASSERT_EQ(weakly_observable.count, 4);
  Directions unobservable;
  unobservable.count = 4;
  const OutlineConstraint constraint = constrain_by_outline(mission_, outline, weakly_observable, covariance(), unobservable);
  ASSERT_EQ(constraint.axes.count, 2);
  EXPECT_EQ(constraint.axes.vectors.col(0), weakly_observable.vectors.col(0));
  EXPECT_EQ(constraint.axes.vectors.col(1), weakly_observable.vectors.col(2));
  EXPECT_DOUBLE_EQ(constraint.sigma_m[0], 2e-3) << "half of the labels' band is enough";
  EXPECT_DOUBLE_EQ(constraint.sigma_m[1], 0.01);
  EXPECT_DOUBLE_EQ(constraint.band_m, 0.02);
  ASSERT_EQ(unobservable.count, 1);
  EXPECT_EQ(unobservable.vectors.col(0), weakly_observable.vectors.col(3));
}

TEST_F(SlackTest, AnOutlineHoldsWhatItKnowsCloselyAndBetterThanTheHits) {
  VERIFIES("LASSO-REG-022~3");
  sigmas_m_ << 1e-4, 2e-4, 6e-3, 0.08, 0.09, 0.1;
  const Directions weakly_observable = find_weakly_observable(mission_, covariance());
  ASSERT_EQ(weakly_observable.count, 4);
  OutlineFit outline;
  outline.within_m << 0.011, 0.08, 0.09, 0, 0, 0;
  Directions unobservable;
  EXPECT_EQ(constrain_by_outline(mission_, outline, weakly_observable, covariance(), unobservable).axes.count, 2)
      << "an eighth of the radius is too wide";
  outline.within_m << 0.013, 0, 0, 0.08, 0, 0;
  const OutlineConstraint constraint = constrain_by_outline(mission_, outline, weakly_observable, covariance(), unobservable);
  ASSERT_EQ(constraint.axes.count, 1);
  EXPECT_EQ(constraint.axes.vectors.col(0), weakly_observable.vectors.col(3));
  EXPECT_EQ(unobservable.count, 0);
}

class HoldTest : public SlackTest {
 protected:
  HoldTest() {
    hold_.axes.count = 2;
    for (int i = 0; i < 2; ++i) hold_.axes.vectors.col(i) = axes_.col(4 + i);
    hold_.sigma_m[0] = 2e-3;
    hold_.sigma_m[1] = 7e-3;
  }
  double radius_m() const { return mission_.radius_m; }

  OutlineConstraint hold_;
};

TEST_F(HoldTest, HeldIsWhatAMeasurementOfEachWouldLeave) {
  VERIFIES("LASSO-REG-023~1");
  Mat6 information = test::inverse_of(covariance());
  for (int i = 0; i < 2; ++i) information += information_along(axes_.col(4 + i), hold_.sigma_m[i]);
  expect_same(add_constraint(radius_m(), hold_, covariance()), test::inverse_of(information), 1e-6);
}

TEST_F(HoldTest, ReleasedIsWhatWouldBeKnownWithoutTheOutline) {
  VERIFIES("LASSO-REG-023~1");
  const Mat6 held = add_constraint(radius_m(), hold_, covariance());
  expect_same(remove_constraint(radius_m(), hold_, held), covariance(), 1e-6);
  const Vec6 label = (axes_.col(5) + 0.4 * axes_.col(4) - 0.3 * axes_.col(1)).normalized();
  const Mat6 told = information_along(label, 6e-4);
  const Mat6 released = remove_constraint(radius_m(), hold_, test::inverse_of(test::inverse_of(held) + told));
  expect_same(released, test::inverse_of(test::inverse_of(covariance()) + told), 1e-6);
}

TEST_F(HoldTest, WhatTheOutlineAloneHeldIsAnywhereOnceReleased) {
  VERIFIES("LASSO-REG-023~1");
  for (const double radius : {0.7, 6.0, 10.0}) {
    for (const double rounding : {-1e-10, 0.0, 1e-10, 1e-9}) {
      mission_.radius_m = radius;
      sigmas_m_[5] = kUnobservableSigma * radius;
      const Mat6 held = (1 + rounding) * add_constraint(radius, hold_, covariance());
      const Mat6 released = scale().asDiagonal() * remove_constraint(radius, hold_, held) * scale().asDiagonal();
      const double sigma_m = std::sqrt(axes_.col(5).dot(released * axes_.col(5)));
      EXPECT_NEAR(sigma_m, kUnobservableSigma * radius, 1e-2 * sigma_m) << radius << rounding;
    }
  }
}

TEST_F(HoldTest, WhereNothingIsHeldNotABitChanges) {
  VERIFIES("LASSO-REG-023~1");
  EXPECT_EQ(add_constraint(radius_m(), OutlineConstraint{}, covariance()), covariance());
  EXPECT_EQ(remove_constraint(radius_m(), OutlineConstraint{}, covariance()), covariance());
}

TEST_F(HoldTest, ASecondLookStartsWhereTheFirstOneBelievesAndHoldsCautiously) {
  VERIFIES("LASSO-REG-023~1");
  PoseBelief belief;
  sigmas_m_.setConstant(1e-4);
  sigmas_m_[4] = 3e-4;  // known by labels
  sigmas_m_[5] = 5e-3;  // hardly
  belief.covariance = covariance();
  belief.mean = Vec6(3e-3 * axes_.col(4) - 1e-3 * axes_.col(5) + 2e-4 * axes_.col(0)).cwiseQuotient(scale());
  const Vec6 step = scale().cwiseProduct(tighten_constraint(mission_, belief, hold_));
  EXPECT_LT((step - 3e-3 * axes_.col(4) + 1e-3 * axes_.col(5)).norm(), 1e-12) << "not along what the hits hold";
  EXPECT_DOUBLE_EQ(hold_.sigma_m[0], 2e-3) << "half of the labels' band is enough";
  EXPECT_DOUBLE_EQ(hold_.sigma_m[1], 7e-3) << "never looser than before";
  EXPECT_DOUBLE_EQ(hold_.band_m, 14e-3);
  sigmas_m_[5] = 1e-3;
  belief.covariance = covariance();
  (void)tighten_constraint(mission_, belief, hold_);
  EXPECT_NEAR(hold_.sigma_m[1], kCautious * 1e-3, 1e-9);
  EXPECT_NEAR(hold_.band_m, 6e-3, 1e-8);
}

// Labels whose contours show some of the held axes, those that hits do not show.
class ShownTest : public HoldTest {
 protected:
  ShownTest() {
    sigmas_m_[4] = sigmas_m_[5] = kUnobservableSigma * mission_.radius_m;
    unseen_.count = 1;
    unseen_.vectors.col(0) = axes_.col(3);
  }

  Vec6 row_along(const Vec6& axis) const { return scale().cwiseProduct(axis); }
  void add_labels(int count, const Vec6& axis, bool at_end = false) {
    for (int i = 0; i < count; ++i) {
      Label label{};
      label.a = row_along(i % 2 == 0 ? axis : Vec6(-axis));
      label.at_end = at_end;
      ASSERT_TRUE(labels_.push_back(label));
    }
  }
  void keep() { keep_shown(mission_, labels_.span(), covariance(), hold_, unseen_); }

  FixedVector<Label, kMaxSites> labels_;
  Directions unseen_;
};

TEST_F(ShownTest, WhereAllIsShownNotABitChanges) {
  VERIFIES("LASSO-REG-023~1");
  add_labels(10, 0.9 * axes_.col(4) + 0.1 * axes_.col(5));
  add_labels(10, 0.3 * axes_.col(4) - 0.8 * axes_.col(5));
  const OutlineConstraint before = hold_;
  keep();
  EXPECT_EQ(hold_.axes.vectors, before.axes.vectors);
  EXPECT_EQ(hold_.sigma_m, before.sigma_m);
  EXPECT_EQ(unseen_.count, 1);
}

// A disc's shift and its turn, as an outline mixes them.
TEST_F(ShownTest, WhatNoContourShowsIsLetGo) {
  VERIFIES("LASSO-REG-023~1");
  const Vec6 shown = (0.6 * axes_.col(4) + 0.8 * axes_.col(5));
  const Vec6 hidden = (0.8 * axes_.col(4) - 0.6 * axes_.col(5));
  add_labels(30, 0.7 * shown + 0.03 * hidden);
  add_labels(30, 0.7 * shown - 0.03 * hidden);
  add_labels(20, hidden, true);  // at corners of the contour
  keep();
  ASSERT_EQ(hold_.axes.count, 1);
  EXPECT_NEAR(std::abs(hold_.axes.vectors.col(0).dot(shown)), 1, 1e-3);
  EXPECT_NEAR(hold_.sigma_m[0], std::hypot(0.6 * 2e-3, 0.8 * 7e-3), 1e-4);
  ASSERT_EQ(unseen_.count, 2);
  EXPECT_NEAR(std::abs(unseen_.vectors.col(1).dot(hidden)), 1, 1e-3);
}

// A corner's lever says nothing of a contour's, nor may it turn the axes.
TEST_F(ShownTest, CornersBetweenTheAxesTurnNone) {
  VERIFIES("LASSO-REG-023~1");
  add_labels(30, 0.7 * axes_.col(4) + 0.03 * axes_.col(5));
  add_labels(30, 0.7 * axes_.col(4) - 0.03 * axes_.col(5));
  add_labels(20, 0.7 * axes_.col(4) + 0.7 * axes_.col(5), true);
  keep();
  ASSERT_EQ(hold_.axes.count, 1);
  EXPECT_NEAR(std::abs(hold_.axes.vectors.col(0).dot(axes_.col(4))), 1, 1e-3);
}

TEST_F(ShownTest, WhatTheHitsShowIsNotUnseen) {
  VERIFIES("LASSO-REG-023~1");
  sigmas_m_[5] = 0.1;
  add_labels(30, axes_.col(4));
  keep();
  EXPECT_EQ(hold_.axes.count, 1);
  EXPECT_EQ(unseen_.count, 1);
}

TEST_F(ShownTest, ALeverHasToBeLongerThanTheHoldIsWide) {
  VERIFIES("LASSO-REG-023~1");
  add_labels(30, axes_.col(4));
  add_labels(30, 0.07 * axes_.col(5));
  hold_.sigma_m[1] = 0.06 * mission_.radius_m;
  keep();
  EXPECT_EQ(hold_.axes.count, 2);
  hold_.sigma_m[1] = 0.08 * mission_.radius_m;
  keep();
  EXPECT_EQ(hold_.axes.count, 1);
}

TEST_F(ShownTest, AFewLabelsShowNothingAndNoneNeither) {
  VERIFIES("LASSO-REG-023~1");
  add_labels(90, axes_.col(4));
  add_labels(14, axes_.col(5));
  keep();
  EXPECT_EQ(hold_.axes.count, 1);
  labels_.clear();
  keep();
  EXPECT_EQ(hold_.axes.count, 0);
  EXPECT_EQ(unseen_.count, 3);
}

}  // namespace
}  // namespace lasso
