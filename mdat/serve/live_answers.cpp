#include "mdat/serve/live_answers.hpp"

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "mdat/missiondb/mission_source.hpp"
#include "mdat/serve/json_body.hpp"
#include "mdat/source/mission_error.hpp"

namespace lasso::mdat::serve {
namespace {

using AskedJson = nlohmann::ordered_json;

std::string live_json(const AskedJson& json) { return json.dump(-1, ' ', false, AskedJson::error_handler_t::replace); }

std::string optional_text(const AskedJson& body, const char* name) {
  const auto found = body.find(name);
  return found == body.end() || found->is_null() ? "" : body_text(body, name);
}

double pace_of(const AskedJson& body) {
  const auto found = body.find("pace");
  if (found == body.end()) return 1;
  const double pace = found->is_number() ? found->get<double>() : -1;
  if (!(pace >= 0 && pace <= kMostPace)) throw Refusal{400, "pace: expected 0 (as fast as it goes) to 1000", "correct it"};
  return pace;
}

std::optional<std::uint64_t> seed_of(const AskedJson& body) {
  constexpr double kMostSeed = 4294967295;
  const auto found = body.find("seed");
  if (found == body.end() || found->is_null()) return std::nullopt;
  const double seed = found->is_number() ? found->get<double>() : -1;
  if (!(seed >= 0 && seed <= kMostSeed) || seed != std::floor(seed))
    throw Refusal{400, "seed: expected a whole number from 0 to 4294967295", "correct it"};
  return static_cast<std::uint64_t>(seed);
}

Response missions_answer(const Live& live) {
  AskedJson list = AskedJson::array();
  for (const LiveMission& mission : live.missions())
    list.push_back({{"id", mission.id}, {"file", mission.file.string()}, {"shipped", mission.shipped}});
  return json_response(live_json(list));
}

// What it can fly. A mission that cannot be read says so by its own words.
Response scenarios_answer(const Live& live, const std::string& id) {
  const LiveMission mission = live.mission(id);
  AskedJson list = AskedJson::array();
  try {
    for (const auto& [name, scenario] : load_mission(mission.file).scenarios)
      list.push_back({{"name", name}, {"frames", scenario.frames}, {"runs", scenario.runs_m().size()}, {"seed", scenario.seed}});
  } catch (const MissionError& error) {
    throw Refusal{422, error.what(), "mend the mission: mdat mission check says the same"};
  }
  return json_response(live_json({{"id", mission.id}, {"scenarios", list}}));
}

struct LiveAct {
  const char* name;
  void (*act)(Live& live, const AskedJson& body);
};
constexpr LiveAct kActs[] = {
    {"start",
     [](Live& live, const AskedJson& body) {
       live.start({body_text(body, "mission"), body_text(body, "scenario"), seed_of(body), pace_of(body)});
     }},
    {"connect",
     [](Live& live, const AskedJson& body) {
       live.connect({body_text(body, "address"), optional_text(body, "mission")});
     }},
    {"command", [](Live& live, const AskedJson& body) { (void)live.command(command_order(body)); }},
    {"pause", [](Live& live, const AskedJson&) { live.pause(); }},
    {"resume", [](Live& live, const AskedJson&) { live.resume(); }},
    {"step", [](Live& live, const AskedJson&) { live.step(); }},
    {"pace", [](Live& live, const AskedJson& body) { live.set_pace(pace_of(body)); }},
    {"stop", [](Live& live, const AskedJson&) { live.stop(); }},
};

Response act_answer(Live& live, const Request& request, const Target& target) {
  for (const LiveAct& row : kActs) {
    if (target.parts.size() != 3 || target.parts[2] != row.name) continue;
    row.act(live, json_body(request));
    return json_response(live.state());
  }
  throw Refusal{404, "there is no " + target.path.substr(0, 120), "see docs/serve.md"};
}

class Watching final : public SocketSession {
 public:
  void on_message(std::string_view /*bytes*/, bool /*text*/) override {}
};

}  // namespace

CommandOrder command_order(const AskedJson& body) {
  CommandOrder order;
  order.name = body_text(body, "name");
  order.arm = body.value("arm", AskedJson(false)) == AskedJson(true);
  const AskedJson values = body.value("values", AskedJson::object());
  if (!values.is_object()) throw Refusal{400, "values: an object was expected", "see docs/serve.md"};
  for (const auto& [item, value] : values.items()) {
    if (!value.is_string()) throw Refusal{400, item + ": a text was expected", "see docs/serve.md"};
    order.values[item] = value.get<std::string>();
  }
  return order;
}

Response live_answer(Live& live, const Request& request, const Target& target) {
  const std::vector<std::string>& parts = target.parts;
  if (request.method == Method::kPost) return act_answer(live, request, target);
  if (parts.size() == 2) return json_response(live.state());
  if (parts.size() == 3 && parts[2] == "commands") return json_response(commands_json());
  if (parts.size() == 3 && parts[2] == "missions") return missions_answer(live);
  if (parts.size() == 3 && parts[2] == "scenarios") return scenarios_answer(live, text_in(target, "mission"));
  throw Refusal{404, "there is no " + target.path.substr(0, 120), "see docs/serve.md"};
}

SocketOpening live_opening(Live& live) {
  return {"",
          [&live](const std::shared_ptr<SocketSender>& sender) -> std::unique_ptr<SocketSession> {
            live.watch(sender);
            return std::make_unique<Watching>();
          },
          std::nullopt};
}

}  // namespace lasso::mdat::serve
