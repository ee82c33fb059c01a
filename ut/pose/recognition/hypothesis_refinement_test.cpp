#include "fsw/pose/recognition/hypothesis_refinement.hpp"

#include <gtest/gtest.h>

#include "fsw/pose/scan/work_units.hpp"
#include "ut/pose/search_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

class SettleTest : public test::SearchFixture {
 protected:
  // From a start that is off; attempts are counted.
  RefinedHypothesis refine(const Pose& start, const ScanSubset& subset) {
    HypothesisRefiner settler;
    settler.begin(start, start);
    attempts_ = 1;
    while (settler.step(mission_, subset, kAnyScore, *workspace_, work_)) ++attempts_;
    return settler.best();
  }
  Pose off(double rotation_rad, double shift_m) { return inverse(test::disturb(scan_.T_sensor_target, rotation_rad, shift_m, random_)); }
  bool is_right(const RefinedHypothesis& refined) const {
    const Vec6 error = error_of(refined.solution.T_target_sensor);
    return error.head<3>().norm() < 0.01 && error.tail<3>().norm() < 0.005;
  }

  int attempts_ = 0;
  std::uint32_t work_ = 0;
};

TEST_F(SettleTest, AStartNearTheTruthTakesOneAttempt) {
  VERIFIES("LASSO-MOD-111~1");
  scan();
  const auto subset = make_evidence();
  const RefinedHypothesis refined = refine(off(0.005, 0.002), *subset);
  EXPECT_TRUE(is_right(refined));
  EXPECT_LT(refined.fit.disagreement(), 0.02);
  EXPECT_EQ(attempts_, 1);
  EXPECT_GT(work_, score_work(refined.fit));
}

TEST_F(SettleTest, ARoughStartMayTakeMore) {
  VERIFIES("LASSO-MOD-111~1");
  int right = 0;
  for (int i = 0; i < 12; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    const auto subset = make_evidence();
    right += is_right(refine(off(0.03, 0.01), *subset)) ? 1 : 0;
    EXPECT_LE(attempts_, 4);
  }
  EXPECT_GE(right, 8);
}

TEST_F(SettleTest, WhatCannotBeExplainedTakesAllAttemptsAndKeepsTheBest) {
  VERIFIES("LASSO-MOD-111~1");
  scan();
  const auto subset = make_evidence();
  Pose turned = scan_.T_sensor_target;
  turned.q = normalized(turned.q * Quat(0.5, 0.5, -0.5, 0.5));
  HypothesisRefiner once;
  once.begin(inverse(turned), inverse(turned));
  std::uint32_t work = 0;
  EXPECT_TRUE(once.step(mission_, *subset, kAnyScore, *workspace_, work));
  const RefinedHypothesis refined = refine(inverse(turned), *subset);
  EXPECT_EQ(attempts_, 4);
  EXPECT_LE(refined.fit.score(), once.best().fit.score());
  EXPECT_GT(refined.fit.disagreement(), 0.02);
  EXPECT_LT(work, work_);
  HypothesisRefiner hopeless;
  hopeless.begin(inverse(turned), inverse(turned));
  EXPECT_FALSE(hopeless.step(mission_, *subset, once.best().fit.score(), *workspace_, work)) << "no better than that";
}

TEST_F(SettleTest, ASketchTellsRightFromWrongByLessWork) {
  VERIFIES("LASSO-MOD-117~2");
  scan();
  const auto subset = make_evidence();
  const RefinedHypothesis right = refine_fast(mission_, *subset, {off(0.005, 0.002), HypothesisScore()}, kAnyScore, *workspace_, work_);
  EXPECT_TRUE(is_right(right));
  Pose turned = scan_.T_sensor_target;
  turned.q = normalized(turned.q * Quat(0.5, 0.5, -0.5, 0.5));
  const RefinedHypothesis wrong =
      refine_fast(mission_, *subset, {inverse(turned), HypothesisScore()}, 2 * right.fit.score(), *workspace_, work_);
  EXPECT_GT(wrong.fit.score(), 2 * right.fit.score());
  EXPECT_LT(wrong.fit.walks, right.fit.walks);
}

// The registration of a wrong start leads to nothing; were the start known to fit well, it would have to be kept.
TEST_F(SettleTest, AStartThatFitsIsNotLostToARegistrationThatStrays) {
  VERIFIES("LASSO-MOD-111~1");
  scan();
  const auto subset = make_evidence();
  const HypothesisScore good = measure_score(mission_, inverse(scan_.T_sensor_target), *subset);
  Pose turned = scan_.T_sensor_target;
  turned.q = normalized(turned.q * Quat(0.5, 0.5, -0.5, 0.5));
  const RefinedHypothesis strayed = refine_fast(mission_, *subset, {inverse(turned), HypothesisScore()}, kAnyScore, *workspace_, work_);
  ASSERT_GT(strayed.fit.score(), 1.25 * good.score() + 0.02);
  const RefinedHypothesis kept = refine_fast(mission_, *subset, {inverse(turned), good}, kAnyScore, *workspace_, work_);
  EXPECT_EQ(kept.fit.score(), good.score());
  EXPECT_EQ(kept.solution.T_target_sensor.p, inverse(turned).p);
  EXPECT_EQ(kept.solution.T_target_sensor.q.coeffs(), inverse(turned).q.coeffs());
  const Pose near = off(0.005, 0.002);
  const HypothesisScore known = measure_score(mission_, near, *subset);
  const RefinedHypothesis aligned = refine_fast(mission_, *subset, {near, known}, kAnyScore, *workspace_, work_);
  EXPECT_TRUE(is_right(aligned)) << "a registration that leads on is taken";
  EXPECT_LT(aligned.fit.score(), known.score());
}

}  // namespace
}  // namespace lasso
