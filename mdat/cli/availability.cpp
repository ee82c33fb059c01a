#include <cstdio>
#include <memory>
#include <thread>

#include "mdat/availability/page.hpp"
#include "mdat/availability/pictures.hpp"
#include "mdat/availability/results.hpp"
#include "mdat/cli/commands.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/version.hpp"

namespace lasso::mdat {
namespace {

struct AvailabilityArguments {
  ComparisonOptions comparison;
  std::string out = "out/availability";
  bool report = true, force = false;
};

constexpr char kAvailabilityResults[] = "results.json", kAvailabilityFrames[] = "frames.csv", kAvailabilityPage[] = "availability.html";

void write_availability_page(const AvailabilityArguments& options, const HeadComparison& comparison, OutputFolder& folder) {
  Plotter plotter(folder.path());
  const std::string file = (folder.path() / kAvailabilityPage).string();
  folder.write(kAvailabilityPage, comparison_html(plotter, comparison, approach_pictures(options.comparison, comparison)));
  folder.commit();
  std::printf("the page: %s\n", file.c_str());
  if (!plotter.missing().empty()) throw PictureError(file + ": figures are missing: " + plotter.missing() + "; all results are written");
}

void availability(const AvailabilityArguments& options) {
  OutputFolder folder(options.out);
  if (!options.force)
    refuse_to_replace({folder.path() / kAvailabilityResults, folder.path() / kAvailabilityFrames, folder.path() / kAvailabilityPage},
                      "--force replaces them, --out DIR keeps them");
  if (options.report) warn_of_plotter();
  HeadComparison comparison = compare_heads(options.comparison);
  comparison.commit = kCommit;
  folder.write(kAvailabilityResults, comparison_json(comparison));
  folder.write(kAvailabilityFrames, comparison_csv(comparison));
  folder.commit();
  folder.remove(kAvailabilityPage);  // of an earlier run
  std::fputs(comparison_text(comparison).c_str(), stdout);
  std::printf("written to %s: %s, %s\n", options.out.c_str(), kAvailabilityResults, kAvailabilityFrames);
  (void)std::fflush(stdout);
  if (options.report) write_availability_page(options, comparison, folder);
}

}  // namespace

void add_availability_command(CLI::App& app) {
  const auto options = std::make_shared<AvailabilityArguments>();
  ComparisonOptions& comparison = options->comparison;
  comparison.jobs = std::max(1U, std::thread::hardware_concurrency());
  CLI::App* command = app.add_subcommand(
      "availability", "when a laser camera and stereo cameras give poses in the light of an orbit, and how good these are");
  command->add_option("MISSION", comparison.mission.file, "mission file of a scene in an orbit, such as cfg/missions/day_and_night.toml")
      ->required();
  command->add_option("--approach", comparison.approach, "scenario that is flown with each head")->capture_default_str();
  command->add_option("--hold", comparison.hold, "scenario whose first frame is taken in samples of whole orbits")->capture_default_str();
  command->add_option("--frames", comparison.frames, "frames of the approach (the scenario's)")->check(CLI::Range(1, 1000000));
  command->add_option("--angles", comparison.angles, "samples of each orbit, evenly spread; 0: none")
      ->capture_default_str()
      ->check(CLI::Range(0, 3600));
  command->add_option("--betas", comparison.betas_deg, "the Sun's elevations above the sampled orbits' planes, deg: 0,30,60")
      ->delimiter(',')
      ->capture_default_str()
      ->check(number_between(-90.0, 90.0));
  command->add_option("-o,--out", options->out, "folder to write")->capture_default_str();
  command->add_option("-j,--jobs", comparison.jobs, "threads; no effect on the results")->capture_default_str()->check(CLI::Range(1, 256));
  add_settings(*command, comparison.mission.settings);
  command->add_flag("--force", options->force, "replace what an earlier run left in the folder");
  add_no_cache(*command, comparison.mission.cached);
  command->add_flag("!--no-report", options->report, "leave availability.html out");
  command->footer(
      "Examples:\n"
      "  mdat availability cfg/missions/day_and_night.toml\n"
      "  mdat availability cfg/missions/day_and_night.toml --frames 12 --angles 4 --set stereo.pixels=400\n"
      "Stereo needs OpenCV: make stereo");
  command->callback([options] { availability(*options); });
}

}  // namespace lasso::mdat
