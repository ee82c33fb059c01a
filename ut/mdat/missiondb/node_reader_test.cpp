#include "mdat/missiondb/node_reader.hpp"

#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/so3.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const std::string kNodeMissionHead = "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'box.toml'\n";  // 6 lines
const std::string kMotions =
    "[motion.spin]\nkind = 'rates'\nspin_degps = [0, 0, 2]\nposition_m = [0, 0, 0.5]\n"
    "[motion.way]\nkind = 'rates'\nposition_m = [0, 0, -5]\nvelocity_mps = [0, 0, 0.1]\n"
    "[motion.rest]\nkind = 'still'\nposition_m = [0, 0, -3]\n";
const std::string kNodes =
    "[node.body]\ntarget = true\nmotion = 'spin'\n[node.chaser]\nmotion = 'way'\n"
    "[node.camera]\nparent = 'chaser'\nposition_m = [0.2, 0.1, 0]\nquaternion = [0, 0, 0.6, 0.8]\nsensor = true\n";

std::string all_of(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

class NodeReaderTest : public ::testing::Test {
 protected:
  NodeReaderTest() { folder_.write("box.toml", "[[part]]\nkind = 'box'\nsize = [1, 1, 1]\n"); }
  MissionSource load(const std::string& text) { return load_mission(folder_.write("m.toml", kNodeMissionHead + text)); }
  std::string problems(const std::string& text) {
    return mission_error_of([&] { static_cast<void>(load(text)); });
  }
  void expect_problem(const std::string& text, const std::string& expected) {
    const std::string said = problems(text);
    EXPECT_NE(said.find(expected), std::string::npos) << "got: " << said << "\nexpected: " << expected;
  }
  Folder folder_;
};

// The camera is turned about its boresight by 73.7 deg, 0.2 m and 0.1 m off the chaser's origin.
TEST_F(NodeReaderTest, ASceneIsTheTargetBeforeASensorOnACraftThatMoves) {
  VERIFIES("LASSO-SCN-020~2");
  const MissionSource source = load(kMotions + kNodes + "[scenario.s]\nframes = 50\n");
  const SceneRun& run = *source.scenarios.at("s").scene;
  const Quat q_chaser_camera(0.8, 0, 0, 0.6);
  for (const double t_s : {0.0, 3.7, 9.9}) {
    const Pose T = run.target_at(static_cast<TimeUs>(std::llround(1e6 * t_s))).T_a_b;
    const Vec3 p = q_chaser_camera.conjugate() * (Vec3(0, 0, 0.5) - Vec3(0.2, 0.1, -5 + 0.1 * t_s));
    const Quat q = q_chaser_camera.conjugate() * Quat(Eigen::AngleAxisd(2 * kRadPerDeg * t_s, Vec3::UnitZ()));
    EXPECT_LT((T.p - p).norm(), 1e-12);
    EXPECT_LT(T.q.angularDistance(q), 1e-9);
  }
  EXPECT_NEAR(run.rate_radps, 2 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(run.acceleration_mps2, 0, 1e-9);
  EXPECT_EQ(run.ranges_m.size(), 50U);
  EXPECT_NEAR(run.times_s.back(), 9.8, 1e-12);
  EXPECT_EQ(source.scenarios.at("s").ranges_m, run.ranges_m);
}

TEST_F(NodeReaderTest, AScenarioReplacesTheMotionsThatItNames) {
  VERIFIES("LASSO-SCN-023~2");
  const MissionSource source = load(kMotions + kNodes + "[scenario.s]\nmotion = {chaser = 'rest'}\n[scenario.t]\n");
  for (const double t_s : {0.0, 9.0}) {
    const auto t_us = static_cast<TimeUs>(std::llround(1e6 * t_s));
    EXPECT_NEAR(source.scenarios.at("s").scene->target_at(t_us).T_a_b.p.z(), 3.5, 1e-12);
    EXPECT_NEAR(source.scenarios.at("t").scene->target_at(t_us).T_a_b.p.z(), 5.5 - 0.1 * t_s, 1e-12);
  }
}

// V-bar is x of LVLH, R-bar its z.
TEST_F(NodeReaderTest, AnOrbitHasDockingsFrameAsWell) {
  VERIFIES("LASSO-SCN-020~2");
  const MissionSource source = load(
      "[orbit]\n[node.body]\ntarget = true\n[node.port]\nparent = 'lvlh'\nposition_m = [-10, 0, 3]\ntowards = 'body'\nsensor = "
      "true\n[scenario.s]\n");
  const SceneRun& run = *source.scenarios.at("s").scene;
  EXPECT_LT((run.tree.state(run.sensor, 0, 0).T_a_b.p - Vec3(-3, -10, 0)).norm(), 1e-12);
  EXPECT_LT((run.target_at(0).T_a_b.p - Vec3(0, 0, std::hypot(10, 3))).norm(), 1e-12);
}

TEST_F(NodeReaderTest, EveryProblemIsToldWithItsPlace) {
  VERIFIES("LASSO-SCN-024~1");
  const std::string said =
      problems(kMotions +
               "[node.a]\nparent = 'b'\ntarget = true\n[node.b]\nparent = 'a'\ntarget = true\n[node.c]\nmotion = 'spinn'\nmesh = 'x.stl'\n"
               "[node.d]\nparent = 'cc'\nmesh = 'x.stl'\nparts = 'y'\n[node.e]\nscale = 2\n[node.f]\ntowards = 'f'\n");
  for (const char* expected :
       {"node.b.target: true: node a is the target already",
        "node.c.motion: \"spinn\": the mission has no [motion.spinn]; did you mean spin?", "node.c.mesh: \"x.stl\": no such file",
        "node.d.parts: expected at most one of model, mesh, points and parts", "node.e.scale: has no effect without model, mesh or points",
        "m.toml:28:10: node.d.parent: \"cc\": there is no such node"}) {
    EXPECT_NE(said.find(expected), std::string::npos) << expected << "\nin:\n" << said;
  }
  expect_problem("[node.a]\nparent = 'b'\n[node.b]\nparent = 'a'\n", "m.toml:8:10: node.a.parent: \"a\" in \"b\" in \"a\": is a circle");
  expect_problem("[node.a]\ntarget = true\nmodel = 'box.toml'\n", "node.a.model: the target's node looks as [target] says");
}

// Each at the place of its own key, and all of one file at once.
TEST_F(NodeReaderTest, ProblemsOfTheTreeStandAtTheirKeys) {
  VERIFIES("LASSO-SCN-024~1");
  const std::string said = problems(
      "[node.a]\nposition_m = [1, 0, 0]\nparent = 'x'\n"
      "[node.b]\ntowards = 'y'\nup = [0, 0, 1]\n"
      "[motion.cone]\nkind = 'torque_free'\nspin_degps = [1, 0, 0]\ninertia = [1, 2, 9]\n"
      "[motion.back]\nkind = 'waypoints'\nat = [\n  {time_s = 2, position_m = [0, 0, 1]},\n  {time_s = 1, position_m = [0, 0, 2]},\n]\n"
      "[motion.loop]\nkind = 'chain'\nof = ['cone', 'loop']\n[node.root]\n");
  for (const char* expected : {"m.toml:9:10: node.a.parent: \"x\": there is no such node",
                               "m.toml:11:11: node.b.towards: \"y\": there is no such node", "m.toml:12:6: node.b.up: lies along the axis",
                               "m.toml:16:11: motion.cone.inertia: 9: ", "m.toml:21:", "is not after 2 s of the row before",
                               "m.toml:25:6: motion.loop.of: is part of itself", "m.toml:26:1: node.root, name: is the root's"})
    EXPECT_NE(said.find(expected), std::string::npos) << expected << "\nin:\n" << said;
}

TEST_F(NodeReaderTest, AScenarioSaysRangesOrFliesNodes) {
  VERIFIES("LASSO-SCN-024~1");
  expect_problem("[node.a]\nsensor = true\n[scenario.s]\n", "m.toml:9:1: scenario.s: no node of the mission has target = true: add it");
  expect_problem("[node.a]\ntarget = true\n[scenario.s]\n", "no node of the mission has sensor = true");
  expect_problem(kMotions + kNodes + "[scenario.s]\ntimes_s = [3]\n", "scenario.s.times_s: leave it out");
  expect_problem(kMotions + kNodes + "[scenario.s]\nmotion = {chasr = 'way'}\n",
                 "scenario.s.motion.chasr: 'way': the mission has no [node.chasr]; did you mean chaser?");
  expect_problem(kMotions + kNodes + "[scenario.s]\nmotion = {body = 'sping'}\n",
                 "scenario.s.motion.body: 'sping': expected the name of a [motion.NAME]");
  expect_problem(kMotions + kNodes + "[scenario.s]\nranges_m = [3]\nmotion = {body = 'spin'}\n",
                 "scenario.s.motion: a table: has no effect where ranges_m say where the target is");
  expect_problem("[scenario.s]\n", "m.toml:7:1: scenario.s.ranges_m: is missing");
}

TEST_F(NodeReaderTest, MotionsOfTheHillFrameMoveNodesOfTheRoot) {
  VERIFIES("LASSO-SCN-024~1");
  const std::string sun =
      "[orbit]\n[motion.sun]\nkind = 'sun_pointing'\n[motion.tumble]\nkind = 'torque_free'\nspin_degps = [1, 2, 3]\ninertia = [2, 3, "
      "4]\n[node.body]\ntarget = true\n";
  EXPECT_EQ(problems(sun + "[node.wing]\nmotion = 'sun'\n"), "");
  expect_problem(sun + "[node.wing]\nparent = 'body'\nmotion = 'sun'\n",
                 "node.wing.motion: \"sun\": is a motion in the Hill frame's axes: the node has to stand in root");
  expect_problem(sun + "[node.wing]\nparent = 'lvlh'\nmotion = 'sun'\n", "is a motion in the Hill frame's axes");
  expect_problem(sun + "[node.lvlh]\n", "node.lvlh: is the orbit's frame of docking: give the node another name");
  const MissionSource source = load(sun + "[node.free]\nmotion = 'tumble'\n");
  EXPECT_NE(all_of(source.warnings).find("node.free.motion: \"tumble\": is torque-free in axes that do not turn"), std::string::npos);
}

TEST_F(NodeReaderTest, WhatLeavesTheFieldAndWhatTurnsByStepsIsSeen) {
  VERIFIES("LASSO-SCN-024~1");
  MissionSource source = load(
      "[motion.pan]\nkind = 'rates'\nspin_degps = [0, 2, 0]\nposition_m = [0, 0, -5]\n[motion.steps]\nkind = 'steps'\nstep_deg = 30\n"
      "[node.body]\ntarget = true\nmotion = 'steps'\n[node.camera]\nmotion = 'pan'\nsensor = true\n[scenario.s]\nframes = "
      "100\n");
  check_target(source, load_target(source));
  const std::string said = all_of(warnings_for(source, "s"));
  EXPECT_NE(said.find("the target's middle is out of the field, or of what is measured"), std::string::npos) << said;
  EXPECT_NE(said.find("the target turns by"), std::string::npos) << said;
}

TEST_F(NodeReaderTest, WhatChangesNothingIsTold) {
  VERIFIES("LASSO-SCN-024~1");
  const std::string scenario = "[scenario.s]\n";
  EXPECT_EQ(all_of(load(kMotions.substr(0, kMotions.find("[motion.rest]")) + kNodes + scenario).warnings), "");
  const std::string said = all_of(load(kMotions + kNodes + "[node.camra]\nposition_m = [1, 2, 3]\n" + scenario).warnings);
  EXPECT_NE(said.find("motion.rest.kind: no node has this motion"), std::string::npos) << said;
  EXPECT_NE(said.find("node.camra.parent: nothing stands at this node, or asks for it: it changes nothing; did you mean camera?"),
            std::string::npos)
      << said;
  // What others stand in or point to is not idle.
  EXPECT_EQ(
      all_of(load("[node.a]\n[node.b]\nparent = 'a'\ntarget = true\n[node.c]\nposition_m = [0, 0, 3]\n[node.d]\nposition_m = [0, 0, -3]\n"
                  "towards = 'c'\nsensor = true\n" +
                  scenario)
                 .warnings),
      "");
}

TEST_F(NodeReaderTest, NodesThatPointToNodesThatPointAreFew) {
  VERIFIES("LASSO-SCN-024~1");
  std::string line = "[node.t]\ntarget = true\n[node.n0]\nposition_m = [1, 2, 3]\n";
  for (int i = 1; i < 20; ++i)
    line += "[node.n" + std::to_string(i) + "]\nparent = 'n" + std::to_string(i - 1) + "'\ntowards = 't'\nposition_m = [0, 1, 0]\n";
  expect_problem(line, "each of its poses would ask more than 2000 others");
}

TEST_F(NodeReaderTest, NamedFramesStandOnTheTargetAndOnTheSensorsCraft) {
  VERIFIES("LASSO-SCN-026~1 LASSO-SCN-024~1");
  const std::string frames = "[node.port]\nparent = 'body'\n[node.wing]\nparent = 'body'\nmotion = 'spin'\n[node.arm]\nparent = 'chaser'\n";
  const std::string scenario = "[scenario.s]\n";
  const MissionSource source = load(kMotions + kNodes + frames + "[relative.dock]\nof = 'port'\nin = 'arm'\n" + scenario);
  const SceneRun& run = *source.scenarios.at("s").scene;
  ASSERT_EQ(run.relative.size(), 1U);
  EXPECT_EQ(run.tree.name(run.relative[0].of), "port");
  EXPECT_EQ(run.tree.name(run.relative[0].in), "arm");
  expect_problem(kMotions + kNodes + frames + "[relative.dock]\nof = 'wing'\nin = 'root'\n" + scenario,
                 "relative.dock.of: \"wing\": moves against the target in scenario s: name a node that stands on body");
  expect_problem(kMotions + kNodes + frames + "[relative.dock]\nof = 'wing'\nin = 'root'\n" + scenario,
                 "relative.dock.in: \"root\": moves against the sensor");
  const std::string dock = "[relative.dock]\nof = 'port'\nin = 'arm'\naxes = ";
  EXPECT_EQ(load(kMotions + kNodes + frames + dock + "'root'\n" + scenario).scenarios.at("s").scene->relative.at(0).axes, 0U);
  expect_problem(kMotions + kNodes + frames + dock + "'port'\n" + scenario,
                 "relative.dock.axes: \"port\": stands on the target, whose attitude is what is measured");
  expect_problem(kMotions + kNodes + frames + dock + "'lvhl'\n", "relative.dock.axes: \"lvhl\": the mission has no [node.lvhl]");
  expect_problem(kMotions + kNodes + frames + "[relative.dock]\nof = 'prot'\n",
                 "relative.dock.of: \"prot\": the mission has no [node.prot]; did you mean port?");
  expect_problem(kMotions + kNodes + frames + "[relative.dock]\nof = 'port'\n", "relative.dock.in: is missing");
}

TEST_F(NodeReaderTest, RulesAskTheMotionThatIsFlown) {
  VERIFIES("LASSO-SCN-024~1");
  MissionSource source = load(
      "[motion.fast]\nkind = 'rates'\nspin_degps = [40, 0, 0]\n[node.body]\ntarget = true\nmotion = 'fast'\n"
      "[node.camera]\nposition_m = [0, 0, -4]\nsensor = true\n[scenario.s]\ntilt_deg = 20\n");
  check_target(source, load_target(source));
  const std::string said = all_of(warnings_for(source, "s"));
  EXPECT_NE(said.find("scenario.s.motion: the target turns by"), std::string::npos) << said;
  EXPECT_NE(said.find("of this scenario's keys these have no effect: tilt_deg"), std::string::npos) << said;
  const std::string behind = mission_error_of([&] {
    MissionSource back = load("[node.body]\ntarget = true\n[node.camera]\nposition_m = [0, 0, 4]\nsensor = true\n[scenario.s]\n");
    check_target(back, load_target(back));
  });
  EXPECT_NE(behind.find("m.toml:12:1: scenario.s.motion: at 0 s the target's middle is behind the sensor"), std::string::npos) << behind;
  const std::string inside = mission_error_of([&] {
    MissionSource close = load(
        "[node.body]\ntarget = true\n[node.camera]\nposition_m = [0, 0, -0.2]\nsensor = true\n[scenario.s]\n[sensor]\nrange_min_m = 0.1\n");
    check_target(close, load_target(close));
  });
  EXPECT_NE(inside.find("the sensor would be in the target"), std::string::npos) << inside;
}

// A name that is misspelt would be a node or a sensor of its own.
TEST_F(NodeReaderTest, ASettingMakesNoTableThatIsNotThere) {
  VERIFIES("LASSO-SCN-024~1");
  const auto file = folder_.write("m.toml", kNodeMissionHead + kMotions + kNodes + "[scenario.s]\n");
  const auto said = [&](const std::string& setting) { return mission_error_of([&] { static_cast<void>(load_mission(file, {setting})); }); };
  EXPECT_NE(said("node.chasr.position_m=[0,0,1]")
                .find("--set: node.chasr.position_m: [0,0,1]: the mission has no [node.chasr]; did you mean "
                      "chaser?; a new one is set as a whole: 'node.chasr={...}'"),
            std::string::npos)
      << said("node.chasr.position_m=[0,0,1]");
  EXPECT_NE(said("further_sensor.near.range_max_m=4").find("the mission has no [further_sensor.near]"), std::string::npos);
  EXPECT_EQ(load_mission(file, {"node.chaser.position_m=[0,0,1]", "node.mast={parent='chaser'}"}).scene.nodes.size(), 4U);
}

}  // namespace
}  // namespace lasso::mdat
