// mdat-match: disparities of a pair of pictures. What it knows are two files of pixels, their calibration, and between which depths to
// look. Exit codes: 0 done, 1 failed, 2 usage or bad input.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>

#include "mdat/match/matching.hpp"

namespace {

using namespace lasso::mdat;

constexpr int kBadUsage = 2;

int match(int argc, char** argv) {
  MatchInput input;
  std::string disparity, geometry;
  CLI::App app("disparities of a pair of pictures (PNG), as a 16-bit PNG", "mdat-match");
  app.add_option("--left", input.left, "picture of the left camera")->required();
  app.add_option("--right", input.right, "picture of the right camera")->required();
  app.add_option("--calibration", input.calibration, "calibration of the pair (TOML, docs/stereo.md)")->required();
  app.add_option("--nearest", input.window.nearest_m, "depth, m")->required();
  app.add_option("--farthest", input.window.farthest_m, "depth, m")->required();
  app.add_option("--disparity", disparity, "file to write: sixteenths of a pixel, 0 where none was found")->required();
  app.add_option("--geometry", geometry, "file to write: what the disparities mean (JSON)")->required();
  CLI11_PARSE(app, argc, argv);
  const bool is_window =
      std::isfinite(input.window.farthest_m) && input.window.nearest_m > 0 && input.window.farthest_m > input.window.nearest_m;
  if (!is_window) {
    std::fprintf(stderr, "mdat-match: --nearest %g --farthest %g: expected a depth above 0, then a greater one\n", input.window.nearest_m,
                 input.window.farthest_m);
    return kBadUsage;
  }
  write_disparity_map(matched_files(input), disparity, geometry);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return match(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mdat-match: %s\n", error.what());
    return kBadUsage;
  }
}
