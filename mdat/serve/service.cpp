#include "mdat/serve/service.hpp"

#include <nlohmann/json.hpp>

#include "mdat/common/errors.hpp"
#include "mdat/common/version.hpp"
#include "mdat/missiondb/mission_schema.hpp"
#include "mdat/serve/design_answers.hpp"
#include "mdat/serve/first_run.hpp"
#include "mdat/serve/live_answers.hpp"
#include "mdat/source/mission_error.hpp"

namespace lasso::mdat::serve {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Response unknown(const Target& target) { return error_response(404, "there is no " + target.path.substr(0, 120), "see docs/serve.md"); }

constexpr char kNoToken[] =
    "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>mdat serve</title><h1>The address is not whole</h1>"
    "<p>Open the address that <code>mdat serve</code> printed, with its token.</p></html>\n";

// For a person, at the page; for programs, elsewhere.
Response no_token(const Target& target) {
  if (target.parts.empty()) return {401, "text/html; charset=utf-8", kNoToken, {}};
  return error_response(401, "this needs the token", "open the address that mdat serve printed, or send Authorization: Bearer TOKEN");
}

using RecordingAnswer = Response (*)(const Shown&, const Target&);
struct RecordingRoute {
  const char* name;
  RecordingAnswer answer;
};
constexpr RecordingRoute kRoutes[] = {{"frames", frames_answer},
                                      {"series", series_answer},
                                      {"statistics", statistics_answer},
                                      {"events", events_answer},
                                      {"model.glb", [](const Shown& shown, const Target&) { return model_answer(shown); }},
                                      {"csv", csv_answer}};

}  // namespace

std::optional<Response> Service::refuse(const Request& request, const Target& target) const {
  const std::string token = text_in(target, "token");
  const bool entering = target.parts.empty() && !token.empty();
  if (entering && gate_.is_token(token)) return gate_.welcome();
  if (entering || !gate_.knows(request)) return no_token(target);
  return std::nullopt;
}

Response Service::answer(const Request& request) {
  try {
    if (const std::optional<Response> refusal = gate_.refuse(request)) return *refusal;
    const std::optional<Target> target = parse_target(request.target);
    if (!target) return error_response(400, "the address is none", "correct it");
    if (const std::optional<Response> refusal = refuse(request, *target)) return *refusal;
    return route(request, *target);
  } catch (const Refusal& refusal) {
    return error_response(refusal.status, refusal.what, refusal.remedy);
  } catch (const std::exception& error) {
    return error_response(500, error.what(), "tell the makers of mdat, with what you did");
  }
}

std::size_t Service::body_limit(const Request& head) {
  const bool known = design_ && !gate_.refuse(head) && gate_.knows(head);
  return known ? body_limit_of(head) : kMaxBodyBytes;
}

SocketOpening Service::open(const Request& request) {
  SocketOpening opening;
  Request checked = request;
  checked.method = Method::kGet;
  opening.refusal = gate_.refuse(checked);
  if (!opening.refusal && !gate_.knows(checked)) opening.refusal = error_response(401, "this needs the token", "open the page first");
  const bool live = options_.live != nullptr && request.target == "/api/live/socket";
  if (!opening.refusal && live) return live_opening(*options_.live);
  if (!opening.refusal) opening.refusal = error_response(404, "no socket is served here", "see docs/serve.md");
  return opening;
}

Response Service::route(const Request& request, const Target& target) {
  const bool reads = request.method == Method::kGet || request.method == Method::kHead;
  const bool room = target.path.rfind("/api/live/", 0) == 0 || target.path.rfind("/api/mission/", 0) == 0;
  const bool acts = options_.live != nullptr && target.parts.size() == 3 && room;
  const bool begins = request.method == Method::kPost && (target.path == "/api/recordings/first" || acts);
  if (!reads && !begins) {
    Response response = error_response(405, "this cannot be done here", "use GET");
    response.headers = {{"Allow", "GET, HEAD"}};
    return response;
  }
  if (!target.parts.empty() && target.parts.front() == "api") return route_api(request, target);
  return page_answer(options_.files, target.path, request);
}

Response Service::route_api(const Request& request, const Target& target) {
  const std::vector<std::string>& parts = target.parts;
  if (parts.size() == 2 && parts[1] == "about") return about();
  if (parts.size() == 2 && parts[1] == "recordings") return recordings();
  if (parts.size() >= 2 && parts[1] == "live" && options_.live != nullptr) return live_answer(*options_.live, request, target);
  if (parts.size() == 2 && parts[1] == "schema") return json_response(mission_schema_text());
  if (parts.size() >= 2 && parts[1] == "mission" && design_) return design_answer(*design_, request, target);
  if (parts.size() == 3 && parts[1] == "jobs") return job(parts[2]);
  if (request.method == Method::kPost) return first();
  if (parts.size() >= 3 && parts[1] == "recordings") return route_recording(target);
  return unknown(target);
}

Response Service::route_recording(const Target& target) {
  const std::string& id = target.parts[2];
  std::shared_ptr<const Recording> recording = options_.live != nullptr ? options_.live->recording(id) : nullptr;
  if (!recording) recording = folder_.recording(id);
  const Shown shown{id, recording->file().path().lexically_relative(folder_.path()).string(), recording};
  if (target.parts.size() == 3) return summary_answer(shown);
  if (target.parts.size() > 4 && target.parts[3] == "frames") return route_frame(shown, target);
  for (const RecordingRoute& row : kRoutes) {
    if (target.parts.size() == 4 && target.parts[3] == row.name) return row.answer(shown, target);
  }
  return unknown(target);
}

Response Service::route_frame(const Shown& shown, const Target& target) {
  const std::optional<std::size_t> n = count_of(target.parts[4]);
  const std::size_t frames = shown.recording->frames().size();
  if (!n || *n >= frames)
    return error_response(404, "there is no frame " + target.parts[4].substr(0, 40),
                          "its frames are 0 to " + std::to_string(frames) + " less one");
  if (target.parts.size() == 5) return frame_answer(shown, *n);
  return target.parts.size() == 6 && target.parts[5] == "scan" ? scan_answer(shown, *n, target) : unknown(target);
}

Response Service::about() const {
  const std::optional<std::filesystem::path> mission = first_mission();
  const Json first =
      mission ? Json{{"mission", kFirstMission}, {"scenario", kFirstScenario}, {"command", first_command(*mission, folder_.path())}}
              : Json();
  return json_response(
      text_of({{"version", kVersion},
               {"commit", options_.commit},
               {"folder", folder_.path().string()},
               {"features", options_.live != nullptr ? Json::array({"replay", "live", "design"}) : Json::array({"replay"})},
               {"first", first}}));
}

Response Service::recordings() {
  Json list = Json::array();
  for (const RecordingEntry& entry : folder_.list()) {
    list.push_back(
        {{"id", entry.id}, {"name", entry.name}, {"size_bytes", entry.size_bytes}, {"modified", entry.modified_s}, {"open", entry.open}});
    if (!entry.error.empty()) list.back()["error"] = entry.error;
  }
  return json_response(text_of(list));
}

Response Service::first() {
  const std::filesystem::path file = folder_.path() / kFirstName;
  if (std::filesystem::exists(file)) return json_response(text_of({{"id", folder_.id_of(file)}}));
  const std::optional<std::filesystem::path> mission = first_mission();
  if (!mission) throw Refusal{404, "the shipped mission hubble_tenth is not there", "run mdat serve in the sources' folder, or install it"};
  const std::string job = jobs_.begin("recording the tenth-scale Hubble", [this, mission, file](const Jobs::Tell& tell) {
    record_first(*mission, folder_.path(), options_.commit, [&](double done) { tell(done, "tracking the tenth-scale Hubble"); });
    return folder_.id_of(file);
  });
  Response response = json_response(text_of({{"job", job}}));
  response.status = 202;
  return response;
}

Response Service::job(const std::string& id) const {
  JobState state;
  if (!jobs_.find(id, state)) throw Refusal{404, "there is no job " + id.substr(0, 40), "begin it again"};
  Json json = {{"done", state.done}, {"text", state.text}};
  if (!state.result.empty()) json["id"] = state.result;
  if (!state.error.empty()) json["error"] = state.error;
  return json_response(text_of(json));
}

}  // namespace lasso::mdat::serve
