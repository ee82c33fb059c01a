#include <algorithm>
#include <cmath>
#include <memory>

#include "fsw/pose/recognition/pose_search.hpp"
#include "ft/bodies/trials.hpp"
#include "mdat/benchmark/still_scans.hpp"
#include "mdat/replay/single_scans.hpp"
#include "mdat/run/true_target.hpp"

namespace lasso::bodies {
namespace {

constexpr double kStartTurn_rad = 10 * kRadPerDeg, kStartShift = 0.1;  // of the size
constexpr double kNear_rad = 7 * kRadPerDeg, kNearShare = 0.05;        // a candidate this near is the right one

using mdat::ScanStream;
using mdat::StillScans;

std::span<const RangeSample> samples_of(const RangeImage& scan) { return {scan.samples.begin(), scan.samples.size()}; }

Trial trial_of(const Subject& subject, std::size_t number, const Pose& truth, const RangeImage& scan) {
  Trial trial;
  trial.number = number;
  trial.range_m = truth.p.norm();
  trial.determined = is_determined(subject, truth, samples_of(scan));
  return trial;
}

void judge(const Subject& subject, const Pose& estimate, const Mat6& covariance, const Pose& truth, Trial& trial) {
  trial.error = mdat::symmetric_error(estimate, truth, covariance, subject.truth.symmetry);
  trial.sigma_rad = std::sqrt(covariance.topLeftCorner<3, 3>().trace());
  trial.sigma_m = std::sqrt(covariance.bottomRightCorner<3, 3>().trace());
  trial.level = mdat::protection_levels(covariance);
}

void add(const Subject& subject, std::size_t number, const Pose& truth, const RangeImage& scan, const Registration& found, Tally& tally) {
  Trial trial = trial_of(subject, number, truth, scan);
  trial.valid = found.valid();
  trial.reason = to_string(found.reason);
  judge(subject, found.T_sensor_target, found.covariance, truth, trial);
  tally.add(trial, subject.truth.size_m);
  ++tally.numbers;
}

bool is_among(const Subject& subject, const SearchResult& result, const Pose& truth) {
  return std::any_of(result.candidates.begin(), result.candidates.end(), [&](const SearchCandidate& candidate) {
    const mdat::SymmetricError error = mdat::symmetric_error(candidate.T_sensor_target, truth, Mat6::Identity(), subject.truth.symmetry);
    return error.rotation_rad < kNear_rad && error.translation_m < kNearShare * subject.truth.size_m;
  });
}

// The body as the model does not have it; nothing where it has no part to change.
std::optional<mdat::Body> changed(const Subject& subject, sim::Random& random) {
  mdat::Body body = subject.body;
  const auto pick = [&](std::size_t count) { return static_cast<std::size_t>(random.uniform() * static_cast<double>(count)); };
  if (!body.parameters.empty() && random.uniform() < 0.6) {
    mdat::BodyParameter& parameter = body.parameters[pick(body.parameters.size())];
    const double turn_deg = random.uniform(10, 90);
    const bool over = parameter.preset_deg + turn_deg > parameter.maximum_deg;
    parameter.preset_deg += over ? -turn_deg : turn_deg;
    return body;
  }
  if (subject.truth.assemblies.size() < 2) return std::nullopt;
  return mdat::without(body, subject.truth.assemblies[1 + pick(subject.truth.assemblies.size() - 1)].assembly);
}

// The share of the returns whose rays find the model elsewhere, by more than 5 sigma, or not at all.
double moved_share(const Subject& subject, const Pose& truth, std::span<const RangeSample> scan) {
  const Pose T_target_sensor = inverse(truth);
  double returns = 0, moved = 0;
  for (const RangeSample& sample : scan) {
    if (sample.state != RayState::kHit) continue;
    const Vec3 u = to_vec3(sample.direction);
    const sim::RayHit hit = subject.target->surface().cast(T_target_sensor.p, rotate(T_target_sensor.q, u));
    const double depth_m = u.z() * hit.range_m;
    const double sigma_m = std::hypot(subject.noise.sigma0_m, subject.noise.sigma_k_per_m * depth_m * depth_m);
    ++returns;
    moved += !hit.hit || std::fabs(hit.range_m - static_cast<double>(sample.range_m)) > 5 * sigma_m ? 1 : 0;
  }
  return returns > 0 ? moved / returns : 0;
}

}  // namespace

Tally start(const Subject& subject, std::size_t starts) {
  Tally tally;
  StillScans scans(subject, ScanStream::kStarts);
  mdat::SingleScans estimator(scans.mission());
  for (std::size_t i = 0; i < starts; ++i) {
    const Pose truth = scans.draw_pose();
    const Pose begin = scans.draw_start(truth, kStartTurn_rad, kStartShift * subject.truth.size_m);
    const RangeImage& scan = scans.scan(subject.target->surface(), truth, begin);
    add(subject, i, truth, scan, estimator.estimate(scan, {begin, {}, true}), tally);
  }
  return tally;
}

Tally search(const Subject& subject, std::size_t searches) {
  constexpr std::uint32_t kSlice = 160'000;
  Tally tally;
  StillScans scans(subject, ScanStream::kSearches);
  const auto finder = std::make_unique<PoseSearch>();
  const auto workspace = std::make_unique<Workspace>();
  for (std::size_t i = 0; i < searches; ++i) {
    const Pose truth = scans.draw_pose();
    const RangeImage& scan = scans.scan(subject.target->surface(), truth, truth);
    Trial trial = trial_of(subject, i, truth, scan);
    SearchLimits limits;
    limits.scans_max = 1;
    finder->begin(limits);
    if (finder->add_scan(scans.mission(), scan, *workspace) == Status::kOk) {
      while (!finder->advance(scans.mission(), *workspace, kSlice)) {
      }
    }
    const SearchResult& found = finder->result();
    trial.valid = found.outcome == SearchOutcome::kAccepted;
    trial.among = found.outcome == SearchOutcome::kAmbiguous && is_among(subject, found, truth);
    trial.reason = std::string(to_string(found.outcome)) + " " + to_string(found.reason);
    judge(subject, found.T_sensor_target, found.covariance, truth, trial);
    tally.add(trial, subject.truth.size_m);
    ++tally.numbers;
  }
  return tally;
}

Tally configuration(const Subject& subject, std::size_t changes) {
  constexpr double kMoved = 0.05;
  Tally tally;
  StillScans scans(subject, ScanStream::kChanges);
  mdat::SingleScans estimator(scans.mission());
  for (std::size_t i = 0; i < changes; ++i) {
    const std::optional<mdat::Body> body = changed(subject, scans.random());
    if (!body) return tally;
    const auto surface = mdat::make_target(mdat::mesh_of(*body));
    const Pose truth = scans.draw_pose();
    const RangeImage& scan = scans.scan(*surface, truth, truth);
    if (moved_share(subject, truth, samples_of(scan)) < kMoved) continue;
    add(subject, i, truth, scan, estimator.estimate(scan, {truth, {}, false}), tally);
  }
  return tally;
}

}  // namespace lasso::bodies
