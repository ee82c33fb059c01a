#include "mdat/run/ranged_scene.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "fsw/geometry/so3.hpp"
#include "hal_sim/trajectory.hpp"
#include "mdat/scene/way.hpp"

namespace lasso::mdat {
namespace {

// Of frame 0, with the origin at the target's center_m.
Pose first_pose_of(const Scenario& scenario, double range_m) {
  Pose start;
  start.q = sim::upright_attitude(scenario.tilt_rad, scenario.boresight_rad);
  if (scenario.roll_rad != 0) start.q = normalized(start.q * exp_so3(scenario.roll_rad * Vec3::UnitX()));
  start.p = Vec3(scenario.offset_m.at(0), scenario.offset_m.at(1), range_m);
  return start;
}

// About center_m, a step a frame.
scene::MotionPtr stepped(const Scenario& scenario, const Pose& start, DurationUs period_us) {
  const auto steps = std::make_shared<scene::Steps>(scene::Steps::Setup{start, Vec3::UnitX(), scenario.step_rad, period_us});
  const Vec3 center_m(scenario.center_m.data());
  if (center_m.isZero(0)) return steps;
  return std::make_shared<scene::Chain>(steps, std::make_shared<scene::Still>(Pose{Quat::Identity(), -center_m}));
}

// Of center_m, through all ranges.
scene::MotionPtr way_of(const Scenario& scenario) {
  scene::MotionTable table;
  table.times_s = scenario.times_s;
  for (const double range_m : scenario.ranges_m) table.positions_m.emplace_back(scenario.offset_m.at(0), scenario.offset_m.at(1), range_m);
  return std::make_shared<scene::Way>(table);
}

// The target alone, in the root, before a sensor that is the root, or rests in it.
std::shared_ptr<const SceneRun> alone_before(const std::optional<Pose>& T_root_sensor, scene::MotionPtr motion) {
  std::vector<scene::Node> nodes(1);
  nodes[0].name = "target";
  nodes[0].motion = std::move(motion);
  if (T_root_sensor) {
    nodes.emplace_back();
    nodes[1].name = "sensor";
    nodes[1].T_parent_base = *T_root_sensor;
  }
  for (scene::Node& node : nodes) node.parent = kSceneRoot;
  const std::size_t sensor = T_root_sensor ? 2 : 0;
  return std::make_shared<SceneRun>(
      SceneRun{scene::Tree(kSceneRoot, nodes), 1, sensor, {}, std::make_shared<SceneSurfaces>(), 0, 0, {}, {}, {}});
}

}  // namespace

scene::MotionPtr ranged_motion(const Scenario& scenario, double range_m, DurationUs period_us) {
  Pose start = first_pose_of(scenario, range_m);
  if (scenario.step_rad != 0) return stepped(scenario, start, period_us);  // a rule: then there are no rates
  const Twist rates{rotate(start.q, Vec3(scenario.spin_radps.data())), Vec3(scenario.drift_mps.data())};
  if (scenario.has_profile()) start.p = Vec3::Zero();
  const auto turn = std::make_shared<scene::ConstantRates>(scene::ConstantRates::Setup{start, rates, Vec3(scenario.center_m.data())});
  if (!scenario.has_profile()) return turn;
  return std::make_shared<scene::Sum>(way_of(scenario), turn);
}

std::shared_ptr<const SceneRun> scene_run(const Scenario& scenario, double range_m, DurationUs period_us) {
  if (scenario.scene != nullptr) return scenario.scene;
  return alone_before(std::nullopt, ranged_motion(scenario, range_m, period_us));
}

std::shared_ptr<const SceneRun> scene_run_from(const Scenario& scenario, double range_m, DurationUs period_us,
                                               const FurtherSensor& sensor) {
  if (scenario.scene == nullptr) return alone_before(sensor.T_sensor_own, ranged_motion(scenario, range_m, period_us));
  auto run = std::make_shared<SceneRun>(*scenario.scene);
  run->sensor = run->tree.need(sensor.node);
  return run;
}

}  // namespace lasso::mdat
