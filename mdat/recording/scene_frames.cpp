#include "mdat/recording/scene_frames.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "mdat/run/simulated_scenario.hpp"

namespace lasso::mdat {
namespace {

constexpr const char* kOwnFrames[] = {kWorldFrame, kSensorFrame, kTargetFrame, kFilteredFrame, kTrueFrame};

Pose T_target_of(const PartSource& part) {
  const std::vector<double>&p = part.origin_m, &q = part.quaternion;
  Pose T_target_part;
  if (p.size() == 3) T_target_part.p = Vec3(p.data());
  if (q.size() == 4) T_target_part.q = Quat(q[3], q[0], q[1], q[2]);
  return T_target_part;
}

}  // namespace

SceneFrames::SceneFrames(const MissionSource& mission, const std::string& scenario) {
  if (!scenario.empty()) scene_ = scenario_of(mission, scenario).scene;
  for (const PartSource& part : mission.parts) estimated_.push_back({kTargetFrame, "part/" + part.name, T_target_of(part)});
  if (!scene_) return;
  for (const scene::Node& node : mission.scene.nodes) links_.emplace_back(scene_->tree.need(node.name), scene_->tree.need(node.parent));
  for (const RelativePair& pair : scene_->relative)
    estimated_.push_back({kTargetFrame, "relative/" + pair.name, scene_->tree.state(pair.of, scene_->target, 0).T_a_b});
}

std::string SceneFrames::frame_of(std::size_t node) const {
  if (node == scene_->sensor) return kSensorFrame;
  if (node == scene_->target) return kTrueFrame;
  if (node == 0) return kWorldFrame;
  const std::string& name = scene_->tree.name(node);
  const bool taken = std::any_of(std::begin(kOwnFrames), std::end(kOwnFrames), [&](const char* own) { return name == own; });
  return taken ? name + "_node" : name;
}

std::vector<ros::FrameTransform> SceneFrames::true_frames(TimeUs t_us, const Pose& T_sensor_true) const {
  if (!scene_) return {{kWorldFrame, kSensorFrame, Pose{}}, {kSensorFrame, kTrueFrame, T_sensor_true}};
  std::vector<ros::FrameTransform> frames;
  for (const auto& [node, parent] : links_)
    frames.push_back({frame_of(parent), frame_of(node), scene_->tree.state(node, parent, t_us - kEpochUs).T_a_b});
  return frames;
}

std::vector<SceneFrames::Body> SceneFrames::bodies() const {
  std::vector<Body> bodies;
  for (std::size_t i = 0; scene_ && i < scene_->body_nodes.size(); ++i)
    bodies.push_back({frame_of(scene_->body_nodes[i]), &scene_->surfaces->bodies[i].mesh});
  return bodies;
}

const std::vector<bool>& SceneFrames::moved_triangles() const {
  static const std::vector<bool> kNone;
  return scene_ ? scene_->surfaces->moved : kNone;
}

}  // namespace lasso::mdat
