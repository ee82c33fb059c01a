#include "mdat/serve/live.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "mdat/serve/first_run.hpp"
#include "mdat/serve/http.hpp"

namespace lasso::mdat::serve {
namespace {

namespace fs = std::filesystem;
using LiveJson = nlohmann::ordered_json;

constexpr const char* kPhaseNames[] = {"idle", "preparing", "running", "over", "failed"};
constexpr int kMissionDepth = 3;
constexpr std::size_t kMostMissions = 500, kMostFilesSeen = 20000;

bool is_under_way(LivePhase phase) { return phase == LivePhase::kPreparing || phase == LivePhase::kRunning; }

void add_missions(const fs::path& folder, bool shipped, std::vector<LiveMission>& missions) {
  std::vector<LiveMission> found;
  std::error_code error;
  std::size_t seen = 0;
  for (fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error), end;
       !error && at != end && ++seen < kMostFilesSeen && found.size() < kMostMissions; at.increment(error)) {
    if (at.depth() >= kMissionDepth || at->is_symlink(error)) at.disable_recursion_pending();
    if (at->path().extension() != ".toml" || at->is_symlink(error)) continue;
    const std::string id = shipped ? at->path().stem().string() : at->path().lexically_relative(folder).string();
    found.push_back({id, at->path(), shipped});
  }
  std::sort(found.begin(), found.end(), [](const LiveMission& a, const LiveMission& b) { return a.id < b.id; });
  missions.insert(missions.end(), found.begin(), found.end());
}

// A name that is free: hubble_tenth-spin-live.mcap, hubble_tenth-spin-live-2.mcap, ...
fs::path free_file(const fs::path& folder, const LiveMission& mission, const std::string& scenario) {
  const std::string stem = fs::path(mission.id).stem().string() + "-" + scenario + "-live";
  fs::path file = folder / (stem + ".mcap");
  for (int i = 2; fs::exists(file); ++i) file = folder / (stem + "-" + std::to_string(i) + ".mcap");
  return file;
}

bool is_plain_name(const std::string& name) {
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return c == '_' || c == '-' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  });
}

}  // namespace

Live::~Live() {
  {
    const std::lock_guard lock(mutex_);
    if (pacing_) pacing_->stop();
  }
  if (thread_.joinable()) thread_.join();
}

std::vector<LiveMission> Live::missions() const {
  std::vector<LiveMission> missions;
  if (const std::optional<fs::path> first = first_mission()) add_missions(first->parent_path(), true, missions);
  add_missions(folder_.path(), false, missions);
  return missions;
}

LiveMission Live::mission(const std::string& id) const {
  const std::vector<LiveMission> all = missions();
  const auto found = std::find_if(all.begin(), all.end(), [&](const LiveMission& one) { return one.id == id; });
  if (found == all.end()) throw Refusal{404, "there is no mission " + id.substr(0, 80), "choose one of the list"};
  return *found;
}

void Live::start(const LiveOrder& order) {
  const LiveMission found = mission(order.mission);
  if (!is_plain_name(order.scenario)) throw Refusal{400, "the scenario has no such name", "choose one of the mission's scenarios"};
  if (!folder_.takes_files()) throw Refusal{409, "mdat serve shows one recording alone", "start it with a folder: mdat serve FOLDER"};
  const std::lock_guard lock(mutex_);
  if (is_under_way(state_.phase)) throw Refusal{409, "another run is under way: " + state_.name, "stop it, or wait for its end"};
  if (thread_.joinable()) thread_.join();
  FlightOrder flight{found.file, order.scenario, order.seed, order.pace, free_file(folder_.path(), found, order.scenario)};
  state_ = {};
  state_.phase = LivePhase::kPreparing;
  state_.id = folder_.id_of(flight.file);
  state_.name = flight.file.filename().string();
  state_.mission = order.mission;
  state_.scenario = order.scenario;
  state_.command = flight_command(flight);
  pacing_ = std::make_unique<Pacing>(order.pace);
  file_ = flight.file;
  recording_.reset();
  recorded_bytes_ = 0;
  thread_ = std::thread([this, flight = std::move(flight)] { fly_order(flight); });
  tell();
}

// The run's thread. Its mutex is never held while it waits.
void Live::fly_order(const FlightOrder& order) {
  const auto change = [this](const std::function<void(State&)>& to) {
    const std::lock_guard lock(mutex_);
    to(state_);
    tell();
  };
  FlightTold told;
  told.begun = [&](std::uint32_t frames) { change([&](State& state) { state.frames = frames; }); };
  told.packets = [this](TimeUs, ConstBytes packets) {
    const std::lock_guard lock(mutex_);
    ++state_.boundaries;
    state_.health.take(packets, std::chrono::steady_clock::now());
  };
  told.written = [&](std::uint64_t bytes) {
    change([&](State& state) {
      state.bytes = bytes;
      state.phase = LivePhase::kRunning;
    });
  };
  try {
    fly(order, commit_, *pacing_, told);
    finish("");
  } catch (const std::exception& error) {
    finish(error.what());
  }
}

void Live::finish(const std::string& error) {
  std::error_code ignored;
  const std::lock_guard lock(mutex_);
  if (!error.empty() && state_.bytes == 0) fs::remove(file_, ignored);
  state_.phase = error.empty() ? LivePhase::kOver : LivePhase::kFailed;
  state_.error = error;
  recording_.reset();
  tell();
}

void Live::act(Act what) {
  const std::lock_guard lock(mutex_);
  if (!is_under_way(state_.phase)) throw Refusal{409, "nothing flies", "start a run"};
  (pacing_.get()->*what)();
  tell();
}

void Live::pause() { act(&Pacing::pause); }
void Live::resume() { act(&Pacing::resume); }
void Live::step() { act(&Pacing::step); }
void Live::stop() { act(&Pacing::stop); }

void Live::set_pace(double pace) {
  const std::lock_guard lock(mutex_);
  if (!is_under_way(state_.phase)) throw Refusal{409, "nothing flies", "start a run"};
  pacing_->set_pace(pace);
  tell();
}

std::string Live::state() const {
  const std::lock_guard lock(mutex_);
  return state_text();
}

std::string Live::state_text() const {
  const auto now = std::chrono::steady_clock::now();
  const double age_s = state_.health.age_s(now);
  const LiveJson json = {{"phase", kPhaseNames[static_cast<std::size_t>(state_.phase)]},
                         {"paused", pacing_ && pacing_->paused()},
                         {"pace", pacing_ ? pacing_->pace() : 1.0},
                         {"id", state_.id},
                         {"name", state_.name},
                         {"mission", state_.mission},
                         {"scenario", state_.scenario},
                         {"command", state_.command},
                         {"error", state_.error.empty() ? LiveJson() : LiveJson(state_.error)},
                         {"frames", state_.frames},
                         {"boundaries", state_.boundaries},
                         {"bytes", state_.bytes},
                         {"packets", state_.health.packets()},
                         {"missing", state_.health.missing()},
                         {"rate_per_s", state_.health.rate_per_s(now)},
                         {"age_s", age_s < 0 ? LiveJson() : LiveJson(age_s)}};
  return json.dump(-1, ' ', false, LiveJson::error_handler_t::replace);
}

// A state replaces the ones before it: of those that wait the oldest may be dropped.
void Live::tell() const {
  std::erase_if(watchers_, [](const std::weak_ptr<SocketSender>& one) { return one.expired(); });
  if (watchers_.empty()) return;
  const std::string text = state_text();
  for (const std::weak_ptr<SocketSender>& one : watchers_) {
    if (const std::shared_ptr<SocketSender> watcher = one.lock()) watcher->send_frame(text, true);
  }
}

void Live::watch(const std::shared_ptr<SocketSender>& watcher) {
  const std::lock_guard lock(mutex_);
  watchers_.push_back(watcher);
  watcher->send_frame(state_text(), true);
}

// What is new is read outside of the run's lock, by one thread at a time.
std::shared_ptr<const Recording> Live::recording(const std::string& id) {
  const std::lock_guard growing(growing_);
  std::shared_ptr<const Recording> known;
  std::uint64_t bytes = 0, before = 0;
  fs::path file;
  {
    const std::lock_guard lock(mutex_);
    if (state_.phase != LivePhase::kRunning || id != state_.id) return nullptr;
    known = recording_;
    bytes = state_.bytes;
    before = recorded_bytes_;
    file = file_;
  }
  if (!known || bytes != before) known = known ? known->grown(bytes) : std::make_shared<const Recording>(file, bytes);
  const std::lock_guard lock(mutex_);
  if (state_.phase != LivePhase::kRunning || id != state_.id) return known;
  recording_ = known;
  recorded_bytes_ = bytes;
  return known;
}

}  // namespace lasso::mdat::serve
