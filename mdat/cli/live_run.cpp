#include "mdat/cli/live_run.hpp"

#include <cstdio>

#include "mdat/cli/commands.hpp"
#include "mdat/common/errors.hpp"

namespace lasso::mdat {
namespace {

constexpr std::uint16_t kLivePort = 8765;   // where viewers look for it
constexpr std::size_t kLiveMessages = 400;  // that wait for a slow client: of some 40 frames
constexpr double kMostPace = 1000;

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
      ->check(number_between(0, kMostPace));
}

void check_live(const LiveOptions& options, const MissionSource& source, const std::string& scenario) {
  if (options.address && scenario_of(source, scenario).runs_m().size() > 1)
    throw InputError("--live: tells one run, and the scenario " + scenario + " has several: choose a scenario of one range, such as spin");
}

LiveRun::LiveRun(const LiveOptions& options, const std::string& name) : pace_(options.pace) {
  if (!options.address) return;
  serve::NetworkOptions network;
  network.port = kLivePort;
  network.waiting_frames = kLiveMessages;
  serve::read_address(*options.address, network);
  server_ = std::make_unique<serve::LiveServer>(network, name);
  std::printf("live: %s (Foxglove WebSocket, for Lichtblick or Foxglove)\n", server_->address().c_str());
  (void)std::fflush(stdout);
}

MessageTap* LiveRun::tap() { return server_ ? &server_->tap() : nullptr; }

RunListener* LiveRun::paced(RunListener* next, bool has_clock) {
  if (!server_ || next == nullptr) return next;
  return &paced_.emplace(*next, has_clock ? 0 : pace_);
}

void LiveRun::end(const char* message) {
  if (server_) server_->end(message);
}

}  // namespace lasso::mdat
