#include "fsw/pose/recognition/acceptance.hpp"

#include "fsw/geometry/symmetric6.hpp"
#include "fsw/pose/recognition/pose_search.hpp"

namespace lasso {
namespace {

constexpr double kRatioFloor = 0.01;
// A pose as this scan's returns register it, as they did what it is compared with; as it stands where they lead to another one.
Pose registered(const Mission& mission, const Evidence& evidence, const Pose& T_target_sensor, Workspace& workspace) {
  put_points(evidence, kEvidenceHits, workspace);
  const Pose near = register_look(mission, RegisterLook::kFirst, T_target_sensor, workspace).T_target_sensor;
  return are_apart(T_target_sensor.q, near.q, kCosHalfSame) ? T_target_sensor : near;
}

}  // namespace

double ratio_of(double score, double best) { return (score + kRatioFloor) / (best + kRatioFloor); }

bool is_near(double score_ratio, double best_cost, double ratio_min) {
  return score_ratio < (best_cost > kCleanCost ? kAloneInDoubt : kAlone) * ratio_min;
}

bool seems_else(const Rival& rival) {
  return rival.best_cost > kCleanCost && rival.best_explained_cost > kFair && rival.best_disagreement > kEven;
}

bool is_left_behind(const Rival& rival, double ratio_min) {
  const bool by_score = rival.score_ratio >= ratio_min;
  if (!is_near(rival.score_ratio, rival.best_cost, ratio_min)) return by_score;
  if (seems_else(rival)) return false;
  if (!rival.weighed) return by_score;
  if (!by_score) return rival.cost > ratio_min * rival.best_cost;
  const bool joined = rival.scans > 1 && rival.score_ratio >= kAlone * ratio_min;
  return rival.cost > kCleanCost && rival.cost > (joined ? kJoinedAgrees : kAgrees) * rival.best_cost;
}

// Another pose whose score alone does not leave it behind. Both are swayed, and what they cost is compared. Poses are moved by that; the
// scores, which tell far poses apart, stay as they are.
bool Search::is_rival(const Track& track) const {
  return is_near(ratio_of(track.total.score(), tracks_[0].total.score()), tracks_[0].cost, limits_.ratio_min);
}

// What a clean pose is compared with must not seem worse for want of care. Beside one that leaves returns unexplained a rival that is
// swayed would only be drawn to what is off, too.
const SwayCare& Search::care_of(std::size_t track) const {
  if (track == 0) return kUsualSway;
  return tracks_[0].cost < kCleanCost ? kThoroughSway : kGlanceSway;
}

std::uint32_t Search::sway_next(const Mission& mission, Workspace& workspace) {
  // What leaves too much unexplained is rejected, wherever it is swayed to.
  const bool worth = tracks_[0].total.disagreement() <= limits_.disagreement_max;
  for (; worth && explores_next(); ++next_) {
    Track& track = tracks_[next_];
    if (!working_ && (track.swayed || (next_ > 0 && !is_rival(track)) || !may_work())) continue;
    if (!working_) sway_.begin(track.T_target_sensor[last()], track.H, care_of(next_));
    std::uint32_t work = 0;
    working_ = sway_.step(mission, evidence_[last()], workspace, work) && may_work_up_to(1);
    track.swayed = true;
    if (!working_) work += take_swayed(mission, track);
    return work;
  }
  prune();
  next_ = 0;
  stage_ = worth && !mirrored_ ? Stage::kMirror : Stage::kVerdict;
  return kEndingWork;
}

// A score that is better there is taken, too: the track had not reached its best place.
std::uint32_t Search::take_swayed(const Mission& mission, Track& track) const {
  const double before = track.fits[last()].score();
  const Fit fit = measure_fit(mission, sway_.T_target_sensor(), evidence_[last()], before);
  track.T_target_sensor[last()] = sway_.T_target_sensor();
  track.H = sway_.H();
  track.cost = sway_.standing().cost;
  track.whole_cost = sway_.standing().whole_cost;
  track.explained_cost = sway_.standing().explained_cost;
  if (fit.score() < before) track.fits[last()] = fit;
  sum_up(track);
  return fit_work(fit);
}

bool Search::is_distinct(const Track& track) const {
  return are_apart(track.T_target_sensor[last()].q, tracks_[0].T_target_sensor[last()].q, kCosHalfDistinct);
}

std::uint32_t Search::conclude() {
  const Track& best = tracks_[0];
  result_.scan_id = evidence_[last()].scan_id;
  result_.t_us = evidence_[last()].t_us;
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
bool Search::describe_covariance(const Track& best) {
  Mat6 covariance;
  if (invert6(best.H, covariance) != Status::kOk) return false;
  result_.covariance = rotated_covariance(to_matrix(best.T_target_sensor[last()].q).transpose(), covariance);
  return true;
}

void Search::describe_candidates() {
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
bool Search::find_rival(std::size_t i, Rival& rival) const {
  const Track& best = tracks_[0];
  const Track& track = tracks_[i];
  if (!is_distinct(track)) return false;
  const double disagreement = best.total.disagreement();
  const bool even = disagreement <= kEven;
  rival = Rival{ratio_of(track.total.score(), best.total.score()),
                track.swayed,
                even ? track.whole_cost : track.cost,
                even ? best.whole_cost : best.cost,
                best.explained_cost,
                disagreement,
                scans_};
  return true;
}

// Is every other pose left behind?
bool Search::stands_alone() const {
  bool alone = true;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    Rival rival;
    if (find_rival(i, rival)) alone = alone && is_left_behind(rival, limits_.ratio_min);
  }
  return alone;
}

bool Search::contradicts(const Mission& mission, const Pose& T_sensor_target, Workspace& workspace) const {
  if (result_.outcome == SearchOutcome::kNone) return false;
  const Track& best = tracks_[0];
  const Pose T_target_sensor = inverse(T_sensor_target);
  const Quat& found = best.T_target_sensor[last()].q;
  if (!are_apart(T_target_sensor.q, found, kCosHalfSame)) return false;
  const Fit fit = measure_fit(mission, registered(mission, evidence_[last()], T_target_sensor, workspace), evidence_[last()], kAnyScore);
  const bool sure = result_.outcome == SearchOutcome::kAccepted && are_apart(T_target_sensor.q, found, kCosHalfDistinct);
  const double ratio = ratio_of(fit.score(), best.fits[last()].score());
  return sure ? ratio > 1 : ratio >= limits_.ratio_min;
}

bool Search::agrees(const Pose& T_sensor_target) const {
  if (result_.outcome != SearchOutcome::kAccepted) return false;
  return !are_apart(inverse(T_sensor_target).q, tracks_[0].T_target_sensor[last()].q, kCosHalfSame);
}

void Search::judge(bool registered) {
  result_.outcome = SearchOutcome::kRejected;
  if (result_.returns < limits_.hits_min) {
    result_.reason = SearchReason::kTooFewReturns;  // no wonder, then, if no pose is registered
  } else if (!registered) {
    result_.reason = SearchReason::kNotRegistered;
  } else if (result_.disagreement > limits_.disagreement_max) {
    result_.reason = SearchReason::kUnexplained;
  } else if (!stands_alone()) {
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
