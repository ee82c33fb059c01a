#include <cstdio>
#include <memory>

#include "mdat/calibrate/camera_table.hpp"
#include "mdat/calibrate/fit.hpp"
#include "mdat/calibrate/picture.hpp"
#include "mdat/cli/commands.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/missiondb/calibration_file.hpp"
#include "mdat/report/plotter.hpp"

namespace lasso::mdat {
namespace {

constexpr double kMmAt3m = 1e-3 / 9;  // k of a noise of 1 mm at 3 m

struct CalibrateArguments {
  std::vector<std::string> recordings;
  std::string start, out, picture, simulate, read;
  bool remote = false;
  double noise_mm = 1;
  PlaneRun run;
};

void record(const CalibrateArguments& options) {
  PlaneRun run = options.run;
  run.sigma_k_per_m = options.noise_mm * kMmAt3m;
  const std::vector<RawPoint> points = simulate_planes(load_calibration(options.simulate), run);
  write_file(options.out, raw_points_text(points));
  std::printf("%zu raw points written to %s\n", points.size(), options.out.c_str());
}

void read(const CalibrateArguments& options) {
  check_writable(options.out);
  const lcs::Calibration table = read_camera_table(options.read, options.remote);
  write_file(options.out, calibration_text(table));
  std::printf("calibration of camera %u written to %s\n", static_cast<unsigned>(table.serial), options.out.c_str());
}

void print(const char* what, const CalibrationReport& report) {
  std::printf("%-7s %zu points: rms %.4f mm, %.3f of the noise, worst cell %.3f\n", what, report.points, report.rms_mm,
              report.rms_over_noise, report.worst_cell);
}

void calibrate(const CalibrateArguments& options) {
  check_writable(options.out);
  if (!options.picture.empty()) check_writable(options.picture);
  if (!options.picture.empty()) warn_of_plotter();
  const lcs::Calibration start = load_calibration(options.start);
  std::vector<RawPoint> points;
  for (const std::string& file : options.recordings) {
    const std::vector<RawPoint> some = read_raw_points(file);
    points.insert(points.end(), some.begin(), some.end());
  }
  const double sigma_k = options.noise_mm * kMmAt3m;
  const CalibrationFit fit = fit_calibration(start, points, sigma_k);
  const CalibrationReport before = residuals_of(start, points, sigma_k);
  print("before:", before);
  print("after:", fit.report);
  write_file(options.out, calibration_text(fit.calibration));
  std::printf("written to %s\n", options.out.c_str());
  if (options.picture.empty()) return;
  Plotter plotter(std::filesystem::absolute(options.picture).parent_path());
  write_file(options.picture, residual_picture(plotter, before, fit.report));
}

}  // namespace

void add_calibrate_command(CLI::App& app) {
  const auto options = std::make_shared<CalibrateArguments>();
  CLI::App* command = app.add_subcommand("calibrate", "fit a laser camera's calibration to raw points of a plane moved through its volume");
  command->add_option("RECORDING", options->recordings, "raw points (CSV, docs/user-guide.md)");
  command->add_option("--start", options->start, "calibration to begin from: the design's, or the last one");
  command->add_option("-o,--out", options->out, "file to write: the calibration")->required();
  command->add_option("--picture", options->picture, "also write the residuals over the volume as a PNG picture");
  command->add_option("--noise", options->noise_mm, "of a range at 3 m, mm; it grows with the square of the depth")
      ->capture_default_str()
      ->check(number_between(1e-3, 1e3));
  CLI::Option* simulate = command->add_option("--simulate", options->simulate,
                                              "instead of a fit: write the raw points that a camera of this calibration measures");
  CLI::Option* read_option = command
                                 ->add_option("--read", options->read,
                                              "instead of a fit: write the table that the camera at the end of this line was made with (a "
                                              "serial device, tcp://127.0.0.1:PORT or unix:PATH)")
                                 ->excludes(simulate);
  command->add_flag("--remote", options->remote, "the line may lead to another machine")->needs(read_option);
  command->add_option("--seed", options->run.seed, "start of its random numbers")->capture_default_str();
  command->callback([options, simulate, read_option] {
    if (simulate->count() > 0) return record(*options);
    if (read_option->count() > 0) return read(*options);
    if (options->recordings.empty()) throw InputError("RECORDING: expected at least one file of raw points");
    if (options->start.empty()) throw InputError("--start: expected a calibration to begin from");
    calibrate(*options);
  });
}

}  // namespace lasso::mdat
