#include "ut/mdat/missiondb/rules_support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

class ScenarioRules : public RuleTest {};

const std::string kSpin = "ranges_m = [5]\n";
const std::string kPass = "ranges_m = [6, 5]\n";

TEST_F(ScenarioRules, TimesAscendAndBelongToRanges) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_scenario_edge(kPass + "times_s = [0, 20]\nframes = 100", kPass + "times_s = [0, 10, 20]\nframes = 100",
                       "error: ", "expected one for each of ranges_m, which are 2");
  expect_scenario_edge(kPass + "times_s = [0, 20]\nframes = 100", kPass + "times_s = [20, 20]\nframes = 100",
                       "error: ", "expected more than the time before it, 20 s, of 20 s");
  expect_scenario_edge(kPass + "times_s = [0, 20]\nframes = 99", kPass + "times_s = [0, 20]\nframes = 98", "scenario.s.frames: 98",
                       "expected 100 frames of 0.2 s");
  expect_scenario_edge(kSpin + "eclipse_s = [1, 2]", kSpin + "eclipse_s = [2, 1]", "error: ", "not before the begin, 2 s");
  expect_scenario_edge(kSpin + "eclipse_s = [71, 80]", kSpin + "eclipse_s = [72, 80]", "warning: ", "ends at 72 s");
  expect_said(said("", "ranges_m = [5, 20]"), "scenario.s.ranges_m: [5, 20]",
              "expected between sensor.range_min_m and sensor.range_max_m, which are 0.5 m and 20 m: 20 m is not");
}

TEST_F(ScenarioRules, AModelErrorIsOne) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_scenario_edge(kSpin + "model_gone_box_m = [0, 0, 0, 1, 1, 1]", kSpin + "model_gone_box_m = [0, 0, 1, 1, 1, 1]",
                       "error: ", "each above its low one");
  const std::string turn = "model_turn_deg = [0, 5, 0]\n";
  expect_scenario_edge(kSpin + turn + "model_turned_box_m = [0, 0, 0, 1, 1, 1]", kSpin + turn + "model_turned_box_m = [2, 0, 0, 1, 1, 1]",
                       "error: ", "each above its low one");
  expect_scenario_edge(kSpin, kSpin + turn, "warning: ", "changes nothing: model_turned_box_m says which part turns");
}

TEST_F(ScenarioRules, AWayMayBeginBeyondWhatIsMeasured) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  const std::string way = "autonomous = true\ntimes_s = [0, 200, 220]\nframes = 1100\nnavigation_from_s = 0\nranges_m = ";
  const std::string values = "filter.acceleration_mps2 = 1\nbearing.returns_min = 4";
  EXPECT_EQ(said(values, way + "[19, 6, 5]"), "");
  expect_said(said(values, way + "[25, 6, 5]"), "warning: ",
              "at 1 of 3 ranges nothing is measured: expected between sensor.range_min_m and sensor.range_max_m, which are 0.5 m and 20 m: "
              "25 m is not");
  expect_said(said("filter.acceleration_mps2 = 1", way + "[40, 30, 20]"), "error: ", "40 m is not");
}

TEST_F(ScenarioRules, ATargetTurnsNoFasterThanScansCanTell) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  const std::string rate = "filter.initial_angular_rate_degps = 100";
  expect_scenario_edge(kSpin + "spin_degps = [0, 24.9, 0]", kSpin + "spin_degps = [0, 30, 0]", "warning: ", "turns by 5.4 deg in a scan",
                       rate);
  expect_scenario_edge(kSpin + "spin_degps = [24.9, 0, 0]", kSpin + "spin_degps = [200, 0, 0]",
                       "warning: ", "turns by 36 deg in a scan and by 40 deg from one to the next", rate);
  expect_scenario_edge(kSpin + "spin_degps = [12, 0, 0]", kSpin + "spin_degps = [13, 0, 0]",
                       "warning: ", "is 2.6 sigmas of filter.initial_angular_rate_degps, which is 5",
                       "filter.initial_angular_rate_degps = 5");
  expect_scenario_edge(kSpin + "drift_mps = [0, 0, 0.12]", kSpin + "drift_mps = [0, 0, 0.15]",
                       "warning: ", "is 3 sigmas of filter.initial_rate_mps, which is 0.05");
  const std::string paper = "variants = true\nranges_m = [5]\nstep_deg = ";
  expect_scenario_edge(paper + "11.9", paper + "12.1", "scenario.s.step_deg: 12.1", "more than 12 deg");
}

TEST_F(ScenarioRules, ASearchFindsPosesAgain) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  const std::string search = "start.fifth = 'search'";
  expect_scenario_edge(kSpin + "prior = false\nspin_degps = [7.4, 0, 0]", kSpin + "prior = false\nspin_degps = [8, 0, 0]",
                       "warning: ", "turns by 16 deg between two scans", search);
  expect_edge(search, "", "scenario.s.prior: false", "finds the bearing, and never a pose", kSpin + "prior = false");
  const std::string approach = "autonomous = true\nranges_m = [6, 5]\ntimes_s = [0, 20]\nframes = 100\nnavigation_from_s = ";
  expect_scenario_edge(approach + "19", approach + "20", "scenario.s.prior", "never a pose");
}

TEST_F(ScenarioRules, AnApproachIsNoHastierThanTheFilterTakesIt) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  // 6 times the way over the square of the time: 0.0496 and 0.06, of 5 times 0.01
  expect_scenario_edge(kPass + "times_s = [0, 11]\nframes = 60", kPass + "times_s = [0, 10]\nframes = 60", "scenario.s.times_s",
                       "takes 0.06 m/s2");
}

TEST_F(ScenarioRules, AMovingTargetIsDeskewed) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  // 1 m at 1.7 and 2 deg/s for 0.18 s: 5.3 and 6.3 mm, of twice 2.8 mm
  expect_scenario_edge(kSpin + "spin_degps = [1.7, 0, 0]", kSpin + "spin_degps = [2, 0, 0]", "estimation.deskew: false", "6.28 mm",
                       "estimation.deskew = false");
}

TEST_F(ScenarioRules, TheSimulatedSensorIsTheOneThatIsAssumed) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_scenario_edge(kSpin + "sigma_k_per_m = 3.3e-4", kSpin + "sigma_k_per_m = 4.1e-4", "scenario.s.sigma_k_per_m: 0.00041",
                       "10.3 mm at 5 m, 3.69 times the 2.78 mm");
  expect_scenario_edge(kSpin + "noise = false\nsigma0_m = 0.05", kSpin + "sigma0_m = 0.05", "warning: ", "18 times");
  expect_scenario_edge(kSpin + "angle_noise_rad = 1.6e-4", kSpin + "angle_noise_rad = 1e-3", "scenario.s.angle_noise_rad: 0.001",
                       "by 5 mm at 5 m");
  expect_scenario_edge(kSpin + "dropout_probability = 0.01", kSpin + "dropout_probability = 0.2", "scenario.s.dropout_probability: 0.2",
                       "20 % drop out");
  // (1 - 0.005) / (1 + 0.005) is 99 %
  expect_scenario_edge(kSpin + "outlier_probability = 0.005", kSpin + "outlier_probability = 0.2", "scenario.s.outlier_probability: 0.2",
                       "explains 66.7 % of the returns, and a start has to explain 99 %");
}

TEST_F(ScenarioRules, KeysThatHaveNoEffectAreTold) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  const std::string offer = "navigation_sigma_m = 0.2\nranges_m = [5]", seek = "start.fifth = 'search'";
  expect_scenario_edge(offer + "\nautonomous = true", offer, "warning: ", "these have no effect: navigation_sigma_m", seek);
  expect_scenario_edge("paper_table = true\nvariants = true\nranges_m = [5]", "paper_table = true\nranges_m = [5]",
                       "warning: ", "these have no effect: paper_table");
}

TEST_F(ScenarioRules, WhatContradictsIsRefused) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  const std::string steps = "step_deg = 1\nranges_m = [6, 5]\nframes = 100\n", still = "variants = true\nranges_m = [6, 5]\nframes = 100\n";
  for (const char* moves : {"spin_degps = [0, 0, 1]", "drift_mps = [0, 0.01, 0]", "times_s = [0, 20]"}) {
    expect_scenario_edge(steps, steps + moves, "scenario.s.step_deg: 1", "expected 0, or no times_s, spin_degps and drift_mps");
    expect_scenario_edge(still, still + moves, "scenario.s.variants: true", "stands still in each scan");
  }
  const std::string alone = "autonomous = true\nframes = 100\nranges_m = ";
  expect_scenario_edge(alone + "[5]", alone + "[6, 5]", "scenario.s.autonomous: true", "is one run: expected one of ranges_m, or times_s",
                       "start.fifth = 'search'");
}

TEST_F(ScenarioRules, OfARunItsOwnScenarioIsTold) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  folder_.write("box.toml", "[[part]]\nkind = 'box'\nsize = [2, 1, 1]\n");
  MissionSource source =
      load_mission(folder_.write("two.toml",
                                 "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'box.toml'\n[start]\nage_max_s = 0\n"
                                 "[scenario.a]\nranges_m = [5]\n[scenario.b]\nranges_m = [5]\nspin_degps = [30, 0, 0]\n"));
  check_target(source, load_target(source));
  ASSERT_EQ(warnings_for(source, "a").size(), 1U);
  EXPECT_NE(warnings_for(source, "a")[0].find("two.toml:8:13: start.age_max_s: 0: "), std::string::npos) << warnings_for(source, "a")[0];
  EXPECT_EQ(warnings_for(source, "b").size(), 3U);  // the turn in a scan, and the rate at the start
  EXPECT_EQ(warnings_for(source, "").size(), 3U);
}

TEST_F(ScenarioRules, RaysReturnFromMostOfTheTarget) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  // the square of the sine
  const std::string all_graze = kSpin + "override.estimation.incidence_max_deg = 45\n";
  expect_scenario_edge(all_graze + "dropout_incidence_deg = 51", all_graze + "dropout_incidence_deg = 45", "dropout_incidence_deg: 45",
                       "50 % return");
  expect_scenario_edge(kSpin + "dropout_incidence_deg = 86", kSpin + "dropout_incidence_deg = 80", "dropout_incidence_deg: 80",
                       "97 % return; misses on the target count against its poses, up to estimation.incidence_max_deg, which is 86 deg");
  expect_scenario_edge(kSpin + "dropout_incidence_deg = 86", kSpin + "dropout_incidence_deg = 1.4", "dropout_incidence_deg: 1.4",
                       "1.4 rad are 80.2 deg");
}

TEST_F(ScenarioRules, RunsLastUntilTheFilterHasSettled) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  expect_scenario_edge(kSpin + "frames = 20", kSpin + "frames = 3", "scenario.s.frames: 3", "takes some 20 frames");
  EXPECT_EQ(said("", "variants = true\nranges_m = [5]\nframes = 3"), "") << "each scan for itself";
}

// 100 frames are 20 s, and the target is 2 m long.
TEST_F(ScenarioRules, ANavigationSystemHelpsInTimeAndWellEnough) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  const std::string approach = "autonomous = true\nranges_m = [6, 5]\ntimes_s = [0, 20]\nframes = 100\n", way = "start.fifth = 'search'";
  expect_scenario_edge(approach + "navigation_from_s = 19", approach + "navigation_from_s = 20", "scenario.s.navigation_from_s: 20",
                       "the run, which ends at 20 s", way);
  EXPECT_EQ(said(way, approach + "navigation_from_s = 1e6"), "") << "never";
  expect_scenario_edge(approach + "navigation_sigma_m = 0.5", approach + "navigation_sigma_m = 50", "scenario.s.navigation_sigma_m: 50",
                       "target's length of 2 m", way);
  EXPECT_EQ(said(way, approach + "navigation_from_s = 1e6\nnavigation_sigma_m = 50"), "") << "not asked";
}

TEST_F(ScenarioRules, BandsOfSensorsMeet) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  const std::string near = "further_sensor.near.use_to_m = 5.5\nsensor.use_from_m = ";
  expect_edge(near + "5.5", near + "5.8", "scenario.s.ranges_m: [6, 5]", "from 5.5 m on the target is in no sensor's band",
              kPass + "times_s = [0, 20]\nframes = 100");
}

TEST_F(ScenarioRules, SimulatedCommonErrorsAreStated) {
  VERIFIES("LASSO-GND-009~1 LASSO-GND-060~1");
  const std::string stated = "sensor.common_sigma_m = 0.002\nsensor.common_sigma_deg = 0.01\nsensor.common_memory_s = 5";
  expect_scenario_edge(kSpin + "common_sigma_m = 0.002", kSpin + "common_sigma_m = 0.02", "scenario.s.common_sigma_m: 0.02",
                       "covariances will be too small", stated);
  expect_scenario_edge(kSpin + "common_sigma_deg = 0.01", kSpin + "common_sigma_deg = 0.1", "warning: ", "0.1 deg, where [sensor]", stated);
  expect_scenario_edge(kSpin + "common_memory_s = 5", kSpin + "common_memory_s = 50", "scenario.s.common_memory_s: 50",
                       "last longer than sensor.common_memory_s says", stated);
  EXPECT_EQ(said("", kSpin + "common_memory_s = 50"), "") << "of nothing";
}

}  // namespace
}  // namespace lasso::mdat
