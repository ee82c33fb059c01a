#include "mdat/trial/trial_results.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TrialPose pose_off(std::size_t light, double off_mm, PoseReason reason = PoseReason::kValid) {
  TrialPose pose;
  pose.light = light;
  pose.reason = reason;
  pose.off_m = 1e-3 * off_mm;
  pose.off_rad = 0.1 * off_mm * kRadPerDeg;
  pose.squared_position = off_mm;
  pose.squared_attitude = 2 * off_mm;
  pose.nees = 9 * off_mm;
  return pose;
}

TrialResult two_lights() {
  TrialResult result;
  result.scenario = "paper";
  result.lights = chosen_lights({"sun_behind", "backlit_no_earth"});
  for (std::uint32_t view = 0; view < 2; ++view) {
    DisparityErrors errors;
    errors.valid_share = 0.6 + 0.2 * view;
    errors.sigma_px = 0.2;
    result.pairs.push_back({0, view, 1.5 * view, 1e-3, errors});
    result.pairs.push_back({1, view, 1.5 * view, 0.1, {}});
  }
  result.poses = {pose_off(0, 1), pose_off(0, 2), pose_off(0, 7), pose_off(1, 50, PoseReason::kTooFewReturns)};
  result.poses[2].wrong = true;
  result.fitted = {pose_off(0, 3)};
  return result;
}

TEST(TrialResults, AreMeansOfPairsAndSizesOfErrors) {
  VERIFIES("LASSO-STE-014~1");
  const TrialResult result = two_lights();
  const PairFigures pairs = pair_figures(result, 0);
  EXPECT_EQ(pairs.pairs, 2U);
  EXPECT_NEAR(pairs.valid_share, 0.7, 1e-12);
  EXPECT_NEAR(pairs.exposure_s, 1e-3, 1e-15);
  const PoseFigures poses = pose_figures(poses_in(result.poses, 0));
  EXPECT_EQ(poses.valid, 3U);
  EXPECT_EQ(poses.wrong, 1U);
  EXPECT_NEAR(poses.median_mm, 2, 1e-12);
  EXPECT_NEAR(poses.rms_mm, std::sqrt(18), 1e-12);
  EXPECT_NEAR(poses.worst_deg, 0.7, 1e-12);
  EXPECT_NEAR(poses.squared_position, 10.0 / 3, 1e-12);
  EXPECT_NEAR(poses.nees, 30, 1e-12);
  const PoseFigures none = pose_figures(poses_in(result.poses, 1));
  EXPECT_EQ(none.scans, 1U);
  EXPECT_EQ(none.valid, 0U);
  EXPECT_TRUE(std::isnan(none.rms_mm) && std::isnan(none.nees));
}

TEST(TrialResults, AreToldByLightAndLeftForPrograms) {
  VERIFIES("LASSO-STE-014~1");
  const TrialResult result = two_lights();
  const std::string text = trial_text(result);
  EXPECT_NE(text.find("sun_behind"), std::string::npos);
  EXPECT_NE(text.find("0/1"), std::string::npos) << text;
  EXPECT_NE(trial_json(result).find("\"backlit_no_earth\""), std::string::npos);
  const std::string pairs = trial_pairs_csv(result), poses = trial_poses_csv(result);
  EXPECT_EQ(std::count(pairs.begin(), pairs.end(), '\n'), 5);
  EXPECT_EQ(std::count(poses.begin(), poses.end(), '\n'), 6);
  EXPECT_NE(poses.find("fitted,sun_behind,0,0,0,valid,0,0,3,0.3,"), std::string::npos) << poses;
  EXPECT_NE(poses.find("rendered,sun_behind,0,0,0,valid,1,0,7,0.7,"), std::string::npos) << poses;
  EXPECT_NE(poses.find("rendered,backlit_no_earth,0,0,0,too_few_returns,0,0,50,"), std::string::npos) << poses;
}

}  // namespace
}  // namespace lasso::mdat
