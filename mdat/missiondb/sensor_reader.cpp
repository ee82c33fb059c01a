#include "mdat/missiondb/sensor_reader.hpp"

#include <algorithm>
#include <cmath>

#include "cfg/capacities.hpp"
#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/so3.hpp"
#include "mdat/missiondb/beside.hpp"
#include "mdat/missiondb/calibration_file.hpp"
#include "mdat/missiondb/detector_reader.hpp"
#include "mdat/missiondb/flash_rows.hpp"
#include "mdat/missiondb/laser_safety.hpp"
#include "mdat/missiondb/optics_reader.hpp"
#include "mdat/missiondb/sections.hpp"
#include "mdat/source/nearest.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kPrefix = sizeof("sensor.") - 1;

ValueRow without_prefix(ValueRow row) {
  row.key = row.key.substr(kPrefix);
  return row;
}

void read_sensor(const std::string& name, const toml::table& table, MissionSource& source, ProblemList& problems) {
  const std::string prefix = "further_sensor." + name + ".";
  const FoundValues found = read_table(table, prefix, further_sensor_rows(), {}, problems);
  for (const ValueRow& row : further_sensor_rows()) {
    const auto value = found.find(row.key);
    source.origins[prefix + row.key] = value == found.end() ? Origin{} : value->second.origin;
  }
  FurtherSensor sensor;
  sensor.name = name;
  const auto kind = found.find("kind");
  if (kind != found.end()) sensor.kind = static_cast<SensorKind>(static_cast<int>(kind->second.numbers.at(0)));
  for (const ParameterRow& row : sensor_rows()) {
    const auto value = found.find(row.key + kPrefix);
    const double number = value == found.end() ? preset_of(sensor.kind, row.key, row.preset) : value->second.numbers.at(0);
    sensor.parameters.*sensor_member(row) = number * row.to_si;
  }
  sensor.flash = read_flash(found, "", sensor.kind, prefix, problems);
  sensor.laser = read_laser_safety(found, "", sensor.kind, prefix, problems);
  sensor.calibration_files = texts_of(found, "calibration");
  sensor.detector = read_detector(found, "", prefix, problems);
  const std::vector<std::string> node = texts_of(found, "node");
  if (!node.empty()) sensor.node = node.front();
  source.further_sensors.push_back(sensor);
}

void read_calibration(const std::string& key, const std::string& written, SensorKind kind, std::uint8_t number, MissionSource& source,
                      ProblemList& problems) {
  const Origin& origin = source.origins[key];
  if (kind != SensorKind::kLaserCamera) return problems.add(origin, key, '"' + written + '"', "expected none: only laser cameras have one");
  std::filesystem::path file;
  if (find_beside(source, written, file)) {
    source.calibrations[number].push_back(load_calibration(file));
    return;
  }
  problems.add(origin, key, '"' + written + '"',
               "no such file in " + std::filesystem::absolute(source.file).parent_path().string() +
                   " or the folder above it: mdat calibrate writes one");
}

// A turn beyond which nothing of what the component plans, in the sensor frame, may be in its field.
void check_boresight(const FurtherSensor& sensor, const std::string& key, MissionSource& source, ProblemList& problems) {
  if (!sensor.T_sensor_own) return;
  const double turn_rad = std::acos(std::clamp(rotate(sensor.T_sensor_own->q, Vec3::UnitZ()).z(), -1.0, 1.0));
  const double limit_rad = std::min(sensor.parameters.fov_half_x_rad, sensor.parameters.fov_half_y_rad);
  if (turn_rad < limit_rad) return;
  problems.add(source.origins.at(key), key, '"' + sensor.node + '"',
               "looks " + number_text(std::round(turn_rad / kRadPerDeg)) + " deg away from where " + source.scene.sensor +
                   " looks, and its field ends at " + number_text(limit_rad / kRadPerDeg) + " deg: turn the node less, or widen the field");
}

void place_sensor(const scene::Tree& tree, FurtherSensor& sensor, MissionSource& source, ProblemList& problems) {
  const std::string key = "further_sensor." + sensor.name + ".node";
  const auto refuse = [&](const std::string& why) { problems.add(source.origins.at(key), key, '"' + sensor.node + '"', why); };
  std::vector<std::string> names;
  for (const scene::Node& node : source.scene.nodes) names.push_back(node.name);
  const auto own = tree.find(sensor.node);
  if (!own) return refuse("the mission has no [node." + sensor.node + "]" + did_you_mean(sensor.node, names));
  if (source.scene.sensor.empty()) return refuse("no node of the mission has sensor = true: that one is the frame of all scans");
  const std::size_t frame = tree.need(source.scene.sensor);
  if (!tree.are_rigid(*own, frame))
    return refuse("moves against " + source.scene.sensor + ", the frame of all scans: name a node that stands on what carries it");
  sensor.T_sensor_own = tree.state(*own, frame, 0).T_a_b;
  check_boresight(sensor, key, source, problems);
}

// [sensor] goes by the name of its kind, a camera by its node's: --camera and telemetry's readers know a sensor by that.
void refuse_doubled_names(const toml::table& root, const MissionSource& source, ProblemList& problems) {
  const std::string kind = root.at_path("sensor.kind").value_or(std::string(kind_name(SensorKind::kLaserCamera)));
  for (const FurtherSensor& sensor : source.further_sensors) {
    const std::string key = "further_sensor." + sensor.name;
    const toml::node* table = root.at_path(key).node();
    const auto refuse = [&](const std::string& whose) {
      problems.add(table != nullptr ? origin_of(table->source()) : Origin{}, key, "", "is the name of " + whose + ": give it another one");
    };
    if (sensor.name == kind) refuse("[sensor] already, which is called by its kind");
    for (const CameraSource& camera : source.scene.cameras) {
      if (camera.node == sensor.name) refuse("the camera at [node." + camera.node + "], too");
    }
  }
}

// A tree with problems of its own has told them.
void place_sensors(MissionSource& source, ProblemList& problems) {
  try {
    const scene::Tree tree(kSceneRoot, source.scene.nodes);
    refuse_lamps_in_sensors(tree, source, problems);
    for (FurtherSensor& sensor : source.further_sensors) {
      if (!sensor.node.empty()) place_sensor(tree, sensor, source, problems);
    }
  } catch (const MissionError&) {
    return;
  }
}

}  // namespace

const std::vector<ValueRow>& further_sensor_rows() {
  static const std::vector<ValueRow> rows = [] {
    std::vector<ValueRow> result{without_prefix(*find_row(mission_rows(), "sensor.kind"))};
    for (const ParameterRow& row : sensor_rows()) result.push_back(without_prefix(value_row(row)));
    result.push_back(without_prefix(*find_row(mission_rows(), "sensor.calibration")));
    for (const DetectorField& field : detector_fields()) result.push_back(field.row);
    for (const ValueRow& row : flash_rows()) result.push_back(without_prefix(row));
    for (const ValueRow& row : laser_safety_rows()) result.push_back(without_prefix(row));
    result.push_back(text_row("node", "[^\\x00-\\x1f]+",
                              "node at which it stands, fixed to that of sensor = true; its scans are moved to that one's frame"));
    return result;
  }();
  return rows;
}

void read_further_sensors(const toml::table& root, MissionSource& source, ProblemList& problems) {
  const toml::table* sensors = root["further_sensor"].as_table();
  if (sensors != nullptr && sensors->size() >= kMaxSensors) {
    return problems.add(*sensors, "further_sensor",
                        "expected at most " + std::to_string(kMaxSensors - 1) + ": the flight component has room for no more");
  }
  for_each_table(root, "further_sensor", problems,
                 [&](const std::string& name, const toml::table& table) { read_sensor(name, table, source, problems); });
  refuse_doubled_names(root, source, problems);
  place_sensors(source, problems);
}

void read_calibrations(MissionSource& source, ProblemList& problems) {
  for (const std::string& file : source.calibration_files) read_calibration("sensor.calibration", file, source.sensor, 0, source, problems);
  std::uint8_t number = 0;
  for (const FurtherSensor& sensor : source.further_sensors) {
    ++number;
    const std::string key = "further_sensor." + sensor.name + ".calibration";
    for (const std::string& file : sensor.calibration_files) read_calibration(key, file, sensor.kind, number, source, problems);
  }
}

}  // namespace lasso::mdat
