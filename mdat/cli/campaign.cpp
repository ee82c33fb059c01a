#include <unistd.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <thread>

#include "mdat/campaign/campaign_list.hpp"
#include "mdat/campaign/chunk_of.hpp"
#include "mdat/campaign/folder.hpp"
#include "mdat/campaign/kept_mission.hpp"
#include "mdat/campaign/launch.hpp"
#include "mdat/campaign/paired.hpp"
#include "mdat/cli/commands.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/text.hpp"
#include "mdat/common/version.hpp"
#include "mdat/report/report.hpp"
#include "mdat/run/frames_table.hpp"
#include "mdat/run/results.hpp"
#include "mdat/stereo/stereo_maker.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;

struct CampaignArguments {
  std::string target, other, campaign, out, chunk, engine;
  std::vector<std::string> settings;
  EngineOptions engine_options;
  unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
  std::uint32_t number = 0, chunks = 0;
  double seconds_per_case = 0;
  bool cached = true, force = false, report = true, partial = false, failed = false, markdown = false;
};

CampaignFolder open_folder(const CampaignArguments& options) { return open_campaign(options.target, options.cached); }

std::string folder_of(const CampaignArguments& options) { return options.out.empty() ? "out/campaign/" + options.campaign : options.out; }

// Throws InputError unless the folder holds the very campaign that the mission would be expanded to now.
void require_same_plan(const CampaignArguments& options, const fs::path& folder) {
  const CampaignPlan plan = load_plan(folder).plan;
  const std::string remedy = "; --out DIR keeps it, --force removes it with all its results";
  if (plan.campaign != options.campaign || plan.settings != options.settings)
    throw InputError(folder.string() + ": holds another campaign (" + plan.campaign + ")" + remedy);
  const auto files = kept_mission(load_mission_input(options.target, options.settings).source).digests();
  if (files == plan.files) return;
  for (const auto& [name, digest] : files) {
    const auto planned = plan.files.find(name);
    if (planned != plan.files.end() && planned->second == digest) continue;
    throw InputError(folder.string() + ": holds the campaign of the mission as it was before " + name.substr(name.find('/') + 1) +
                     " changed: mdat campaign run " + shell_word(folder.string()) + " goes on with that" + remedy);
  }
  throw InputError(folder.string() + ": holds the campaign of a mission with more files" + remedy);
}

void expand(const CampaignArguments& options) {
  const fs::path folder = folder_of(options);
  if (has_plan(folder) && !options.force)
    throw InputError(folder.string() + ": holds a campaign; --out DIR keeps it, --force removes it with all its results");
  MissionInput input = load_mission_input(options.target, options.settings);
  const CampaignSource& campaign = campaign_of(input.source, options.campaign);
  refuse_pictures(input.source, "campaigns");
  for (const std::string& warning : warnings_for(input.source, campaign.scenario)) std::fprintf(stderr, "warning: %s\n", warning.c_str());
  expand_campaign(input, options.campaign, options.cached, kCommit, folder, options.force);
  std::fprintf(stderr, "%s: plan.json and cases.csv, %u cases of the campaign %s\n", folder.c_str(), campaign.cases,
               options.campaign.c_str());
}

// What is known so far, in files and on the terminal.
void conclude(const CampaignArguments& options, const CampaignFolder& folder, bool partial) {
  const ResultTable table = merged(folder, partial);
  std::fputs(write_results(folder, table).c_str(), stdout);
  (void)std::fflush(stdout);
  if (options.report) std::printf("the report: %s\n", write_report(folder, table).c_str());
}

[[noreturn]] void leave(int exit_code) { throw CLI::RuntimeError(exit_code); }

EngineResult fly(const CampaignArguments& options, const CampaignFolder& folder) {
  EngineOptions engine = options.engine_options;
  engine.jobs = options.jobs;
  if (!options.chunk.empty()) {
    const ChosenChunk chosen = chunk_of(options.chunk, [](const char* name) -> const char* { return std::getenv(name); });
    engine.chunk = chosen.chunk;
    if (!chosen.from.empty()) std::fprintf(stderr, "chunk %u of %u by %s\n", chosen.chunk.number, chosen.chunk.of, chosen.from.c_str());
  }
  return fly_campaign(folder, engine);
}

void run_campaign(CampaignArguments options) {
  if (fs::is_directory(options.target) && (!options.campaign.empty() || !options.out.empty() || !options.settings.empty() || options.force))
    throw InputError(options.target +
                     ": is the folder of a campaign that is expanded already: --campaign, --out, --set and --force go "
                     "with a mission file");
  if (!fs::is_directory(options.target)) {
    const fs::path folder = folder_of(options);
    if (options.force || !has_plan(folder)) {
      expand(options);
    } else {
      require_same_plan(options, folder);
    }
    options.target = folder.string();
  }
  const CampaignFolder folder = open_folder(options);
  const EngineResult flown = fly(options, folder);
  if (exit_code_of(flown.end) != kExitDone) leave(exit_code_of(flown.end));
  if (options.chunk.empty()) conclude(options, folder, false);
}

void list(const CampaignArguments& options) {
  const auto campaigns = load_mission_input(options.target, options.settings).source.campaigns;
  std::fputs((options.markdown ? campaign_table(campaigns) : campaign_list(campaigns)).c_str(), stdout);
}

void show_status(const CampaignArguments& options) {
  const LoadedPlan loaded = load_plan(options.target);
  const Records records(options.target, loaded.digest, loaded.plan.cases);
  if (records.missing() > 0 && loaded.plan.look_every > 0) {
    if (const auto end = ended_after(open_folder(options))) {
      std::printf("%u of at most %u cases are done, and the stopping rule ended the campaign after %u: mdat campaign merge %s\n",
                  records.done(), records.cases(), *end, shell_word(options.target).c_str());
      return;
    }
  }
  std::fputs(status_text(options.target, records).c_str(), stdout);
  if (records.missing() > 0) leave(kExitFailed);
}

void retry(const CampaignArguments& options) {
  const LoadedPlan loaded = load_plan(options.target);
  const std::size_t taken = retry_failed(options.target, loaded.digest);
  if (taken == 0) return (void)std::printf("no case has failed\n");
  std::printf("%zu failed %s to be flown again: mdat campaign run %s\n", taken, taken == 1 ? "case is" : "cases are",
              shell_word(options.target).c_str());
}

// Throws RunError where the case is not what the campaign recorded. Returns whether it recorded it.
bool is_as_recorded(const CampaignFolder& folder, std::uint32_t number, const std::string& fields) {
  const Records records(folder.path, folder.digest, folder.plan.cases);
  const auto recorded = records.of(number);
  if (!recorded || *recorded == fields) return recorded.has_value();
  throw RunError("case " + std::to_string(number) + " is not what the campaign recorded: " + std::string(*recorded) + ", now " + fields);
}

void warn_of_another_program(const CampaignPlan& plan) {
  if (program_sha256() == plan.program_sha256) return;
  std::fprintf(stderr, "warning: this mdat is not the one that expanded the campaign (%s, commit %s): the case might differ\n",
               plan.version.c_str(), plan.commit.c_str());
}

void case_again(const CampaignArguments& options) {
  const CampaignFolder folder = open_folder(options);
  warn_of_another_program(folder.plan);
  const fs::path out = options.out.empty() ? fs::path(options.target) / ("case-" + std::to_string(options.number)) : fs::path(options.out);
  OutputFolder files(out);
  FlownCase flown = fly_case(folder, options.number);
  files.write("results.json", results_json(flown.result));
  files.write("frames.csv", frames_csv(flown.result));
  files.write("telemetry.ccsds", telemetry_bytes(flown.result));
  files.commit();
  std::fputs(summary_text(flown.result).c_str(), stdout);
  const bool recorded = is_as_recorded(folder, options.number, flown.fields);
  std::printf("written to %s: results.json, frames.csv, telemetry.ccsds%s\n", out.c_str(),
              recorded ? "; all figures are those that the campaign recorded" : "");
  if (!options.report) return;
  Plotter plotter(out);
  files.write("report.html", report_html(plotter, flown.mission, flown.result));
  files.commit();
  std::printf("the report: %s\n", (out / "report.html").c_str());
}

void launch(const CampaignArguments& options) {
  const LoadedPlan loaded = load_plan(options.target);
  LaunchOptions launch;
  launch.program = fs::canonical("/proc/self/exe").string();
  launch.folder = fs::absolute(options.target).lexically_normal().string();
  launch.chunks = options.chunks != 0 ? options.chunks : chunks_for(loaded.plan.cases, options.seconds_per_case);
  launch.chunk_s = options.seconds_per_case * loaded.plan.cases / launch.chunks;
  const std::string text = launch_text(options.engine, launch);
  const Launcher& launcher = launcher_of(options.engine);
  OutputFolder out(fs::path(options.target) / "launch");
  out.write(launcher.file, text);
  out.commit();
  std::fputs(text.c_str(), stdout);
  std::fprintf(stderr, "written to %s; in its folder: %s\n", (out.path() / launcher.file).c_str(), launcher.submit);
}

void compare(const CampaignArguments& options) {
  const CampaignFolder a = open_campaign(options.target, options.cached), b = open_campaign(options.other, options.cached);
  const Comparison both = compare_cases(a.campaign(), merged(a, true), b.campaign(), merged(b, true));
  std::fputs(comparison_text(both, options.target, options.other).c_str(), stdout);
}

// Of an option: more than none, and a number.
std::string check_seconds(const std::string& text) {
  double seconds = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  const bool is_number = error == std::errc{} && end == text.data() + text.size();
  return is_number && seconds > 0 && std::isfinite(seconds) ? "" : "expected a number of seconds above 0, not " + text;
}

CLI::App* folder_command(CLI::App& group, const char* name, const char* what, const std::shared_ptr<CampaignArguments>& options) {
  CLI::App* command = group.add_subcommand(name, what);
  command->add_option("DIR", options->target, "folder of a campaign")->required()->check(CLI::ExistingDirectory);
  return command;
}

void add_expansion(CLI::App& command, const std::shared_ptr<CampaignArguments>& options) {
  command.add_option("--campaign", options->campaign, "name of the mission's [campaign.NAME]");
  command.add_option("--out", options->out, "folder of the campaign (out/campaign/NAME)");
  command.add_flag("--force", options->force, "remove an earlier campaign that is there, with all its results");
  add_settings(command, options->settings);
}

void add_run(CLI::App& group) {
  const auto options = std::make_shared<CampaignArguments>();
  CLI::App* command = group.add_subcommand("run", "fly a campaign of a mission, or what is missing in its folder, and conclude");
  command->add_option("MISSION|DIR", options->target, "mission file (.toml), or folder of a campaign that was expanded or begun")
      ->required();
  add_expansion(*command, options);
  add_no_cache(*command, options->cached);
  command->add_option("--jobs", options->jobs, "cases at a time (all cores)")->check(CLI::Range(1, 1024));
  command->add_option("--chunk", options->chunk, "k/N: fly only chunk k of N, from 1; auto or auto/N: as the scheduler's job array says");
  command->add_option("--time-limit", options->engine_options.time_limit_s, "begin no case that would end later than this, in seconds")
      ->check(&check_seconds);
  command->add_option("--case-time-limit", options->engine_options.case_time_limit_s, "a case that takes longer has failed, in seconds")
      ->check(&check_seconds);
  command->add_flag("!--no-report", options->report, "without report.html");
  command->footer(
      "The same command goes on where it was stopped or killed; finished cases are never lost.\n"
      "Exit codes: 0 flown and concluded, whatever the verdicts (summary.json, junit.xml have them); 75 stopped before the end: go on "
      "later.");
  command->callback([options] { run_campaign(*options); });
}

void add_expand(CLI::App& group) {
  const auto options = std::make_shared<CampaignArguments>();
  CLI::App* command = group.add_subcommand("expand", "draw all cases of a campaign, for other machines to fly");
  command->add_option("MISSION", options->target, "mission file (.toml)")->required()->check(CLI::ExistingFile);
  add_expansion(*command, options);
  add_no_cache(*command, options->cached);
  command->callback([options] { expand(*options); });
}

void add_list(CLI::App& group) {
  const auto options = std::make_shared<CampaignArguments>();
  CLI::App* command = group.add_subcommand("list", "the campaigns of a mission: what each varies and asks");
  command->add_option("MISSION", options->target, "mission file (.toml)")->required()->check(CLI::ExistingFile);
  command->add_flag("--markdown", options->markdown, "as a table for a page");
  add_settings(*command, options->settings);
  command->callback([options] { list(*options); });
}

void add_status(CLI::App& group) {
  const auto options = std::make_shared<CampaignArguments>();
  CLI::App* command = folder_command(group, "status", "how many cases are done, have failed, are missing", options);
  add_no_cache(*command, options->cached);
  command->footer("Exit codes: 0 none is missing (or the stopping rule needs no more), 1 some are.");
  command->callback([options] { show_status(*options); });
}

void add_retry(CLI::App& group) {
  const auto options = std::make_shared<CampaignArguments>();
  CLI::App* command = folder_command(group, "retry", "have the failed cases flown again", options);
  command->add_flag("--failed", options->failed, "those that failed to run; their records are kept beside")->required();
  command->callback([options] { retry(*options); });
}

void add_merge(CLI::App& group) {
  const auto options = std::make_shared<CampaignArguments>();
  CLI::App* command = folder_command(group, "merge", "put all chunks together, and conclude", options);
  add_no_cache(*command, options->cached);
  command->add_flag("--partial", options->partial, "although cases are missing");
  command->add_flag("!--no-report", options->report, "without report.html");
  command->callback([options] { conclude(*options, open_folder(*options), options->partial); });
}

void add_case(CLI::App& group) {
  const auto options = std::make_shared<CampaignArguments>();
  CLI::App* command = folder_command(group, "case", "fly one case again, bit for bit, with its report", options);
  command->add_option("NUMBER", options->number, "of the case, from 0")->required();
  command->add_option("--out", options->out, "folder for its results (DIR/case-NUMBER)");
  add_no_cache(*command, options->cached);
  command->add_flag("!--no-report", options->report, "without report.html");
  command->callback([options] { case_again(*options); });
}

void add_compare(CLI::App& group) {
  const auto options = std::make_shared<CampaignArguments>();
  CLI::App* command = group.add_subcommand("compare", "the same cases under two missions or versions: what changed, and is it chance?");
  command->add_option("A", options->target, "folder of a campaign")->required()->check(CLI::ExistingDirectory);
  command->add_option("B", options->other, "the other one")->required()->check(CLI::ExistingDirectory);
  command->footer("Cases are paired by their numbers, and have to draw the same values. Exit codes: 0 printed, whatever differs.");
  command->callback([options] { compare(*options); });
}

void add_launch(CLI::App& group) {
  const auto options = std::make_shared<CampaignArguments>();
  CLI::App* command = folder_command(group, "launch", "write and print what starts the chunks on a cluster", options);
  std::vector<std::string> engines;
  for (const Launcher& launcher : launchers()) engines.emplace_back(launcher.engine);
  command->add_option("--engine", options->engine, "whose language")->required()->check(CLI::IsMember(engines));
  command->add_option("--seconds", options->seconds_per_case, "processor seconds of a case, as times.csv of a trial has them")
      ->required()
      ->check(&check_seconds);
  command->add_option("--chunks", options->chunks, "how many (so many that one takes a quarter of an hour)")->check(CLI::Range(1, 100000));
  command->callback([options] { launch(*options); });
}

}  // namespace

void add_campaign_command(CLI::App& app) {
  CLI::App* group =
      app.add_subcommand("campaign", "fly a mission many times, as [campaign.NAME] varies it: how often does it fail, and where?");
  group->require_subcommand(1);
  add_list(*group);
  add_run(*group);
  add_expand(*group);
  add_status(*group);
  add_retry(*group);
  add_merge(*group);
  add_case(*group);
  add_compare(*group);
  add_launch(*group);
}

}  // namespace lasso::mdat
