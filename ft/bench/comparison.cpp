#include "ft/bench/comparison.hpp"

#include <algorithm>

#include "mdat/common/cpu_clock.hpp"
#include "mdat/common/errors.hpp"

namespace lasso::bench {
namespace {

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

// `turn` scans each; another method begins each round.
std::vector<Track> take_turns(const Methods& methods, const std::vector<Scan>& scans, std::size_t turn, std::size_t done,
                              mdat::ProgressBar& bar) {
  const std::size_t n = methods.size();
  std::vector<Track> tracks(n);
  for (std::size_t begin = 0, round = 0; begin < scans.size(); begin += turn, ++round) {
    const std::size_t end = std::min(begin + turn, scans.size());
    for (std::size_t m = 0; m < n; ++m) {
      const std::size_t now = (round + m) % n;
      for (std::size_t i = begin; i < end; ++i) run_once(*methods[now], scans[i], tracks[now]);
    }
    bar.show(done + end);
  }
  return tracks;
}

}  // namespace

std::vector<MethodResult> compare(const Methods& methods, const std::vector<Scan>& scans, std::size_t done, mdat::ProgressBar& bar) {
  const std::vector<Track> in_a_row = take_turns(methods, scans, kScansInARow, done, bar);
  const std::vector<Track> by_turns = take_turns(methods, scans, 1, done + scans.size(), bar);
  std::vector<MethodResult> results;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const double mean = in_a_row[m].iterations / static_cast<double>(scans.size());
    const mdat::RunStatistics statistics = mdat::run_statistics(in_a_row[m].frames);
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
