#include "ft/bodies/compare.hpp"

#include <gtest/gtest.h>

#include "fsw/geometry/so3.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::bodies {
namespace {

ScoredPose pose_at(double turn_rad, double hits, double likelihood) {
  ScoredPose pose;
  pose.T_sensor_target.q = exp_so3(turn_rad * Vec3(0.6, -0.48, 0.64));
  pose.valid = true;
  pose.scores = {hits, likelihood};
  return pose;
}

TEST(Compare, TakesTheBestByEachScoreAndItsMarginToPosesApart) {
  VERIFIES("LASSO-GND-160~1");
  std::vector<ScoredPose> poses{pose_at(0, -10, 5), pose_at(0.2, -11, 4), pose_at(1, -12, 25), pose_at(2.5, -40, -7)};
  poses[2].wrong = true;
  const Choice hits = choose(poses, PoseScore::kHits);
  EXPECT_FALSE(hits.wrong);
  EXPECT_DOUBLE_EQ(hits.margin, 2);  // the second one is the same pose
  const Choice likelihood = choose(poses, PoseScore::kLikelihood);
  EXPECT_TRUE(likelihood.wrong);
  EXPECT_DOUBLE_EQ(likelihood.margin, 20);
}

TEST(Compare, APoseWithoutAnotherHasAnInfiniteMargin) {
  VERIFIES("LASSO-GND-160~1");
  EXPECT_GT(choose({pose_at(0, 1, 1), pose_at(0.1, 0, 0)}, PoseScore::kHits).margin, 1e300);
}

TEST(Compare, CountsWhatWouldBeAcceptedByAMargin) {
  VERIFIES("LASSO-GND-160~1");
  Comparison search{0, true, true, true, 1, {}};  // accepted by the search alone, and wrong
  Comparison both{1, true, false, false, 2, {{{true, false, 9}, {true, true, 31}}}};
  Comparison open{2, false, false, false, 2, {{{true, false, 3}, {true, false, 60}}}};
  const std::string text = comparison_text({search, both, open});
  const auto has = [&](const std::string& line) { return text.find(line) != std::string::npos; };
  EXPECT_TRUE(has("search                        1 accepted,      1 of 2 determined (50.0 %), wrong 1\n")) << text;
  EXPECT_TRUE(has("hits, by 8 nats               1 accepted,      1 of 2 determined (50.0 %), wrong 0\n")) << text;
  EXPECT_TRUE(has("likelihood, by 30 nats        2 accepted,      1 of 2 determined (50.0 %), wrong 1\n")) << text;
  EXPECT_TRUE(has("likelihood, by 50 nats        1 accepted,      0 of 2 determined (0.0 %), wrong 0\n")) << text;
}

TEST(Compare, WritesALineForEachScan) {
  VERIFIES("LASSO-GND-160~1");
  const Comparison scan{4, true, false, false, 2, {{{true, false, 9.5}, {true, true, 31}}}};
  EXPECT_EQ(comparison_csv(17, {scan}), "17,4,1,0,0,2,1,0,9.500,1,1,31.000\n");
}

}  // namespace
}  // namespace lasso::bodies
