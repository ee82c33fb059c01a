// peer_bench MISSION: the estimator beside what others use, on the same scans in one run. Exit codes as mdat's.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "ft/bench/outcome_table.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/source/mission_error.hpp"

namespace {

using namespace lasso::bench;
namespace mdat = lasso::mdat;

struct Options {
  std::string mission, out = "out/bench";
  ScanOptions scans;
};

Comparison compare_all(const Options& options) {
  const mdat::CompiledMission mission = mdat::compile_mission(options.mission);
  ScanOptions noise_free = options.scans;
  noise_free.noise = false;
  const std::vector<Scan> clean = make_scans(mission, noise_free), noisy = make_scans(mission, options.scans);
  const auto methods = make_methods(mission, options.scans.scenario);
  mdat::ProgressBar bar("peers", (kRounds + 1) * (clean.size() + noisy.size()), "scans");
  Comparison comparison{mission.source.name, options.scans.scenario, noisy.size(), {}, {}};
  comparison.noise_free = compare(methods, clean, 0, bar);
  comparison.noisy = compare(methods, noisy, (kRounds + 1) * clean.size(), bar);
  bar.finish();
  return comparison;
}

void run(const Options& options) {
  mdat::OutputFolder folder(options.out);
  const Comparison comparison = compare_all(options);
  folder.write("results.json", table_json(comparison));
  folder.commit();
  std::fputs(table_text(comparison).c_str(), stdout);
  std::printf("\nwritten to %s: results.json\n", options.out.c_str());
}

int refuse(const std::exception& error, int exit_code) {
  std::fprintf(stderr, "peer_bench: %s\n", error.what());
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Options options;
    CLI::App app("registers the same scans by the estimator and by its peers", "peer_bench");
    app.add_option("MISSION", options.mission, "mission file")->required();
    app.add_option("--scenario", options.scans.scenario, "scenario of the paper's kind")->capture_default_str();
    app.add_option("--stride", options.scans.stride, "register every n-th frame of each range")
        ->capture_default_str()
        ->check(CLI::Range(1, 100000));
    app.add_option("-o,--out", options.out, "folder to write results.json into")->capture_default_str();
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      return app.exit(error) == 0 ? mdat::kExitDone : mdat::kExitBadInput;
    }
    run(options);
    return mdat::kExitDone;
  } catch (const mdat::InputError& error) {
    return refuse(error, mdat::kExitBadInput);
  } catch (const mdat::MissionError& error) {
    return refuse(error, mdat::kExitBadInput);
  } catch (const std::exception& error) {
    return refuse(error, mdat::kExitFailed);
  }
}
