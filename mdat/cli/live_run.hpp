// --live of mdat run and mdat monitor: what comes is told to viewers while it does.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "mdat/missiondb/mission_source.hpp"
#include "mdat/run/paced_listener.hpp"
#include "mdat/serve/live_server.hpp"

namespace lasso::mdat {

struct LiveOptions {
  std::optional<std::string> address;  // none: nobody is told; empty: the usual one
  double pace = 1;                     // seconds of the run in one of the clock; 0: as fast as it goes
};

// --live alone; `options` lives as long as the command.
CLI::Option* add_live_option(CLI::App& command, LiveOptions& options);
// --pace, too.
void add_live_options(CLI::App& command, LiveOptions& options);

// What is told is one run. Throws InputError where the scenario has several.
void check_live(const LiveOptions& options, const MissionSource& source, const std::string& scenario);

// Where nobody is to be told, it does nothing.
class LiveRun {
 public:
  // Listens from now on, and prints its address. `name`: for the viewers. Throws InputError.
  LiveRun(const LiveOptions& options, const std::string& name);

  MessageTap* tap();
  // What the run is told to instead of `next`; it keeps the pace, unless the run has another clock.
  RunListener* paced(RunListener* next, bool has_clock);
  void end(const char* message = "the run is over");

 private:
  double pace_;
  std::unique_ptr<serve::LiveServer> server_;
  std::optional<PacedListener> paced_;
};

}  // namespace lasso::mdat
