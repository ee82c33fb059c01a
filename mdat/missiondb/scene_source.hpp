// The scene that a mission declares: nodes in a tree, how they move, and what stands at them; and what a scenario makes of it.
//
// The root of the tree is the node `root`: at rest, or, of a mission with [orbit], the Hill frame (mdat/scene/orbit.hpp), in which there is
// then also `lvlh`. The target's node has the target's frame, the sensor's node the frame of all sensors.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "fsw/geometry/portable_math.hpp"
#include "hal_sim/laser_reflection.hpp"
#include "hal_sim/scatter_volume.hpp"
#include "mdat/modelc/mesh.hpp"
#include "mdat/scene/orbit.hpp"
#include "mdat/scene/tree.hpp"

namespace lasso::mdat {

constexpr char kSceneRoot[] = "root", kSceneLvlh[] = "lvlh";

// What a node other than the target's looks like. Its file's axes, or the target's where it is a part of that, are the node's.
struct BodySource {
  std::string node;
  std::string key;                 // that says it, node.NAME.model, .mesh, .points or .parts
  std::filesystem::path file;      // resolved; empty: parts of the target
  bool parametric = false;         // file is a model (TOML), not a mesh
  double scale = 1;                // applied to the file's lengths to get metres
  double disc_radius_m = 0;        // of the points of a cloud; 0: the file is a surface
  std::vector<std::string> parts;  // names of the target's parts, or their beginnings with * at the end
};

// A cloud that stands at a node.
struct VolumeSource {
  std::string node;
  std::shared_ptr<const sim::ScatterVolume> volume;
};

// A lamp that shines along the z axis of its node.
struct LampSource {
  std::string node;
  double intensity_Wpsr = 0;    // between 400 and 900 nm, even within its cone
  double half_angle_rad = kPi;  // of the cone; pi: to all sides
};

// A camera for pictures: z of its node ahead, x right, y down.
struct CameraSource {
  std::string node;
  double fov_half_x_rad = 0, fov_half_y_rad = 0;
};

// A surface with the names of its parts.
struct BodySurface {
  Mesh mesh;
  std::vector<std::string> part_names;          // each once
  std::vector<std::uint32_t> part_of_triangle;  // index into part_names, for each triangle
  std::vector<sim::LaserReflection> laser;      // of each triangle; none: no sensor sees light
};

// Filled by load_scene: what all scenarios of a mission have in common.
struct SceneSurfaces {
  std::vector<BodySurface> bodies;  // of SceneSource::bodies
  std::vector<bool> moved;          // triangles of the target's mesh that are another node's; empty: none
};

// A value of a node, a motion or the orbit as the file says it.
struct WrittenValue {
  std::string key, value, unit, meaning;
};

// A pose that results are also said of: of one node in another, in the axes of a third one (empty: of the second).
struct RelativeSource {
  std::string name, of, in, axes;
  bool telemetry = true;  // the component is to tell it, too, if it knows the axes (mdat/missiondb/named_pairs.hpp)
};
struct RelativePair {
  std::string name;
  std::size_t of, in;                              // nodes: `of` does not move against the target, `in` not against the sensor
  std::optional<std::size_t> axes = std::nullopt;  // node that has the axes, and may turn against both; none: in
};

struct SceneSource {
  std::optional<scene::Orbit> orbit;
  std::map<std::string, scene::MotionPtr> motions;
  std::set<std::string> used_motions;
  std::set<std::string> in_hill;       // of these, those whose first axes are the Hill frame's
  std::set<std::string> free_tumbles;  // and those that are torque-free by themselves, in axes that do not turn
  std::vector<scene::Node> nodes;      // with their motions; the root is not among them
  std::vector<BodySource> bodies;
  std::vector<VolumeSource> volumes;
  std::vector<LampSource> lamps;
  std::vector<CameraSource> cameras;
  std::string target, sensor;  // nodes; empty: none is said to be
  std::vector<RelativeSource> relative;
  std::shared_ptr<SceneSurfaces> surfaces = std::make_shared<SceneSurfaces>();
  std::vector<WrittenValue> values;
};

// What a scenario flies. Times are in microseconds since frame 0.
struct SceneRun {
  scene::Tree tree;
  std::size_t target, sensor;           // nodes
  std::vector<std::size_t> body_nodes;  // of SceneSource::bodies
  std::shared_ptr<const SceneSurfaces> surfaces;
  double rate_radps = 0;         // greatest of the target's in the sensor's axes, at the times below
  double acceleration_mps2 = 0;  // greatest of its origin there
  std::vector<double> times_s, ranges_m;
  std::vector<RelativePair> relative;
  std::optional<scene::Orbit> orbit = std::nullopt;
  std::vector<std::pair<std::size_t, std::shared_ptr<const sim::ScatterVolume>>> volumes = {};  // with their nodes

  scene::MotionState target_at(TimeUs t_us) const { return tree.state(target, sensor, t_us); }
};

}  // namespace lasso::mdat
