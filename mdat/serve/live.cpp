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
fs::path free_file(const fs::path& folder, const std::string& stem) {
  fs::path file = folder / (stem + ".mcap");
  for (int i = 2; fs::exists(file); ++i) file = folder / (stem + "-" + std::to_string(i) + ".mcap");
  return file;
}

bool is_plain_name(const std::string& name) {
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return c == '_' || c == '-' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  });
}

LiveJson commands_of(const CommandDesk& desk) {
  LiveJson list = LiveJson::array();
  for (const CommandRecord& record : desk.records())
    list.push_back({{"number", record.number},
                    {"name", record.order.name},
                    {"arm", record.order.arm},
                    {"values", record.order.values},
                    {"phase", phase_name(record.phase)},
                    {"why", record.why}});
  return list;
}

}  // namespace

Live::~Live() {
  {
    const std::lock_guard lock(mutex_);
    if (pacing_) pacing_->stop();
    ending_ = true;
  }
  if (thread_.joinable()) thread_.join();
}

std::vector<LiveMission> Live::missions() const {
  std::vector<LiveMission> missions;
  if (const std::optional<fs::path> first = first_mission()) add_missions(first->parent_path(), true, missions);
  if (folder_.takes_files()) add_missions(folder_.path(), false, missions);
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
  const fs::path file = free_file(folder_.path(), fs::path(found.id).stem().string() + "-" + order.scenario + "-live");
  const FlightOrder flight{found.file, order.scenario, order.seed, order.pace, file};
  State state;
  state.mission = order.mission;
  state.scenario = order.scenario;
  state.command = flight_command(flight);
  begin(std::move(state), file, order.pace, [this, flight] { fly_order(flight); });
}

void Live::connect(const LinkOrder& order) {
  const std::string fault = address_fault(order.address);
  if (!fault.empty()) throw Refusal{400, fault, "give the address that the component's link says"};
  WatchOrder watched;
  watched.address = order.address;
  if (!order.mission.empty()) watched.mission = mission(order.mission).file;
  const std::string stem = order.mission.empty() ? "component" : fs::path(order.mission).stem().string();
  watched.file = free_file(folder_.path(), stem + "-link");
  watched.key = rights_.key;
  watched.apid = rights_.apid;
  State state;
  state.mission = order.mission;
  state.address = order.address;
  state.command = watch_command(watched);
  begin(std::move(state), watched.file, 1, [this, watched] { watch_order(watched); });
}

void Live::begin(State state, const fs::path& file, double pace, const std::function<void()>& work) {
  if (!folder_.takes_files()) throw Refusal{409, "mdat serve shows one recording alone", "start it with a folder: mdat serve FOLDER"};
  const std::lock_guard lock(mutex_);
  if (is_under_way(state_.phase)) throw Refusal{409, "another one is under way: " + state_.name, "stop it, or wait for its end"};
  if (thread_.joinable()) thread_.join();
  state_ = std::move(state);
  state_.phase = LivePhase::kPreparing;
  state_.id = folder_.id_of(file);
  state_.name = file.filename().string();
  pacing_ = std::make_unique<Pacing>(pace);
  ending_ = false;
  desk_.clear();
  file_ = file;
  recording_.reset();
  recorded_bytes_ = 0;
  thread_ = std::thread([this, work] { finish_as(work); });
  tell();
}

// The thread's. No mutex is held while it waits.
void Live::finish_as(const std::function<void()>& work) {
  try {
    work();
    finish("");
  } catch (const std::exception& error) {
    finish(error.what());
  }
}

void Live::change(const std::function<void(State&)>& to) {
  const std::lock_guard lock(mutex_);
  to(state_);
  tell();
}

void Live::take_packets(ConstBytes packets) {
  const std::lock_guard lock(mutex_);
  state_.health.take(packets, std::chrono::steady_clock::now());
}

void Live::fly_order(const FlightOrder& order) {
  FlightTold told;
  told.begun = [&](std::uint32_t frames) { change([&](State& state) { state.frames = frames; }); };
  told.packets = [this](TimeUs, ConstBytes packets) {
    take_packets(packets);
    const std::lock_guard lock(mutex_);
    ++state_.boundaries;
  };
  told.written = [&](std::uint64_t bytes) {
    change([&](State& state) {
      state.bytes = bytes;
      state.phase = LivePhase::kRunning;
    });
  };
  fly(order, commit_, *pacing_, told);
}

void Live::watch_order(const WatchOrder& order) {
  WatchTold told;
  told.begun = [&] { change([](State& state) { state.phase = LivePhase::kRunning; }); };
  told.packet = [this](ConstBytes packet) { take_packets(packet); };
  told.written = [this](const fs::path& file, std::uint64_t bytes, std::uint64_t frames) { take_written(file, bytes, frames); };
  told.looked = [this](Connection& connection) { look(connection); };
  told.commanded = [this] { change([](State&) {}); };
  watch_link(order, commit_, ending_, desk_, told);
}

// In a further file, where the component's clock began anew.
void Live::take_written(const fs::path& file, std::uint64_t bytes, std::uint64_t frames) {
  change([&](State& state) {
    if (file != file_) {
      file_ = file;
      state.id = folder_.id_of(file);
      state.name = file.filename().string();
      recording_.reset();
      recorded_bytes_ = 0;
    }
    state.bytes = bytes;
    state.boundaries = frames;
  });
}

// It is told only where something has changed.
void Live::look(Connection& connection) {
  const std::lock_guard lock(mutex_);
  if (state_.trouble == connection.trouble() && state_.other_bytes == connection.other_bytes()) return;
  state_.trouble = connection.trouble();
  state_.other_bytes = connection.other_bytes();
  tell();
}

void Live::finish(const std::string& error) {
  std::error_code ignored;
  const std::lock_guard lock(mutex_);
  if (state_.bytes == 0) fs::remove(file_, ignored);
  state_.phase = error.empty() ? LivePhase::kOver : LivePhase::kFailed;
  state_.error = error;
  recording_.reset();
  tell();
}

void Live::check_under_way(bool paced) const {
  if (!is_under_way(state_.phase)) throw Refusal{409, "nothing flies", "start a run"};
  if (paced && !state_.address.empty()) throw Refusal{409, "a component keeps its own pace", "stop ends the connection"};
}

void Live::act(Act what) {
  const std::lock_guard lock(mutex_);
  check_under_way(true);
  (pacing_.get()->*what)();
  tell();
}

void Live::pause() { act(&Pacing::pause); }
void Live::resume() { act(&Pacing::resume); }
void Live::step() { act(&Pacing::step); }

void Live::stop() {
  const std::lock_guard lock(mutex_);
  check_under_way(false);
  ending_ = true;
  pacing_->stop();
  tell();
}

void Live::set_pace(double pace) {
  const std::lock_guard lock(mutex_);
  check_under_way(true);
  pacing_->set_pace(pace);
  tell();
}

std::uint64_t Live::command(const CommandOrder& order) {
  {
    const std::lock_guard lock(mutex_);
    if (state_.phase != LivePhase::kRunning || state_.address.empty())
      throw Refusal{409, "no component is connected", "connect to one; a run that the page flies takes no commands"};
    if (!state_.trouble.empty()) throw Refusal{409, "the link has ended: " + state_.trouble, "wait until it is there again"};
  }
  if (!rights_.commands) throw Refusal{403, "commands are not allowed from this page", "start it with mdat serve --allow-commands"};
  const std::uint64_t number = desk_.order(order);
  change([](State&) {});
  return number;
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
                         {"address", state_.address.empty() ? LiveJson() : LiveJson(state_.address)},
                         {"trouble", state_.trouble.empty() ? LiveJson() : LiveJson(state_.trouble)},
                         {"other_bytes", state_.other_bytes},
                         {"may_command", rights_.commands},
                         {"commands", commands_of(desk_)},
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
