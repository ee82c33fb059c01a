#include "mdat/serve/scan_preview.hpp"

#include <algorithm>
#include <memory>

#include "fsw/geometry/so3.hpp"
#include "fsw/sense/pattern.hpp"
#include "fsw/sense/planner.hpp"
#include "hal_sim/ray_caster.hpp"
#include "mdat/modelc/hull.hpp"
#include "mdat/run/mounted_sensor.hpp"
#include "mdat/run/simulated_scenario.hpp"
#include "mdat/run/simulation.hpp"
#include "mdat/run/true_target.hpp"
#include "mdat/source/mission_error.hpp"

namespace lasso::mdat::serve {
namespace {

// What the planner gets of a mesh: the compiler's hull of it, and the middle of its box.
struct MeshOutline {
  explicit MeshOutline(const Mesh& mesh) {
    Eigen::Vector3d low = mesh.vertices.front(), high = low;
    for (const Eigen::Vector3d& v : mesh.vertices) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
      radius_m = std::max(radius_m, v.norm());
    }
    center_m = (low + high) / 2;
    for (const Eigen::Vector3d& p : extreme_points(mesh.vertices, (high - low).maxCoeff(), kMaxHullPoints)) {
      HullPoint point{};
      for (int i = 0; i < 3; ++i) point.p[i] = static_cast<FlightNumber::Length>(p[i]);
      hull.push_back(point);
    }
  }
  TargetOutline outline() const { return {Span<const HullPoint>(hull.data(), hull.size()), center_m, 0}; }

  std::vector<HullPoint> hull;
  Vec3 center_m = Vec3::Zero();
  double radius_m = 0;
};

// The sensor whose turn it is where the target's origin is so far away: the first of them.
void choose_sensor(const MissionSource& source, ScanPreview& preview) {
  const double range_m = preview.T_sensor_target.p.norm();
  const auto turn = [&](const SensorParameters& s) { return range_m >= s.use_from_m && range_m <= s.use_to_m; };
  preview.sensor = sensor_names(source).front();
  if (turn(preview.parameters)) return;
  for (const FurtherSensor& sensor : source.further_sensors) {
    if (!turn(sensor.parameters)) continue;
    static_cast<SensorParameters&>(preview.parameters) = sensor.parameters;
    preview.sensor = sensor.name;
    if (sensor.T_sensor_own) preview.T_sensor_own = *sensor.T_sensor_own;
    return;
  }
}

SensorKind kind_of(const MissionSource& source, const std::string& sensor) {
  for (const FurtherSensor& further : source.further_sensors) {
    if (further.name == sensor) return further.kind;
  }
  return source.sensor;
}

// The target is at rest while the scan lasts. `T_own_target` is of the sensor that scans.
std::vector<PreviewRay> cast_rays(const ScanPlan& plan, const Pose& T_own_target, const sim::RayCaster& target) {
  const Pose T_target_own = inverse(T_own_target);
  const double miss_range_m = T_own_target.p.norm();
  std::vector<PreviewRay> rays;
  for (PatternGenerator pattern(plan); !pattern.done();) {
    const double time_s = 1e-6 * static_cast<double>(pattern_time_us(plan, pattern.index()));
    const Vec3 direction = pattern.next();
    const sim::RayHit hit = target.cast(T_target_own.p, rotate(T_target_own.q, direction));
    rays.push_back({(hit.hit ? hit.range_m : miss_range_m) * direction, time_s, hit.hit});
  }
  return rays;
}

// In the axes of the sensor that scans. One that stands aside looks past the target unless a scan before has told how far away it is.
Status plan_of(const ScanPreview& preview, const TargetOutline& outline, ScanPlan& plan) {
  ScanPlan commanded;
  const Status status = plan_scan(preview.parameters, outline, preview.T_sensor_target, 0, commanded);
  if (status != Status::kOk) return status;
  const SensorMounting mounting{preview.T_sensor_own, preview.parameters.fov_half_x_rad, preview.parameters.fov_half_y_rad};
  std::optional<double> depth_m;
  if (mounting.is_aside()) depth_m = preview.T_sensor_target.p.z();
  return plan_from(mounting, depth_m, commanded, plan);
}

std::string remark_on(SensorKind kind, const ScanPreview& preview) {
  const double range_m = preview.T_sensor_target.p.norm();
  if (range_m < preview.parameters.range_min_m || range_m > preview.parameters.range_max_m)
    return "the target's origin is beyond the ranges that the sensor measures";
  if (kind == SensorKind::kFlashLidar || kind == SensorKind::kStereo)
    return "this sensor takes whole pictures: the rays are those of the pattern, of which it keeps as many pixels, spread evenly";
  if (preview.parameters.aimed_share > 0) return "rays that are aimed at contours are drawn where the pattern would have them";
  return "";
}

}  // namespace

ScanPreview preview_scan(const MissionSource& source, const Mesh& target, const std::string& scenario, std::size_t run) {
  const auto found = source.scenarios.find(scenario);
  if (found == source.scenarios.end()) throw MissionError({"", 0, 0, "scenario", scenario, "there is none of this name"});
  ScanPreview preview;
  preview.scenario = scenario;
  preview.ranges_m = found->second.runs_m();
  preview.run = std::min(run, preview.ranges_m.size() - 1);
  const CaseSetup setup = plain_case(source, found->second, static_cast<std::uint64_t>(found->second.seed), 1, preview.run);
  preview.parameters = setup.parameters;
  const DurationUs period = period_us(preview.parameters);
  preview.T_sensor_target = make_trajectory(setup.scenario, setup.range_m, kEpochUs, period)->at(kEpochUs).T_sensor_target;
  choose_sensor(source, preview);
  const MeshOutline outline(target);
  preview.size_m = 2 * outline.radius_m;
  ScanPlan plan;
  const Status status = plan_of(preview, outline.outline(), plan);
  if (status != Status::kOk) {
    preview.remark = "no scan is planned: the target is outside the field of view, or the pattern's counts do not fit its points";
    return preview;
  }
  preview.rays = cast_rays(plan, inverse(preview.T_sensor_own) * preview.T_sensor_target, *make_target(target));
  preview.remark = remark_on(kind_of(source, preview.sensor), preview);
  return preview;
}

}  // namespace lasso::mdat::serve
