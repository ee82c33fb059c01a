#include "mdat/serve/mission_view.hpp"

#include <nlohmann/json.hpp>

#include "mdat/missiondb/mission_diff.hpp"
#include "mdat/missiondb/mission_edit.hpp"
#include "mdat/missiondb/mission_source.hpp"
#include "mdat/missiondb/mission_text.hpp"
#include "mdat/source/mission_error.hpp"

namespace lasso::mdat::serve {
namespace {

using ViewJson = nlohmann::ordered_json;

ViewJson problems_json(const std::vector<Problem>& problems) {
  ViewJson list = ViewJson::array();
  for (const Problem& problem : problems)
    list.push_back({{"line", problem.line},
                    {"column", problem.column},
                    {"key", problem.key},
                    {"value", problem.value},
                    {"expected", problem.expected}});
  return list;
}

ViewJson value_json(const MissionSource& source, const EffectiveValue& value) {
  const auto origin = source.origins.find(value.key);
  return {{"key", value.key},
          {"value", value.value},
          {"unit", value.unit},
          {"place", value.place},
          {"line", origin == source.origins.end() ? 0 : origin->second.line}};
}

// Tables of which the text alone says something: campaigns and materials, whose values are laws and choices.
void add_written(const std::string& text, const std::filesystem::path& file, ViewJson& list) {
  for (const char* table : {"campaign", "material"}) {
    for (const WrittenValueText& value : written_below(text, table, file))
      list.push_back({{"key", value.key},
                      {"value", value.toml},
                      {"unit", ""},
                      {"place", file.filename().string() + ":" + std::to_string(value.line)},
                      {"line", value.line}});
  }
}

ViewJson values_json(const MissionSource& source, const std::string& text) {
  ViewJson list = ViewJson::array();
  for (const EffectiveValue& value : effective_values(source)) {
    if (!value.key.empty()) list.push_back(value_json(source, value));
  }
  for (const EffectiveValue& value : override_values(source)) list.push_back(value_json(source, value));
  add_written(text, source.file, list);
  return list;
}

ViewJson scenarios_json(const MissionSource& source) {
  ViewJson list = ViewJson::array();
  for (const auto& [name, scenario] : source.scenarios)
    list.push_back({{"name", name}, {"frames", scenario.frames}, {"runs", scenario.runs_m().size()}, {"seed", scenario.seed}});
  return list;
}

ViewJson view_of(const std::string& text, const std::filesystem::path& file) {
  try {
    const MissionSource source = load_mission_text(text, file);
    return {{"problems", ViewJson::array()},
            {"warnings", warnings_for(source, "")},
            {"values", values_json(source, text)},
            {"scenarios", scenarios_json(source)}};
  } catch (const MissionError& error) {
    return {{"problems", problems_json(error.problems())}};
  }
}

// null: no settings make the one of the other.
ViewJson settings_json(const std::string& saved, const std::string& text, const std::filesystem::path& file) {
  try {
    const auto settings = settings_between(saved, text, file);
    return settings ? ViewJson(*settings) : ViewJson(nullptr);
  } catch (const MissionError&) {
    return nullptr;
  }
}

}  // namespace

std::string mission_view(const std::string& text, const std::filesystem::path& file, const std::string* saved) {
  ViewJson view = view_of(text, file);
  if (saved != nullptr) view["settings"] = settings_json(*saved, text, file);
  return view.dump(-1, ' ', false, ViewJson::error_handler_t::replace);
}

}  // namespace lasso::mdat::serve
