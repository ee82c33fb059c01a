#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/missiondb/rule.hpp"
#include "mdat/missiondb/seen.hpp"
#include "mdat/missiondb/value_row.hpp"
#include "mdat/modelc/compile_error.hpp"
#include "mdat/modelc/grid.hpp"
#include "mdat/modelc/model.hpp"

namespace lasso::mdat {
namespace {

constexpr double kBestCells = 110;  // along the target
constexpr double kMostCells = 450;  // 70 times as many in all
constexpr double kFewestCells = 12;
constexpr double kFootprintShare = 0.01;  // of half of the target's length
constexpr double kStartShare = 0.5;       // of the range
constexpr int kBisections = 40;
constexpr double kNarrowCone_rad = 5 * kRadPerDeg;
constexpr double kRadiansOfCrease = 1.6;  // a right angle

// Of frame 0, where the target's center_m is at range_m (mission_source.hpp: Scenario).
Eigen::Isometry3d first_pose(const Scenario& scenario, double range_m) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translate(Vector3d(scenario.offset_m.at(0), scenario.offset_m.at(1), range_m));
  T.rotate(AngleAxisd(scenario.boresight_rad, Vector3d::UnitZ()) * AngleAxisd(-scenario.tilt_rad, Vector3d::UnitX()) *
           AngleAxisd(-kPi / 2, Vector3d::UnitZ()) * AngleAxisd(scenario.roll_rad, Vector3d::UnitX()));
  return T * Eigen::Translation3d(-Vector3d(scenario.center_m.data()));
}

// The first range in a sensor's band at which that sensor has what `misses` asks, even where another one sees the target: in the
// overlap of their bands either may take the scans. Empty where there is none.
std::string misses_at(const Subject& s, bool (*misses)(const Seen&, const SensorParameters&), const std::string& what) {
  if (s.scenario->scene != nullptr) return "";  // scene_rules.cpp looks at its whole run
  const std::vector<SensorInUse> sensors = sensors_in_use(s.source, s.p, s.scenario);
  for (const SensorInUse& sensor : sensors) {
    const std::string whose = sensors.size() == 1 ? "" : " of " + sensor.prefix.substr(0, sensor.prefix.size() - 1);
    for (const double range_m : sensor.ranges_m) {
      const Seen seen = seen_of(*s.target, first_pose(*s.scenario, range_m));
      if (seen.in_front && misses(seen, sensor.p))
        return "at " + figure(range_m) + " m " + what + whose + ": " + sides_text(sensor.p, seen);
    }
  }
  return "";
}

std::string outside_fault(const Subject& s) {
  if (s.scenario->drawn != 0 && s.target->middle().norm() > s.target->half_m()) return "";
  return misses_at(s, is_outside, "the target is wholly outside of the field");
}

std::string off_fault(const Subject& s) {
  if (!outside_fault(s).empty() || s.scenario->drawn != 0) return "";
  return misses_at(s, is_off, "the target's middle is outside of the field");
}

// Does any sensor see the middle of a target that has drifted for so long?
bool is_measured(const Subject& s, double range_m, double t_s) {
  Eigen::Isometry3d T = first_pose(*s.scenario, range_m);
  T.pretranslate(t_s * Eigen::Vector3d(s.scenario->drift_mps.data()));
  const double z_m = (T * s.target->middle()).z();
  const std::vector<SensorInUse> sensors = sensors_in_use(s.source, s.p, s.scenario);
  return std::any_of(sensors.begin(), sensors.end(), [&](const SensorInUse& sensor) {
    return z_m > sensor.p.range_min_m && z_m < sensor.p.range_max_m && !is_off(seen_of(*s.target, T), sensor.p);
  });
}

// By bisection: what a sensor measures is convex. Afterwards the run is of an empty field.
std::string lost_fault(const Subject& s) {
  const Scenario& scenario = *s.scenario;
  if (scenario.has_profile() || scenario.drawn != 0) return "";
  for (const double range_m : scenario.ranges_m) {
    double seen_s = 0, lost_s = (scenario.frames - 1) * s.p.period_s;
    if (!is_measured(s, range_m, seen_s) || is_measured(s, range_m, lost_s)) continue;
    for (int i = 0; i < kBisections; ++i) {
      const double middle_s = 0.5 * (seen_s + lost_s);
      (is_measured(s, range_m, middle_s) ? seen_s : lost_s) = middle_s;
    }
    return "from " + figure(range_m) + " m the target drifts out of the field, or of what is measured, after " + figure(lost_s) +
           " s, in frame " + figure(std::ceil(lost_s / s.p.period_s)) + " of " + figure(scenario.frames);
  }
  return "";
}

// Is the attitude at the range known, which is that of frame 0?
bool has_first_attitude(const Scenario& scenario, double range_m) {
  const auto& spin = scenario.spin_radps;
  const bool turns = std::any_of(spin.begin(), spin.end(), [](double rate_radps) { return rate_radps != 0; });
  return scenario.drawn == 0 && (!scenario.has_profile() || !turns || range_m == scenario.ranges_m.front());
}

// Of an attitude that is not known: in any.
bool is_sensor_inside(const Subject& s, double range_m) {
  const TargetSize& box = *s.target;
  const Eigen::Isometry3d T_sensor_target = first_pose(*s.scenario, range_m);
  const Eigen::Vector3d sensor = T_sensor_target.inverse().translation(), center(s.scenario->center_m.data());
  if (has_first_attitude(*s.scenario, range_m)) return (sensor - box.low).minCoeff() > 0 && (box.high - sensor).minCoeff() > 0;
  return (sensor - center).norm() < std::min((center - box.low).minCoeff(), (box.high - center).minCoeff());
}

std::string inside_fault(const Subject& s) {
  if (s.scenario->scene != nullptr) return "";  // scene_rules.cpp
  for (const double range_m : s.scenario->ranges_m) {
    if (!is_sensor_inside(s, range_m)) continue;
    const Eigen::Vector3d size = s.target->high - s.target->low;
    return figure(range_m) + ": the sensor would be in the target, which is " + figure(size.x()) + " by " + figure(size.y()) + " by " +
           figure(size.z()) + " m; is target.scale right, which is " + figure(s.source.target.scale) + ", and the scenario's center_m?";
  }
  return "";
}

std::string footprint_fault(const Subject& s) {
  const double range_m = *std::max_element(s.scenario->ranges_m.begin(), s.scenario->ranges_m.end());
  const double radius_m = s.scenario->edge_mixing_m + (s.scenario->noise != 0 ? s.scenario->beam_divergence_rad * range_m : 0);
  if (radius_m <= kFootprintShare * s.target->half_m()) return "";
  return "the simulated beam has a radius of " + figure(1e3 * radius_m) + " mm at " + figure(range_m) +
         " m, and mixes the ranges of both sides of an edge on a target of " + figure(s.target->longest_m()) +
         " m: covariances are too small, or poses are not confirmed";
}

Surface box_surface(const TargetSize& target) {
  Surface surface;
  surface.low = target.low;
  surface.high = target.high;
  surface.extent = target.longest_m();
  return surface;
}

std::string grid_fault(const Subject& s) {
  const Surface surface = box_surface(*s.target);
  const double margin_m = ModelOptions{}.far_margin * surface.extent, cell_m = s.source.target.cell_size_m;
  try {
    make_grid(surface, margin_m, cell_m, LengthScale(image_reach_m(surface, margin_m, cell_m)));
  } catch (const CompileError& error) {
    return std::string(error.what()) + ", about " + figure(surface.extent / kBestCells) + " m";
  }
  return "";
}

std::string cells_fault(const Subject& s) {
  const double cells = s.target->longest_m() / s.source.target.cell_size_m;
  if (!grid_fault(s).empty() || (cells <= kMostCells && cells >= kFewestCells)) return "";
  return "the target of " + figure(s.target->longest_m()) + " m has " + figure(cells) + " cells along it, and is fastest with about " +
         figure(kBestCells) + ": " + figure(s.target->longest_m() / kBestCells) + " m; " +
         (cells < kFewestCells ? "rays pass through long lists of elements" : "the image and its compilation grow with the square");
}

Eigen::Isometry3d initial_pose(const MissionParameters& p) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translate(Eigen::Vector3d(p.initial_x_m, p.initial_y_m, p.initial_z_m));
  T.rotate(Eigen::Quaterniond(p.initial_qw, p.initial_qx, p.initial_qy, p.initial_qz).normalized());
  return T;
}

// Such a start is refused in flight, as out_of_reach.
std::string unreached_fault(const Subject& s) {
  if (s.p.initial_present < 0.5) return "";
  const double middle_m = (initial_pose(s.p) * s.target->middle()).norm();
  const double radius_m = 0.5 * (s.target->high - s.target->low).norm();
  for (const SensorInUse& sensor : sensors_in_use(s.source, s.p, nullptr)) {
    if (middle_m + radius_m >= sensor.p.range_min_m && middle_m - radius_m <= sensor.p.range_max_m) return "";
  }
  return "the target is wholly outside the ranges that the sensors measure, and the start will be refused: correct the pose, or "
         "sensor.range_min_m and sensor.range_max_m";
}

std::string unseen_start_fault(const Subject& s) {
  if (s.p.initial_present < 0.5) return "";
  const Seen seen = seen_of(*s.target, initial_pose(s.p));
  if (!seen.in_front) return "";
  for (const SensorInUse& sensor : sensors_in_use(s.source, s.p, nullptr)) {
    if (!is_off(seen, sensor.p)) return "";
  }
  return "the target of [tracking.initial] is outside of the field: " + sides_text(s.p, seen);
}

std::string start_sigma_fault(const Subject& s) {
  const double range_m = *std::min_element(s.scenario->ranges_m.begin(), s.scenario->ranges_m.end());
  if (s.p.start_sigma_m <= kStartShare * range_m) return "";
  return "is " + percent_text(s.p.start_sigma_m / range_m) + " of the range of " + figure(range_m) +
         " m: the first scans reach as much farther than the target, and miss it; in millimetres? " + figure(s.p.start_sigma_m) +
         " mm are " + figure(1e-3 * s.p.start_sigma_m) + " m";
}

double offset_m(const PartSource& part) { return std::hypot(part.origin_m[0], part.origin_m[1], part.origin_m[2]); }

std::string named(const Subject& s, bool (*is_it)(const Subject&, const PartSource&)) {
  std::string names;
  for (const PartSource& part : s.source.parts) {
    if (is_it(s, part)) names += (names.empty() ? "" : ", ") + part.name;
  }
  return names;
}

std::string far_parts_fault(const Subject& s) {
  const auto is_far = [](const Subject& of, const PartSource& part) {
    return part.range_m[0] >= of.p.short_range_leave_m + offset_m(part);
  };
  const std::string names = s.p.short_range_enter_m > 0 ? named(s, is_far) : "";
  return names.empty() ? "" : "within so short a range these parts never serve, by their range_m: " + names;
}

// Nearest that the origin is to the sensor in any scenario.
double nearest_m(const MissionSource& source) {
  double nearest = 1e9;
  for (const auto& [name, scenario] : source.scenarios)
    nearest = std::min(nearest, *std::min_element(scenario.ranges_m.begin(), scenario.ranges_m.end()));
  return nearest;
}

std::string near_parts_fault(const Subject& s) {
  const auto is_near = [](const Subject& of, const PartSource& part) { return part.range_m[1] < nearest_m(of.source) - offset_m(part); };
  const std::string names = s.source.scenarios.empty() ? "" : named(s, is_near);
  return names.empty() ? ""
                       : "no scenario has the target nearer than " + figure(nearest_m(s.source)) +
                             " m, where these parts do not serve, by their range_m: " + names;
}

std::string narrow_parts_fault(const Subject& s) {
  const auto is_narrow = [](const Subject&, const PartSource& part) { return part.cone_rad < kNarrowCone_rad; };
  const std::string names = named(s, is_narrow);
  return names.empty() ? ""
                       : "seen from within less than " + degrees_text(kNarrowCone_rad) +
                             " of their view, in radians?, these parts hardly ever serve, by their cone_deg: " + names;
}

std::string unreached_parts_fault(const Subject& s) {
  if (s.p.short_range_enter_m <= 0 || s.source.scenarios.empty() || nearest_m(s.source) <= s.p.short_range_enter_m) return "";
  return "no scenario has the target nearer than " + figure(nearest_m(s.source)) + " m: its parts are never looked at";
}

std::string crease_fault(const Subject& s) {
  const double in_degrees = s.source.target.crease_angle_rad / kRadPerDeg;
  if (in_degrees == 0 || in_degrees > kRadiansOfCrease) return "";
  return "each facet of a round surface is one of its own; in radians? " + figure(in_degrees) + " rad are " + degrees_text(in_degrees);
}

// Rays of a scan of the whole field that meet the target, as a box that is seen from all sides: its mean shadow is a quarter of its
// surface.
double full_field_returns(const Subject& s, double range_m) {
  const Eigen::Vector3d size = s.target->high - s.target->low;
  const double shadow_m2 = 0.5 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
  const double field_m2 = 4 * range_m * range_m * std::tan(s.p.fov_half_x_rad) * std::tan(s.p.fov_half_y_rad);
  return s.p.points * (1 - s.p.dropout_probability) * std::min(1.0, shadow_m2 / field_m2);
}

std::string bearing_fault(const Subject& s) {
  const double range_m = s.scenario->runs_m().front(), returns = full_field_returns(s, range_m);
  if (!s.scenario->seeks_bearing() || returns >= s.p.bearing_returns_min) return "";
  return "of a scan of the whole field some " + figure(returns) + " rays meet the target at " + figure(range_m) +
         " m: there would be no bearing";
}

}  // namespace

const Rules& target_rules() {
  using enum Severity;
  using enum Scope;
  using enum Needs;
  // clang-format off
  static const Rules rules = {
    {kError, kMission, kTarget, {"target.cell_size_m"}, grid_fault},
    {kWarning, kMission, kTarget, {"target.cell_size_m"}, cells_fault},
    {kWarning, kParameters, kTarget, {"tracking.initial.z_m", "tracking.initial.present"}, unreached_fault},
    {kWarning, kParameters, kTarget, {"tracking.initial.x_m", "tracking.initial.y_m", "tracking.initial.present"}, unseen_start_fault},
    {kWarning, kScenario, kTarget, {"tracking.start_sigma_m"}, start_sigma_fault},
    {kWarning, kParameters, kValues, {"short_range.leave_m", "short_range.enter_m"}, far_parts_fault},
    {kWarning, kMission, kValues, {"short_range.enter_m"}, near_parts_fault},
    {kWarning, kMission, kValues, {"short_range.enter_m"}, narrow_parts_fault},
    {kWarning, kMission, kValues, {"short_range.enter_m"}, unreached_parts_fault},
    {kWarning, kMission, kValues, {"target.crease_angle_deg"}, crease_fault},
    {kWarning, kScenario, kTarget, {"bearing.returns_min", "scan.points"}, bearing_fault},
    {kWarning, kScenario, kTarget, {"offset_m", "sensor.fov_half_x_deg", "sensor.fov_half_y_deg"}, outside_fault},
    {kWarning, kScenario, kTarget, {"offset_m", "sensor.fov_half_x_deg", "sensor.fov_half_y_deg"}, off_fault},
    {kWarning, kScenario, kTarget, {"drift_mps", "frames"}, lost_fault},
    {kError, kScenario, kTarget, {"ranges_m", "target.scale", "center_m", "offset_m"}, inside_fault},
    {kWarning, kScenario, kTarget, {"edge_mixing_m", "beam_divergence_rad"}, footprint_fault},
  };
  // clang-format on
  return rules;
}

}  // namespace lasso::mdat
