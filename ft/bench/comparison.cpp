#include "ft/bench/comparison.hpp"

#include <algorithm>

#include "mdat/common/cpu_clock.hpp"
#include "mdat/common/errors.hpp"

namespace lasso::bench {
namespace {

// What the bar shows: steps done.
struct Progress {
  mdat::ProgressBar& bar;
  std::size_t done;
  void advance(std::size_t steps) { bar.show(done += steps); }
};

struct Track {
  std::vector<mdat::FrameError> frames;
  double iterations = 0;
};

mdat::FrameError judged(const Scan& scan, const Outcome& outcome, double elapsed_us) {
  mdat::FrameError error;
  error.reported = is_valid(outcome.T_sensor_target);  // a method may return anything
  error.estimate_us = elapsed_us;
  if (!error.reported) return error;
  error.valid = outcome.valid;
  error.registration = mdat::pose_error(outcome.T_sensor_target, scan.truth);
  error.filtered = error.registration;
  if (outcome.covariance.trace() > 0) error.nees = mdat::nees(outcome.T_sensor_target, scan.truth, outcome.covariance);
  error.bound = scan.bound;
  return error;
}

void run_once(Method& method, const Scan& scan, Track& track) {
  method.set_scan(scan);
  const double begin_us = mdat::thread_cpu_us();
  const Outcome outcome = method.run(scan.start);
  const double end_us = mdat::thread_cpu_us();
  track.frames.push_back(judged(scan, outcome, end_us - begin_us));
  track.iterations += outcome.iterations;
}

using Methods = std::vector<std::unique_ptr<Method>>;

// `turn` scans each; another method begins each round of turns.
std::vector<Track> take_turns(const Methods& methods, const std::vector<Scan>& scans, std::size_t turn, std::size_t first,
                              Progress& progress) {
  const std::size_t n = methods.size();
  std::vector<Track> tracks(n);
  for (std::size_t begin = 0, round = first; begin < scans.size(); begin += turn, ++round) {
    const std::size_t end = std::min(begin + turn, scans.size());
    for (std::size_t m = 0; m < n; ++m) {
      const std::size_t now = (round + m) % n;
      for (std::size_t i = begin; i < end; ++i) run_once(*methods[now], scans[i], tracks[now]);
    }
    progress.advance(end - begin);
  }
  return tracks;
}

mdat::TimeStatistics times_of(const std::vector<std::vector<Track>>& rounds, std::size_t method) {
  std::vector<double> times_us;
  for (const std::vector<Track>& tracks : rounds) {
    for (const mdat::FrameError& frame : tracks[method].frames) times_us.push_back(frame.estimate_us);
  }
  return mdat::time_statistics(std::move(times_us));
}

}  // namespace

std::vector<MethodResult> compare(const Methods& methods, const std::vector<Scan>& scans, std::size_t done, mdat::ProgressBar& bar) {
  Progress progress{bar, done};
  std::vector<std::vector<Track>> in_a_row;
  for (std::size_t round = 0; round < kRounds; ++round) in_a_row.push_back(take_turns(methods, scans, scans.size(), round, progress));
  const std::vector<Track> by_turns = take_turns(methods, scans, 1, 0, progress);
  std::vector<MethodResult> results;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const Track& first = in_a_row[0][m];
    mdat::RunStatistics statistics = mdat::run_statistics(first.frames);
    statistics.time = times_of(in_a_row, m);
    const double mean = first.iterations / static_cast<double>(scans.size());
    results.push_back({methods[m]->name(), methods[m]->is_peer(), statistics, mdat::run_statistics(by_turns[m].frames).time, mean});
  }
  return results;
}

const MethodResult& result_of(const std::vector<MethodResult>& results, const std::string& name) {
  for (const MethodResult& result : results) {
    if (result.name == name) return result;
  }
  throw mdat::RunError("no method is called " + name);
}

}  // namespace lasso::bench
