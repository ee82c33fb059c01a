// How the component does on bodies that nobody has tuned for (docs/bodies.md).
//
// usage: bodies WHAT FIRST:LAST COUNT FRAMES SENSOR JOBS FOLDER [KEY=VALUE ...]
// WHAT is track (COUNT flights of FRAMES each), start, search, configuration or compare (COUNT scans each). SENSOR is laser, lidar, or -
// for what the body's size asks for. FOLDER gets table.csv, wrong.csv, again.txt (commands that fly flights with wrong
// poses again), summary.txt, and the missions; of compare compare.csv, summary.txt and the missions.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "ft/bodies/compare.hpp"
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
  const auto known = {"track", "start", "search", "configuration", "compare"};
  if (std::find(known.begin(), known.end(), options.what) == known.end())
    throw mdat::InputError("WHAT=" + options.what + ": track, start, search, configuration or compare");
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

// A body's line, and of compare its scans.
struct TriedBody {
  Row row;
  std::vector<Comparison> comparisons;
};

TriedBody try_seed(const Options& options, std::uint64_t seed) {
  TriedBody body;
  body.row.seed = seed;
  try {
    const Subject subject = make_subject(options, seed);
    body.row = row_of(subject);
    if (options.what == "compare") {
      body.comparisons = compare(subject, options.count);
    } else {
      body.row.tally = tried(options, subject);
    }
  } catch (const std::exception& error) {
    body.row.failure = error.what();
  }
  return body;
}

// In the order of the seeds, whoever tried them.
std::vector<TriedBody> try_all(const Options& options) {
  std::vector<TriedBody> bodies(options.last - options.first + 1);
  std::atomic<std::size_t> next{0}, done{0};
  std::mutex drawing;
  mdat::ProgressBar bar(options.what, bodies.size(), "bodies");
  const auto work = [&] {
    for (std::size_t i = next++; i < bodies.size(); i = next++) {
      bodies[i] = try_seed(options, options.first + i);
      const std::lock_guard lock(drawing);
      bar.show(++done);
    }
  };
  {
    std::vector<std::jthread> threads;
    for (unsigned job = 0; job < options.jobs; ++job) threads.emplace_back(work);
  }
  bar.finish();
  return bodies;
}

// Says which files there are.
std::string write_comparisons(const Options& options, const std::vector<TriedBody>& bodies) {
  std::vector<Comparison> all;
  std::string csv =
      "body,scan,determined,accepted,accepted_wrong,poses,hits_valid,hits_wrong,hits_margin,likelihood_valid,likelihood_wrong,"
      "likelihood_margin\n";
  for (const TriedBody& body : bodies) {
    csv += comparison_csv(body.row.seed, body.comparisons);
    all.insert(all.end(), body.comparisons.begin(), body.comparisons.end());
  }
  const std::string summary = comparison_text(all);
  mdat::write_file(options.folder / "compare.csv", csv);
  mdat::write_file(options.folder / "summary.txt", summary);
  return summary + "written to " + options.folder.string() + ": compare.csv, summary.txt, missions\n";
}

std::string write_tallies(const Options& options, const std::vector<TriedBody>& bodies) {
  std::vector<Row> rows;
  for (const TriedBody& body : bodies) rows.push_back(body.row);
  const std::string summary = summary_text(options.what, rows);
  mdat::write_file(options.folder / "table.csv", table_csv(rows));
  mdat::write_file(options.folder / "wrong.csv", wrong_csv(rows));
  mdat::write_file(options.folder / "again.txt", again_text(rows));
  mdat::write_file(options.folder / "summary.txt", summary);
  return summary + "written to " + options.folder.string() + ": table.csv, wrong.csv, again.txt, summary.txt, missions\n";
}

int run(const Options& options) {
  std::filesystem::create_directories(options.folder / "missions");
  const std::vector<TriedBody> bodies = try_all(options);
  const std::string text = options.what == "compare" ? write_comparisons(options, bodies) : write_tallies(options, bodies);
  for (const TriedBody& body : bodies) {
    const Row& row = body.row;
    if (!row.failure.empty()) std::fprintf(stderr, "body %llu: %s\n", static_cast<unsigned long long>(row.seed), row.failure.c_str());
  }
  std::fputs(text.c_str(), stdout);
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
