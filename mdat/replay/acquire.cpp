#include "mdat/replay/acquire.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>

#include "fsw/pose/recognition/pose_search.hpp"
#include "mdat/common/cpu_clock.hpp"
#include "mdat/common/progress_bar.hpp"
#include "mdat/common/text.hpp"
#include "mdat/replay/scan_notes.hpp"
#include "mdat/replay/search_words.hpp"
#include "mdat/run/statistics.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kTold = 10;          // scans
constexpr std::uint32_t kSlice = 100'000;  // units of work; the result does not depend on it

AcquiredScan acquire_scan(const Mission& mission, const RangeImage& image, PoseSearch& search, Workspace& workspace) {
  AcquiredScan acquired;
  const double begin_us = thread_cpu_us();
  SearchLimits limits;
  limits.scans_max = 1;
  search.begin(limits);
  acquired.status = search.add_scan(mission, image, workspace);
  while (!search.advance(mission, workspace, kSlice)) {
  }
  acquired.search_us = thread_cpu_us() - begin_us;
  acquired.result = search.result();
  acquired.why = acquired.status == Status::kOk ? search_words(search.result(), decisive_rival(search, limits.ratio_min), limits)
                                                : "no return that the sensor can have measured (sensor.range_min_m to range_max_m)";
  acquired.result.t_us = image.reference_time_us();
  return acquired;
}

std::string row(const AcquiredScan& scan) {
  const SearchResult& r = scan.result;
  const Quat& q = r.T_sensor_target.q;
  const Vec3& p = r.T_sensor_target.p;
  char text[400];
  std::snprintf(text, sizeof text, ",%s,%s,%.12g,%.12g,%.12g,%.12g,%.9g,%.9g,%.9g,%.6f,%.4f,%.4f,%zu,%u,%.1f,",
                scan.status == Status::kOk ? to_string(r.outcome) : to_string(SearchOutcome::kRejected),
                scan.status == Status::kOk ? to_string(r.reason) : to_string(scan.status), q.x(), q.y(), q.z(), q.w(), p.x(), p.y(), p.z(),
                to_seconds(r.t_us), r.ratio, r.disagreement, r.candidates.size(), r.returns, scan.search_us);
  return scan.scan + text + scan.why;
}

const char* outcome_of(const AcquiredScan& scan) {
  return to_string(scan.status == Status::kOk ? scan.result.outcome : SearchOutcome::kRejected);
}

// Of each of a scan's candidates, the best first.
std::string candidate_rows(const AcquiredScan& scan) {
  std::string rows;
  for (std::size_t i = 0; i < scan.result.candidates.size(); ++i) {
    const SearchCandidate& candidate = scan.result.candidates[i];
    const Quat& q = candidate.T_sensor_target.q;
    const Vec3& p = candidate.T_sensor_target.p;
    char text[300];
    std::snprintf(text, sizeof text, ",%zu,%.12g,%.12g,%.12g,%.12g,%.9g,%.9g,%.9g,%.4f,%.6g\n", i + 1, q.x(), q.y(), q.z(), q.w(), p.x(),
                  p.y(), p.z(), candidate.disagreement, candidate.score);
    rows += scan.scan + text;
  }
  return rows;
}

}  // namespace

std::vector<AcquiredScan> acquire(const Mission& mission, const sim::RecordedScans& scans, const std::vector<InitialPose>& truth) {
  const auto search = std::make_unique<PoseSearch>();
  const auto workspace = std::make_unique<Workspace>();
  std::vector<AcquiredScan> acquired;
  ProgressBar bar("search", scans.size(), "scans", kQuietReplay_s);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    acquired.push_back(acquire_scan(mission, scans.read(i), *search, *workspace));
    acquired.back().scan = scans.stem(i);
    acquired.back().errors = error_of(truth, scans.stem(i), acquired.back().result.T_sensor_target);
    bar.show(i + 1);
  }
  bar.finish();
  return acquired;
}

std::string acquired_csv(const std::vector<AcquiredScan>& scans) {
  std::string text = "scan,outcome,reason,qx,qy,qz,qw,x_m,y_m,z_m,t_s,ratio,disagreement,candidates,returns,search_us,why";
  const bool errors = std::any_of(scans.begin(), scans.end(), [](const AcquiredScan& scan) { return scan.errors.has_value(); });
  text += errors ? std::string(kErrorColumns) + "\n" : "\n";
  for (const AcquiredScan& scan : scans) text += row(scan) + (errors ? error_fields(scan.errors) : "") + "\n";
  return text;
}

std::string candidates_csv(const std::vector<AcquiredScan>& scans) {
  std::string text = "scan,candidate,qx,qy,qz,qw,x_m,y_m,z_m,disagreement,score\n";
  for (const AcquiredScan& scan : scans) text += candidate_rows(scan);
  return text;
}

std::string acquired_summary(const std::vector<AcquiredScan>& scans) {
  std::size_t accepted = 0, ambiguous = 0;
  std::vector<double> times_us;
  std::vector<JudgedScan> judged;
  for (const AcquiredScan& scan : scans) {
    if (scan.result.outcome == SearchOutcome::kAccepted) judged.push_back({scan.scan, scan.errors});
    accepted += scan.result.outcome == SearchOutcome::kAccepted ? 1U : 0U;
    ambiguous += scan.result.outcome == SearchOutcome::kAmbiguous ? 1U : 0U;
    times_us.push_back(scan.search_us);
  }
  const TimeStatistics time = time_statistics(times_us);
  std::string summary = format("%s: %zu accepted, %zu ambiguous, %zu rejected; time of a search: median %.0f ms, 99th percentile %.0f ms\n",
                               amount(scans.size(), "scan").c_str(), accepted, ambiguous, scans.size() - accepted - ambiguous,
                               1e-3 * time.median_us, 1e-3 * time.p99_us);
  for (std::size_t i = 0; i < scans.size() && i < kTold; ++i)
    summary += "  " + scans[i].scan + " " + outcome_of(scans[i]) + ": " + scans[i].why + "\n";
  if (scans.size() > kTold) summary += "  the others: column why\n";
  return summary + error_summary(judged);
}

}  // namespace lasso::mdat
