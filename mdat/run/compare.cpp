#include "mdat/run/compare.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kUnknown = "-";

// A figure of a variant, or of a timeline: where it stands, and how it is written.
struct Row {
  const char* title;
  const char* pointer;
  int decimals;
};
constexpr Row kRows[] = {{"frames", "/frames", 0},
                         {"lost", "/lost", 0},
                         {"valid", "/valid", 0},
                         {"invalid", "/invalid", 0},
                         {"wrong", "/wrong", 0},
                         {"rms, mm", "/rms_mm", 4},
                         {"rms, deg", "/rms_deg", 5},
                         {"worst, mm", "/worst_mm", 3},
                         {"worst, deg", "/worst_deg", 4},
                         {"filter's rms, mm", "/filtered/rms_mm", 4},
                         {"filter's rms, deg", "/filtered/rms_deg", 5},
                         {"settled rates, deg/s", "/settled/rms_degps", 4},
                         {"settled rates, mm/s", "/settled/rms_mmps", 3},
                         {"bound, mm", "/crlb_mm", 4},
                         {"bound, deg", "/crlb_deg", 5},
                         {"NEES (6 is honest)", "/nees", 2},
                         {"times wrong", "/time_to_alert/episodes", 0},
                         {"time to alert, worst s", "/time_to_alert/worst_s", 3},
                         {"misleading", "/protection/misleading", 0},
                         {"protection level, mm", "/protection/position/median_mm", 3},
                         {"protection level, deg", "/protection/attitude/median_deg", 4},
                         {"estimate, median us", "/estimate_us/median", 0},
                         {"estimate, p99 us", "/estimate_us/p99", 0}};

Json parse(const NamedResults& results) {
  Json json = Json::parse(results.json, nullptr, false);
  if (!json.is_object() || !json.contains("mission") || !json.contains("scenario"))
    throw InputError(results.name + ": not the results of mdat run; give its folder, or the results.json in it");
  return json;
}

// Aligned columns: the second and third, and what follows, are as wide as the widest entry.
std::string aligned(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string space(widths[i] - row[i].size(), ' ');
      text += "  " + (i == 0 ? row[i] + space : space + row[i]);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text += "\n";
  }
  return text;
}

std::string value_text(const Json& object, const std::string& key) {
  if (!object.contains(key)) return kUnknown;
  const Json& value = object.at(key);
  return value.is_string() ? value.get<std::string>() : value.dump();
}

// What each run is of, with what the command line said.
const char* const kHead[] = {"mission", "scenario", "seed", "frames", "version", "commit", "sensor"};

// By key; a scenario's keys without its name, so that those of two scenarios stand beside each other.
Json settings_of(const Json& results) {
  Json settings = Json::object();
  if (!results.contains("settings")) return settings;
  const std::string prefix = "scenario.", own = prefix + value_text(results, "scenario") + ".";
  for (const auto& item : results.at("settings").items()) {
    const bool is_own = item.key().rfind(own, 0) == 0;
    settings[is_own ? prefix + item.key().substr(own.size()) : item.key()] = item.value();
  }
  return settings;
}

std::string aligned_settings(std::vector<std::vector<std::string>> rows) {
  if (rows.empty()) return "settings: all the same\n";
  rows.insert(rows.begin(), {"settings that differ", "A", "B"});
  return aligned(rows);
}

std::string settings_text(const Json& a, const Json& b) {
  std::vector<std::vector<std::string>> rows;
  const auto add = [&rows](const std::string& key, const std::string& of_a, const std::string& of_b) {
    if (of_a != of_b) rows.push_back({key, of_a, of_b});
  };
  for (const char* key : kHead) add(key, value_text(a, key), value_text(b, key));
  const Json of_a = settings_of(a), of_b = settings_of(b);
  if (of_a.empty() || of_b.empty()) add("settings", of_a.empty() ? "not recorded" : "recorded", of_b.empty() ? "not recorded" : "recorded");
  if (of_a.empty() || of_b.empty()) return aligned_settings(std::move(rows));
  for (const auto& item : of_a.items()) add(item.key(), value_text(of_a, item.key()), value_text(of_b, item.key()));
  for (const auto& item : of_b.items()) {
    if (!of_a.contains(item.key())) add(item.key(), kUnknown, value_text(of_b, item.key()));
  }
  return aligned_settings(std::move(rows));
}

std::optional<double> number_at(const Json& object, const char* pointer) {
  const Json::json_pointer place(pointer);
  if (!object.contains(place) || !object.at(place).is_number()) return std::nullopt;
  return object.at(place).get<double>();
}

std::string figure_text(std::optional<double> value, int decimals_wanted) { return value ? decimals(*value, decimals_wanted) : kUnknown; }

std::string ratio_text(std::optional<double> a, std::optional<double> b) {
  return a && b && *a > 0 ? format("%.3g", *b / *a) : std::string(kUnknown);
}

// The rows of which either knows something.
std::string part_text(const std::string& title, const Json& a, const Json& b) {
  std::vector<std::vector<std::string>> rows = {{title, "A", "B", "B/A"}};
  for (const Row& row : kRows) {
    const std::optional<double> of_a = number_at(a, row.pointer), of_b = number_at(b, row.pointer);
    if (of_a || of_b) rows.push_back({row.title, figure_text(of_a, row.decimals), figure_text(of_b, row.decimals), ratio_text(of_a, of_b)});
  }
  return aligned(rows);
}

bool is_part(const Json& value) { return value.is_object() && value.contains("frames"); }

// Variants and timelines, those of the table without tilt as side_on/NAME, in the order of the results.
void collect_parts(const Json& results, const std::string& prefix, std::vector<std::pair<std::string, Json>>& parts) {
  for (const auto& item : results.items()) {
    if (is_part(item.value())) parts.emplace_back(prefix + item.key(), item.value());
    if (item.key() == "side_on" && !is_part(item.value())) collect_parts(item.value(), "side_on/", parts);
  }
}

const Json* find(const std::vector<std::pair<std::string, Json>>& parts, const std::string& name) {
  const auto found = std::find_if(parts.begin(), parts.end(), [&](const auto& part) { return part.first == name; });
  return found == parts.end() ? nullptr : &found->second;
}

std::string parts_text(const Json& a, const Json& b) {
  std::vector<std::pair<std::string, Json>> of_a, of_b;
  collect_parts(a, "", of_a);
  collect_parts(b, "", of_b);
  const Json none = Json::object();
  std::string text;
  for (const auto& [name, part] : of_a) {
    const Json* other = find(of_b, name);
    text += "\n" + part_text(name + (other == nullptr ? " (in A alone)" : ""), part, other == nullptr ? none : *other);
  }
  for (const auto& [name, part] : of_b) {
    if (find(of_a, name) == nullptr) text += "\n" + part_text(name + " (in B alone)", none, part);
  }
  return text;
}

}  // namespace

NamedResults load_results(const std::string& name) {
  std::filesystem::path file = name;
  if (std::filesystem::is_directory(file)) file /= "results.json";
  return {name, file_content(file)};
}

std::string comparison_text(const NamedResults& a, const NamedResults& b) {
  const Json of_a = parse(a), of_b = parse(b);
  return "A: " + a.name + "\nB: " + b.name + "\n\n" + settings_text(of_a, of_b) + parts_text(of_a, of_b);
}

}  // namespace lasso::mdat
