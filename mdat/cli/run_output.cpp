#include "mdat/cli/run_output.hpp"

#include <cstdio>
#include <thread>
#include <utility>

#include "mdat/common/errors.hpp"
#include "mdat/render/run_pictures.hpp"
#include "mdat/report/report.hpp"
#include "mdat/run/frames_table.hpp"
#include "mdat/run/relative_table.hpp"
#include "mdat/run/results.hpp"

namespace lasso::mdat {
namespace {

std::vector<SeenPicture> seen_pictures(const CompiledMission& mission, const SimulationResult& result) {
  std::vector<SeenPicture> pictures;
  for (RunPicture& picture : run_pictures(mission, result, std::max(1U, std::thread::hardware_concurrency())))
    pictures.push_back({std::move(picture.caption), std::move(picture.png)});
  return pictures;
}

}  // namespace

void write_results(const SimulationResult& result, OutputFolder& folder) {
  folder.write("results.json", results_json(result));
  folder.write("frames.csv", frames_csv(result));
  folder.write("telemetry.ccsds", telemetry_bytes(result));
  if (!result.relative.empty()) folder.write("relative.csv", relative_csv(result.relative));
  folder.commit();
  folder.remove("report.html");  // of an earlier run
  if (result.relative.empty()) folder.remove("relative.csv");
}

void write_pictures(bool report, const std::string& picture, const CompiledMission& mission, const SimulationResult& result,
                    OutputFolder& folder) {
  Plotter plotter(folder.path());
  std::string problem;
  if (report) {
    folder.write("report.html", report_html(plotter, mission, result, seen_pictures(mission, result)));
    folder.commit();
    std::printf("the report: %s\n", (folder.path() / "report.html").c_str());
  }
  if (!plotter.missing().empty()) problem = (folder.path() / "report.html").string() + ": figures are missing: " + plotter.missing();
  try {
    if (!picture.empty()) write_file(picture, picture_png(plotter, mission, result));
  } catch (const PictureError& error) {
    problem = problem.empty() ? picture + ": " + error.what() : problem;
  }
  if (!problem.empty()) throw PictureError(problem + "; all results are written");
}

}  // namespace lasso::mdat
