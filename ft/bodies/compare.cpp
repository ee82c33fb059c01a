#include "ft/bodies/compare.hpp"

#include <algorithm>
#include <memory>

#include "fsw/pose/estimator/estimator.hpp"
#include "fsw/pose/recognition/pose_search.hpp"
#include "ft/bodies/likelihood.hpp"
#include "mdat/benchmark/still_scans.hpp"
#include "mdat/common/text.hpp"
#include "mdat/run/symmetric_error.hpp"

namespace lasso::bodies {
namespace {

constexpr double kApart_rad = 15 * kRadPerDeg;  // as poses of a search are told apart
constexpr std::uint32_t kCompareSlice = 160'000;
constexpr std::array<double, 5> kMargins{2, 8, 12.5, 30, 50};  // nats; 12.5 is five sigmas
constexpr std::array<const char*, kPoseScores> kScoreNames{"hits", "likelihood"};

double score_of_hits(const Registration& r) {
  const double mean = r.inlier_share * r.normalized_residual * r.normalized_residual + kUnexplainedCost * (1 - r.inlier_share);
  return -0.5 * mean * r.returns;
}

// Searches and registers; keeps references.
class Comparer {
 public:
  explicit Comparer(const mdat::Subject& subject) : subject_(subject), scans_(subject, mdat::ScanStream::kSearches) {}

  Comparison next(std::size_t number) {
    const Pose truth = scans_.draw_pose();
    const RangeImage& scan = scans_.scan(subject_.target->surface(), truth, truth);
    Comparison comparison;
    comparison.number = number;
    comparison.determined = mdat::is_determined(subject_, truth, {scan.samples.begin(), scan.samples.size()});
    if (!search(scan)) return comparison;
    const SearchResult& found = search_->result();
    comparison.accepted = found.outcome == SearchOutcome::kAccepted;
    comparison.accepted_wrong = comparison.accepted && is_wrong(found.T_sensor_target, found.covariance, truth);
    std::vector<ScoredPose> poses{registered(scan, found.T_sensor_target, truth)};
    for (const SearchCandidate& candidate : found.candidates) poses.push_back(registered(scan, candidate.T_sensor_target, truth));
    comparison.poses = poses.size();
    for (std::size_t i = 0; i < kPoseScores; ++i) comparison.choices[i] = choose(poses, static_cast<PoseScore>(i));
    return comparison;
  }

 private:
  bool search(const RangeImage& scan) {
    SearchLimits limits;
    limits.scans_max = 1;
    search_->begin(limits);
    if (search_->add_scan(scans_.mission(), scan, estimator_->workspace()) != Status::kOk) return false;
    while (!search_->advance(scans_.mission(), estimator_->workspace(), kCompareSlice)) {
    }
    return search_->result().returns >= limits.hits_min;
  }

  bool is_wrong(const Pose& estimate, const Mat6& covariance, const Pose& truth) const {
    return mdat::is_wrong(mdat::symmetric_error(estimate, truth, covariance, subject_.truth.symmetry), subject_.truth.size_m);
  }

  ScoredPose registered(const RangeImage& scan, const Pose& from, const Pose& truth) {
    const Registration found = estimator_->estimate(scans_.mission(), scan, {from, {}, false});
    const double whole = log_likelihood(scans_.mission(), found, scan.misses_known, estimator_->workspace());
    return {found.T_sensor_target,
            found.valid(),
            found.valid() && is_wrong(found.T_sensor_target, found.covariance, truth),
            {score_of_hits(found), whole}};
  }

  const mdat::Subject& subject_;
  mdat::StillScans scans_;
  std::unique_ptr<Estimator> estimator_ = std::make_unique<Estimator>();
  std::unique_ptr<PoseSearch> search_ = std::make_unique<PoseSearch>();
};

std::string accepted_text(const char* name, std::size_t accepted, std::size_t determined, std::size_t all, std::size_t wrong) {
  const double percent = all > 0 ? 100.0 * static_cast<double>(determined) / static_cast<double>(all) : 0;
  return mdat::format("  %-24s %6zu accepted, %6zu of %zu determined (%.1f %%), wrong %zu\n", name, accepted, determined, all, percent,
                      wrong);
}

// What is accepted of the scans, by a predicate; wrong ones by another.
template <class Accepted, class Wrong>
std::string accepted_line(const std::string& name, const std::vector<Comparison>& comparisons, const Accepted& accepted,
                          const Wrong& wrong) {
  std::size_t count = 0, determined = 0, all = 0, bad = 0;
  for (const Comparison& c : comparisons) {
    all += c.determined ? 1U : 0U;
    if (!accepted(c)) continue;
    ++count;
    determined += c.determined ? 1U : 0U;
    bad += wrong(c) ? 1U : 0U;
  }
  return accepted_text(name.c_str(), count, determined, all, bad);
}

}  // namespace

Choice choose(const std::vector<ScoredPose>& poses, PoseScore score) {
  const auto i = static_cast<std::size_t>(score);
  const ScoredPose& best =
      *std::max_element(poses.begin(), poses.end(), [i](const ScoredPose& a, const ScoredPose& b) { return a.scores[i] < b.scores[i]; });
  Choice choice{best.valid, best.wrong};
  for (const ScoredPose& pose : poses) {
    const bool apart = pose_difference(pose.T_sensor_target, best.T_sensor_target).head<3>().norm() > kApart_rad;
    if (apart) choice.margin = std::min(choice.margin, best.scores[i] - pose.scores[i]);
  }
  return choice;
}

std::vector<Comparison> compare(const mdat::Subject& subject, std::size_t scans) {
  Comparer comparer(subject);
  std::vector<Comparison> comparisons;
  for (std::size_t i = 0; i < scans; ++i) comparisons.push_back(comparer.next(i));
  return comparisons;
}

std::string comparison_csv(std::uint64_t seed, const std::vector<Comparison>& comparisons) {
  std::string csv;
  for (const Comparison& c : comparisons) {
    csv += mdat::format("%llu,%zu,%d,%d,%d,%zu", static_cast<unsigned long long>(seed), c.number, c.determined, c.accepted,
                        c.accepted_wrong, c.poses);
    for (const Choice& choice : c.choices) csv += mdat::format(",%d,%d,%.3f", choice.valid, choice.wrong, choice.margin);
    csv += '\n';
  }
  return csv;
}

std::string comparison_text(const std::vector<Comparison>& comparisons) {
  std::string text = accepted_line(
      "search", comparisons, [](const Comparison& c) { return c.accepted; }, [](const Comparison& c) { return c.accepted_wrong; });
  for (std::size_t i = 0; i < kPoseScores; ++i) {
    for (const double margin : kMargins) {
      text += accepted_line(
          mdat::format("%s, by %.4g nats", kScoreNames[i], margin), comparisons,
          [&](const Comparison& c) { return c.poses > 0 && c.choices[i].valid && c.choices[i].margin >= margin; },
          [&](const Comparison& c) { return c.choices[i].wrong; });
    }
  }
  return text;
}

}  // namespace lasso::bodies
