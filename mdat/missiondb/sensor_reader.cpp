#include "mdat/missiondb/sensor_reader.hpp"

#include "cfg/capacities.hpp"
#include "mdat/missiondb/beside.hpp"
#include "mdat/missiondb/calibration_file.hpp"
#include "mdat/missiondb/detector_reader.hpp"
#include "mdat/missiondb/flash_rows.hpp"
#include "mdat/missiondb/sections.hpp"

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
  sensor.calibration_files = texts_of(found, "calibration");
  sensor.detector = read_detector(found, "", prefix, problems);
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

}  // namespace

const std::vector<ValueRow>& further_sensor_rows() {
  static const std::vector<ValueRow> rows = [] {
    std::vector<ValueRow> result{without_prefix(*find_row(mission_rows(), "sensor.kind"))};
    for (const ParameterRow& row : sensor_rows()) result.push_back(without_prefix(value_row(row)));
    result.push_back(without_prefix(*find_row(mission_rows(), "sensor.calibration")));
    for (const DetectorField& field : detector_fields()) result.push_back(field.row);
    for (const ValueRow& row : flash_rows()) result.push_back(without_prefix(row));
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
