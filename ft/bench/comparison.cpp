#include "ft/bench/comparison.hpp"

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

}  // namespace

std::vector<MethodResult> compare(const std::vector<std::unique_ptr<Method>>& methods, const std::vector<Scan>& scans, std::size_t done,
                                  mdat::ProgressBar& bar) {
  const std::size_t n = methods.size();
  std::vector<Track> tracks(n);
  for (const auto& method : methods) {
    Track warm_up;
    run_once(*method, scans.front(), warm_up);
  }
  for (std::size_t i = 0; i < scans.size(); ++i) {
    for (std::size_t turn = 0; turn < n; ++turn) run_once(*methods[(i + turn) % n], scans[i], tracks[(i + turn) % n]);
    bar.show(done + i + 1);
  }
  std::vector<MethodResult> results;
  for (std::size_t m = 0; m < n; ++m) {
    const double mean = tracks[m].iterations / static_cast<double>(scans.size());
    results.push_back({methods[m]->name(), methods[m]->is_peer(), mdat::run_statistics(tracks[m].frames), mean});
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
