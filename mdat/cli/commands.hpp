// The subcommands of mdat. Each adds itself to the command line and runs when chosen, before the parser returns.
#pragma once

#include <CLI/CLI.hpp>

#include "fsw/core/identity.hpp"
#include "mdat/missiondb/mission_source.hpp"

namespace lasso::mdat {

void add_mission_commands(CLI::App& app);
void add_mission_edits(CLI::App& mission);  // of that one
void add_run_command(CLI::App& app);
void add_campaign_command(CLI::App& app);
void add_lcs_sim_command(CLI::App& app);
void add_calibrate_command(CLI::App& app);
void add_recording_command(CLI::App& app);
void add_recording_edits(CLI::App* group);  // of that one
void add_replay_command(CLI::App& app);
void add_compare_command(CLI::App& app);
void add_benchmark_commands(CLI::App& app);
void add_gallery_command(CLI::App& app);
void add_paper_command(CLI::App& app);
void add_availability_command(CLI::App& app);
void add_render_command(CLI::App& app);
void add_stereo_command(CLI::App& app);
void add_modes_command(CLI::App& app);
void add_faults_command(CLI::App& app);
void add_decode_command(CLI::App& app);
void add_command_command(CLI::App& app);
void add_upload_command(CLI::App& app);
void add_key_command(CLI::App& app);
void add_dictionary_command(CLI::App& app);
void add_monitor_command(CLI::App& app);
void add_serve_command(CLI::App& app);

// A recording that is flown again: as it was, or, where one of the first three is given, with a component that is another one: with
// settings beside those of the run, of another mission, by a flight image.
struct RecordedReplay {
  std::vector<std::string> settings;
  std::string mission, image;
  std::string file, record, key;  // the recording; one to write, or none; the key of its commands, or none
  bool cached = true, force = false;
};
struct LiveOptions;
// The component gets the recorded scans and commands; viewers are told as `live` says. Prints a summary and whether telemetry is the
// recorded one; of a changed component the figures of both, side by side. Throws InputError or MissionError as what it reads; RunError
// where nothing was changed, and telemetry differs.
void replay_recording(const RecordedReplay& options, const LiveOptions& live);

// --set KEY=VALUE of a subcommand that reads a mission; may be given again and again.
void add_settings(CLI::App& command, std::vector<std::string>& settings);

// On the error stream: settings that change nothing, as the value is that already.
void tell_idle_settings(const MissionSource& source, const std::string& scenario);

// --no-cache of a subcommand that compiles a mission; `cached` is true unless it is given.
void add_no_cache(CLI::App& command, bool& cached);

// Of an option: a number from low to high. CLI11's own ranges take what is not a number.
CLI::Validator number_between(double low, double high);

// --apid of a subcommand that speaks with a component, or of one.
CLI::Option* add_apid(CLI::App& command, std::uint16_t& apid);

// Refuses an output that is one of the inputs, or another output. Throws InputError.
void refuse_same_files(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

// On the error stream, before any long work: that pictures will be missing, where gnuplot cannot be run.
void warn_of_plotter();

}  // namespace lasso::mdat
