#include "mdat/cli/live_run.hpp"

#include <cstdio>

#include "mdat/cli/commands.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/run/simulated_scenario.hpp"

namespace lasso::mdat {
namespace {

constexpr std::uint16_t kLivePort = 8765;   // where viewers look for it
constexpr std::size_t kLiveMessages = 400;  // that wait for a slow client: of some 40 frames

// Passes on what it hears, and holds each boundary back until its time.
class HeldBack final : public RunListener {
 public:
  HeldBack(RunListener& next, serve::Pacing& pacing) : next_(next), pacing_(pacing) {}
  void on_packets(TimeUs boundary_us, ConstBytes packets) override {
    (void)pacing_.pass(boundary_us);  // nobody stops it
    next_.on_packets(boundary_us, packets);
  }
  void on_frame(const FlownFrame& frame) override { next_.on_frame(frame); }
  void on_commands(TimeUs slot_us, ConstBytes bytes) override { next_.on_commands(slot_us, bytes); }
  void on_pair(const TakenPair& pair) override { next_.on_pair(pair); }

 private:
  RunListener& next_;
  serve::Pacing& pacing_;
};

}  // namespace

CLI::Option* add_live_option(CLI::App& command, LiveOptions& options) {
  return command
      .add_option_function<std::string>(
          "--live", [&options](const std::string& address) { options.address = address; },
          "tell viewers what comes while it does, by the Foxglove WebSocket protocol (docs/live.md), at HOST:PORT (127.0.0.1:8765)")
      ->expected(0, 1)
      ->type_name("[ADDRESS]");
}

void add_live_options(CLI::App& command, LiveOptions& options) {
  (void)add_live_option(command, options);
  command.add_option("--pace", options.pace, "with --live: seconds of the run in one of the clock; 0: as fast as it goes")
      ->needs("--live")
      ->capture_default_str()
      ->check(number_between(0, serve::kMostPace));
}

void check_live(const LiveOptions& options, const MissionSource& source, const std::string& scenario) {
  if (options.address && scenario_of(source, scenario).runs_m().size() > 1)
    throw InputError("--live: tells one run, and the scenario " + scenario + " has several: choose a scenario of one range, such as spin");
}

serve::PlaybackRange playback_range(std::uint64_t frames, double period_s) {
  const auto of = [](TimeUs time_us) { return static_cast<std::uint64_t>(time_us) * 1000; };
  return {of(kEpochUs), of(kEpochUs + static_cast<TimeUs>(frames) * to_us(period_s))};
}

LiveRun::LiveRun(const LiveOptions& options, const std::string& name, const std::optional<serve::PlaybackRange>& range)
    : pacing_(range ? options.pace : 0) {
  if (!options.address) return;
  serve::NetworkOptions network;
  network.port = kLivePort;
  network.waiting_frames = kLiveMessages;
  serve::read_address(*options.address, network);
  serve::Playback* const playback = range ? &playback_.emplace(pacing_, *range) : nullptr;
  server_ = std::make_unique<serve::LiveServer>(network, name, playback);
  std::printf("live: %s (Foxglove WebSocket, for Lichtblick or Foxglove)\n", server_->address().c_str());
  (void)std::fflush(stdout);
}

MessageTap* LiveRun::tap() { return server_ ? &server_->tap() : nullptr; }

RunListener* LiveRun::listener(const CompiledMission& mission, const std::string& scenario) {
  if (!server_) return nullptr;
  told_ = std::make_unique<FrameRecorder>("", mission, RecordingHead{{{"scenario", scenario}}, {}}, nullptr, RecordingContent::kAll, tap());
  paced_ = std::make_unique<HeldBack>(*told_, pacing_);
  return paced_.get();
}

void LiveRun::end(const char* message) {
  if (server_) server_->end(message);
}

}  // namespace lasso::mdat
