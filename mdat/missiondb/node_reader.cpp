#include "mdat/missiondb/node_reader.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "mdat/missiondb/optics_reader.hpp"
#include "mdat/missiondb/volume_reader.hpp"
#include "mdat/source/nearest.hpp"

namespace lasso::mdat {
namespace {

using enum ValueKind;

constexpr std::size_t kMostParts = 64;
constexpr std::size_t kLooks = 240;  // at a run's motion, for what checks ask; results are of all frames

ValueRow flag_row(const char* key, const char* meaning, double preset = 0) {
  return number_row(key, "1", kBoolean, 1, 0, 1, preset, meaning);
}

ValueRow parts_row() {
  ValueRow row =
      text_row("parts", "[^\\x00-\\x1f]+",
               "parts of the target that this node is, by their names, or beginnings with * at the end; the target then is without them");
  row.count_max = kMostParts;
  return row;
}

// What a motion needs of the axes in which it moves a node.
void check_axes(const std::string& motion, const scene::Node& node, const std::string& key, MissionSource& source, ProblemList& problems) {
  source.scene.used_motions.insert(motion);
  const bool in_root = node.parent == kSceneRoot && node.T_parent_base.q.isApprox(Quat::Identity(), 1e-9);
  if (source.scene.in_hill.count(motion) != 0 && !in_root)
    problems.add(source.origins.at(key), key, '"' + motion + '"',
                 "is a motion in the Hill frame's axes: the node has to stand in root, not turned");
  if (source.scene.free_tumbles.count(motion) != 0 && source.scene.orbit && node.parent == kSceneRoot)
    source.warnings.push_back(to_string(
        problem_at(source, key, '"' + motion + '"',
                   "is torque-free in axes that do not turn, and the Hill frame does: a chain of an inertial motion and this one is")));
}

// One [node.NAME].
class NodeReader {
 public:
  NodeReader(const std::string& name, const toml::table& table, MissionSource& source, ProblemList& problems)
      : source_(source), problems_(problems), values_(table, "node." + name, node_rows(), {}, source, problems) {
    node_.name = name;
    node_.place = values_.place();
  }

  void read() {
    node_.parent = values_.is_written("parent") ? values_.text("parent") : kSceneRoot;
    node_.T_parent_base = values_.pose();
    node_.towards = values_.text("towards");
    node_.pointing = {values_.axis("axis"), values_.axis("up"), values_.axis("up_reference")};
    read_motion();
    read_body();
    if (values_.is_any_written("scatter.")) read_volume(values_, node_.name, source_);
    read_optics(values_, node_.name, source_);
    claim("target", source_.scene.target);
    claim("sensor", source_.scene.sensor);
    source_.scene.nodes.push_back(node_);
  }

 private:
  void read_motion() {
    const std::string motion = values_.text("motion");
    if (motion.empty()) return;
    const auto known = source_.scene.motions.find(motion);
    if (known != source_.scene.motions.end()) {
      node_.motion = known->second;
      return check_axes(motion, node_, "node." + node_.name + ".motion", source_, problems_);
    }
    std::vector<std::string> names;
    for (const auto& entry : source_.scene.motions) names.push_back(entry.first);
    values_.complain("motion", '"' + motion + '"', "the mission has no [motion." + motion + "]" + did_you_mean(motion, names));
  }

  void read_body() {
    std::string key;
    for (const char* candidate : {"model", "mesh", "points", "parts"}) {
      if (!values_.is_written(candidate)) continue;
      if (!key.empty()) values_.complain(candidate, "", "expected at most one of model, mesh, points and parts");
      key = candidate;
    }
    if (values_.number("target") != 0 && !key.empty())
      values_.complain(key, "", "the target's node looks as [target] says: leave it out, or give it a node of its own");
    if (key != "points" && values_.is_written("disc_radius_m")) values_.complain("disc_radius_m", "", "has no effect without points");
    if (key.empty()) {
      if (values_.is_written("scale")) values_.complain("scale", "", "has no effect without model, mesh or points");
      return;
    }
    BodySource body;
    body.node = node_.name;
    body.key = "node." + node_.name + "." + key;
    body.parametric = key == "model";
    if (key == "points") body.disc_radius_m = values_.number("disc_radius_m");
    body.scale = values_.number("scale");
    body.parts = values_.texts("parts");
    if (key != "parts") body.file = values_.file(key);
    source_.scene.bodies.push_back(std::move(body));
  }

  void claim(const std::string& key, std::string& holder) {
    if (values_.number(key) == 0) return;
    if (!holder.empty()) values_.complain(key, "true", "node " + holder + " is the " + key + " already: there is one");
    holder = node_.name;
  }

  MissionSource& source_;
  ProblemList& problems_;
  SceneValues values_;
  scene::Node node_;
};

std::vector<std::string> node_names(const SceneSource& scene) {
  std::vector<std::string> names;
  for (const scene::Node& node : scene.nodes) names.push_back(node.name);
  return names;
}

// Those that are the target, the sensors or a body, or that others of these stand in or point to, or that results are said of.
std::set<std::string> used_nodes(const MissionSource& source) {
  const SceneSource& scene = source.scene;
  std::set<std::string> used{scene.target, scene.sensor, kSceneLvlh};
  for (const FurtherSensor& sensor : source.further_sensors) used.insert(sensor.node);
  for (const BodySource& body : scene.bodies) used.insert(body.node);
  for (const VolumeSource& volume : scene.volumes) used.insert(volume.node);
  for (const LampSource& lamp : scene.lamps) used.insert(lamp.node);
  for (const CameraSource& camera : scene.cameras) used.insert(camera.node);
  for (const RelativeSource& relative : scene.relative) used.insert({relative.of, relative.in, relative.axes});
  for (std::size_t before = 0; before != used.size();) {
    before = used.size();
    for (const scene::Node& node : scene.nodes) {
      if (used.count(node.name) != 0) used.insert({node.parent, node.towards});
    }
  }
  return used;
}

// What the tree has besides the mission's nodes.
void add_lvlh(SceneSource& scene, ProblemList& problems) {
  if (!scene.orbit) return;
  for (const scene::Node& node : scene.nodes) {
    if (node.name == kSceneLvlh)
      return problems.add(origin_of(node.place), "node.lvlh", "", "is the orbit's frame of docking: give the node another name");
  }
  scene::Node node;
  node.name = kSceneLvlh;
  node.parent = kSceneRoot;
  node.T_parent_base.q = scene::q_hill_lvlh();
  scene.nodes.push_back(node);
}

// The tree says "NODE, WHAT".
Problem of_node(const Problem& problem, const MissionSource& source) {
  const std::size_t end = std::min(problem.key.rfind(", "), problem.key.size());
  return at_key(problem, "node." + problem.key.substr(0, end), problem.key.substr(std::min(end + 2, problem.key.size())), source);
}

// At evenly spread frames of the run.
void look_at_motion(double frames, double period_s, SceneRun& run) {
  const double end_s = (frames - 1) * period_s;
  const auto looks = static_cast<std::size_t>(std::min<double>(frames, kLooks));
  const auto step_us = static_cast<TimeUs>(std::llround(1e6 * period_s));
  const auto t_us = [&](std::size_t i) {
    return looks < 2 ? TimeUs{0} : static_cast<TimeUs>(std::llround(1e6 * end_s * static_cast<double>(i) / static_cast<double>(looks - 1)));
  };
  constexpr DurationUs kStepUs = 1000;
  for (std::size_t i = 0; i < looks; ++i) {
    const scene::MotionState now = run.target_at(t_us(i)), next = run.target_at(t_us(i) + kStepUs);
    run.times_s.push_back(1e-6 * static_cast<double>(t_us(i)));
    run.ranges_m.push_back(now.T_a_b.p.norm());
    const Quat after = run.target_at(t_us(i) + step_us).T_a_b.q;  // of steps the rate is zero
    run.rate_radps = std::max({run.rate_radps, now.rates.omega_radps.norm(), after.angularDistance(now.T_a_b.q) / period_s});
    run.acceleration_mps2 = std::max(run.acceleration_mps2, (next.rates.v_mps - now.rates.v_mps).norm() / (1e-6 * kStepUs));
  }
}

// Those that stand at nodes of their own, with the motions of this scenario.
void check_sensors_fixed(const MissionSource& source, const std::string& scenario, const SceneRun& run, ProblemList& problems) {
  for (const FurtherSensor& sensor : source.further_sensors) {
    const std::string key = "further_sensor." + sensor.name + ".node";
    if (!sensor.T_sensor_own || run.tree.are_rigid(run.tree.need(sensor.node), run.sensor)) continue;
    problems.add(source.origins.at(key), key, '"' + sensor.node + '"',
                 "moves against " + source.scene.sensor + " in scenario " + scenario + ": all sensors stand still against each other");
  }
}

// The component knows one pose, of the target before the sensors: what moves against either, it knows nothing of.
void pair_frames(const MissionSource& source, const std::string& scenario, SceneRun& run, ProblemList& problems) {
  const SceneSource& scene = source.scene;
  const auto refuse = [&](const std::string& key, const std::string& node, const std::string& why) {
    problems.add(source.origins.at(key), key, '"' + node + '"', why);
  };
  for (const RelativeSource& relative : scene.relative) {
    RelativePair pair{relative.name, run.tree.need(relative.of), run.tree.need(relative.in)};
    const std::string path = "relative." + relative.name;
    if (!run.tree.are_rigid(pair.of, run.target))
      refuse(path + ".of", relative.of,
             "moves against the target in scenario " + scenario + ": name a node that stands on " + scene.target);
    if (!run.tree.are_rigid(pair.in, run.sensor))
      refuse(path + ".in", relative.in,
             "moves against the sensor in scenario " + scenario + ": name a node that stands on what carries " + scene.sensor);
    if (!relative.axes.empty()) pair.axes = run.tree.need(relative.axes);
    if (pair.axes && run.tree.are_rigid(*pair.axes, run.target))
      refuse(path + ".axes", relative.axes,
             "stands on the target, whose attitude is what is measured: name a node that does not, such as lvlh");
    run.relative.push_back(pair);
  }
}

}  // namespace

const std::vector<ValueRow>& node_rows() {
  static const std::vector<ValueRow> rows = with_optics_rows(with_volume_rows({
      text_row("parent", "[^\\x00-\\x1f]+", "node in which it stands; root where not given, which with [orbit] is the Hill frame"),
      position_row("where it stands in the parent; its motion begins there"),
      quaternion_row("how it stands there: x, y, z, w, takes its axes to the parent's"),
      text_row("motion", "[^\\x00-\\x1f]+", "a [motion.NAME] by which it moves there; none: it rests"),
      text_row("towards", "[^\\x00-\\x1f]+", "node to which its axis points, in place of the motion's attitude"),
      axis_row("axis", Vec3::UnitZ(), "towards: the axis that points"),
      axis_row("up", -Vec3::UnitY(), "towards: axis that is turned as near to up_reference as can be"),
      axis_row("up_reference", Vec3::UnitZ(), "towards: roll reference, in the axes that it stands in"),
      flag_row("target", "the tracked target: poses are of this node's frame; it looks as [target] says"),
      flag_row("sensor", "the sensors' frame: z is the boresight, x right, y down"),
      text_row("model", "[^\\x00-\\x1f]+\\.toml", "what it looks like: a parametric model with its presets"),
      text_row("mesh", "[^\\x00-\\x1f]+", "what it looks like: a mesh (STL, OBJ, PLY, glTF)"),
      text_row("points", "[^\\x00-\\x1f]+\\.ply",
               "what it looks like: a cloud of points (PLY), each a small disc across its normal, or a grain where the file has none"),
      number_row("disc_radius_m", "m", kReal, 1, 1e-6, 10, 0.005, "radius of these discs"),
      number_row("scale", "1", kReal, 1, 1e-9, 1e9, 1, "that file's lengths times this are metres"),
      parts_row(),
  }));
  return rows;
}

void read_nodes(const toml::table& root, MissionSource& source, ProblemList& problems) {
  for_each_table(root, "node", problems,
                 [&](const std::string& name, const toml::table& table) { NodeReader(name, table, source, problems).read(); });
  add_lvlh(source.scene, problems);
  try {
    static_cast<void>(scene::Tree(kSceneRoot, source.scene.nodes));
  } catch (const MissionError& error) {
    std::vector<Problem> told;
    for (const Problem& problem : error.problems()) told.push_back(of_node(problem, source));
    problems.add(MissionError(told));
  }
}

const std::vector<ValueRow>& relative_rows() {
  static const std::vector<ValueRow> rows = {
      required(text_row("of", "[^\\x00-\\x1f]+", "node that stands on the target: what the pose is of")),
      required(text_row("in", "[^\\x00-\\x1f]+", "node that stands on what carries the sensor: whose axes the pose is in")),
      text_row("axes", "[^\\x00-\\x1f]+",
               "node whose axes it is said in instead, such as lvlh: how they turn against the sensors is taken as known"),
      flag_row("telemetry", "the component reports it in telemetry, too, if the axes stand still against the sensors", 1),
  };
  return rows;
}

void read_relative(const toml::table& root, MissionSource& source, ProblemList& problems) {
  std::vector<std::string> names = node_names(source.scene);
  names.emplace_back(kSceneRoot);
  for_each_table(root, "relative", problems, [&](const std::string& name, const toml::table& table) {
    SceneValues values(table, "relative." + name, relative_rows(), {}, source, problems);
    if (name.find_first_of(",\"\n\r;") != std::string::npos)
      values.complain("", "", "expected a name without commas, semicolons and quotes: it stands in a table");
    for (const char* key : {"of", "in", "axes"}) {
      const std::string written = values.text(key);
      if (!written.empty() && std::find(names.begin(), names.end(), written) == names.end())
        values.complain(key, '"' + written + '"', "the mission has no [node." + written + "]" + did_you_mean(written, names));
    }
    source.scene.relative.push_back({name, values.text("of"), values.text("in"), values.text("axes"), values.number("telemetry") != 0});
  });
}

ChosenMotions read_chosen_motions(const toml::table& scenario, const std::string& prefix, MissionSource& source, ProblemList& problems) {
  ChosenMotions chosen;
  const toml::node* node = scenario.get("motion");
  if (node == nullptr) return chosen;
  if (!node->is_table()) {
    problems.add(*node, prefix + "motion", "wrong type: expected a table of motions by node, such as motion = {target = \"NAME\"}");
    return chosen;
  }
  const std::vector<std::string> names = node_names(source.scene);
  for (const auto& [name, value] : *node->as_table()) {
    const std::string key(name.str()), path = prefix + "motion." + key, motion = value.value_or(std::string());
    if (std::find(names.begin(), names.end(), key) == names.end()) {
      problems.add(value, path, "the mission has no [node." + key + "]" + did_you_mean(key, names));
    } else if (source.scene.motions.count(motion) == 0) {
      problems.add(value, path, "expected the name of a [motion.NAME] of the mission");
    } else {
      chosen[key] = motion;
      source.origins[path] = origin_of(value.source());
      for (const scene::Node& of : source.scene.nodes) {
        if (of.name == key) check_axes(motion, of, path, source, problems);
      }
      source.scene.values.push_back({path, '"' + motion + '"', "", "how the node moves in this scenario"});
    }
  }
  return chosen;
}

void warn_of_idle(MissionSource& source) {
  const SceneSource& scene = source.scene;
  const auto warn = [&](const std::string& key, const std::string& what) {
    source.warnings.push_back(to_string(problem_at(source, key, "", what)));
  };
  for (const auto& [name, motion] : scene.motions) {
    if (scene.used_motions.count(name) == 0) warn("motion." + name + ".kind", "no node has this motion: it changes nothing");
  }
  const std::set<std::string> used = used_nodes(source);
  for (const scene::Node& node : scene.nodes) {
    if (used.count(node.name) == 0)
      warn("node." + node.name + ".parent",
           "nothing stands at this node, or asks for it: it changes nothing" + did_you_mean(node.name, {used.begin(), used.end()}));
  }
}

void make_scene_run(const ChosenMotions& chosen, const std::string& name, Origin origin, double period_s, const MissionSource& source,
                    Scenario& scenario, ProblemList& problems) {
  const SceneSource& scene = source.scene;
  for (const auto& [key, node] : {std::pair{"target", scene.target}, std::pair{"sensor", scene.sensor}}) {
    if (node.empty())
      problems.add(origin, "scenario." + name, "",
                   std::string("no node of the mission has ") + key + " = true: add it to a [node.NAME]; or write ranges_m");
  }
  if (scene.target.empty() || scene.sensor.empty()) return;
  std::vector<scene::Node> nodes = scene.nodes;
  for (scene::Node& node : nodes) {
    const auto motion = chosen.find(node.name);
    if (motion != chosen.end()) node.motion = scene.motions.at(motion->second);
  }
  const auto run =
      std::make_shared<SceneRun>(SceneRun{scene::Tree(kSceneRoot, nodes), 0, 0, {}, scene.surfaces, 0, 0, {}, {}, {}, scene.orbit, {}});
  run->target = run->tree.need(scene.target);
  run->sensor = run->tree.need(scene.sensor);
  for (const BodySource& body : scene.bodies) run->body_nodes.push_back(run->tree.need(body.node));
  for (const VolumeSource& volume : scene.volumes) run->volumes.emplace_back(run->tree.need(volume.node), volume.volume);
  check_sensors_fixed(source, name, *run, problems);
  pair_frames(source, name, *run, problems);
  look_at_motion(scenario.frames, period_s, *run);
  scenario.times_s = run->times_s;
  scenario.ranges_m = run->ranges_m;
  scenario.scene = run;
}

}  // namespace lasso::mdat
