#include "mdat/missiondb/named_pairs.hpp"

#include "cfg/capacities.hpp"

namespace lasso::mdat {
namespace {

// Of a mission's nodes with their own motions: those of a scenario make nothing stand still that moves here.
struct Rigid {
  explicit Rigid(const SceneSource& scene)
      : tree(kSceneRoot, scene.nodes), target(tree.need(scene.target)), sensor(tree.need(scene.sensor)) {}

  bool knows_axes(const RelativeSource& relative) const {
    return relative.axes.empty() || tree.are_rigid(tree.need(relative.axes), sensor);
  }
  bool knows(const RelativeSource& relative) const {
    return tree.are_rigid(tree.need(relative.of), target) && tree.are_rigid(tree.need(relative.in), sensor) && knows_axes(relative);
  }
  // In the origin of `in`, with the axes of `axes`.
  NamedFrame frame(const RelativeSource& relative) const {
    const std::size_t in = tree.need(relative.in);
    NamedFrame frame{tree.state(tree.need(relative.of), target, 0).T_a_b, tree.state(sensor, in, 0).T_a_b};
    if (!relative.axes.empty()) {
      Pose turn = tree.state(in, tree.need(relative.axes), 0).T_a_b;
      turn.p = Vec3::Zero();
      frame.T_in_sensor = turn * frame.T_in_sensor;
    }
    return frame;
  }

  scene::Tree tree;
  std::size_t target, sensor;
};

bool says_whose(const SceneSource& scene) { return !scene.target.empty() && !scene.sensor.empty() && !scene.relative.empty(); }

}  // namespace

std::vector<NamedPair> named_pairs(const SceneSource& scene) {
  std::vector<NamedPair> pairs;
  if (!says_whose(scene)) return pairs;
  const Rigid rigid(scene);
  for (const RelativeSource& relative : scene.relative) {
    if (relative.telemetry && rigid.knows(relative)) pairs.push_back({relative.name, rigid.frame(relative)});
  }
  return pairs;
}

void check_named_pairs(const MissionSource& source, ProblemList& problems) {
  if (!says_whose(source.scene)) return;
  const Rigid rigid(source.scene);
  for (const RelativeSource& relative : source.scene.relative) {
    const std::string key = "relative." + relative.name + ".telemetry";
    const auto place = source.origins.find(key);
    if (place != source.origins.end() && !place->second.preset() && relative.telemetry && !rigid.knows_axes(relative))
      problems.add(place->second, key, "true",
                   "the component does not know how " + relative.axes + " turns against the sensors: leave telemetry out, or axes");
  }
  const std::vector<NamedPair> pairs = named_pairs(source.scene);
  for (std::size_t i = kMaxNamedFrames; i < pairs.size(); ++i) {
    const std::string key = "relative." + pairs[i].name;
    problems.add(
        source.origins.at(key + ".of"), key, "",
        "a flight image has room for " + std::to_string(kMaxNamedFrames) + " pairs of frames: telemetry = false leaves it to the ground");
  }
}

}  // namespace lasso::mdat
