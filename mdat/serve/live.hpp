// What is live: one run at a time, that the page starts, paces and stops, or one component elsewhere that it is connected to. Frames are
// asked for as those of any recording; who watches is told how many there are.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "mdat/link/link_health.hpp"
#include "mdat/serve/application.hpp"
#include "mdat/serve/flight.hpp"
#include "mdat/serve/folder.hpp"
#include "mdat/serve/watch.hpp"

namespace lasso::mdat::serve {

enum class LivePhase : std::uint8_t { kIdle, kPreparing, kRunning, kOver, kFailed };

// A mission that can be flown, by its id: its file below the folder, or a shipped one's name.
struct LiveMission {
  std::string id;
  std::filesystem::path file;
  bool shipped = false;
};

struct LiveOrder {
  std::string mission, scenario;  // mission: its id
  std::optional<std::uint64_t> seed;
  double pace = 1;
};

struct LinkOrder {
  std::string address, mission;  // mission: its id, or empty
};

// Of who has the page over a component that it is connected to, and which one that is.
struct LinkRights {
  bool commands = false;
  std::optional<Key> key;  // by which they are signed
  std::uint16_t apid = kApid;
};

// Safe for several threads.
class Live {
 public:
  // Recordings are written to `folder`, which outlives it.
  Live(Folder& folder, std::string commit, LinkRights rights = {})
      : folder_(folder), commit_(std::move(commit)), rights_(std::move(rights)) {}
  ~Live();  // stops what flies, and waits for its end
  Live(const Live&) = delete;
  Live& operator=(const Live&) = delete;

  // Shipped ones first, by name; those below the folder unless a single recording is served.
  std::vector<LiveMission> missions() const;
  // Throws Refusal (404).
  LiveMission mission(const std::string& id) const;

  // Throws Refusal: 409 another one is under way, or no recording can be written here; 404 there is no such mission.
  void start(const LiveOrder& order);
  // The same, and 400: no address that is reached from a page. Whether somebody answers there, the state says.
  void connect(const LinkOrder& order);
  // Throw Refusal (409) where nothing flies; all but stop() also where it is a component, which keeps its own pace.
  void pause();
  void resume();
  void step();
  void set_pace(double pace);
  void stop();
  // Of the component that is connected; what becomes of it, the state says. Its number. Throws Refusal as CommandDesk, and 403: commands
  // are not allowed; 409: none is connected.
  std::uint64_t command(const CommandOrder& order);

  // As JSON: docs/serve.md.
  std::string state() const;
  // The recording that is being written, with all its frames so far; null: it is another one's id, or its run is over.
  std::shared_ptr<const Recording> recording(const std::string& id);
  // Gets the state now and after each change; what is slow misses some, but not the last one.
  void watch(const std::shared_ptr<SocketSender>& watcher);

 private:
  struct State {
    LivePhase phase = LivePhase::kIdle;
    std::string id, name, mission, scenario, command, error;
    std::string address, trouble;  // of a component; trouble: why nothing can come now
    std::uint64_t other_bytes = 0;
    std::uint32_t frames = 0;      // that it will have
    std::uint64_t boundaries = 0;  // that passed
    std::uint64_t bytes = 0;       // of the file, that are whole
    LinkHealth health;
  };
  using Act = void (Pacing::*)();
  void act(Act what);
  void check_under_way(bool paced) const;  // under the lock
  void begin(State state, const std::filesystem::path& file, double pace, const std::function<void()>& work);
  void change(const std::function<void(State&)>& to);
  void take_packets(ConstBytes packets);
  void fly_order(const FlightOrder& order);
  void watch_order(const WatchOrder& order);
  void look(Connection& connection);
  void take_written(const std::filesystem::path& file, std::uint64_t bytes, std::uint64_t frames);
  void finish_as(const std::function<void()>& work);
  void finish(const std::string& error);
  void tell() const;
  std::string state_text() const;  // under the lock

  Folder& folder_;
  const std::string commit_;
  const LinkRights rights_;
  CommandDesk desk_;
  mutable std::mutex mutex_;
  State state_;
  std::unique_ptr<Pacing> pacing_;
  std::atomic<bool> ending_{false};  // of a connection
  std::filesystem::path file_;
  std::shared_ptr<const Recording> recording_;
  std::uint64_t recorded_bytes_ = 0;  // of it
  std::mutex growing_;                // one thread at a time reads what is new
  mutable std::vector<std::weak_ptr<SocketSender>> watchers_;
  std::thread thread_;
};

}  // namespace lasso::mdat::serve
