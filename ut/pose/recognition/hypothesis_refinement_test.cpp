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
  Settled settle(const Pose& start, const Evidence& evidence) {
    Settler settler;
    settler.begin(start, start);
    attempts_ = 1;
    while (settler.step(mission_, evidence, kAnyScore, *workspace_, work_)) ++attempts_;
    return settler.best();
  }
  Pose off(double rotation_rad, double shift_m) { return inverse(test::disturb(scan_.T_sensor_target, rotation_rad, shift_m, random_)); }
  bool is_right(const Settled& settled) const {
    const Vec6 error = error_of(settled.solution.T_target_sensor);
    return error.head<3>().norm() < 0.01 && error.tail<3>().norm() < 0.005;
  }

  int attempts_ = 0;
  std::uint32_t work_ = 0;
};

TEST_F(SettleTest, AStartNearTheTruthTakesOneAttempt) {
  VERIFIES("LASSO-MOD-111~1");
  scan();
  const auto evidence = make_evidence();
  const Settled settled = settle(off(0.005, 0.002), *evidence);
  EXPECT_TRUE(is_right(settled));
  EXPECT_LT(settled.fit.disagreement(), 0.02);
  EXPECT_EQ(attempts_, 1);
  EXPECT_GT(work_, fit_work(settled.fit));
}

TEST_F(SettleTest, ARoughStartMayTakeMore) {
  VERIFIES("LASSO-MOD-111~1");
  int right = 0;
  for (int i = 0; i < 12; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    const auto evidence = make_evidence();
    right += is_right(settle(off(0.03, 0.01), *evidence)) ? 1 : 0;
    EXPECT_LE(attempts_, 4);
  }
  EXPECT_GE(right, 8);
}

TEST_F(SettleTest, WhatCannotBeExplainedTakesAllAttemptsAndKeepsTheBest) {
  VERIFIES("LASSO-MOD-111~1");
  scan();
  const auto evidence = make_evidence();
  Pose turned = scan_.T_sensor_target;
  turned.q = normalized(turned.q * Quat(0.5, 0.5, -0.5, 0.5));
  Settler once;
  once.begin(inverse(turned), inverse(turned));
  std::uint32_t work = 0;
  EXPECT_TRUE(once.step(mission_, *evidence, kAnyScore, *workspace_, work));
  const Settled settled = settle(inverse(turned), *evidence);
  EXPECT_EQ(attempts_, 4);
  EXPECT_LE(settled.fit.score(), once.best().fit.score());
  EXPECT_GT(settled.fit.disagreement(), 0.02);
  EXPECT_LT(work, work_);
  Settler hopeless;
  hopeless.begin(inverse(turned), inverse(turned));
  EXPECT_FALSE(hopeless.step(mission_, *evidence, once.best().fit.score(), *workspace_, work)) << "no better than that";
}

TEST_F(SettleTest, ASketchTellsRightFromWrongByLessWork) {
  VERIFIES("LASSO-MOD-117~1");
  scan();
  const auto evidence = make_evidence();
  const Settled right = sketch(mission_, *evidence, {off(0.005, 0.002), Fit()}, kAnyScore, *workspace_, work_);
  EXPECT_TRUE(is_right(right));
  Pose turned = scan_.T_sensor_target;
  turned.q = normalized(turned.q * Quat(0.5, 0.5, -0.5, 0.5));
  const Settled wrong = sketch(mission_, *evidence, {inverse(turned), Fit()}, 2 * right.fit.score(), *workspace_, work_);
  EXPECT_GT(wrong.fit.score(), 2 * right.fit.score());
  EXPECT_LT(wrong.fit.walks, right.fit.walks);
}

// The registration of a wrong start leads to nothing; were the start known to fit well, it would have to be kept.
TEST_F(SettleTest, AStartThatFitsIsNotLostToARegistrationThatStrays) {
  VERIFIES("LASSO-MOD-111~1");
  scan();
  const auto evidence = make_evidence();
  const Fit good = measure_fit(mission_, inverse(scan_.T_sensor_target), *evidence);
  Pose turned = scan_.T_sensor_target;
  turned.q = normalized(turned.q * Quat(0.5, 0.5, -0.5, 0.5));
  const Settled strayed = sketch(mission_, *evidence, {inverse(turned), Fit()}, kAnyScore, *workspace_, work_);
  ASSERT_GT(strayed.fit.score(), 1.25 * good.score() + 0.02);
  const Settled kept = sketch(mission_, *evidence, {inverse(turned), good}, kAnyScore, *workspace_, work_);
  EXPECT_EQ(kept.fit.score(), good.score());
  EXPECT_EQ(kept.solution.T_target_sensor.p, inverse(turned).p);
  EXPECT_EQ(kept.solution.T_target_sensor.q.coeffs(), inverse(turned).q.coeffs());
  const Pose near = off(0.005, 0.002);
  const Fit known = measure_fit(mission_, near, *evidence);
  const Settled drawn = sketch(mission_, *evidence, {near, known}, kAnyScore, *workspace_, work_);
  EXPECT_TRUE(is_right(drawn)) << "a registration that leads on is taken";
  EXPECT_LT(drawn.fit.score(), known.score());
}

}  // namespace
}  // namespace lasso
