#include "mdat/benchmark/score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "mdat/replay/pose_errors.hpp"

namespace lasso::mdat {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

using RowsByScan = std::map<std::pair<std::string, std::string>, const ProgramPose*>;

ScanVerdict verdict_of(const SymmetricError& error, double size_m, bool covariance) {
  if (!is_far(error, size_m)) return ScanVerdict::kRight;
  return !covariance || is_wrong(error, size_m) ? ScanVerdict::kWrong : ScanVerdict::kAdmitted;
}

ScanScore judge_scan(const TrueBody& body, const TrueScan& truth, const ProgramPose* pose, bool covariance) {
  ScanScore scan{body.name, truth.scan, truth.determined, ScanVerdict::kRefused, {}};
  if (pose == nullptr || !pose->valid) return scan;
  // Errors in metres and radians do not depend on the covariance.
  const Mat6& weight = covariance ? pose->covariance : Mat6(Mat6::Identity());
  scan.error = symmetric_error(pose->T_sensor_target, truth.T_sensor_target, weight, body.symmetry);
  scan.verdict = verdict_of(scan.error, body.size_m, covariance);
  if (!covariance) scan.error.squared = kUnknown;
  return scan;
}

BodyScore judge_body(const TrueBody& body, const RowsByScan& rows, bool covariances, Score& score) {
  BodyScore result{body.name, body.kind, body.what, body.size_m, {}, kUnknown};
  double sum = 0;
  for (const TrueScan& truth : body.scans) {
    const auto row = rows.find({body.name, truth.scan});
    if (row == rows.end()) ++score.missing;
    const ScanScore scan = judge_scan(body, truth, row == rows.end() ? nullptr : row->second, covariances);
    result.counts.add(scan);
    score.counts.add(scan);
    if (scan.verdict != ScanVerdict::kRefused) sum += scan.error.squared;
    score.scans.push_back(scan);
  }
  if (covariances && result.counts.valid > 0) result.nees = sum / static_cast<double>(result.counts.valid);
  return result;
}

void conclude_nees(Score& score) {
  std::vector<double> all;
  score.nees_worst = kUnknown;
  for (const BodyScore& body : score.bodies) {
    if (std::isnan(body.nees)) continue;
    all.push_back(body.nees);
    if (score.nees_worst >= body.nees) continue;
    score.nees_worst = body.nees;
    score.nees_worst_body = body.name;
  }
  score.nees_median = all.empty() ? kUnknown : median(all);
}

// Larger is worse.
std::tuple<std::size_t, double, double> badness(const BodyScore& body) {
  const double determined = static_cast<double>(body.counts.determined);
  const double not_right = determined > 0 ? 1 - static_cast<double>(body.counts.right) / determined : 0;
  return {body.counts.wrong, not_right, std::isnan(body.nees) ? 0 : body.nees};
}

void conclude_times(const ProgramPoses& poses, Score& score) {
  std::vector<double> times_us;
  for (const ProgramPose& row : poses.rows) {
    if (row.time_s) times_us.push_back(1e6 * *row.time_s);
  }
  score.timed = times_us.size();
  score.time = time_statistics(times_us);
}

}  // namespace

const char* to_string(ScanVerdict verdict) {
  constexpr const char* kNames[] = {"right", "admitted", "wrong", "refused"};
  return kNames[static_cast<std::size_t>(verdict)];
}

void ScoreCounts::add(const ScanScore& scan) {
  const auto is = [&](ScanVerdict verdict) { return scan.verdict == verdict ? 1U : 0U; };
  ++scans;
  valid += 1U - is(ScanVerdict::kRefused);
  wrong += is(ScanVerdict::kWrong);
  if (!scan.determined) return;
  ++determined;
  right += is(ScanVerdict::kRight);
  admitted += is(ScanVerdict::kAdmitted);
  determined_wrong += is(ScanVerdict::kWrong);
  refused += is(ScanVerdict::kRefused);
}

Score score(const BenchmarkSet& set, const ProgramPoses& poses) {
  RowsByScan rows;
  for (const ProgramPose& row : poses.rows) rows[{row.body, row.scan}] = &row;
  Score result;
  result.program = poses.program;
  result.covariances = poses.covariances;
  for (const TrueBody& body : set.truth) result.bodies.push_back(judge_body(body, rows, poses.covariances, result));
  const auto worst = std::max_element(result.bodies.begin(), result.bodies.end(),
                                      [](const BodyScore& a, const BodyScore& b) { return badness(a) < badness(b); });
  result.worst_body = static_cast<std::size_t>(worst - result.bodies.begin());
  conclude_nees(result);
  conclude_times(poses, result);
  return result;
}

}  // namespace lasso::mdat
