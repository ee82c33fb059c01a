#include "mdat/missiondb/mission_text.hpp"

#include <Eigen/Core>
#include <iomanip>
#include <optional>
#include <sstream>

#include "mdat/missiondb/detector_reader.hpp"
#include "mdat/missiondb/flash_rows.hpp"
#include "mdat/missiondb/laser_safety.hpp"
#include "mdat/missiondb/mesh_faults.hpp"
#include "mdat/missiondb/rule.hpp"
#include "mdat/missiondb/sections.hpp"
#include "mdat/missiondb/sensor_reader.hpp"

namespace lasso::mdat {
namespace {

struct Box {
  Eigen::Vector3d low, high;
};

Box box_of(const Mesh& mesh) {
  Box box{mesh.vertices.at(0), mesh.vertices.at(0)};
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    box.low = box.low.cwiseMin(vertex);
    box.high = box.high.cwiseMax(vertex);
  }
  return box;
}

std::string place_text(const MissionSource& source, const std::string& key) {
  const auto origin = source.origins.find(key);
  if (origin == source.origins.end() || origin->second.preset()) return "preset";
  if (origin->second.set) return kSettingPlace;
  return source.file.filename().string() + ":" + std::to_string(origin->second.line);
}

using ValueLines = std::vector<EffectiveValue>;

void write_line(ValueLines& out, const std::string& key, const std::string& value, const std::string& unit, const std::string& place,
                const std::string& meaning) {
  out.push_back({key, value, unit == "1" ? "" : unit, place, meaning});
}

void write_calibration(ValueLines& out, const MissionSource& source, const std::string& key, const std::vector<std::string>& files) {
  std::string text;
  for (const std::string& file : files) text += (text.empty() ? "" : ", ") + file;
  if (!files.empty()) write_line(out, key, text, "", place_text(source, key), find_row(mission_rows(), "sensor.calibration")->meaning);
}

// Where anything of it is said.
void write_detector(ValueLines& out, const MissionSource& source, const std::string& prefix, const sim::DetectorModel& detector) {
  if (!sim::is_simulated(detector) && detector.returns == sim::Returns::kMixed) return;
  for (const DetectorField& field : detector_fields()) {
    write_line(out, prefix + field.row.key, value_text(field.row, {detector_value(detector, field)}), field.row.unit,
               place_text(source, prefix + field.row.key), field.row.meaning);
  }
}

void write_flash(ValueLines& out, const MissionSource& source, const std::string& prefix, SensorKind kind, const sim::FlashModel& flash) {
  if (kind != SensorKind::kFlashLidar) return;
  for (const ValueRow& row : flash_rows()) {
    const std::string key = prefix + row.key.substr(row.key.find('.') + 1);
    write_line(out, key, value_text(row, {flash_value(flash, row)}), row.unit, place_text(source, key), row.meaning);
  }
}

// Where anything of it is stated: then that a class is not, too.
void write_laser(ValueLines& out, const MissionSource& source, const std::string& prefix, const LaserSafety& laser) {
  if (!laser.stated) return;
  for (const ValueRow& row : laser_safety_rows()) {
    const std::string key = prefix + row.key.substr(row.key.find('.') + 1);
    write_line(out, key, value_text(row, {laser_safety_value(laser, row)}), row.unit, place_text(source, key), row.meaning);
  }
}

void write_sensor(ValueLines& out, const MissionSource& source) {
  const ValueRow& row = *find_row(mission_rows(), "sensor.kind");
  write_line(out, row.key, value_text(row, {static_cast<double>(source.sensor)}), row.unit, place_text(source, row.key), row.meaning);
  write_calibration(out, source, "sensor.calibration", source.calibration_files);
  write_detector(out, source, "sensor.", source.detector);
  write_flash(out, source, "sensor.", source.sensor, source.flash);
  write_laser(out, source, "sensor.", source.laser);
}

void write_further_sensor(ValueLines& out, const MissionSource& source, const FurtherSensor& sensor) {
  const std::string prefix = "further_sensor." + sensor.name + ".";
  const ValueRow& kind = further_sensor_rows().front();
  write_line(out, prefix + kind.key, value_text(kind, {static_cast<double>(sensor.kind)}), kind.unit, place_text(source, prefix + kind.key),
             kind.meaning);
  for (std::size_t i = 0; i < sensor_rows().size(); ++i) {
    const ValueRow& row = further_sensor_rows()[i + 1];
    write_line(out, prefix + row.key, value_text(row, {sensor.parameters.*sensor_member(sensor_rows()[i])}), row.unit,
               place_text(source, prefix + row.key), row.meaning);
  }
  write_calibration(out, source, prefix + "calibration", sensor.calibration_files);
  write_detector(out, source, prefix, sensor.detector);
  write_flash(out, source, prefix, sensor.kind, sensor.flash);
  write_laser(out, source, prefix, sensor.laser);
  if (!sensor.node.empty())
    write_line(out, prefix + "node", '"' + sensor.node + '"', "", place_text(source, prefix + "node"),
               further_sensor_rows().back().meaning);
}

void write_parameters(ValueLines& out, const MissionSource& source, const std::string& scenario) {
  const MissionParameters parameters = parameters_for(source, scenario);
  const std::string prefix = "scenario." + scenario + ".override.";
  for (const ParameterRow& row : parameter_rows()) {
    const std::string key = row.key;
    const bool overridden = source.origins.count(prefix + key) != 0;
    write_line(out, key, value_text(value_row(row), {parameters.*row.member}), row.unit,
               place_text(source, overridden ? prefix + key : key), row.meaning);
  }
}

void write_part(ValueLines& out, const MissionSource& source, const PartSource& part) {
  for (const PartField& field : part_fields()) {
    const std::string key = "part." + part.name + "." + field.row.key;
    const bool text = field.list == nullptr && field.number == nullptr;
    if (text || (field.list != nullptr && (part.*field.list).empty())) continue;
    const std::vector<double> values = field.list != nullptr ? part.*field.list : std::vector<double>{part.*field.number};
    write_line(out, key, value_text(field.row, values), field.row.unit, place_text(source, key), field.row.meaning);
  }
  if (!part.file.empty()) write_line(out, "part." + part.name + ".model", part.file.string(), "", "", "its model");
}

void write_scenario(ValueLines& out, const MissionSource& source, const std::string& name) {
  const Scenario& scenario = scenario_of(source, name);
  for (const ScenarioField& field : scenario_fields()) {
    if (is_of_motion(scenario, field.row.key) || (field.list != nullptr && (scenario.*field.list).empty())) continue;
    const std::string key = "scenario." + name + "." + field.row.key;
    std::string place = place_text(source, key);
    if (place == "preset" && !field.row.preset_from.empty()) place = "as sensor." + field.row.preset_from.substr(7);
    const std::vector<double> values = field.list != nullptr ? scenario.*field.list : std::vector<double>{scenario.*field.number};
    write_line(out, key, value_text(field.row, values), field.row.unit, place, field.row.meaning);
  }
}

void write_target(ValueLines& out, const MissionSource& source) {
  const TargetSource& target = source.target;
  const double degrees = find_row(mission_rows(), "target.crease_angle_deg")->to_si;
  write_line(out, target.file_key, target.file.filename().string(), "", place_text(source, target.file_key), "sha256 " + target.sha256);
  write_line(out, "target.scale", number_text(target.scale), "1", place_text(source, "target.scale"),
             "the file's lengths times this are metres");
  const ValueRow& origin = *find_row(mission_rows(), "target.origin_m");
  write_line(out, origin.key, value_text(origin, target.origin_m), origin.unit, place_text(source, origin.key), origin.meaning);
  ValueRow crease = *find_row(mission_rows(), "target.crease_angle_deg");
  crease.to_si = degrees;
  write_line(out, crease.key, value_text(crease, {target.crease_angle_rad}), crease.unit, place_text(source, crease.key), crease.meaning);
  const ValueRow& cell = *find_row(mission_rows(), "target.cell_size_m");
  write_line(out, cell.key, number_text(target.cell_size_m), cell.unit, place_text(source, cell.key), cell.meaning);
  for (const auto& [name, value] : target.parameters) {
    const std::string key = "target.parameters." + name;
    write_line(out, key, number_text(value), "", place_text(source, key), "parameter of the model");
  }
}

// Nodes, motions and the orbit; what a scenario says of them where it is the one, or none is chosen.
void write_scene(ValueLines& out, const MissionSource& source, const std::string& scenario) {
  for (const WrittenValue& value : source.scene.values) {
    const bool of_other =
        value.key.rfind("scenario.", 0) == 0 && !scenario.empty() && value.key.rfind("scenario." + scenario + ".", 0) != 0;
    if (!of_other) write_line(out, value.key, value.value, value.unit, place_text(source, value.key), value.meaning);
  }
}

std::string campaigns_text(std::size_t count) {
  return count == 0 ? "" : ", " + std::to_string(count) + (count == 1 ? " campaign" : " campaigns");
}

// Of one campaign a line.
std::string campaign_text(const CampaignSource& campaign) {
  std::string columns;
  for (const Dispersion& dispersion : campaign.dispersions) {
    for (const std::string& column : dispersion.columns) columns += (columns.empty() ? "" : ", ") + column;
  }
  return "campaign " + campaign.name + ": " + std::to_string(campaign.cases) + " cases of scenario " + campaign.scenario + ", " +
         (columns.empty() ? "nothing but the noise varies" : "varied: " + columns) + '\n';
}

// What holds where nobody writes the key; empty where it has to be written, or holds because of another one.
std::string preset_text(const MissionSource& source, const std::string& key, const std::string& scenario) {
  const std::string prefix = "scenario." + scenario + ".";
  const bool of_scenario = key.rfind(prefix, 0) == 0;
  const std::string name = of_scenario ? key.substr(prefix.size()) : key;
  const ValueRow* row = find_row(of_scenario ? scenario_rows() : flight_rows(), name);
  if (row == nullptr && !of_scenario) row = find_row(mission_rows(), name);
  if (row == nullptr || row->preset.empty()) return "";
  if (row->kind == ValueKind::kReals) return toml_text(*row, row->preset);
  return toml_text(*row, {preset_of(source.sensor, name, row->preset[0])});
}

// Empty of a key whose value is not listed, and of a file, which is listed by its name alone.
std::optional<std::string> value_of(const MissionSource& source, const std::string& key, const std::string& scenario) {
  for (const EffectiveValue& value : effective_values(source, scenario)) {
    if (value.key == key && key != source.target.file_key && key != "sensor.calibration") return value.value;
  }
  return std::nullopt;
}

// Empty, too, where the mission is none without what is left out.
std::optional<std::string> value_without(const std::filesystem::path& file, const std::vector<std::string>& settings,
                                         const std::string& key, const std::string& scenario) {
  try {
    return value_of(load_mission(file, settings), key, scenario);
  } catch (const MissionError&) {
    return std::nullopt;
  }
}

// What is odd about a surface, a line each.
std::string surface_text(const std::filesystem::path& file, const Mesh& mesh, bool parametric) {
  std::string text;
  for (const MeshRemark& remark : mesh_remarks(file, mesh, parametric))
    text += (remark.follows ? "warning: " : "note: ") + file.string() + ": " + remark.text + '\n';
  return text;
}

}  // namespace

std::string check_text(const MissionSource& source, const Mesh& mesh) {
  std::ostringstream out;
  std::vector<std::string> warnings = warnings_for(source, "");
  std::string surfaces = surface_text(source.target.file, mesh, source.target.parametric);
  for (const PartSource& part : source.parts) {
    const Mesh of_part = load_part(source, part, mesh, &warnings);
    if (!part.file.empty()) surfaces += surface_text(part.file, of_part, part.parametric);
  }
  const Box box = box_of(mesh);
  for (const std::string& warning : warnings) out << "warning: " << warning << '\n';
  out << surfaces;
  const Eigen::Vector3d size = box.high - box.low;
  out << source.file.string() << ": good: mission " << source.id << " \"" << source.name << "\" version " << source.version
      << ", target of " << mesh.triangles.size() << " triangles, " << std::setprecision(4) << size.x() << " x " << size.y() << " x "
      << size.z() << " m, " << source.scenarios.size() << " scenarios" << campaigns_text(source.campaigns.size()) << '\n';
  return out.str();
}

std::vector<EffectiveValue> effective_values(const MissionSource& source, const std::string& scenario) {
  ValueLines out;
  write_target(out, source);
  out.emplace_back();
  write_sensor(out, source);
  write_parameters(out, source, scenario);
  out.emplace_back();
  for (const FurtherSensor& sensor : source.further_sensors) write_further_sensor(out, source, sensor);
  for (const PartSource& part : source.parts) write_part(out, source, part);
  write_scene(out, source, scenario);
  for (const auto& entry : source.scenarios) {
    if (scenario.empty() || entry.first == scenario) write_scenario(out, source, entry.first);
  }
  return out;
}

std::vector<std::string> idle_settings(const MissionSource& source, const std::string& scenario) {
  std::vector<std::string> idle;
  for (std::size_t i = 0; i < source.settings.size(); ++i) {
    std::vector<std::string> others = source.settings;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const std::string& setting = source.settings[i];
    const std::string key = setting.substr(0, setting.find_first_of(" ="));
    const std::optional<std::string> without = value_without(source.file, others, key, scenario);
    if (without && without == value_of(source, key, scenario)) idle.push_back(setting);
  }
  return idle;
}

std::vector<Deviation> deviations(const MissionSource& source, const std::string& scenario) {
  std::vector<Deviation> result;
  for (const EffectiveValue& value : effective_values(source, scenario)) {
    const bool written = !value.key.empty() && value.place != "preset" && value.place.rfind("as ", 0) != 0;
    const std::string preset = written ? preset_text(source, value.key, scenario) : "";
    if (written && (value.value != preset || is_laser_safety(value.key))) result.push_back({value, preset});
  }
  return result;
}

std::string info_text(const MissionSource& source, const std::string& scenario) {
  std::ostringstream out;
  out << "mission " << source.id << " \"" << source.name << "\" version " << source.version << "\n\n";
  for (const EffectiveValue& value : effective_values(source, scenario)) {
    if (!value.key.empty())
      out << std::left << std::setw(40) << value.key << ' ' << std::setw(24) << value.value << ' ' << std::setw(7) << value.unit << ' '
          << std::setw(26) << value.place << ' ' << value.meaning;
    out << '\n';
  }
  if (!source.campaigns.empty()) out << '\n';
  for (const auto& [name, campaign] : source.campaigns) out << campaign_text(campaign);
  return out.str();
}

}  // namespace lasso::mdat
