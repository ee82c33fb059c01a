// Rules of scenarios that fly a scene. They look at the times of SceneRun::times_s: what happens between two of them only is not seen.
#include <algorithm>
#include <cmath>

#include "mdat/missiondb/rule.hpp"
#include "mdat/missiondb/seen.hpp"

namespace lasso::mdat {
namespace {

using PoseFault = std::string (*)(const Subject&, const Eigen::Isometry3d& T_sensor_target);

// Of the first time at which there is one, with that time.
std::string first_fault(const Subject& s, PoseFault fault) {
  if (s.scenario->scene == nullptr) return "";
  for (const double t_s : s.scenario->scene->times_s) {
    const Pose pose = s.scenario->scene->target_at(static_cast<TimeUs>(std::llround(1e6 * t_s))).T_a_b;
    const std::string found = fault(s, Eigen::Translation3d(pose.p) * Eigen::Isometry3d(pose.q));
    if (!found.empty()) return "at " + figure(t_s) + " s " + found;
  }
  return "";
}

std::string scene_inside_fault(const Subject& s) {
  return first_fault(s, [](const Subject& of, const Eigen::Isometry3d& T_sensor_target) -> std::string {
    const Eigen::Vector3d sensor_m = T_sensor_target.inverse().translation();
    const bool inside = (sensor_m - of.target->low).minCoeff() > 0 && (of.target->high - sensor_m).minCoeff() > 0;
    return inside ? "the sensor would be in the target, whose scale is " + figure(of.source.target.scale) : "";
  });
}

std::string scene_behind_fault(const Subject& s) {
  const std::string fault = first_fault(s, [](const Subject& of, const Eigen::Isometry3d& T_sensor_target) -> std::string {
    return (T_sensor_target * of.target->middle()).z() > 0 ? "" : "the target's middle is behind the sensor";
  });
  // A run may end so; a start there is refused.
  if (fault.rfind("at 0 s ", 0) != 0) return "";
  return fault + ", whose boresight is its z axis: towards = \"" + s.source.scene.target + "\" turns a node to it";
}

std::string scene_lost_fault(const Subject& s) {
  return first_fault(s, [](const Subject& of, const Eigen::Isometry3d& T_sensor_target) -> std::string {
    const Seen seen = seen_of(*of.target, T_sensor_target);
    const double z_m = (T_sensor_target * of.target->middle()).z();
    const std::vector<SensorInUse> sensors = sensors_in_use(of.source, of.p, of.scenario);
    const bool measured = std::any_of(sensors.begin(), sensors.end(), [&](const SensorInUse& sensor) {
      return z_m > sensor.p.range_min_m && z_m < sensor.p.range_max_m && !is_off(seen, sensor.p);
    });
    return measured ? "" : "the target's middle is out of the field, or of what is measured";
  });
}

std::string scene_haste_fault(const Subject& s) {
  if (s.scenario->scene == nullptr || s.scenario->scene->acceleration_mps2 <= kAccelerations * s.p.acceleration_mps2) return "";
  return "the target's acceleration reaches " + figure(s.scenario->scene->acceleration_mps2) + " m/s2, and filter.acceleration_mps2 is " +
         figure(s.p.acceleration_mps2);
}

}  // namespace

const Rules& scene_rules() {
  using enum Severity;
  using enum Scope;
  using enum Needs;
  // clang-format off
  static const Rules rules = {
    {kError, kScenario, kTarget, {"offset_m"}, scene_inside_fault},
    {kError, kScenario, kTarget, {"offset_m"}, scene_behind_fault},
    {kWarning, kScenario, kTarget, {"offset_m"}, scene_lost_fault},
    {kWarning, kScenario, kValues, {"times_s", "filter.acceleration_mps2"}, scene_haste_fault},
  };
  // clang-format on
  return rules;
}

}  // namespace lasso::mdat
