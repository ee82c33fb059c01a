// mdat, the mission design and analysis tool. Exit codes: 0 done, 1 the run failed, 2 usage or bad input, 3 done, but a picture could not
// be drawn, 75 a campaign was stopped before its end.
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "hal_sim/scan_file.hpp"
#include "mdat/cli/commands.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/version.hpp"
#include "mdat/source/mission_error.hpp"
#include "mdat/source/nearest.hpp"

namespace {

using namespace lasso::mdat;

int refuse(const std::exception& error, int exit_code) {
  std::fprintf(stderr, "mdat: %s\n", error.what());
  return exit_code;
}

// Of the subcommands and options of the command, and of what was found of it on the line.
std::vector<std::string> names_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
    if (!command->parsed()) continue;
    const std::vector<std::string> inner = names_of(*command);
    names.insert(names.end(), inner.begin(), inner.end());
  }
  for (const CLI::Option* option : app.get_options()) names.push_back(option->get_name());
  return names;
}

int usage(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return app.exit(error);  // help or version: as asked, on standard output
  const std::vector<std::string> unknown = app.remaining(true);
  const std::string what =
      unknown.empty() ? error.what() : "'" + unknown.front() + "' is not known here" + did_you_mean(unknown.front(), names_of(app));
  std::fprintf(stderr, "mdat: %s (mdat --help shows the commands, mdat COMMAND --help their options)\n", what.c_str());
  return kExitBadInput;
}

int run(int argc, char** argv) {
  CLI::App app("3DLASSO mission design and analysis tool", "mdat");
  app.set_version_flag("--version", std::string("mdat ") + kVersion);
  app.require_subcommand(1);
  add_mission_commands(app);
  add_run_command(app);
  add_campaign_command(app);
  add_lcs_sim_command(app);
  add_calibrate_command(app);
  add_recording_command(app);
  add_replay_command(app);
  add_compare_command(app);
  add_benchmark_commands(app);
  add_gallery_command(app);
  add_paper_command(app);
  add_availability_command(app);
  add_render_command(app);
  add_stereo_command(app);
  add_modes_command(app);
  add_faults_command(app);
  add_decode_command(app);
  add_command_command(app);
  add_upload_command(app);
  add_key_command(app);
  add_dictionary_command(app);
  add_monitor_command(app);
  add_serve_command(app);
  app.footer(
      "Exit codes: 0 done, 1 the run failed, 2 usage or bad input, 3 done, but a picture could not be drawn, 75 a campaign was stopped and "
      "can go on.");
  try {
    app.parse(argc, argv);
    return kExitDone;
  } catch (const CLI::RuntimeError& error) {  // what a command ends with, which is no error of the line
    return error.get_exit_code();
  } catch (const CLI::ParseError& error) {
    return usage(app, error);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const InputError& error) {
    return refuse(error, kExitBadInput);
  } catch (const MissionError& error) {
    return refuse(error, kExitBadInput);
  } catch (const lasso::sim::ScanFileError& error) {
    return refuse(error, kExitBadInput);
  } catch (const PictureError& error) {
    return refuse(error, kExitNoPicture);
  } catch (const std::exception& error) {
    return refuse(error, kExitFailed);
  }
}
