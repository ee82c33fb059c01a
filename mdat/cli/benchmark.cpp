#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>

#include "mdat/benchmark/benchmark_set.hpp"
#include "mdat/benchmark/run_set.hpp"
#include "mdat/benchmark/score_text.hpp"
#include "mdat/cli/commands.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

struct BenchmarkArguments {
  std::string folder, sensor, out = "poses.csv", json, csv;
  std::vector<std::string> poses;
  SetPlan plan{2001, 20, 20, std::nullopt, 10};
  bool cached = true, force = false;
};

void print_answer(const std::string& text) { std::fputs(text.c_str(), stdout); }

std::size_t determined_scans(const BenchmarkSet& set) {
  std::size_t count = 0;
  for (const TrueBody& body : set.truth) {
    for (const TrueScan& scan : body.scans) count += scan.determined ? 1U : 0U;
  }
  return count;
}

void make(const BenchmarkArguments& options) {
  SetPlan plan = options.plan;
  plan.sensor = sensor_named(options.sensor);
  if (plan.seed + plan.bodies - 1 > kSeedMost) {
    throw InputError("--seed: " + std::to_string(plan.seed) + ": the last of " + std::to_string(plan.bodies) +
                     " bodies would have a seed above " + std::to_string(kSeedMost) + ": take a smaller one, or fewer bodies");
  }
  const BenchmarkSet set = make_set(plan, options.folder, options.cached);
  ScoreCounts counts;
  counts.scans = plan.bodies * plan.scans;
  counts.determined = determined_scans(set);
  const std::string folder = shell_word(options.folder);
  print_answer(set_text(set, counts) + options.folder + ": written: " + kProtocolFile +
               ", a folder a body; the truth is not in it\nnext:\n  mdat benchmark run " + folder +
               " --out poses.csv      # or your program, in the form that mdat benchmark --help shows\n  mdat benchmark score " + folder +
               " poses.csv\n");
}

void run(const BenchmarkArguments& options) {
  if (!options.force) refuse_to_replace({options.out}, "--force replaces it");
  check_writable(options.out);
  const ProgramPoses poses = run_set(options.folder, options.cached);
  write_file(options.out, program_poses_csv(poses));
  std::size_t valid = 0;
  for (const ProgramPose& row : poses.rows) valid += row.valid ? 1U : 0U;
  print_answer(format("%zu of %s gave a valid pose\n", valid, amount(poses.rows.size(), "scan").c_str()) + options.out +
               ": written\nnext:\n  mdat benchmark score " + shell_word(options.folder) + " " + shell_word(options.out) + "\n");
}

// All tables are read before anything is made; two of one name would not be told apart.
std::vector<ProgramPoses> read_all(const BenchmarkArguments& options) {
  const Protocol protocol = read_protocol(options.folder);
  std::vector<ProgramPoses> all;
  std::set<std::string> names;
  for (const std::string& file : options.poses) {
    all.push_back(read_program_poses(file, protocol));
    if (!names.insert(all.back().program).second)
      throw InputError(file + ": a table of the name " + all.back().program + " is given already; programs are named after their files");
  }
  return all;
}

void score_all(const BenchmarkArguments& options) {
  for (const std::string& file : {options.json, options.csv}) {
    if (file.empty()) continue;
    if (!options.force) refuse_to_replace({file}, "--force replaces it");
    check_writable(file);
  }
  std::vector<std::string> inputs = options.poses;
  inputs.push_back((std::filesystem::path(options.folder) / "protocol.json").string());
  refuse_same_files({options.json, options.csv}, inputs);
  const std::vector<ProgramPoses> programs = read_all(options);
  const BenchmarkSet set = open_set(options.folder, options.cached);
  std::vector<Score> scores;
  for (const ProgramPoses& poses : programs) scores.push_back(score(set, poses));
  if (!options.json.empty()) write_file(options.json, scores_json(set, scores));
  if (!options.csv.empty()) write_file(options.csv, scores_csv(scores));
  print_answer(scores_text(set, scores));
  for (const std::string& file : {options.json, options.csv}) print_answer(file.empty() ? "" : file + ": written\n");
}

constexpr char kForms[] =
    "A set is a folder that any program can read: protocol.json names the bodies' meshes, missions, scans and starts.\n"
    "A program's table has a row a scan, columns in any order and among others:\n"
    "  body,scan           as protocol.json and starts.csv name them\n"
    "  qx,qy,qz,qw         the quaternion of T_sensor_target, scalar last, which takes target coordinates to sensor coordinates\n"
    "  x_m,y_m,z_m         its translation in metres\n"
    "  valid               1, or 0 where the program refuses the pose (optional: without it each row is valid)\n"
    "  time_s              processor time of the scan (optional)\n"
    "  cov_x_x ... cov_rz_rz   covariance: all 21 pairs of x, y, z (origin, metres) and rx, ry, rz (radians), sensor axes (optional)\n"
    "A scan without a row counts as refused. docs/benchmark-protocol.md has the rules.";

void add_make(CLI::App& benchmark, const std::shared_ptr<BenchmarkArguments>& options) {
  CLI::App* command = benchmark.add_subcommand("make", "write a set: bodies, missions, scans and starts, but no truth");
  command->add_option("FOLDER", options->folder, "new folder to write")->required();
  command->add_option("--seed", options->plan.seed, "of the first body; those of the others follow")
      ->capture_default_str()
      ->check(number_between(0, static_cast<double>(kSeedMost)));
  command->add_option("--bodies", options->plan.bodies, "how many")
      ->capture_default_str()
      ->check(CLI::Range(std::uint64_t{1}, kBodiesMost));
  command->add_option("--scans", options->plan.scans, "of each body")
      ->capture_default_str()
      ->check(CLI::Range(std::uint64_t{1}, kScansMost));
  command->add_option("--sensor", options->sensor, "of all bodies; otherwise a body's size decides")
      ->check(CLI::IsMember({"laser_camera", "lidar"}));
  command
      ->add_option("--start", options->plan.start_deg, "how far starts are turned [deg]; each degree also shifts them by 1 % of the size")
      ->capture_default_str()
      ->check(number_between(kStartLeast_deg, kStartMost_deg));
  add_no_cache(*command, options->cached);
  command->callback([options] { make(*options); });
}

void add_run(CLI::App& benchmark, const std::shared_ptr<BenchmarkArguments>& options) {
  CLI::App* command = benchmark.add_subcommand("run", "register a set's scans, as mdat replay --wide does");
  command->add_option("FOLDER", options->folder, "folder of the set")->required();
  command->add_option("-o,--out", options->out, "table of poses to write")->capture_default_str();
  command->add_flag("--force", options->force, "replace a table that is there");
  add_no_cache(*command, options->cached);
  command->callback([options] { run(*options); });
}

void add_score(CLI::App& benchmark, const std::shared_ptr<BenchmarkArguments>& options) {
  CLI::App* command = benchmark.add_subcommand("score", "judge tables of poses against the truth, which is made again from the seed");
  command->add_option("FOLDER", options->folder, "folder of the set")->required();
  command->add_option("POSES", options->poses, "tables of poses, one a program, named after it")->required();
  command->add_option("--json", options->json, "file to write: the same, and each body");
  command->add_option("--csv", options->csv, "file to write: a row for each scan of each program, its verdict and errors");
  command->add_flag("--force", options->force, "replace these files where they are there");
  add_no_cache(*command, options->cached);
  command->footer(std::string(kForms) + "\n\nExit codes: 0 scored, however well; 2 the set was changed, or a table is wrong.");
  command->callback([options] { score_all(*options); });
}

}  // namespace

void add_benchmark_commands(CLI::App& app) {
  const auto options = std::make_shared<BenchmarkArguments>();
  CLI::App* benchmark = app.add_subcommand("benchmark", "compare programs that find poses: make a set of scans, run it, score any program");
  benchmark->require_subcommand(1);
  add_make(*benchmark, options);
  add_run(*benchmark, options);
  add_score(*benchmark, options);
  benchmark->footer(kForms);
}

}  // namespace lasso::mdat
