#include "fsw/pose/recognition/hypothesis_score.hpp"

#include <gtest/gtest.h>

#include "ut/pose/search_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

class FitTest : public test::SearchFixture {};

TEST_F(FitTest, TruthIsExplainedAndAnotherPoseIsNot) {
  VERIFIES("LASSO-MOD-122~2");
  for (int i = 0; i < 10; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    const auto subset = make_evidence();
    const HypothesisScore right = measure_score(mission_, truth(), *subset);
    EXPECT_EQ(right.hits, static_cast<double>(subset->hits.size()));
    EXPECT_LT(right.disagreement(), 0.03);
    EXPECT_LT(right.score(), 0.06);
    Pose turned = scan_.T_sensor_target;
    turned.q = normalized(turned.q * Quat(0.5, 0.5, -0.5, 0.5));
    EXPECT_GT(measure_score(mission_, inverse(turned), *subset).score(), 3 * right.score() + 0.1);
  }
}

TEST_F(FitTest, SurfacesInFrontAndBehindAreBad) {
  VERIFIES("LASSO-MOD-122~2");
  scan();
  const auto subset = make_evidence();
  for (const double shift : {-0.15, 0.15}) {
    Pose moved = scan_.T_sensor_target;
    moved.p[2] += shift;
    EXPECT_GT(measure_score(mission_, inverse(moved), *subset).disagreement(), 0.8);
  }
}

TEST_F(FitTest, MissesThroughTheModelAreHeldAgainstIt) {
  VERIFIES("LASSO-MOD-122~2");
  scan();
  const auto subset = make_evidence();
  Pose moved = scan_.T_sensor_target;
  moved.p[0] += 0.25;
  EXPECT_GT(measure_score(mission_, inverse(moved), *subset).violated, 5);
  EXPECT_LT(measure_score(mission_, truth(), *subset).violated, 2);
}

TEST_F(FitTest, TheNoiseWidensWhatCountsAsOnTheSurface) {
  VERIFIES("LASSO-MOD-122~2");
  parameters().sigma0_m = 0.02;
  scan_.sigma_m = 0.02;
  scan();
  EXPECT_LT(measure_score(mission_, truth(), *make_evidence()).disagreement(), 0.06);
}

TEST_F(FitTest, EndsOnceTheScoreExceedsTheLimit) {
  VERIFIES("LASSO-MOD-117~2");
  scan();
  const auto subset = make_evidence();
  const std::size_t all = subset->hits.size() + subset->misses.size();
  Pose moved = scan_.T_sensor_target;
  moved.p[2] += 0.15;
  const HypothesisScore whole = measure_score(mission_, inverse(moved), *subset);
  const HypothesisScore part = measure_score(mission_, inverse(moved), *subset, 0.2);
  EXPECT_EQ(whole.walks, all);
  EXPECT_LT(part.walks, all / 2);
  EXPECT_GT(part.score(), 0.2);
  EXPECT_LE(part.score(), whole.score());
  EXPECT_EQ(measure_score(mission_, inverse(moved), *subset, whole.score()).score(), whole.score());
  const HypothesisScore left = measure_score(mission_, inverse(moved), *subset, 0.2, 16);  // ahead of its share
  EXPECT_GT(left.score(), 0.2);
  EXPECT_LT(left.walks, part.walks);
  EXPECT_NEAR(left.score(), whole.score(), 0.5 * whole.score()) << "as if the others were like those";
  // Hits that all agree, and misses that do not.
  const HypothesisScore right = measure_score(mission_, truth(), *subset);
  subset->misses.clear();
  for (const ScanRay<FlightNumber>& ray : workspace_->rays) {
    if (ray.state == RayState::kHit && !subset->misses.full()) (void)subset->misses.push_back(ray);
  }
  const HypothesisScore violated = measure_score(mission_, truth(), *subset, right.score() + 0.02);
  EXPECT_GT(violated.walks, subset->hits.size());
  EXPECT_LT(violated.walks, subset->hits.size() + subset->misses.size());
  EXPECT_GT(violated.score(), right.score() + 0.02);
}

TEST_F(FitTest, AModelOutOfSightExplainsNothing) {
  VERIFIES("LASSO-MOD-122~2");
  scan();
  const auto subset = make_evidence();
  Pose far = truth();
  far.p[1] += 1e6;
  const HypothesisScore fit = measure_score(mission_, far, *subset);
  EXPECT_EQ(fit.bad, fit.hits);
  EXPECT_EQ(fit.violated, 0);
  EXPECT_EQ(fit.disagreement(), 1);
  EXPECT_DOUBLE_EQ(fit.score(), 1.5);
}

TEST(HypothesisScore, NothingLookedAtExplainsNothing) {
  VERIFIES("LASSO-MOD-122~2");
  EXPECT_EQ(HypothesisScore().disagreement(), 1);
  EXPECT_EQ(HypothesisScore().score(), 1.5);
  const HypothesisScore sum = HypothesisScore{10, 1, 2, 3} + HypothesisScore{20, 3, 0, 1};
  EXPECT_DOUBLE_EQ(sum.disagreement(), 6.0 / 32.0);
  EXPECT_DOUBLE_EQ(sum.score(), 6.0 / 32.0 + 0.5 * 4.0 / 30.0);
}

}  // namespace
}  // namespace lasso
