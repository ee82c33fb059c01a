#include "fsw/pose/recognition/acceptance.hpp"

#include <gtest/gtest.h>

#include "ut/pose/whole_search.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using VerdictTest = test::WholeSearch;

TEST(Verdict, AFarScoreLeavesARivalBehind) {
  VERIFIES("LASSO-MOD-122~2");
  EXPECT_TRUE(is_outscored({2.0, false, 0, 0}, 1.3));
  EXPECT_TRUE(is_outscored({2.0, true, 1.0, 1.0}, 1.3));
  EXPECT_TRUE(is_outscored({1.4, false, 0, 0}, 1.3)) << "nothing else is known";
  EXPECT_FALSE(is_outscored({2.3, true, 1.0, 1.9}, 1.3)) << "the best pose leaves returns unexplained";
  EXPECT_TRUE(is_outscored({4.0, true, 1.0, 1.9}, 1.3));
  EXPECT_FALSE(is_outscored({1.2, false, 0, 0}, 1.3));
}

TEST(Verdict, ScoresAreComparedAboveAFloorAndNearOnesAskForCosts) {
  VERIFIES("LASSO-MOD-122~2");
  EXPECT_DOUBLE_EQ(ratio_of(0.02, 0.02), 1);
  EXPECT_DOUBLE_EQ(ratio_of(0.05, 0.02), 2);
  EXPECT_TRUE(is_near(1.94, 1.0, 1.3));
  EXPECT_FALSE(is_near(1.96, 1.0, 1.3));
  EXPECT_TRUE(is_near(3.89, 1.9, 1.3)) << "the best pose leaves returns unexplained";
  EXPECT_FALSE(is_near(3.91, 1.9, 1.3));
}

TEST(Verdict, ANearScoreDoesNotWhereTheNoiseSaysOtherwise) {
  VERIFIES("LASSO-MOD-122~2 LASSO-MOD-121~1");
  EXPECT_TRUE(is_outscored({1.4, true, 1.5, 1.0}, 1.3));
  EXPECT_FALSE(is_outscored({1.4, true, 1.1, 0.8}, 1.3)) << "explained as the noise allows";
  EXPECT_FALSE(is_outscored({1.4, true, 3.0, 2.9}, 1.3)) << "as badly as the best";
}

TEST(Verdict, WhereSeveralScansTellTheNoiseHasToAgreeLessClearly) {
  VERIFIES("LASSO-MOD-122~2 LASSO-MOD-120~2");
  EXPECT_FALSE(is_outscored({2.0, true, 2.2, 2.0, 1.0, 0, 1}, 1.3));
  EXPECT_TRUE(is_outscored({2.0, true, 2.2, 2.0, 1.0, 0, 2}, 1.3));
  EXPECT_FALSE(is_outscored({2.0, true, 2.05, 2.0, 1.0, 0, 2}, 1.3)) << "alike";
  EXPECT_FALSE(is_outscored({1.9, true, 2.2, 2.0, 1.0, 0, 2}, 1.3)) << "near by its score";
}

TEST(Verdict, WhatIsExplainedHasToBeExplainedAsTheNoiseAllowsWhereSomethingIsNot) {
  VERIFIES("LASSO-MOD-122~2 LASSO-MOD-119~2");
  EXPECT_TRUE(is_outscored({1.4, false, 0, 2.5, 1.5, 0.05}, 1.3)) << "a part is off";
  EXPECT_FALSE(is_outscored({1.4, false, 0, 2.5, 1.55, 0.05}, 1.3)) << "everything is a little off";
  EXPECT_FALSE(is_outscored({1.4, true, 6.0, 2.5, 2.0, 0.05}, 1.3));
  EXPECT_TRUE(is_outscored({1.4, true, 6.0, 2.5, 1.5, 0.05}, 1.3));
  EXPECT_TRUE(is_outscored({1.4, false, 0, 2.5, 2.0, 0.01}, 1.3)) << "within the score's tolerance: it moves";
  EXPECT_TRUE(is_outscored({1.4, false, 0, 1.1, 2.0, 0.05}, 1.3)) << "nothing is unexplained";
  EXPECT_TRUE(is_outscored({4.0, false, 0, 2.5, 2.0, 0.05}, 1.3)) << "far by its score";
}

TEST(Verdict, TheNoiseAloneTellsWhatLooksAlike) {
  VERIFIES("LASSO-MOD-120~2");
  EXPECT_TRUE(is_outscored({1.05, true, 1.4, 1.0}, 1.3));
  EXPECT_FALSE(is_outscored({1.05, true, 1.2, 1.0}, 1.3));
  EXPECT_FALSE(is_outscored({1.05, true, 0.5, 1.0}, 1.3));
}

TEST_F(VerdictTest, RejectsAnotherTarget) {
  VERIFIES("LASSO-MOD-122~2");
  scan_.model.half = Vec3(0.09, 0.42, 0.05);
  scan_.others.clear();
  for (int i = 0; i < 2; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    search_->begin(limits_);
    ASSERT_EQ(search(), Status::kOk);
    EXPECT_NE(result().outcome, SearchOutcome::kAccepted);
    EXPECT_GT(result().disagreement, limits_.disagreement_max);
  }
}

TEST_F(VerdictTest, RejectsAPoseThatLeavesTooMuchUnexplained) {
  VERIFIES("LASSO-MOD-122~2");
  look_from_few_sides();
  limits_.disagreement_max = -1;
  search_->begin(limits_);
  ASSERT_EQ(search(), Status::kOk);
  EXPECT_EQ(result().outcome, SearchOutcome::kRejected);
  EXPECT_EQ(result().reason, SearchReason::kUnexplained);
}

TEST_F(VerdictTest, RejectsTooFewReturns) {
  VERIFIES("LASSO-MOD-122~2");
  look_from_few_sides();
  limits_.hits_min = 1000;
  search_->begin(limits_);
  ASSERT_EQ(search(), Status::kOk);
  EXPECT_EQ(result().outcome, SearchOutcome::kRejected);
  EXPECT_EQ(result().reason, SearchReason::kTooFewReturns);
}

// The same scan, its result on either side of each limit.
TEST_F(VerdictTest, AcceptsUpToItsLimitsAndNotBeyond) {
  VERIFIES("LASSO-MOD-122~2");
  EXPECT_EQ(SearchLimits().hits_min, 80);
  EXPECT_EQ(SearchLimits().disagreement_max, 0.20);
  EXPECT_EQ(SearchLimits().ratio_min, 1.3);
  scan_.T_sensor_target = test::random_box_pose(random_);
  const auto image = scan_at(0);
  const std::uint32_t enough = limits_.work_max;
  const SearchResult found = search_within(enough, *image);
  ASSERT_EQ(found.outcome, SearchOutcome::kAccepted);
  limits_.hits_min = found.returns;
  EXPECT_EQ(search_within(enough, *image).outcome, SearchOutcome::kAccepted);
  limits_.hits_min = found.returns + 1;
  EXPECT_EQ(search_within(enough, *image).reason, SearchReason::kTooFewReturns);
  scan_.model.half = Vec3(0.09, 0.42, 0.05);  // another target: all poses leave something unexplained
  const auto other = scan_at(0);
  look_from_few_sides();
  limits_ = SearchLimits();
  limits_.disagreement_max = 1;
  const double unexplained = search_within(enough, *other).disagreement;
  ASSERT_GT(unexplained, 0);
  limits_.disagreement_max = 1.1 * unexplained;
  EXPECT_NE(search_within(enough, *other).reason, SearchReason::kUnexplained);
  limits_.disagreement_max = 0.9 * unexplained;
  EXPECT_EQ(search_within(enough, *other).reason, SearchReason::kUnexplained);
}

TEST_F(VerdictTest, RejectsWhatCannotBeRegistered) {
  VERIFIES("LASSO-MOD-122~2");
  look_from_few_sides();
  auto image = scan_at(0);
  int hits = 0;
  for (RangeSample& sample : image->samples) {
    if (sample.state == RayState::kHit && ++hits > 9) sample.state = RayState::kInvalid;
  }
  for (const double hits_min : {10.0, 1.0}) {
    limits_.hits_min = hits_min;
    search_->begin(limits_);
    ASSERT_EQ(search_->add_scan(mission_, *image, *workspace_), Status::kOk);
    work();
    EXPECT_EQ(result().outcome, SearchOutcome::kRejected);
    EXPECT_EQ(result().reason, hits_min > 9 ? SearchReason::kTooFewReturns : SearchReason::kNotRegistered) << "what comes first";
  }
}

class SymmetricVerdictTest : public VerdictTest {
 protected:
  SymmetricVerdictTest() : VerdictTest(test::box_mission()) { scan_.others.clear(); }
};

TEST_F(SymmetricVerdictTest, ASymmetricTargetIsAmbiguousWithItsCandidates) {
  VERIFIES("LASSO-MOD-121~1 LASSO-MOD-120~2");
  for (int i = 0; i < 2; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    search_->begin(limits_);
    for (int k = 0; k < 2; ++k) {
      ASSERT_EQ(search(k), Status::kOk);
      EXPECT_EQ(result().outcome, SearchOutcome::kAmbiguous);
      EXPECT_LT(result().ratio, 1.3);
      ASSERT_GE(result().candidates.size(), 2u);
    }
    bool found = false;
    for (const SearchCandidate& candidate : result().candidates) {
      const Vec6 error = pose_difference(candidate.T_sensor_target, scan_.T_sensor_target);
      found = found || (error.head<3>().norm() < 2 * kRadPerDeg && error.tail<3>().norm() < 0.02);
    }
    EXPECT_TRUE(found);
  }
}

// A target that turns twists its scan: the best of equal poses is as the search has registered it, the one of a track a little aside.
TEST_F(SymmetricVerdictTest, ContradictsNoPoseThatTheReturnsLeadToAnEqualOf) {
  VERIFIES("LASSO-MOD-184~5");
  for (int i = 0; i < 10; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    for (int k = 0; k < 3; ++k) scan_.rates.omega_radps[k] = 6 * kRadPerDeg * random_.normal();
    search_->begin(limits_);
    ASSERT_EQ(search(), Status::kOk);
    for (int axis = 0; axis < 3; ++axis) {
      Pose symmetric;
      symmetric.q = exp_so3(kPi * Vec3::Unit(axis));
      symmetric.p = scan_.model.center - rotate(symmetric.q, scan_.model.center);
      const Pose aside = test::disturb(scan_.T_sensor_target * symmetric, kRadPerDeg, 0.003, random_);
      EXPECT_FALSE(search_->contradicts(mission_, aside, *workspace_)) << i << ", " << axis;
    }
  }
}

// A pose that is held against a search of its own scan.
TEST_F(VerdictTest, ContradictsAPoseThatExplainsTheScanWorseAndNoOther) {
  VERIFIES("LASSO-MOD-184~5");
  scan_.T_sensor_target = test::random_box_pose(random_);
  const auto turned = [&](double deg) {
    Pose pose = scan_.T_sensor_target;
    pose.q = normalized(exp_so3(deg * kRadPerDeg * Vec3(0.48, -0.6, 0.64)) * pose.q);
    return pose;
  };
  search_->begin(limits_);
  EXPECT_FALSE(search_->contradicts(mission_, turned(180), *workspace_)) << "nothing was searched";
  ASSERT_EQ(search(), Status::kOk);
  ASSERT_EQ(result().outcome, SearchOutcome::kAccepted);
  EXPECT_FALSE(search_->contradicts(mission_, turned(0), *workspace_));
  EXPECT_FALSE(search_->contradicts(mission_, turned(3), *workspace_)) << "the registration goes on from there";
  for (const double deg : {10.0, 90.0, 180.0}) EXPECT_TRUE(search_->contradicts(mission_, turned(deg), *workspace_)) << deg;
}

// What a report says of a search is what it decided by: accepted where all that compete are left behind, ambiguous where one is not.
TEST_F(VerdictTest, TheRivalsThatItGivesAreThoseThatItDecidedBy) {
  VERIFIES("LASSO-MOD-184~5");
  scan_.T_sensor_target = test::random_box_pose(random_);
  const auto image = scan_at(0);
  const auto outcome = [&] {
    search_->begin(limits_);
    EXPECT_EQ(search_->add_scan(mission_, *image, *workspace_), Status::kOk);
    work();
    return result().outcome;
  };
  const auto left_behind = [&] {
    bool all = true;
    Competitor competitor;
    for (std::size_t i = 0; i < search_->poses(); ++i)
      all = all && (!search_->find_competitor(i, competitor) || is_outscored(competitor, limits_.ratio_min));
    return all;
  };
  ASSERT_EQ(outcome(), SearchOutcome::kAccepted);
  Competitor competitor;
  EXPECT_FALSE(search_->find_competitor(0, competitor)) << "the best one competes with none";
  EXPECT_TRUE(left_behind());
  limits_.ratio_min = 1e6;
  ASSERT_EQ(outcome(), SearchOutcome::kAmbiguous);
  EXPECT_FALSE(left_behind());
}

TEST_F(VerdictTest, ContradictsNothingWhereItIsAmbiguousUnlessByItsRatioNorWhereItIsRejected) {
  VERIFIES("LASSO-MOD-184~5");
  scan_.T_sensor_target = test::random_box_pose(random_);
  Pose turned = scan_.T_sensor_target;
  turned.q = normalized(exp_so3(Vec3(0, kPi, 0)) * turned.q);
  const auto image = scan_at(0);
  const auto contradicts = [&](SearchOutcome outcome) {
    search_->begin(limits_);
    EXPECT_EQ(search_->add_scan(mission_, *image, *workspace_), Status::kOk);
    work();
    EXPECT_EQ(result().outcome, outcome);
    return search_->contradicts(mission_, turned, *workspace_);
  };
  EXPECT_TRUE(contradicts(SearchOutcome::kAccepted));
  EXPECT_TRUE(search_->agrees(scan_.T_sensor_target));
  EXPECT_FALSE(search_->agrees(turned));
  limits_.work_max = 0;
  EXPECT_TRUE(contradicts(SearchOutcome::kAmbiguous)) << "unfinished, and far better";
  EXPECT_FALSE(search_->agrees(scan_.T_sensor_target)) << "nothing is accepted";
  limits_.ratio_min = 1e6;
  EXPECT_FALSE(contradicts(SearchOutcome::kAmbiguous));
  limits_.hits_min = 1e6;
  EXPECT_FALSE(contradicts(SearchOutcome::kRejected));
}

}  // namespace
}  // namespace lasso
