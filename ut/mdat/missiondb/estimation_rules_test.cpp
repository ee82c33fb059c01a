#include "ut/mdat/missiondb/rules_support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

class EstimationRules : public RuleTest {};

TEST_F(EstimationRules, SharesWithTheirHysteresisAreShares) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_edge("start.inlier_share_min = 1\ntracking.inlier_share_min = 0.98",
              "start.inlier_share_min = 1\ntracking.inlier_share_min = 0.99", "tracking.inlier_share_min: 0.99", "expected at most 0.98");
}

TEST_F(EstimationRules, AnAgreementThatTellsNoMismatchIsTold) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_edge("tracking.agreement_min = 0.9", "tracking.agreement_min = 0.6", "tracking.agreement_min: 0.6", "40 % of the returns");
}

TEST_F(EstimationRules, AStartExplainsAsMuchAsATrack) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_edge("start.inlier_share_min = 0.5", "start.inlier_share_min = 0.49", "start.inlier_share_min: 0.49", "which is 0.5");
}

TEST_F(EstimationRules, AnImageCanPassItsTrial) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_edge("image.trial_valid_min = 10", "image.trial_valid_min = 11", "error: ", "at most image.trial_scans, which is 10");
  EXPECT_EQ(said("image.trial_valid_min = 30\nimage.trial_scans = 0"), "");
}

TEST_F(EstimationRules, ContoursAreWithinTheirBand) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_edge("estimation.silhouette_sigma_m = 0.003", "estimation.silhouette_sigma_m = 0.0031", "silhouette_sigma_m: 0.0031",
              "which is 0.003 m");
  expect_edge("estimation.probe_step_m = 0.003", "estimation.probe_step_m = 0.0031", "probe_step_m: 0.0031", "which is 0.003 m");
}

TEST_F(EstimationRules, TimesAreNotShorterThanAPeriod) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_edge("start.age_max_s = 0.2", "start.age_max_s = 0.1", "start.age_max_s: 0.1", "which is 0.2 s");
  expect_edge("link.silence_max_s = 0.2", "link.silence_max_s = 0.19", "link.silence_max_s: 0.19", "which is 0.2 s");
}

// Tables of chi-square, 6 degrees of freedom: 12.59 is exceeded with 5 %, 9 with 17.4 %.
TEST_F(EstimationRules, GatesLetGoodPosesPass) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_edge("tracking.innovation_max = 3.55", "tracking.innovation_max = 3", "tracking.innovation_max: 3", "17.4 % of them");
}

TEST_F(EstimationRules, SourcesOfAStartAreDifferentAndPossible) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_edge("start.third = 'none'", "start.third = 'handover'", "start.third: \"handover\"", "than that of start.second");
  expect_edge("start.fifth = 'search'", "start.fifth = 'uplink'", "start.fifth: \"uplink\"", "than that of start.first");
  const std::string pose = "tracking.initial.present = true\ntracking.initial.z_m = 5\n";
  expect_edge(pose, pose + "start.fourth = 'none'", "warning: ", "\"apriori\" is none of");
  const std::string apriori = "start.first = 'apriori'\nstart.second = 'none'\nstart.third = 'none'\nstart.fourth = 'none'\n";
  expect_edge(apriori + pose, apriori, "error: ", "the only source of a start");
}

TEST_F(EstimationRules, TheInitialPoseIsOne) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  const std::string present = "tracking.initial.present = true\n";
  expect_edge(present + "tracking.initial.z_m = 5", present + "tracking.initial.z_m = -1", "tracking.initial.z_m: -1", "in front");
  expect_edge("tracking.initial.qw = 0.9991", "tracking.initial.qw = 0.99", "error: ", "that of [0, 0, 0, 0.99] is 0.99");
}

TEST_F(EstimationRules, PartsAreLookedAtFromWithinTheShortRange) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  const std::string part = "part.a.box_m = [-1, -0.5, -0.5, 0, 0.5, 0.5]\npart.a.view = [0, 0, -1]\npart.a.range_m = [";
  const std::string range = "short_range.enter_m = 5\nshort_range.leave_m = 5.5\n";
  expect_edge(range + part + "0.5, 6]", part + "0.5, 6]", "short_range.enter_m: 0", "never looked at");
  expect_edge(range + part + "5.4, 6]", range + part + "5.5, 6]", "short_range.leave_m: 5.5",
              "these parts never serve, by their range_m: a");
  expect_edge(range + part + "0.5, 6]", "short_range.enter_m = 5\nshort_range.leave_m = 5\n" + part + "0.5, 6]", "short_range.leave_m: 5",
              "more than short_range.enter_m");
  expect_said(said(range), "short_range.enter_m: 5", "has no parts to look at");
}

TEST_F(EstimationRules, LengthsAreSmallAgainstTheTarget) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_edge("estimation.gate_first_m = 0.25", "estimation.gate_first_m = 0.26", "estimation.gate_first_m: 0.26",
              "13 % of the target's length");
  for (const char* key : {"edge_gap_min_m", "edge_depth_m", "silhouette_band_m"}) {
    expect_edge(std::string("estimation.") + key + " = 0.25", std::string("estimation.") + key + " = 0.5", key, "0.5 mm are 0.0005 m");
  }
  const std::string small = "target.scale = 0.1\ntarget.cell_size_m = 0.002\nestimation.silhouette_band_m = 0.025\n";  // 0.2 m
  for (const char* key : {"silhouette_sigma_m", "probe_step_m", "surface_sigma_m", "stop_translation_m"}) {
    EXPECT_EQ(said(small + "estimation." + key + " = 0.025"), "") << key;
    expect_said(said(small + "estimation." + key + " = 0.05"), std::string(key) + ": 0.05", "25 % of the target's length, which is 0.2 m");
  }
}

TEST_F(EstimationRules, LimitsLeaveGoodPosesTheirRoom) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_edge("estimation.kernel_width = 3", "estimation.kernel_width = 2", "estimation.kernel_width: 2", "more than 2 sigmas off");
  const std::string pose = "tracking.initial.present = true\ntracking.initial.z_m = 5\ntracking.initial.wx_degps = ";
  expect_edge(pose + "83", pose + "300", "tracking.initial.wx_degps: 300", "turns by 54 deg in a scan");
}

}  // namespace
}  // namespace lasso::mdat
