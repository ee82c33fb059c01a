#include <cstdio>
#include <memory>
#include <thread>

#include "mdat/cli/commands.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/version.hpp"
#include "mdat/paper/page.hpp"
#include "mdat/paper/results.hpp"

namespace lasso::mdat {
namespace {

struct PaperArguments {
  PaperOptions paper;
  std::string out = "out/paper";
  bool report = true, force = false;
};

constexpr char kPaperResults[] = "results.json", kPaperPage[] = "paper.html";

void write_paper_page(const PaperResult& result, OutputFolder& folder) {
  Plotter plotter(folder.path());
  folder.write(kPaperPage, paper_html(plotter, result));
  folder.commit();
  std::printf("the page: %s\n", (folder.path() / kPaperPage).c_str());
  if (!plotter.missing().empty())
    throw PictureError((folder.path() / kPaperPage).string() + ": figures are missing: " + plotter.missing() + "; all results are written");
}

void paper(const PaperArguments& options) {
  OutputFolder folder(options.out);
  if (!options.force)
    refuse_to_replace({folder.path() / kPaperResults, folder.path() / kPaperPage}, "--force replaces them, --out DIR keeps them");
  if (options.report) warn_of_plotter();
  PaperResult result = repeat_paper(options.paper);
  result.commit = kCommit;
  folder.write(kPaperResults, paper_json(result));
  folder.commit();
  folder.remove(kPaperPage);  // of an earlier run
  std::fputs(paper_text(result).c_str(), stdout);
  std::printf("written to %s: %s\n", options.out.c_str(), kPaperResults);
  (void)std::fflush(stdout);
  if (options.report) write_paper_page(result, folder);
}

}  // namespace

void add_paper_command(CLI::App& app) {
  const auto options = std::make_shared<PaperArguments>();
  options->paper.jobs = std::max(1U, std::thread::hardware_concurrency());
  CLI::App* command = app.add_subcommand(
      "paper", "repeat the experiments of the 3DLASSO paper (2005) in simulation, and set the figures beside the paper's");
  command->add_option("-o,--out", options->out, "folder to write")->capture_default_str();
  command->add_option("--missions", options->paper.missions, "folder with hubble_tenth.toml and laboratory.toml")->capture_default_str();
  command
      ->add_option("--frames", options->paper.frames, "frames of each range, and at most as many of each stand (the missions' 360 and 50)")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--stands", options->paper.laboratory.stands, "stands of a full turn in the laboratory test; 24 are 15 degrees apart")
      ->capture_default_str()
      ->check(CLI::Range(2, 360));
  command
      ->add_option("--mock-ups", options->paper.laboratory.mock_ups,
                   "mock-ups at each range of the laboratory test, each with errors of its own")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command->add_option("-j,--jobs", options->paper.jobs, "ranges and stands at a time; no effect on the results")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  command->add_flag("--force", options->force, "replace what an earlier run left in the folder");
  add_no_cache(*command, options->paper.cached);
  command->add_flag("!--no-report", options->report, "leave paper.html out");
  command->callback([options] { paper(*options); });
}

}  // namespace lasso::mdat
