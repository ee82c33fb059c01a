#include <algorithm>

#include "mdat/missiondb/campaign_reader.hpp"
#include "mdat/missiondb/campaign_rules.hpp"
#include "mdat/missiondb/detector_reader.hpp"
#include "mdat/missiondb/flash_rows.hpp"
#include "mdat/missiondb/laser_safety.hpp"
#include "mdat/missiondb/material_reader.hpp"
#include "mdat/missiondb/mission_checks.hpp"
#include "mdat/missiondb/mission_source.hpp"
#include "mdat/missiondb/model_file.hpp"
#include "mdat/missiondb/motion_reader.hpp"
#include "mdat/missiondb/named_pairs.hpp"
#include "mdat/missiondb/node_reader.hpp"
#include "mdat/missiondb/old_kinds.hpp"
#include "mdat/missiondb/part_reader.hpp"
#include "mdat/missiondb/sections.hpp"
#include "mdat/missiondb/sensor_reader.hpp"
#include "mdat/missiondb/settings.hpp"
#include "mdat/missiondb/stereo_reader.hpp"
#include "mdat/missiondb/toml_reader.hpp"
#include "mdat/source/nearest.hpp"
#include "mdat/source/sha256.hpp"

namespace lasso::mdat {
namespace {

double number_or(const FoundValues& found, const ValueRow& row, double preset) {
  const auto value = found.find(row.key);
  return value == found.end() ? preset : value->second.numbers.at(0);
}

std::string text_or_empty(const FoundValues& found, const std::string& key) {
  const std::vector<std::string> texts = texts_of(found, key);
  return texts.empty() ? "" : texts.front();
}

void override_parameters(MissionParameters& parameters, const std::map<std::string, double>& overrides) {
  for (const ParameterRow& row : parameter_rows()) {
    const auto value = overrides.find(row.key);
    if (value != overrides.end()) parameters.*row.member = value->second * row.to_si;
  }
  normalize_attitude(parameters);
}

// Builds a MissionSource from a parsed file; the stages follow each other, problems gather.
class Loader {
 public:
  Loader(toml::table root, const std::filesystem::path& file, const std::vector<std::string>& settings)
      : root_(std::move(root)), problems_(file) {
    source_.file = file;
    source_.settings = settings;
    apply_settings(settings, root_, problems_);
  }

  MissionSource load() {
    read_values();
    if (problems_.empty()) check_whole();  // wrong values would only cause further complaints
    problems_.throw_if_any();
    normalize_attitude(source_.parameters);
    return std::move(source_);
  }

 private:
  void check_whole() {
    read_target();
    if (problems_.empty()) check_model();
    read_calibrations(source_, problems_);
    read_scenarios();
    if (problems_.empty()) warn_of_idle(source_);
    if (problems_.empty()) check_named_pairs(source_, problems_);
    warn_of_no_sun(source_);
    check_contradictions();
    if (problems_.empty()) check_campaigns(source_, problems_);
  }
  // Values of all sections, scenarios included, so that one pass shows the mistakes of all.
  void read_values() {
    std::vector<ValueRow> rows = mission_rows();
    rows.insert(rows.end(), flight_rows().begin(), flight_rows().end());
    found_ = read_table(root_, "", rows,
                        {"campaign", "further_sensor", "material", "motion", "node", "orbit", "part", "relative", "scenario", "stereo",
                         "target.parameters"},
                        problems_);
    for (const ValueRow& row : rows) note_origin(row.key, found_, row.key);
    read_motions(root_, source_, problems_);
    read_nodes(root_, source_, problems_);
    read_relative(root_, source_, problems_);
    read_materials(root_, source_, problems_);
    read_stereo(root_, source_, problems_);
    read_scenario_values();
    read_further_sensors(root_, source_, problems_);
    read_parts(root_, source_, problems_);
    read_campaigns(root_, source_, problems_);
    read_model_parameters();
    fill_mission();
  }
  void note_origin(const std::string& key, const FoundValues& found, const std::string& found_key) {
    const auto value = found.find(found_key);
    source_.origins[key] = value == found.end() ? Origin{} : value->second.origin;
  }
  void fill_mission() {
    source_.sensor = static_cast<SensorKind>(static_cast<int>(mission_number("sensor.kind")));
    source_.flash = read_flash(found_, "sensor.", source_.sensor, "sensor.", problems_);
    source_.laser = read_laser_safety(found_, "sensor.", source_.sensor, "sensor.", problems_);
    for (const ParameterRow& row : parameter_rows()) {
      const double preset = preset_of(source_.sensor, row.key, row.preset);
      source_.parameters.*row.member = number_or(found_, value_row(row), preset) * row.to_si;
    }
    source_.id = static_cast<std::uint32_t>(mission_number("mission.id"));
    source_.version = static_cast<std::uint32_t>(mission_number("mission.version"));
    source_.name = text_or_empty(found_, "mission.name");
    source_.calibration_files = texts_of(found_, "sensor.calibration");
    source_.detector = read_detector(found_, "sensor.", "sensor.", problems_);
    source_.target.scale = mission_number("target.scale");
    source_.target.origin_m = mission_list("target.origin_m");
    source_.target.crease_angle_rad = mission_number("target.crease_angle_deg");
    source_.target.cell_size_m = mission_number("target.cell_size_m");
  }
  double mission_number(const std::string& key) const {
    const ValueRow& row = *find_row(mission_rows(), key);
    return number_or(found_, row, row.preset.empty() ? 0 : row.preset[0]) * row.to_si;
  }

  std::vector<double> mission_list(const std::string& key) const {
    const auto value = found_.find(key);
    return value == found_.end() ? find_row(mission_rows(), key)->preset : value->second.numbers;
  }

  void read_scenario_values() {
    for_each_table(root_, "scenario", problems_,
                   [&](const std::string& name, const toml::table& table) { read_scenario_table(name, table, "scenario." + name + "."); });
  }
  void read_scenario_table(const std::string& name, const toml::table& table, const std::string& prefix) {
    source_.origins["scenario." + name] = origin_of(table.source());
    scenario_found_[name] = read_table(table, prefix, scenario_rows(), {"kind", "motion", "override"}, problems_);
    for (const ValueRow& row : scenario_rows()) note_origin(prefix + row.key, scenario_found_[name], row.key);
    motions_[name] = read_chosen_motions(table, prefix, source_, problems_);
    refuse_kind(table, prefix, problems_);
    if (!table.contains("kind")) check_place(table, prefix, scenario_found_[name]);
    const toml::node* node = table.get("override");
    if (node == nullptr) return;
    if (!node->is_table()) return problems_.add(*node, prefix + "override", "wrong type: expected a table of flight parameters");
    overrides_[name] = read_table(*node->as_table(), prefix + "override.", flight_rows(), {}, problems_);
    for (const auto& [key, value] : overrides_[name]) source_.origins[prefix + "override." + key] = value.origin;
  }

  // Who says ranges says nothing of the nodes' motions, and the other way round.
  void check_place(const toml::table& table, const std::string& prefix, const FoundValues& found) {
    const auto times = found.find("times_s");
    if (table.contains("ranges_m")) {
      if (table.contains("motion"))
        problems_.add(*table.get("motion"), prefix + "motion",
                      "has no effect where ranges_m say where the target is: leave one of both out");
    } else if (source_.scene.target.empty() && source_.scene.sensor.empty()) {
      problems_.add(origin_of(table.source()), prefix + "ranges_m", "",
                    "is missing: " + expectation(*find_row(scenario_rows(), "ranges_m")) +
                        "; or nodes, one with target = true and one with sensor = true (docs/scenes.md)");
    } else if (times != found.end()) {
      problems_.add(times->second.origin, prefix + "times_s", "",
                    "leave it out: without ranges_m the nodes' motions say where the target is");
    }
  }

  void read_model_parameters() {
    const auto node = root_.at_path("target.parameters");
    if (!node) return;
    if (!node.is_table()) return problems_.add(*node.node(), "target.parameters", "wrong type: expected a table of the model's parameters");
    ValueRow any;
    any.minimum = -1e9;
    any.maximum = 1e9;
    for (const auto& [name, value] : *node.as_table()) {
      any.meaning = "a parameter of the model";
      const std::string key = "target.parameters." + std::string(name.str());
      const auto number = read_value(value, any, key, problems_);
      if (!number) continue;
      source_.target.parameters[std::string(name.str())] = number->numbers[0];
      source_.origins[key] = number->origin;
    }
  }

  void read_target() {
    const bool model = found_.count("target.model") != 0;
    const bool mesh = found_.count("target.mesh") != 0;
    if (model == mesh) {
      const Origin origin = model ? found_["target.mesh"].origin
                                  : origin_of(root_.at_path("target").node() ? root_.at_path("target").node()->source() : root_.source());
      return problems_.add(origin, "target", "", "expected exactly one of target.model (a parametric model) and target.mesh (a mesh)");
    }
    source_.target.parametric = model;
    source_.target.file_key = model ? "target.model" : "target.mesh";
    find_target_file();
  }
  void find_target_file() {
    const FoundValue& written = found_[source_.target.file_key];
    const std::filesystem::path folder = std::filesystem::absolute(source_.file).parent_path();
    for (const auto& candidate : {folder / written.texts.at(0), folder.parent_path() / written.texts.at(0)}) {
      source_.target.file = candidate.lexically_normal();
      std::error_code unnameable;  // such as a name that is too long
      if (!std::filesystem::exists(candidate, unnameable)) continue;
      source_.named_files.push_back(source_.target.file);
      return check_digest(written);
    }
    problems_.add(written.origin, source_.target.file_key, '"' + written.texts.at(0) + '"',
                  "no such file in " + folder.string() + " or the folder above it");
  }
  void check_digest(const FoundValue& written) {
    try {
      source_.target.sha256 = sha256_of(read_file(source_.target.file));
    } catch (const std::runtime_error& error) {
      return problems_.add(written.origin, source_.target.file_key, '"' + written.texts.at(0) + '"', error.what());
    }
    std::string expected = text_or_empty(found_, "target.sha256");
    std::transform(expected.begin(), expected.end(), expected.begin(), [](char c) { return static_cast<char>(std::tolower(c)); });
    if (expected.empty()) {
      if (!source_.target.parametric) warn_of_digest();
    } else if (expected != source_.target.sha256) {
      problems_.add(
          found_["target.sha256"].origin, "target.sha256", expected,
          source_.target.file.string() + " has " + source_.target.sha256 + ": restore the file, or accept it by writing this digest");
    }
  }
  void warn_of_digest() {
    source_.warnings.push_back(to_string(
        problem_at(source_, source_.target.file_key, "", "not protected against change; add: sha256 = \"" + source_.target.sha256 + '"')));
  }

  void check_model() {
    TargetSource& target = source_.target;
    if (!target.parametric) {
      for (const auto& [name, value] : target.parameters) {
        problems_.add(source_.origins["target.parameters." + name], "target.parameters." + name, number_text(value),
                      "a mesh has no parameters");
      }
      return;
    }
    const std::vector<ModelParameter> known = known_parameters(target.file);
    if (!problems_.empty()) return;
    for (const auto& [name, value] : target.parameters) check_model_parameter(known, name, value);
  }
  std::vector<ModelParameter> known_parameters(const std::filesystem::path& file) {
    try {
      return model_parameters(file);
    } catch (const MissionError& error) {
      problems_.add(error);
    }
    return {};
  }
  void check_model_parameter(const std::vector<ModelParameter>& known, const std::string& name, double value) {
    const std::string key = "target.parameters." + name;
    const Origin origin = source_.origins[key];
    std::vector<std::string> names;
    for (const ModelParameter& parameter : known) {
      names.push_back(parameter.name);
      if (parameter.name != name) continue;
      if (value >= parameter.minimum && value <= parameter.maximum) return;
      return problems_.add(origin, key, number_text(value),
                           "out of range: expected " + number_text(parameter.minimum) + " to " + number_text(parameter.maximum) + " " +
                               parameter.unit + " (" + parameter.meaning + ")");
    }
    problems_.add(origin, key, number_text(value), "the model has no such parameter" + did_you_mean(name, names));
  }

  void read_scenarios() {
    for (const auto& [name, found] : scenario_found_) {
      Scenario scenario;
      scenario.detector = source_.detector;
      for (const auto& [key, value] : overrides_[name]) scenario.overrides[key] = value.numbers[0];
      MissionParameters parameters = source_.parameters;
      override_parameters(parameters, scenario.overrides);
      for (const ScenarioField& field : scenario_fields()) fill_field(scenario, field, found, parameters);
      if (scenario.ranges_m.empty())
        make_scene_run(motions_[name], name, source_.origins.at("scenario." + name), parameters.period_s, source_, scenario, problems_);
      source_.scenarios[name] = scenario;
    }
  }
  void fill_field(Scenario& scenario, const ScenarioField& field, const FoundValues& found, const MissionParameters& parameters) const {
    const auto value = found.find(field.row.key);
    if (value == found.end() && !field.row.preset_from.empty()) {
      for (const ParameterRow& row : parameter_rows()) {
        if (field.row.preset_from == row.key) scenario.*field.number = parameters.*row.member;
      }
      return;
    }
    std::vector<double> numbers = value == found.end() ? field.row.preset : value->second.numbers;
    for (double& number : numbers) number *= field.row.to_si;
    if (field.list != nullptr) {
      scenario.*field.list = numbers;
    } else {
      scenario.*field.number = value == found.end() ? preset_of(source_.sensor, field.row.key, numbers.at(0)) : numbers.at(0);
    }
  }

  void check_contradictions() {
    const auto is_unmade = [](const auto& entry) { return entry.second.ranges_m.empty() && entry.second.scene == nullptr; };
    if (std::any_of(source_.scenarios.begin(), source_.scenarios.end(), is_unmade)) return;  // which has been said
    const std::vector<Problem> contradictions = check_rules(source_, nullptr);
    if (!contradictions.empty()) problems_.add(MissionError(contradictions));
  }

  toml::table root_;
  ProblemList problems_;
  MissionSource source_;
  FoundValues found_;
  std::map<std::string, FoundValues> scenario_found_, overrides_;
  std::map<std::string, ChosenMotions> motions_;  // by scenario
};

}  // namespace

Problem problem_at(const MissionSource& source, const std::string& key, const std::string& value, const std::string& expected) {
  const auto found = source.origins.find(key);
  const Origin origin = found == source.origins.end() ? Origin{} : found->second;
  return {origin.set ? kSettingPlace : source.file.string(), origin.line, origin.column, key, value, expected};
}

MissionSource load_mission(const std::filesystem::path& file, const std::vector<std::string>& settings) {
  return Loader(parse_toml(file), file, settings).load();
}

MissionSource load_mission_text(const std::string& text, const std::filesystem::path& file) {
  return Loader(parse_toml_text(text, file), file, {}).load();
}

void check_settings(const MissionSource& source, const std::string& scenario) {
  const std::string own = "scenario." + scenario + ".";
  const auto refuse = [](const std::string& key, const std::string& why) {
    throw MissionError({kSettingPlace, 0, 0, key, "", "changes nothing: " + why});
  };
  for (const auto& [key, origin] : source.origins) {
    if (!origin.set) continue;
    if (key.rfind("scenario.", 0) == 0 && key.rfind(own, 0) != 0)
      refuse(key, scenario.empty() ? "no scenario is chosen; add --scenario" : "the scenario is " + scenario);
    const auto over = source.origins.find(own + "override." + key);
    if (over != source.origins.end() && !over->second.set) refuse(key, "the scenario overrides it; set " + own + "override." + key);
  }
}

const Scenario& scenario_of(const MissionSource& source, const std::string& name) {
  const auto found = source.scenarios.find(name);
  if (found != source.scenarios.end()) return found->second;
  std::string names;
  std::vector<std::string> known;
  for (const auto& entry : source.scenarios) {
    names += (names.empty() ? "" : ", ") + entry.first;
    known.push_back(entry.first);
  }
  throw MissionError({source.file.string(), 0, 0, "scenario", name,
                      names.empty() ? "the mission has no scenarios" : "expected one of " + names + did_you_mean(name, known)});
}

MissionParameters parameters_for(const MissionSource& source, const std::string& scenario) {
  return scenario.empty() ? source.parameters : parameters_for(source, scenario_of(source, scenario));
}

MissionParameters parameters_for(const MissionSource& source, const Scenario& scenario) {
  MissionParameters parameters = source.parameters;
  override_parameters(parameters, scenario.overrides);
  return parameters;
}

}  // namespace lasso::mdat
