#include "mdat/missiondb/mission_edit.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

#include "mdat/cli/commands.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/text.hpp"
#include "mdat/missiondb/key_facts.hpp"
#include "mdat/missiondb/mission_diff.hpp"
#include "mdat/missiondb/old_keys.hpp"
#include "mdat/source/nearest.hpp"

namespace lasso::mdat {
namespace {

using TextLines = std::vector<std::vector<std::string>>;

void print_lines(const std::string& text) { std::fputs(text.c_str(), stdout); }

// --- explain

struct ExplainOptions {
  std::string key, mission, scenario;
};

void add_line(TextLines& lines, const std::string& name, const std::string& text) {
  if (!text.empty()) lines.push_back({"  " + name, text});
}

std::string with_unit(const std::string& value, const std::string& unit) { return unit.empty() ? value : value + " " + unit; }

std::string joined_texts(const std::vector<std::string>& texts) {
  std::string joined;
  for (const std::string& text : texts) joined += (joined.empty() ? "" : ", ") + text;
  return joined;
}

// A form of the key.
TextLines lines_of_form(const KeyFacts& facts) {
  TextLines lines;
  add_line(lines, "means", facts.meaning);
  add_line(lines, "may be", facts.expected);
  add_line(lines, "preset", facts.preset.empty() ? "" : with_unit(facts.preset, facts.unit));
  return lines;
}

// What the mission has there, and which scenarios have something else.
void add_values(TextLines& lines, const ExplainOptions& options) {
  const MissionSource source = load_mission(options.mission);
  const auto value_in = [&](const std::string& scenario) -> std::optional<EffectiveValue> {
    for (const EffectiveValue& value : effective_values(source, scenario)) {
      if (value.key == options.key) return value;
    }
    return std::nullopt;
  };
  const std::optional<EffectiveValue> own = value_in(options.scenario);
  add_line(lines, "is", own ? with_unit(own->value, own->unit) + "  (" + own->place + ")" : "not written in " + options.mission);
  for (const auto& [name, scenario] : source.scenarios) {
    if (!options.scenario.empty() || scenario.overrides.count(options.key) == 0) continue;
    const std::optional<EffectiveValue> over = value_in(name);
    if (over) add_line(lines, "in " + name, with_unit(over->value, over->unit) + "  (" + over->place + ")");
  }
}

// What a table has, in short: "pattern, points, ..."
std::string names_in(const std::string& table) {
  constexpr std::size_t kMost = 8;
  const std::vector<KeyFacts> keys = keys_in(table);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(keys.size(), kMost); ++i) names.push_back(keys[i].key.substr(table.size() + 1));
  return joined_texts(names) + (keys.size() > kMost ? ", ..." : "");
}

std::string table_text(const std::string& table) {
  TextLines lines;
  for (const KeyFacts& facts : keys_in(table)) {
    const std::string meaning = facts.meaning.empty() && facts.table ? names_in(facts.key) : facts.meaning;
    lines.push_back({facts.key, facts.preset.empty() ? "" : with_unit(facts.preset, facts.unit), meaning});
  }
  return aligned_text(lines);
}

[[noreturn]] void refuse_key(const std::string& key) {
  const std::string old = remedy_of_old_key(key);
  if (!old.empty()) throw InputError("mission explain: " + key + ": " + old);
  std::vector<std::string> keys = all_keys();
  for (const KeyFacts& facts : keys_in("")) keys.push_back(facts.key);
  const std::string last = key.substr(key.rfind('.') == std::string::npos ? 0 : key.rfind('.') + 1);
  const auto same = std::find_if(keys.begin(), keys.end(), [&](const std::string& known) {
    return known.size() > last.size() && known.compare(known.size() - last.size() - 1, last.size() + 1, "." + last) == 0;
  });
  throw InputError("mission explain: " + key + ": unknown key" +
                   (same == keys.end() ? did_you_mean(key, keys) : "; did you mean " + *same + "?") +
                   "; mdat mission explain lists the tables of a mission");
}

void explain(const ExplainOptions& options) {
  if (options.key.empty()) return print_lines(table_text(""));
  const std::vector<KeyFacts> forms = facts_of(options.key);
  if (forms.empty()) refuse_key(options.key);
  if (forms.front().table) return print_lines(table_text(options.key));
  TextLines lines;
  for (const KeyFacts& form : forms) {
    for (const std::vector<std::string>& line : lines_of_form(form)) {
      if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
    }
  }
  if (!options.mission.empty()) add_values(lines, options);
  add_line(lines, "checked with", joined_texts(checked_with(options.key)));
  print_lines(options.key + "\n" + aligned_text(lines));
}

void add_explain_command(CLI::App& mission) {
  const auto options = std::make_shared<ExplainOptions>();
  CLI::App* command = mission.add_subcommand(
      "explain", "say what a key means, what it may be, and what a mission has there; without a key, which tables there are");
  command->add_option("KEY", options->key, "dotted, such as scan.points, scan, scenario.spin.ranges_m or motion.NAME.kind");
  command->add_option("MISSION", options->mission, "mission file");
  command->add_option("--scenario", options->scenario, "as this scenario has it");
  command->callback([options] { explain(*options); });
}

// --- set

struct SetOptions {
  std::string mission;
  std::vector<std::string> settings;
  bool dry_run = false;
};

// The mission as it would be. Its problems name this command in place of --set, which nobody has typed.
MissionSource changed_mission(const SetOptions& options) {
  try {
    return load_mission(options.mission, options.settings);
  } catch (const MissionError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems) {
      if (problem.file == kSettingPlace) problem.file = "mission set";
    }
    throw MissionError(problems);
  }
}

// Written once the changed mission is known to be one.
void set_values(const SetOptions& options) {
  if (is_image_file(options.mission))
    throw InputError(options.mission +
                     ": a flight image: set values in the mission file that it was compiled from, or compile it with --set");
  const MissionSource source = changed_mission(options);
  const std::filesystem::path file = std::filesystem::canonical(options.mission);  // a link stays one
  std::string text = file_content(file), changes;
  for (const std::string& setting : options.settings) {
    const std::string next = edited(text, {setting}, options.mission);
    changes += changed_lines(text, next);
    text = next;
  }
  if (changes.empty()) return print_lines(options.mission + ": says so already\n");
  if (!options.dry_run) write_file(file, text);
  print_lines(changes + options.mission + (options.dry_run ? ": would change so\n" : ": written\n"));
  for (const std::string& warning : warnings_for(source, "")) std::fprintf(stderr, "warning: %s\n", warning.c_str());
}

void add_set_command(CLI::App& mission) {
  const auto options = std::make_shared<SetOptions>();
  CLI::App* command = mission.add_subcommand("set",
                                             "change values in a mission file; comments and all else stay, and a mission that is not "
                                             "valid is not written");
  command->add_option("MISSION", options->mission, "mission file")->required();
  command->add_option("KEY=VALUE", options->settings, "as for --set: scan.points=512, scan.pattern=lissajous, 'initial.position_m=[0,0,4]'")
      ->required();
  command->add_flag("--dry-run", options->dry_run, "print the lines that would change, and write nothing");
  command->callback([options] { set_values(*options); });
}

// --- diff

struct DiffOptions {
  std::string first, second, scenario;
};

std::vector<EffectiveValue> parameters_only(const std::vector<EffectiveValue>& values, const std::vector<EffectiveValue>& parameters) {
  std::vector<EffectiveValue> result;
  for (const EffectiveValue& value : values) {
    const auto is_it = [&](const EffectiveValue& parameter) { return parameter.key == value.key; };
    if (std::any_of(parameters.begin(), parameters.end(), is_it)) result.push_back(value);
  }
  return result;
}

void append(std::vector<EffectiveValue>& values, const std::vector<EffectiveValue>& more) {
  values.insert(values.end(), more.begin(), more.end());
}

// An image's number and version, and its flight parameters.
std::vector<EffectiveValue> values_of_image(const std::string& file) {
  const LoadedImage image(file, read_bytes(file));
  std::vector<EffectiveValue> values = identity_values(image.mission().id, image.mission().version);
  append(values, values_of(image.mission().parameters));
  return values;
}

// Of a mission also its name, what its scenarios override, its campaigns as they are written, and the digest of its target.
std::vector<EffectiveValue> values_of_file(const std::string& file, const std::string& scenario) {
  if (is_image_file(file)) return values_of_image(file);
  const MissionSource source = load_mission(file);
  std::vector<EffectiveValue> values = identity_values(source.id, source.version);
  values.push_back({"mission.name", '"' + source.name + '"', "", "", ""});
  append(values, effective_values(source, scenario));
  values.push_back({"target.sha256", source.target.sha256.substr(0, 12), "", "", ""});
  if (!scenario.empty()) return values;
  append(values, override_values(source));
  for (const WrittenValueText& law : written_below(file_content(file), "campaign", file)) values.push_back({law.key, law.toml, "", "", ""});
  return values;
}

std::string changes_text(const DiffOptions& options, const std::vector<ValueChange>& changes) {
  if (changes.empty()) return "no value differs\n";
  TextLines lines{{"", options.first, options.second}};
  for (const ValueChange& change : changes) {
    const auto shown = [&](const std::string& value) { return value.empty() ? "-" : with_unit(value, change.unit); };
    lines.push_back({change.key, shown(change.first), shown(change.second)});
  }
  return aligned_text(lines);
}

// Of an image not all that it has is compared.
void diff(const DiffOptions& options) {
  std::vector<EffectiveValue> first = values_of_file(options.first, options.scenario);
  std::vector<EffectiveValue> second = values_of_file(options.second, options.scenario);
  const bool images[] = {is_image_file(options.first), is_image_file(options.second)};
  if (images[1]) first = parameters_only(first, second);
  if (images[0]) second = parameters_only(second, first);
  print_lines(changes_text(options, changes_between(first, second)));
  if (images[0] || images[1])
    print_lines(
        "compared: mission.id, mission.version and flight parameters; not an image's model, parts, calibrations and named frames\n");
}

void add_diff_command(CLI::App& mission) {
  const auto options = std::make_shared<DiffOptions>();
  CLI::App* command = mission.add_subcommand("diff", "print the values that differ between two missions or flight images, in their units");
  command->add_option("A", options->first, "mission file or flight image")->required();
  command->add_option("B", options->second, "the other one")->required();
  command->add_option("--scenario", options->scenario, "with this scenario's overrides of parameters, in both");
  command->footer("Exit codes: 0 printed, whatever differs; 2 one of the two cannot be read.");
  command->callback([options] { diff(*options); });
}

}  // namespace

void add_mission_edits(CLI::App& mission) {
  add_explain_command(mission);
  add_set_command(mission);
  add_diff_command(mission);
}

}  // namespace lasso::mdat
