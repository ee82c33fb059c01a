#include "fsw/pose/recognition/acceptance.hpp"

#include "fsw/geometry/symmetric6.hpp"
#include "fsw/pose/recognition/pose_search.hpp"

namespace lasso {
namespace {

constexpr double kRatioFloor = 0.01;
// A pose as this scan's returns register it, as they did what it is compared with; as it stands where they lead to another one.
Pose registered(const Mission& mission, const ScanSubset& subset, const Pose& T_target_sensor, Workspace& workspace) {
  put_points(subset, kSubsetHits, workspace);
  const Pose near = register_look(mission, RegisterLook::kFirst, T_target_sensor, workspace).T_target_sensor;
  return are_apart(T_target_sensor.q, near.q, kCosHalfSame) ? T_target_sensor : near;
}

}  // namespace

double ratio_of(double score, double best) { return (score + kRatioFloor) / (best + kRatioFloor); }

bool is_near(double score_ratio, double best_cost, double ratio_min) {
  return score_ratio < (best_cost > kCleanCost ? kScoreAloneInDoubt : kScoreAlone) * ratio_min;
}

bool is_another_object(const Competitor& competitor) {
  return competitor.best_cost > kCleanCost && competitor.best_explained_cost > kFair && competitor.best_disagreement > kEven;
}

bool is_outscored(const Competitor& competitor, double ratio_min) {
  const bool by_score = competitor.score_ratio >= ratio_min;
  if (!is_near(competitor.score_ratio, competitor.best_cost, ratio_min)) return by_score;
  if (is_another_object(competitor)) return false;
  if (!competitor.weighed) return by_score;
  if (!by_score) return competitor.cost > ratio_min * competitor.best_cost;
  const bool joined = competitor.scans > 1 && competitor.score_ratio >= kScoreAlone * ratio_min;
  return competitor.cost > kCleanCost && competitor.cost > (joined ? kJoinedAgrees : kAgrees) * competitor.best_cost;
}

// Another pose that the score alone does not rule out. Both are refined robustly, and what they cost is compared. Poses are moved by that;
// the scores, which tell far poses apart, stay as they are.
bool PoseSearch::is_competitor(const Track& track) const {
  return is_near(ratio_of(track.total.score(), tracks_[0].total.score()), tracks_[0].cost, limits_.ratio_min);
}

// What a clean pose is compared with must not seem worse for want of care. Beside one that leaves returns unexplained a competitor that is
// refined robustly would only be moved to what is off, too.
const RobustSettings& PoseSearch::robust_settings_of(std::size_t track) const {
  if (track == 0) return kUsualRobust;
  return tracks_[0].cost < kCleanCost ? kThoroughRobust : kGlanceRobust;
}

std::uint32_t PoseSearch::refine_robustly_next(const Mission& mission, Workspace& workspace) {
  // What leaves too much unexplained is rejected, wherever robust refinement leads.
  const bool worth = tracks_[0].total.disagreement() <= limits_.disagreement_max;
  for (; worth && is_next_searched(); ++next_) {
    Track& track = tracks_[next_];
    if (!working_ && (track.robustly_refined || (next_ > 0 && !is_competitor(track)) || !may_work())) continue;
    if (!working_) robust_refiner_.begin(track.T_target_sensor[last()], track.H, robust_settings_of(next_));
    std::uint32_t work = 0;
    working_ = robust_refiner_.step(mission, subsets_[last()], workspace, work) && may_work_up_to(1);
    track.robustly_refined = true;
    if (!working_) work += take_robust(mission, track);
    return work;
  }
  prune();
  next_ = 0;
  stage_ = worth && !symmetry_tested_ ? Stage::kSymmetryTest : Stage::kAcceptance;
  return kEndingWork;
}

// A score that is better there is taken, too: the track had not reached its best place.
std::uint32_t PoseSearch::take_robust(const Mission& mission, Track& track) const {
  const double before = track.scores[last()].score();
  const HypothesisScore fit = measure_score(mission, robust_refiner_.T_target_sensor(), subsets_[last()], before);
  track.T_target_sensor[last()] = robust_refiner_.T_target_sensor();
  track.H = robust_refiner_.H();
  track.cost = robust_refiner_.region_costs().cost;
  track.whole_cost = robust_refiner_.region_costs().whole_cost;
  track.explained_cost = robust_refiner_.region_costs().explained_cost;
  if (fit.score() < before) track.scores[last()] = fit;
  sum_up(track);
  return score_work(fit);
}

bool PoseSearch::is_distinct(const Track& track) const {
  return are_apart(track.T_target_sensor[last()].q, tracks_[0].T_target_sensor[last()].q, kCosHalfDistinct);
}

std::uint32_t PoseSearch::conclude() {
  const Track& best = tracks_[0];
  result_.scan_id = subsets_[last()].scan_id;
  result_.t_us = subsets_[last()].t_us;
  result_.scans = static_cast<std::uint32_t>(scans_);
  result_.T_sensor_target = inverse(best.T_target_sensor[last()]);
  result_.rates = rates_of(best, last());
  result_.disagreement = best.total.disagreement();
  result_.returns = static_cast<std::uint32_t>(best.total.hits);
  describe_candidates();
  judge(describe_covariance(best));
  stage_ = Stage::kIdle;
  return kEndingWork;
}

// A step x of T_target_sensor in target axes is a step -R x of T_sensor_target in sensor axes. False where the pose has no covariance.
bool PoseSearch::describe_covariance(const Track& best) {
  Mat6 covariance;
  if (invert6(best.H, covariance) != Status::kOk) return false;
  result_.covariance = rotated_covariance(to_matrix(best.T_target_sensor[last()].q).transpose(), covariance);
  return true;
}

void PoseSearch::describe_candidates() {
  const double best = tracks_[0].total.score();
  result_.ratio = 0;
  result_.candidates.clear();
  for (const Track& track : tracks_) {
    const double ratio = ratio_of(track.total.score(), best);
    if (is_distinct(track) && !(result_.ratio > 0)) result_.ratio = ratio;
    if (ratio < limits_.ratio_min) {
      (void)result_.candidates.push_back({inverse(track.T_target_sensor[last()]), track.total.disagreement(), track.total.score()});
    }
  }
}

// Where nothing is off but by noise and motion, a part is not what costs: no region's cost is bounded then.
bool PoseSearch::find_competitor(std::size_t i, Competitor& competitor) const {
  const Track& best = tracks_[0];
  const Track& track = tracks_[i];
  if (!is_distinct(track)) return false;
  const double disagreement = best.total.disagreement();
  const bool even = disagreement <= kEven;
  competitor = Competitor{ratio_of(track.total.score(), best.total.score()),
                          track.robustly_refined,
                          even ? track.whole_cost : track.cost,
                          even ? best.whole_cost : best.cost,
                          best.explained_cost,
                          disagreement,
                          scans_};
  return true;
}

// Is every other pose left behind?
bool PoseSearch::outscores_all() const {
  bool alone = true;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    Competitor competitor;
    if (find_competitor(i, competitor)) alone = alone && is_outscored(competitor, limits_.ratio_min);
  }
  return alone;
}

bool PoseSearch::contradicts(const Mission& mission, const Pose& T_sensor_target, Workspace& workspace) const {
  if (result_.outcome == SearchOutcome::kNone) return false;
  const Track& best = tracks_[0];
  const Pose T_target_sensor = inverse(T_sensor_target);
  const Quat& found = best.T_target_sensor[last()].q;
  if (!are_apart(T_target_sensor.q, found, kCosHalfSame)) return false;
  const HypothesisScore fit =
      measure_score(mission, registered(mission, subsets_[last()], T_target_sensor, workspace), subsets_[last()], kAnyScore);
  const bool sure = result_.outcome == SearchOutcome::kAccepted && are_apart(T_target_sensor.q, found, kCosHalfDistinct);
  const double ratio = ratio_of(fit.score(), best.scores[last()].score());
  return sure ? ratio > 1 : ratio >= limits_.ratio_min;
}

bool PoseSearch::agrees(const Pose& T_sensor_target) const {
  if (result_.outcome != SearchOutcome::kAccepted) return false;
  return !are_apart(inverse(T_sensor_target).q, tracks_[0].T_target_sensor[last()].q, kCosHalfSame);
}

void PoseSearch::judge(bool registered) {
  result_.outcome = SearchOutcome::kRejected;
  if (result_.returns < limits_.hits_min) {
    result_.reason = SearchReason::kTooFewReturns;  // no wonder, then, if no pose is registered
  } else if (!registered) {
    result_.reason = SearchReason::kNotRegistered;
  } else if (result_.disagreement > limits_.disagreement_max) {
    result_.reason = SearchReason::kUnexplained;
  } else if (!outscores_all()) {
    result_.outcome = SearchOutcome::kAmbiguous;
    result_.reason = SearchReason::kCompetitor;
  } else if (unfinished_) {
    result_.outcome = SearchOutcome::kAmbiguous;
    result_.reason = SearchReason::kUnfinished;
  } else {
    result_.outcome = SearchOutcome::kAccepted;
    result_.reason = SearchReason::kDistinct;
  }
}

}  // namespace lasso
