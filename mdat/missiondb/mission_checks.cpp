#include "mdat/missiondb/mission_checks.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mdat/missiondb/sections.hpp"
#include "mdat/missiondb/value_row.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kSensorPrefix = sizeof("sensor.") - 1;
constexpr std::size_t kLongestValue = 60;
constexpr std::size_t kMostNames = 4;  // of scenarios, in a line

bool is_of_sensor(const std::string& key) { return key.rfind("sensor.", 0) == 0; }

bool is_of_scenario(const std::string& key) { return key.find('.') == std::string::npos; }

// As the mission has it.
std::string mission_key(const Subject& s, const std::string& key) {
  return s.sensor != nullptr && is_of_sensor(key) ? s.sensor->prefix + key.substr(kSensorPrefix) : key;
}

std::string scenario_prefix(const Subject& s) { return "scenario." + s.name + "."; }

bool is_overridden(const Subject& s, const std::string& key) {
  return s.scenario != nullptr && mission_key(s, key) == key && s.scenario->overrides.count(key) != 0;
}

bool overrides_any(const Subject& s, const Rule& rule) {
  return std::any_of(rule.keys.begin(), rule.keys.end(), [&](const char* key) { return is_overridden(s, key); });
}

bool is_of_nodes(const Subject& s, const std::string& key) {
  return s.scenario != nullptr && is_of_scenario(key) && is_of_motion(*s.scenario, key);
}

std::string label_of(const Subject& s, const Rule& rule) {
  const std::string key = rule.keys.front();
  if (is_of_nodes(s, key)) return scenario_prefix(s) + "motion";
  if (is_of_scenario(key)) return scenario_prefix(s) + key;
  return (is_overridden(s, key) ? scenario_prefix(s) + "override: " : "") + mission_key(s, key);
}

std::string value_of_field(const Subject& s, const std::string& key) {
  for (const ScenarioField& field : scenario_fields()) {
    if (field.row.key != key) continue;
    return value_text(field.row, field.list != nullptr ? s.scenario->*field.list : std::vector<double>{s.scenario->*field.number});
  }
  return "";
}

std::string value_of(const Subject& s, const std::string& key) {
  if (is_of_nodes(s, key)) return "";
  if (is_of_scenario(key)) return value_of_field(s, key);
  if (key == "target.cell_size_m") return number_text(s.source.target.cell_size_m);
  if (key == "target.crease_angle_deg") return value_text(*find_row(mission_rows(), key), {s.source.target.crease_angle_rad});
  for (const ParameterRow& row : parameter_rows()) {
    if (row.key != key) continue;
    const double si = s.sensor != nullptr && is_of_sensor(key) ? s.sensor->p.*sensor_member(row) : s.p.*row.member;
    return value_text(value_row(row), {si});
  }
  return "";
}

std::string cut(std::string text) {
  if (text.size() > kLongestValue) text.replace(kLongestValue, std::string::npos, "...");
  return text;
}

std::optional<Origin> written_at(const MissionSource& source, const std::string& key) {
  const auto origin = source.origins.find(key);
  return origin == source.origins.end() || origin->second.preset() ? std::nullopt : std::optional<Origin>(origin->second);
}

// In the scenario, or else in the mission.
std::optional<Origin> written_for(const Subject& s, const std::string& key) {
  if (s.scenario != nullptr) {
    for (const char* inner : {"override.", ""}) {
      if (const auto origin = written_at(s.source, scenario_prefix(s) + inner + mission_key(s, key))) return origin;
    }
  }
  return written_at(s.source, mission_key(s, key));
}

// Of the first key that was set on the command line, or else that somebody wrote. None: the file as a whole.
Origin place_of(const Subject& s, const Rule& rule) {
  Origin place;
  for (const char* key : rule.keys) {
    const auto origin = written_for(s, key);
    if (!origin) continue;
    if (origin->set) return *origin;
    if (place.preset()) place = *origin;
  }
  if (place.preset() && is_of_nodes(s, rule.keys.front())) return written_at(s.source, "scenario." + s.name).value_or(place);
  return place;
}

Problem problem_of(const Subject& s, const Rule& rule, const std::string& fault) {
  const Origin place = place_of(s, rule);
  return {place.set ? kSettingPlace : s.source.file.string(),
          place.line,
          place.column,
          label_of(s, rule),
          cut(value_of(s, rule.keys.front())),
          fault};
}

std::string scenarios_text(const std::vector<std::string>& names) {
  std::string text;
  const std::size_t shown = names.size() > kMostNames ? kMostNames - 1 : names.size();
  for (std::size_t i = 0; i < shown; ++i) text += (i == 0 ? "" : ", ") + names[i];
  if (shown < names.size()) text += " and " + std::to_string(names.size() - shown) + " more";
  return (names.size() == 1 ? " (scenario " : " (scenarios ") + text + ")";
}

// What is said alike of several scenarios, of one place, is said once, with their names; a key of a scenario has its name already.
std::vector<Problem> joined(const std::vector<Doubt>& doubts) {
  std::vector<std::pair<Doubt, std::vector<std::string>>> groups;
  for (const Doubt& doubt : doubts) {
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const auto& group) {
      const Problem& first = group.first.problem;
      return group.first.rule == doubt.rule && first.line == doubt.problem.line && first.column == doubt.problem.column;
    });
    if (same == groups.end()) {
      groups.push_back({doubt, {doubt.scenario}});
    } else if (same->second.back() != doubt.scenario) {
      same->second.push_back(doubt.scenario);
    }
  }
  std::vector<Problem> problems;
  for (auto& [doubt, names] : groups) {
    const bool named = names.size() == 1 && (names[0].empty() || doubt.problem.key.rfind("scenario.", 0) == 0);
    if (!named) doubt.problem.expected += scenarios_text(names);
    problems.push_back(doubt.problem);
  }
  return problems;
}

// One pass over the rules that need, or do not need, the target.
class Check {
 public:
  Check(MissionSource& source, const TargetSize* target) : source_(source), target_(target), broken_(all_rules().size()) {}

  std::vector<Problem> run() {
    ask("");
    for (const auto& [name, scenario] : source_.scenarios) {
      if (errors_.empty() || !errors_.front().scenario.empty()) ask(name);
    }
    return joined(errors_);
  }

 private:
  void ask(const std::string& scenario) {
    Subject subject = subject_of(source_, scenario);
    subject.target = target_;
    const std::vector<SensorInUse> sensors = sensors_in_use(source_, subject.p, subject.scenario);
    for (std::size_t i = 0; i < all_rules().size(); ++i) {
      if (!is_asked(i, subject)) continue;
      if (all_rules()[i].scope == Scope::kSensor) {
        look(i, subject, sensors);
      } else {
        look(i, subject);
      }
    }
  }

  // What the mission breaks by itself is not said of its scenarios again.
  bool is_asked(std::size_t number, const Subject& subject) const {
    const Rule& rule = all_rules()[number];
    if ((rule.needs == Needs::kTarget) != (target_ != nullptr)) return false;
    if (subject.scenario == nullptr) return rule.scope != Scope::kScenario;
    if (rule.scope == Scope::kScenario) return true;
    if (rule.scope == Scope::kMission || broken_[number]) return false;
    return rule.scope == Scope::kSensor || overrides_any(subject, rule);
  }

  void look(std::size_t number, Subject subject, const std::vector<SensorInUse>& sensors) {
    for (const SensorInUse& sensor : sensors) {
      subject.sensor = &sensor;
      look(number, subject);
    }
  }

  void look(std::size_t number, const Subject& subject) {
    const Rule& rule = all_rules()[number];
    const std::string fault = rule.fault(subject);
    if (fault.empty()) return;
    if (subject.scenario == nullptr) broken_[number] = true;
    (rule.severity == Severity::kError ? errors_ : source_.doubts).push_back({number, subject.name, problem_of(subject, rule, fault)});
  }

  MissionSource& source_;
  const TargetSize* target_;
  std::vector<bool> broken_;
  std::vector<Doubt> errors_;
};

TargetSize target_size(const Mesh& mesh) {
  TargetSize size{mesh.vertices.at(0), mesh.vertices.at(0)};
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    size.low = size.low.cwiseMin(vertex);
    size.high = size.high.cwiseMax(vertex);
  }
  return size;
}

}  // namespace

const Rules& all_rules() {
  static const Rules rules = [] {
    Rules all;
    for (const Rules& some : {scan_rules(), estimation_rules(), sensor_rules(), scenario_rules(), scene_rules(), target_rules()})
      all.insert(all.end(), some.begin(), some.end());
    return all;
  }();
  return rules;
}

std::vector<Problem> check_rules(MissionSource& source, const TargetSize* target) { return Check(source, target).run(); }

void check_target(MissionSource& source, const Mesh& target) {
  const TargetSize size = target_size(target);
  const std::vector<Problem> problems = check_rules(source, &size);
  if (!problems.empty()) throw MissionError(problems);
}

std::vector<std::string> warnings_for(const MissionSource& source, const std::string& scenario) {
  std::vector<std::string> warnings = source.warnings;
  std::vector<Doubt> doubts;
  for (const Doubt& doubt : source.doubts) {
    if (scenario.empty() || doubt.scenario.empty() || doubt.scenario == scenario) doubts.push_back(doubt);
  }
  for (const Problem& problem : joined(doubts)) warnings.push_back(to_string(problem));
  return warnings;
}

void normalize_attitude(MissionParameters& parameters) {
  const Eigen::Vector4d q(parameters.initial_qx, parameters.initial_qy, parameters.initial_qz, parameters.initial_qw);
  const double length = q.norm();
  parameters.initial_qx /= length;
  parameters.initial_qy /= length;
  parameters.initial_qz /= length;
  parameters.initial_qw /= length;
}

}  // namespace lasso::mdat
