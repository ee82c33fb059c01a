#include "fsw/pose/recognition/hypothesis_score.hpp"

#include <gtest/gtest.h>

#include "ut/pose/search_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

class FitTest : public test::SearchFixture {};

TEST_F(FitTest, TruthIsExplainedAndAnotherPoseIsNot) {
  VERIFIES("LASSO-MOD-122~1");
  for (int i = 0; i < 10; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    scan();
    const auto evidence = make_evidence();
    const Fit right = measure_fit(mission_, truth(), *evidence);
    EXPECT_EQ(right.hits, static_cast<double>(evidence->hits.size()));
    EXPECT_LT(right.disagreement(), 0.03);
    EXPECT_LT(right.score(), 0.06);
    Pose turned = scan_.T_sensor_target;
    turned.q = normalized(turned.q * Quat(0.5, 0.5, -0.5, 0.5));
    EXPECT_GT(measure_fit(mission_, inverse(turned), *evidence).score(), 3 * right.score() + 0.1);
  }
}

TEST_F(FitTest, SurfacesInFrontAndBehindAreBad) {
  VERIFIES("LASSO-MOD-122~1");
  scan();
  const auto evidence = make_evidence();
  for (const double shift : {-0.15, 0.15}) {
    Pose moved = scan_.T_sensor_target;
    moved.p[2] += shift;
    EXPECT_GT(measure_fit(mission_, inverse(moved), *evidence).disagreement(), 0.8);
  }
}

TEST_F(FitTest, MissesThroughTheModelAreHeldAgainstIt) {
  VERIFIES("LASSO-MOD-122~1");
  scan();
  const auto evidence = make_evidence();
  Pose moved = scan_.T_sensor_target;
  moved.p[0] += 0.25;
  EXPECT_GT(measure_fit(mission_, inverse(moved), *evidence).violated, 5);
  EXPECT_LT(measure_fit(mission_, truth(), *evidence).violated, 2);
}

TEST_F(FitTest, TheNoiseWidensWhatCountsAsOnTheSurface) {
  VERIFIES("LASSO-MOD-122~1");
  parameters().sigma0_m = 0.02;
  scan_.sigma_m = 0.02;
  scan();
  EXPECT_LT(measure_fit(mission_, truth(), *make_evidence()).disagreement(), 0.06);
}

TEST_F(FitTest, EndsOnceTheScoreExceedsTheLimit) {
  VERIFIES("LASSO-MOD-117~1");
  scan();
  const auto evidence = make_evidence();
  const std::size_t all = evidence->hits.size() + evidence->misses.size();
  Pose moved = scan_.T_sensor_target;
  moved.p[2] += 0.15;
  const Fit whole = measure_fit(mission_, inverse(moved), *evidence);
  const Fit part = measure_fit(mission_, inverse(moved), *evidence, 0.2);
  EXPECT_EQ(whole.walks, all);
  EXPECT_LT(part.walks, all / 2);
  EXPECT_GT(part.score(), 0.2);
  EXPECT_LE(part.score(), whole.score());
  EXPECT_EQ(measure_fit(mission_, inverse(moved), *evidence, whole.score()).score(), whole.score());
  const Fit left = measure_fit(mission_, inverse(moved), *evidence, 0.2, 16);  // ahead of its share
  EXPECT_GT(left.score(), 0.2);
  EXPECT_LT(left.walks, part.walks);
  EXPECT_NEAR(left.score(), whole.score(), 0.5 * whole.score()) << "as if the others were like those";
  // Hits that all agree, and misses that do not.
  const Fit right = measure_fit(mission_, truth(), *evidence);
  evidence->misses.clear();
  for (const ScanRay<FlightNumber>& ray : workspace_->rays) {
    if (ray.state == RayState::kHit && !evidence->misses.full()) (void)evidence->misses.push_back(ray);
  }
  const Fit violated = measure_fit(mission_, truth(), *evidence, right.score() + 0.02);
  EXPECT_GT(violated.walks, evidence->hits.size());
  EXPECT_LT(violated.walks, evidence->hits.size() + evidence->misses.size());
  EXPECT_GT(violated.score(), right.score() + 0.02);
}

TEST_F(FitTest, AModelOutOfSightExplainsNothing) {
  VERIFIES("LASSO-MOD-122~1");
  scan();
  const auto evidence = make_evidence();
  Pose far = truth();
  far.p[1] += 1e6;
  const Fit fit = measure_fit(mission_, far, *evidence);
  EXPECT_EQ(fit.bad, fit.hits);
  EXPECT_EQ(fit.violated, 0);
  EXPECT_EQ(fit.disagreement(), 1);
  EXPECT_DOUBLE_EQ(fit.score(), 1.5);
}

TEST(Fit, NothingLookedAtExplainsNothing) {
  VERIFIES("LASSO-MOD-122~1");
  EXPECT_EQ(Fit().disagreement(), 1);
  EXPECT_EQ(Fit().score(), 1.5);
  const Fit sum = Fit{10, 1, 2, 3} + Fit{20, 3, 0, 1};
  EXPECT_DOUBLE_EQ(sum.disagreement(), 6.0 / 32.0);
  EXPECT_DOUBLE_EQ(sum.score(), 6.0 / 32.0 + 0.5 * 4.0 / 30.0);
}

}  // namespace
}  // namespace lasso
