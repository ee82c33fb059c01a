#include <cstdio>
#include <memory>
#include <thread>

#include "mdat/cli/commands.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/report/report.hpp"
#include "mdat/run/recording.hpp"
#include "mdat/run/results.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat {
namespace {

struct Options {
  std::string mission, sensor = "simulated", out = "out/run", picture, record;
  SimulationOptions simulation;
  bool report = true;
};

void write_outputs(const Options& options, const CompiledMission& mission, const SimulationResult& result, OutputFolder& folder) {
  folder.write("results.json", results_json(result));
  folder.write("telemetry.ccsds", telemetry_bytes(result));
  if (options.report) folder.write("report.html", report_html(mission, result));
  if (!options.picture.empty()) write_file(options.picture, picture_png(mission, result));
  folder.commit();
}

void run(const Options& options) {
  OutputFolder folder(options.out);
  if (!options.picture.empty()) check_writable(options.picture);
  if (options.report || !options.picture.empty()) require_plotter();
  const CompiledMission mission = compile_mission(options.mission);
  for (const std::string& warning : mission.source.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
  const SimulationResult result = simulate(mission, options.simulation);
  write_outputs(options, mission, result, folder);
  std::fputs(summary_text(result).c_str(), stdout);
  std::printf("written to %s: results.json, telemetry.ccsds%s\n", options.out.c_str(), options.report ? ", report.html" : "");
}

void record(const Options& options) {
  OutputFolder writable(options.record);
  write_recording(compile_mission(options.mission), options.simulation, options.record);
  writable.commit();
  std::printf("written to %s: for each range scans/, poses.csv (of the frame before) and truth.csv\n", options.record.c_str());
}

}  // namespace

void add_run_command(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  options->simulation.jobs = std::max(1U, std::thread::hardware_concurrency());
  CLI::App* command = app.add_subcommand("run", "track a mission's target in simulation, and report");
  command->add_option("MISSION", options->mission, "mission file")->required();
  command->add_option("--scenario", options->simulation.scenario, "scenario of the mission")->capture_default_str();
  command->add_option("--seed", options->simulation.seed, "start of the random numbers (the scenario's)")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{4294967295}));
  command
      ->add_option("--sensor", options->sensor,
                   "simulated, or lcs-wire: laser cameras are reached over their serial line, byte by byte (docs/icd/lcs.md)")
      ->capture_default_str()
      ->check(CLI::IsMember({"simulated", "lcs-wire"}));
  command->add_option("-o,--out", options->out, "folder to write")->capture_default_str();
  command->add_option("--frames", options->simulation.frames, "frames of each range (the scenario's)")->check(CLI::Range(1, 1000000));
  command->add_option("-j,--jobs", options->simulation.jobs, "ranges and variants at a time; no effect on the results")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  command->add_flag("!--no-report", options->report, "leave report.html out");
  command->add_option("--picture", options->picture, "also write the scan on the target as a PNG picture");
  CLI::Option* recording = command->add_option("--record", options->record,
                                               "instead of a run: write its scans (.csv) and true poses into this folder, for replay");
  command->callback([options, recording] {
    options->simulation.laser_camera_line = options->sensor == "lcs-wire";
    recording->count() > 0 ? record(*options) : run(*options);
  });
}

}  // namespace lasso::mdat
