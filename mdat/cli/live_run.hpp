// --live of mdat run, replay and monitor: what comes is told to viewers while it does.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "mdat/missiondb/mission_source.hpp"
#include "mdat/recording/frame_recorder.hpp"
#include "mdat/run/run_listener.hpp"
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

// When the messages of a simulated run come: from its epoch, so many frames of the period.
serve::PlaybackRange playback_range(std::uint64_t frames, double period_s);

// Where nobody is to be told, it does nothing.
class LiveRun {
 public:
  // Listens from now on, and prints its address. `name`: for the viewers. `range`: of a run that viewers may pause and pace; none: it has
  // a clock of its own. Throws InputError.
  LiveRun(const LiveOptions& options, const std::string& name, const std::optional<serve::PlaybackRange>& range);

  MessageTap* tap();
  // Tells the run of this mission, and keeps its pace; null: nobody is to be told.
  RunListener* listener(const CompiledMission& mission, const std::string& scenario);
  void end(const char* message = "the run is over");

 private:
  serve::Pacing pacing_;
  std::optional<serve::Playback> playback_;
  std::unique_ptr<serve::LiveServer> server_;
  std::unique_ptr<FrameRecorder> told_;  // passes each message on, and keeps none
  std::unique_ptr<RunListener> paced_;
};

}  // namespace lasso::mdat
