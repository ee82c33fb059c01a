#include <cmath>
#include <nlohmann/json.hpp>

#include "fsw/link/choices.hpp"
#include "mdat/common/text.hpp"
#include "mdat/recording/recording_head.hpp"
#include "mdat/serve/answers.hpp"

namespace lasso::mdat::serve {
namespace {

using Json = nlohmann::ordered_json;

std::string word_in(const mcap::Text& about, const std::string& key) {
  const auto found = about.find(key);
  return found != about.end() ? found->second : "";
}

Json seed_json(const std::string& text) {
  if (text.empty()) return nullptr;
  const std::optional<std::size_t> seed = count_of(text);
  return seed ? Json(*seed) : Json(text);
}

Json settings_of(const std::string& text) {
  Json settings = Json::object();
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    const std::size_t equals = std::min(line.find('='), line.size());
    settings[line.substr(0, equals)] = line.substr(std::min(equals + 1, line.size()));
    at = end + 1;
  }
  return settings;
}

Json topics_of(const mcap::IndexedFile& file) {
  Json topics = Json::array();
  for (const auto& [id, channel] : file.channels()) {
    const auto schema = file.schemas().find(channel.schema);
    const auto count = file.counts().find(id);
    topics.push_back({{"name", channel.topic},
                      {"type", schema != file.schemas().end() ? schema->second.name : ""},
                      {"messages", file.counts().empty() ? Json() : Json(count != file.counts().end() ? count->second : 0)}});
  }
  return topics;
}

Json names_of(const Enumeration& enumeration) {
  Json names = Json::array();
  for (const Choice& choice : enumeration.choices) names.push_back(choice.name);
  return names;
}

Json values_of(const std::vector<Value>& values) {
  Json list = Json::array();
  for (const Value& value : values) {
    list.push_back({{"id", value.id}, {"label", value.label}, {"unit", value.unit}, {"topic", value.topic}, {"group", value.group}});
    if (value.choices != nullptr) list.back()["choices"] = names_of(*value.choices);
  }
  return list;
}

// The half angles of its field, as full ones.
Json camera_of(const LoadedImage* image) {
  if (image == nullptr) return nullptr;
  const MissionParameters& p = image->mission().parameters;
  return {{"frustum_deg", {2 * p.fov_half_x_rad / kRadPerDeg, 2 * p.fov_half_y_rad / kRadPerDeg}},
          {"range_m", {p.range_min_m, p.range_max_m}}};
}

Json parts_of(const LoadedImage* image) {
  Json parts = Json::array({"target"});
  if (image == nullptr) return parts;
  for (std::size_t i = 0; i < image->parts().size(); ++i) parts.push_back("part " + std::to_string(i + 1));
  return parts;
}

}  // namespace

Response summary_answer(const Shown& shown) {
  const Recording& recording = *shown.recording;
  const auto metadata = recording.file().metadata().find(kRecordingMetadata);
  const mcap::Text about = metadata != recording.file().metadata().end() ? metadata->second : mcap::Text();
  const std::vector<Frame>& frames = recording.frames();
  const bool replayed = recording.own() && about.count(kLinkAddress) == 0;
  const std::string command = (replayed ? "mdat replay " : "mdat recording info ") + shell_word(shown.name);
  const std::string seed = word_in(about, "seed");
  const Json json = {{"id", shown.id},
                     {"name", shown.name},
                     {"command", command},
                     {"mission", word_in(about, "mission")},
                     {"scenario", word_in(about, "scenario")},
                     {"sensor", word_in(about, "sensor")},
                     {"seed", seed_json(seed)},
                     {"commit", word_in(about, "commit")},
                     {"writer", recording.file().library()},
                     {"start_s", frames.empty() ? 0.0 : frames.front().time_s},
                     {"end_s", frames.empty() ? 0.0 : frames.back().time_s},
                     {"frames", frames.size()},
                     {"settings", settings_of(word_in(about, "settings"))},
                     {"damage", recording.damage()},
                     {"has_truth", recording.has_truth()},
                     {"own", recording.own()},
                     {"parts", parts_of(shown.recording->image())},
                     {"modes", names_of(kTrackingMode)},
                     {"reasons", names_of(kPoseReason)},
                     {"topics", topics_of(recording.file())},
                     {"values", values_of(recording.values())},
                     {"camera", camera_of(shown.recording->image())},
                     {"size_m", shown.recording->image() != nullptr ? Json(2 * shown.recording->image()->mission().radius_m) : Json()}};
  return json_response(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace lasso::mdat::serve
