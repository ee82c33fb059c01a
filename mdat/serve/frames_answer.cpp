// Columns of all frames, and their events.
#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

#include "mdat/recording/recording_head.hpp"
#include "mdat/run/simulated_scenario.hpp"
#include "mdat/serve/answers.hpp"
#include "mdat/serve/bits.hpp"

namespace lasso::mdat::serve {
namespace {

using Json = nlohmann::ordered_json;

constexpr float kUnknownFlag = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint8_t kWarnLevel = 30, kErrorLevel = 40;  // of rcl_interfaces/Log

// Frames as the run counts them (frames.csv), from its scans' times and period; of what no mission is known of, those that were told.
class FrameNumbers {
 public:
  explicit FrameNumbers(const Recording& recording) {
    const bool simulated = recording.own() && recording.file().metadata().at(kRecordingMetadata).count(kLinkAddress) == 0;
    if (simulated && recording.image() != nullptr) period_us_ = to_us(recording.image()->mission().parameters.period_s);
  }
  float of(const Frame& frame, std::size_t index) const {
    const TimeUs since_us = static_cast<TimeUs>(frame.time_ns / 1000) - kEpochUs;
    return static_cast<float>(period_us_ > 0 && since_us >= 0 ? static_cast<std::size_t>(since_us / period_us_) : index);
  }

 private:
  TimeUs period_us_ = 0;  // 0: not known
};

float flag_of(std::optional<bool> flag) { return flag ? (*flag ? 1.0F : 0.0F) : kUnknownFlag; }

using FrameNumber = float (*)(const Frame&, bool own);

// Of the names that the time line asks for; null: another one.
FrameNumber frame_number(const std::string& name) {
  if (name == "valid") return [](const Frame& frame, bool own) { return own ? flag_of(frame.valid) : kUnknownFlag; };
  if (name == "wrong") return [](const Frame& frame, bool) { return flag_of(frame.wrong); };
  if (name == "mode") return [](const Frame& frame, bool own) { return own ? static_cast<float>(frame.mode) : kUnknownFlag; };
  if (name == "reason") return [](const Frame& frame, bool own) { return own ? static_cast<float>(frame.reason) : kUnknownFlag; };
  return nullptr;
}

void put_column(const Shown& shown, const std::string& name, std::size_t from, std::string& bytes) {
  const std::vector<Frame>& all = shown.recording->frames();
  const std::span<const Frame> frames = std::span(all).subspan(std::min(from, all.size()));
  if (name == "time_s") {
    for (const Frame& frame : frames) mcap::put(frame.time_s, bytes);
    return;
  }
  if (name == "number") {
    const FrameNumbers numbers(*shown.recording);
    for (std::size_t i = all.size() - frames.size(); i < all.size(); ++i) mcap::put(numbers.of(all[i], i), bytes);
    return;
  }
  if (const FrameNumber number = frame_number(name)) {
    for (const Frame& frame : frames) mcap::put(number(frame, shown.recording->own()), bytes);
    return;
  }
  const Value& value = value_in(shown, name);
  const std::vector<float>& column = shown.recording->column(value);
  if (column.size() != all.size()) throw Refusal{400, name + " is not told once a frame", "ask for its series"};
  for (std::size_t i = from; i < column.size(); ++i) mcap::put(column[i], bytes);
}

const char* level_name(std::uint8_t level) {
  if (level >= kErrorLevel) return "error";
  return level >= kWarnLevel ? "warning" : "info";
}

std::uint8_t least_level(const std::string& name) {
  if (name.empty() || name == "info") return 0;
  if (name == "warning") return kWarnLevel;
  if (name == "error") return kErrorLevel;
  throw Refusal{400, "level=" + name.substr(0, 40) + ": expected info, warning or error", "correct the address"};
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(c < 0x80 ? std::tolower(c) : c); });
  return text;
}

}  // namespace

Response frames_answer(const Shown& shown, const Target& target) {
  std::vector<std::string> names = list_in(target, "columns");
  if (names.empty()) names = {"time_s", "valid", "wrong", "mode"};
  if (names.size() > kMostColumns) throw Refusal{400, "too many columns", "ask for " + std::to_string(kMostColumns) + " at a time"};
  const std::size_t from = count_in(target, "from", 0, std::numeric_limits<std::uint32_t>::max());
  std::string bytes;
  for (const std::string& name : names) put_column(shown, name, from, bytes);
  return binary_response(std::move(bytes));
}

Response events_answer(const Shown& shown, const Target& target) {
  const std::size_t from = count_in(target, "from", 0, std::numeric_limits<std::uint32_t>::max());
  const std::size_t count = count_in(target, "count", 1000, kMostEvents);
  const std::string filter = lower(text_in(target, "filter"));
  const std::uint8_t least = least_level(text_in(target, "level"));
  Json events = Json::array();
  std::size_t total = 0;
  for (const RecordedEvent& event : shown.recording->events()) {
    if (event.level < least || lower(event.name + " " + event.text).find(filter) == std::string::npos) continue;
    const std::size_t number = total++;
    if (number < from || number - from >= count) continue;
    events.push_back(
        {{"time_s", event.time_s}, {"frame", event.frame}, {"level", level_name(event.level)}, {"name", event.name}, {"text", event.text}});
  }
  const Json json = {{"total", total}, {"events", events}};
  return json_response(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace lasso::mdat::serve
