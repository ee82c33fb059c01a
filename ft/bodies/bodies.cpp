// How the component does on bodies that nobody has tuned for (docs/bodies.md).
//
// usage: bodies WHAT FIRST:LAST COUNT FRAMES SENSOR JOBS FOLDER [KEY=VALUE ...]
// WHAT is track (COUNT flights of FRAMES each), start, search or configuration (COUNT scans each). SENSOR is laser, lidar, or - for what
// the body's size asks for. FOLDER gets table.csv, wrong.csv, again.txt (commands that fly flights with wrong
// poses again), summary.txt, and the missions.
#include <atomic>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "ft/bodies/trials.hpp"
#include "mdat/common/count.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/progress_bar.hpp"

namespace {

using namespace lasso;
using namespace lasso::bodies;

struct Options {
  std::string what;
  std::uint64_t first = 1, last = 1;
  std::size_t count = 1;
  std::uint32_t frames = 1;
  std::optional<mdat::SensorKind> sensor;
  unsigned jobs = 1;
  std::filesystem::path folder;
  std::vector<std::string> settings;
};

std::optional<mdat::SensorKind> sensor_of(const std::string& name) {
  if (name == "laser") return mdat::SensorKind::kLaserCamera;
  if (name == "lidar") return mdat::SensorKind::kTimeOfFlight;
  if (name == "-") return std::nullopt;
  throw mdat::InputError("SENSOR=" + name + ": laser or lidar, or none for what the body's size asks for");
}

Options options_of(int count, char** arguments) {
  Options options;
  options.what = arguments[1];
  if (options.what != "track" && options.what != "start" && options.what != "search" && options.what != "configuration")
    throw mdat::InputError("WHAT=" + options.what + ": track, start, search or configuration");
  const std::string range = arguments[2];
  const std::size_t colon = range.find(':');
  options.first = mdat::count_of<std::uint64_t>("BODIES", range.substr(0, colon));
  options.last =
      colon == std::string::npos ? options.first : mdat::count_of<std::uint64_t>("BODIES", range.substr(colon + 1), options.first);
  options.count = mdat::count_of<std::size_t>("FLIGHTS", arguments[3], 1);
  options.frames = mdat::count_of<std::uint32_t>("FRAMES", arguments[4], 1);
  options.sensor = sensor_of(arguments[5]);
  options.jobs = mdat::count_of<unsigned>("JOBS", arguments[6], 1);
  options.folder = arguments[7];
  options.settings.assign(arguments + 8, arguments + count);
  return options;
}

// Mission and model are kept, for who flies the body again.
Subject make_subject(const Options& options, std::uint64_t seed) {
  mdat::SubjectRequest request;
  request.seed = seed;
  request.sensor = options.sensor;
  request.settings = options.settings;
  const std::string name = "body_" + std::to_string(seed);
  request.mission = options.folder / "missions" / (name + ".toml");
  request.model = options.folder / "missions" / (name + "_model.toml");
  return mdat::make_subject(request);
}

Tally tried(const Options& options, const Subject& subject) {
  if (options.what == "track") return track(subject, options.count, options.frames);
  if (options.what == "start") return start(subject, options.count);
  if (options.what == "search") return search(subject, options.count);
  return configuration(subject, options.count);
}

Row row_of_seed(const Options& options, std::uint64_t seed) {
  Row row;
  row.seed = seed;
  try {
    const Subject subject = make_subject(options, seed);
    row = row_of(subject);
    row.tally = tried(options, subject);
  } catch (const std::exception& error) {
    row.failure = error.what();
  }
  return row;
}

// In the order of the seeds, whoever tried them.
std::vector<Row> try_all(const Options& options) {
  std::vector<Row> rows(options.last - options.first + 1);
  std::atomic<std::size_t> next{0}, done{0};
  std::mutex drawing;
  mdat::ProgressBar bar(options.what, rows.size(), "bodies");
  const auto work = [&] {
    for (std::size_t i = next++; i < rows.size(); i = next++) {
      rows[i] = row_of_seed(options, options.first + i);
      const std::lock_guard lock(drawing);
      bar.show(++done);
    }
  };
  {
    std::vector<std::jthread> threads;
    for (unsigned job = 0; job < options.jobs; ++job) threads.emplace_back(work);
  }
  bar.finish();
  return rows;
}

int run(const Options& options) {
  std::filesystem::create_directories(options.folder / "missions");
  const std::vector<Row> rows = try_all(options);
  const std::string summary = summary_text(options.what, rows);
  mdat::write_file(options.folder / "table.csv", table_csv(rows));
  mdat::write_file(options.folder / "wrong.csv", wrong_csv(rows));
  mdat::write_file(options.folder / "again.txt", again_text(rows));
  mdat::write_file(options.folder / "summary.txt", summary);
  for (const Row& row : rows) {
    if (!row.failure.empty()) std::fprintf(stderr, "body %llu: %s\n", static_cast<unsigned long long>(row.seed), row.failure.c_str());
  }
  std::printf("%swritten to %s: table.csv, wrong.csv, again.txt, summary.txt, missions\n", summary.c_str(), options.folder.c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 8) throw mdat::InputError("usage: bodies WHAT FIRST:LAST COUNT FRAMES SENSOR JOBS FOLDER [KEY=VALUE ...]");
    return run(options_of(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bodies: %s\n", error.what());
    return 2;
  }
}
