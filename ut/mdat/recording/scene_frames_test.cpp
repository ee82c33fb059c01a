#include "mdat/recording/scene_frames.hpp"

#include <gtest/gtest.h>

#include <map>

#include "mdat/run/case.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

const Pose kT_chaser_head{normalized(Quat(0.9, 0.1, -0.3, 0.2)), Vec3(0.3, -0.2, 0.5)};
const Pose kT_target_grapple{normalized(Quat(0.6, 0.3, 0.6, -0.4)), Vec3(-6.4, 0.3, 1.2)};

scene::MotionPtr turning(const Vec3& omega_radps, const Vec3& v_mps, const Vec3& p_m) {
  scene::ConstantRates::Setup setup;
  setup.T_parent_pivot = {normalized(Quat(0.8, 0.2, 0.5, -0.1)), p_m};
  setup.rates = {omega_radps, v_mps};
  return std::make_shared<scene::ConstantRates>(setup);
}

scene::Node node(const char* name, const char* parent, const Pose& T_parent_base, scene::MotionPtr motion = nullptr) {
  scene::Node result;
  result.name = name;
  result.parent = parent;
  result.T_parent_base = T_parent_base;
  result.motion = std::move(motion);
  return result;
}

// A chaser that moves past a target that tumbles and whose array turns; a node that has the name of a frame of every recording.
MissionSource docking_mission() {
  MissionSource mission;
  mission.scene.nodes = {node("hubble", "root", {}, turning({0.01, -0.02, 0.005}, {0.05, 0.02, -0.1}, {2, -1, 30})),
                         node("array", "hubble", {Quat::Identity(), Vec3(0, 2, 0)}, turning({0, 0.1, 0}, Vec3::Zero(), Vec3::Zero())),
                         node("grapple", "hubble", kT_target_grapple),
                         node("chaser", "root", {}, turning({0.001, 0.003, 0}, {0.2, 0, 0.1}, {0, 0, -3})),
                         node("head", "chaser", kT_chaser_head),
                         node("target", "chaser", {Quat::Identity(), Vec3(1, 0, 0)})};
  const scene::Tree tree(kSceneRoot, mission.scene.nodes);
  auto surfaces = std::make_shared<SceneSurfaces>();
  surfaces->bodies.resize(1);
  surfaces->moved = {false, true};
  mission.scenarios["approach"].scene = std::make_shared<SceneRun>(SceneRun{tree,
                                                                            tree.need("hubble"),
                                                                            tree.need("head"),
                                                                            {tree.need("array")},
                                                                            surfaces,
                                                                            0,
                                                                            0,
                                                                            {},
                                                                            {},
                                                                            {{"docking", tree.need("grapple"), tree.need("chaser")}}});
  PartSource part;
  part.name = "bay";
  part.origin_m = {1, 2, 3};
  part.quaternion = {0, 0, 1, 0};
  mission.parts.push_back(part);
  mission.scenarios["spin"];
  return mission;
}

using Frames = std::map<std::string, ros::FrameTransform>;

Frames by_child(const std::vector<ros::FrameTransform>& transforms) {
  Frames frames;
  for (const ros::FrameTransform& transform : transforms) EXPECT_TRUE(frames.emplace(transform.child, transform).second) << transform.child;
  return frames;
}

// As a viewer does it: from a frame to the root.
Pose in_world(const Frames& frames, std::string frame) {
  Pose T_world_frame;
  for (int depth = 0; frame != kWorldFrame && depth < 9; ++depth) {
    const ros::FrameTransform& transform = frames.at(frame);
    T_world_frame = transform.T_parent_child * T_world_frame;
    frame = transform.parent;
  }
  EXPECT_EQ(frame, kWorldFrame);
  return T_world_frame;
}

void expect_near(const Pose& a, const Pose& b) {
  EXPECT_LT((a.p - b.p).norm(), 1e-9);
  EXPECT_LT(a.q.angularDistance(b.q), 1e-9);
}

TEST(SceneFrames, AreWhereTheNodesAre) {
  VERIFIES("LASSO-REC-023~1");
  const MissionSource mission = docking_mission();
  const SceneFrames scene(mission, "approach");
  const SceneRun& run = *mission.scenarios.at("approach").scene;
  for (const TimeUs t_us : {TimeUs{0}, TimeUs{7'300'000}}) {
    const Frames frames = by_child(scene.true_frames(kEpochUs + t_us, Pose{}));
    EXPECT_EQ(frames.size(), mission.scene.nodes.size());
    const Pose T_world_sensor = in_world(frames, kSensorFrame);
    expect_near(inverse(T_world_sensor) * in_world(frames, kTrueFrame), run.target_at(t_us).T_a_b);
    expect_near(in_world(frames, "grapple"), run.tree.state(run.tree.need("grapple"), 0, t_us).T_a_b);
    expect_near(in_world(frames, "array"), run.tree.state(run.tree.need("array"), 0, t_us).T_a_b);
    EXPECT_EQ(frames.at("array").parent, kTrueFrame);
    EXPECT_EQ(frames.at("target_node").parent, "chaser") << "its own name is that of an estimate";
  }
}

TEST(SceneFrames, OfTheEstimatedTargetArePartsAndNamedFrames) {
  VERIFIES("LASSO-REC-023~1");
  const MissionSource mission = docking_mission();
  const SceneFrames scene(mission, "approach");
  const Frames frames = by_child(scene.estimated_frames());
  ASSERT_EQ(frames.size(), 2U);
  expect_near(frames.at("part/bay").T_parent_child, {Quat(0, 0, 0, 1), Vec3(1, 2, 3)});
  expect_near(frames.at("relative/docking").T_parent_child, kT_target_grapple);
  for (const auto& [name, frame] : frames) EXPECT_EQ(frame.parent, kTargetFrame) << name;
}

TEST(SceneFrames, SurfacesAreAtTheirNodes) {
  VERIFIES("LASSO-REC-023~1");
  const MissionSource mission = docking_mission();
  const SceneFrames scene(mission, "approach");
  ASSERT_EQ(scene.bodies().size(), 1U);
  EXPECT_EQ(scene.bodies()[0].frame, "array");
  EXPECT_EQ(scene.moved_triangles(), (std::vector<bool>{false, true}));
}

TEST(SceneFrames, WithoutASceneTheSensorRestsInTheWorld) {
  VERIFIES("LASSO-REC-023~1");
  const MissionSource mission = docking_mission();
  const Pose T_sensor_target{Quat(0, 1, 0, 0), Vec3(0, 0, 4)};
  for (const char* scenario : {"spin", ""}) {
    const SceneFrames scene(mission, scenario);
    const Frames frames = by_child(scene.true_frames(kEpochUs, T_sensor_target));
    ASSERT_EQ(frames.size(), 2U);
    expect_near(in_world(frames, kSensorFrame), Pose{});
    expect_near(in_world(frames, kTrueFrame), T_sensor_target);
    EXPECT_TRUE(scene.bodies().empty() && scene.moved_triangles().empty());
    EXPECT_EQ(scene.estimated_frames().size(), 1U) << "the mission's part";
  }
}

}  // namespace
}  // namespace lasso::mdat
