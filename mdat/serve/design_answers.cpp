#include "mdat/serve/design_answers.hpp"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

#include "mdat/missiondb/new_mission.hpp"
#include "mdat/serve/begun_mission.hpp"
#include "mdat/serve/json_body.hpp"
#include "mdat/serve/mission_view.hpp"
#include "mdat/serve/preview_answer.hpp"

namespace lasso::mdat::serve {
namespace {

using DesignJson = nlohmann::ordered_json;

std::string design_json(const DesignJson& json) { return json.dump(-1, ' ', false, DesignJson::error_handler_t::replace); }

// With the settings that make it of the text that the body says was saved, where it says one.
DesignJson view_json(const LiveMission& mission, const std::string& text, const DesignJson& body = DesignJson::object()) {
  const std::string saved = body.contains("saved") ? body_text(body, "saved") : "";
  return DesignJson::parse(mission_view(text, mission.file, body.contains("saved") ? &saved : nullptr));
}

std::vector<std::string> words_of(const DesignJson& body, const char* name) {
  const auto found = body.find(name);
  if (found == body.end() || !found->is_array()) throw Refusal{400, std::string(name) + ": a list was expected", "see docs/serve.md"};
  std::vector<std::string> words;
  for (const DesignJson& word : *found) {
    if (!word.is_string()) throw Refusal{400, std::string(name) + ": a list of texts was expected", "see docs/serve.md"};
    words.push_back(word.get<std::string>());
  }
  return words;
}

Response opened(const Design& design, const LiveMission& mission) {
  const MissionText text = design.open(mission);
  DesignJson json{
      {"id", mission.id}, {"file", mission.file.string()}, {"shipped", mission.shipped}, {"digest", text.digest}, {"text", text.text}};
  json.update(view_json(mission, text.text));
  return json_response(design_json(json));
}

std::optional<SensorKind> sensor_in(const Target& target) {
  const std::string name = text_in(target, "sensor");
  if (name.empty()) return std::nullopt;
  const auto found = std::find(std::begin(kSensorKindNames), std::end(kSensorKindNames), name);
  if (found == std::end(kSensorKindNames)) throw Refusal{400, "sensor: there is no such kind", "see docs/serve.md"};
  return static_cast<SensorKind>(found - std::begin(kSensorKindNames));
}

// The bounds of mdat mission new.
std::size_t simplify_in(const Target& target) {
  constexpr std::size_t kFewest = 4, kMost = 500000;
  if (text_in(target, "simplify") == "chosen") return kSimplifyChosen;
  const std::size_t triangles = count_in(target, "simplify", 0, kMost);
  if (triangles > 0 && triangles < kFewest) throw Refusal{400, "simplify: expected 4 to 500000 triangles", "correct it"};
  return triangles;
}

Response begun(const Design& design, const Request& request, const Target& target) {
  if (request.header("content-type") != "application/octet-stream")
    throw Refusal{415, "the body has another type", "send the file's bytes, as Content-Type: application/octet-stream"};
  const MeshOrder order{text_in(target, "name"), text_in(target, "file"),         request.body,
                        sensor_in(target),       number_in(target, "scale", 1.0), simplify_in(target)};
  const BegunMission mission = begin_mission(design.folder(), order);
  return json_response(design_json({{"id", mission.id}, {"remarks", mission.remarks}, {"command", mission.command}}));
}

std::size_t body_count(const DesignJson& body, const char* name) {
  const auto found = body.find(name);
  return found != body.end() && found->is_number_unsigned() ? found->get<std::size_t>() : 0;
}

struct DesignAct {
  const char* name;
  DesignJson (*act)(Design& design, const LiveMission& mission, const DesignJson& body);
};
constexpr DesignAct kDesignActs[] = {
    {"look", [](Design&, const LiveMission& mission, const DesignJson& body) { return view_json(mission, body_text(body, "text"), body); }},
    {"preview",
     [](Design&, const LiveMission& mission, const DesignJson& body) {
       return DesignJson::parse(preview_json(mission, body_text(body, "text"), body_text(body, "scenario"), body_count(body, "run")));
     }},
    {"set",
     [](Design&, const LiveMission& mission, const DesignJson& body) {
       const std::string text = Design::set(mission, body_text(body, "text"), words_of(body, "set"));
       DesignJson json{{"text", text}};
       json.update(view_json(mission, text, body));
       return json;
     }},
    {"save",
     [](Design& design, const LiveMission& mission, const DesignJson& body) {
       return DesignJson{{"digest", design.save(mission, body_text(body, "text"), body_text(body, "digest"))}};
     }},
    {"copy",
     [](Design& design, const LiveMission& mission, const DesignJson& body) {
       return DesignJson{{"id", design.copy(mission, body_text(body, "name"))}};
     }},
};

}  // namespace

Response design_answer(Design& design, const Request& request, const Target& target) {
  const bool acts = request.method == Method::kPost;
  if (!acts && target.parts.size() == 2) return opened(design, design.mission(text_in(target, "id")));
  if (acts && target.parts.size() == 3 && target.parts[2] == "new") return begun(design, request, target);
  if (acts && target.parts.size() == 3 && target.parts[2] == "surface")
    return mission_surface(design.mission(text_in(target, "id")), body_text(json_body(request), "text"));
  for (const DesignAct& row : kDesignActs) {
    if (!acts || target.parts.size() != 3 || target.parts[2] != row.name) continue;
    const DesignJson body = json_body(request);
    return json_response(design_json(row.act(design, design.mission(text_in(target, "id")), body)));
  }
  throw Refusal{404, "there is no " + target.path.substr(0, 120), "see docs/serve.md"};
}

}  // namespace lasso::mdat::serve
