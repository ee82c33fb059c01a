#include "mdat/recording/sensor_sight.hpp"

#include <array>
#include <cmath>

#include "mdat/recording/scene_frames.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat {
namespace {

constexpr double kViewColor[] = {0.35, 0.6, 0.85}, kPathColor[] = {0.55, 0.55, 0.6};  // red, green, blue

// From the sensor to each corner, and from corner to corner.
std::vector<Vec3> edges_of(const SensorParameters& sensor, const Pose& T_sensor_own, double depth_m) {
  const double x = std::tan(sensor.fov_half_x_rad), y = std::tan(sensor.fov_half_y_rad);
  const std::array<Vec3, 4> corners = {Vec3(-x, -y, 1), Vec3(x, -y, 1), Vec3(x, y, 1), Vec3(-x, y, 1)};
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 here = T_sensor_own.p + T_sensor_own.q * Vec3(depth_m * corners[i]),
               next = T_sensor_own.p + T_sensor_own.q * Vec3(depth_m * corners[(i + 1) % corners.size()]);
    points.insert(points.end(), {T_sensor_own.p, here, here, next});
  }
  return points;
}

// Of the first one that is a stereo head.
std::optional<Pose> camera_place(const MissionSource& mission) {
  if (mission.stereo.is_fitted()) return std::nullopt;
  if (mission.sensor == SensorKind::kStereo) return Pose{};
  for (const FurtherSensor& sensor : mission.further_sensors) {
    if (sensor.kind == SensorKind::kStereo) return sensor.T_sensor_own.value_or(Pose{});
  }
  return std::nullopt;
}

}  // namespace

SensorSight::SensorSight(const MissionSource& mission, const std::string& scenario) : camera_(camera_place(mission)) {
  const std::vector<std::string> names = sensor_names(mission);
  sensors_.push_back({names.front(), parameters_for(mission, scenario), Pose{}});
  for (std::size_t i = 0; i < mission.further_sensors.size(); ++i) {
    const FurtherSensor& sensor = mission.further_sensors[i];
    sensors_.push_back({names.at(i + 1), sensor.parameters, sensor.T_sensor_own.value_or(Pose{})});
  }
}

std::vector<ros::Path> SensorSight::fields_of_view(double depth_m) const {
  std::vector<ros::Path> paths;
  for (const Sensor& sensor : sensors_)
    paths.push_back({"field of view, " + sensor.name, kSensorFrame, edges_of(sensor.parameters, sensor.T_sensor_own, depth_m), false,
                     Vec3(kViewColor)});
  return paths;
}

const SensorParameters& SensorSight::parameters(std::uint8_t sensor) const {
  return sensors_[sensor < sensors_.size() ? sensor : 0].parameters;
}

ros::Path scan_path(const std::vector<RangeSample>& samples, double range_m) {
  ros::Path path{"scan pattern", kSensorFrame, {}, true, Vec3(kPathColor)};
  for (const RangeSample& sample : samples)
    path.points.push_back(range_m * Vec3(static_cast<double>(sample.direction[0]), static_cast<double>(sample.direction[1]),
                                         static_cast<double>(sample.direction[2])));
  return path;
}

}  // namespace lasso::mdat
