// The poses that a search's best one is most easily confused with: its near-symmetries.
#include "fsw/pose/recognition/acceptance.hpp"
#include "fsw/pose/recognition/pose_search.hpp"

namespace lasso {

using N = FlightNumber;

namespace {

Pose symmetric_of(const NearSymmetry<N>& symmetry, const Pose& T_target_sensor) {
  Pose motion;
  motion.q =
      normalized(Quat(N::to_double(symmetry.q[3]), N::to_double(symmetry.q[0]), N::to_double(symmetry.q[1]), N::to_double(symmetry.q[2])));
  motion.p = Vec3(N::to_double(symmetry.p[0]), N::to_double(symmetry.p[1]), N::to_double(symmetry.p[2]));
  return motion * T_target_sensor;
}

}  // namespace

// Symmetric images of the pose that was refined first: they are refined, too, fast and fully.
void PoseSearch::add_symmetric_hypotheses(const Mission& mission) {
  if (mission.search.symmetries.empty()) return;
  next_ = tracks_.size();
  stage_ = Stage::kFastRefine;
  const Pose best = tracks_[0].T_target_sensor[last()];
  for (const NearSymmetry<N>& symmetry : mission.search.symmetries) add_track(symmetric_of(symmetry, best), HypothesisScore());
  symmetries_ = true;
}

// Does it fit better than all that stand where it does?
bool PoseSearch::is_new(const Pose& T_target_sensor, const HypothesisScore& fit) const {
  bool better = true;
  for (const Track& track : tracks_) {
    const bool apart = are_apart(T_target_sensor.q, track.T_target_sensor[last()].q, kCosHalfSame);
    better = better && (apart || fit.score() < track.scores[last()].score());
  }
  return better;
}

// Of the best pose as it stands: it was refined further since, and its symmetric images may have ended elsewhere. They are measured where
// they are; one that competes there, and is better than what was found near it, is kept: refined robustly if among the best.
std::uint32_t PoseSearch::test_symmetry_next(const Mission& mission, Workspace& workspace) {
  if (next_ == mission.search.symmetries.size() || !may_work_up_to(1)) return end_symmetry_test();
  const Track& best = tracks_[0];
  const NearSymmetry<N>& symmetry = mission.search.symmetries[next_++];
  const Pose T_target_sensor = symmetric_of(symmetry, best.T_target_sensor[last()]);
  const HypothesisScore fit = measure_score(mission, T_target_sensor, subsets_[last()], hopeless_beyond(best.scores[last()].score()));
  const bool near = is_near(ratio_of(fit.score(), best.scores[last()].score()), best.cost, limits_.ratio_min);
  if (!near || !is_new(T_target_sensor, fit)) return score_work(fit);
  Track symmetric;
  put_points(subsets_[last()], kSubsetHits, workspace);
  take({weigh_hits(mission, T_target_sensor, workspace), fit}, symmetric);
  const std::uint32_t work = score_work(fit) + weigh_work(workspace.points.size()) + image_before(mission, symmetry, symmetric);
  invariant(tracks_.push_back(symmetric), "room for a symmetric hypothesis");
  return work;
}

// In the scans before, too: as it is there, or as what is near it was refined, whichever fits better.
std::uint32_t PoseSearch::image_before(const Mission& mission, const NearSymmetry<N>& symmetry, Track& symmetric) const {
  std::uint32_t work = 0;
  for (std::size_t scan = 0; scan < last(); ++scan) {
    symmetric.T_target_sensor[scan] = symmetric_of(symmetry, tracks_[0].T_target_sensor[scan]);
    symmetric.scores[scan] = measure_score(mission, symmetric.T_target_sensor[scan], subsets_[scan], kAnyScore);
    work += score_work(symmetric.scores[scan]);
  }
  for (const Track& track : tracks_) {
    if (!are_apart(track.T_target_sensor[last()].q, symmetric.T_target_sensor[last()].q, kCosHalfSame)) inherit(track, symmetric);
  }
  sum_up(symmetric);
  return work;
}

void PoseSearch::inherit(const Track& other, Track& symmetric) const {
  for (std::size_t scan = 0; scan < last(); ++scan) {
    if (!(other.scores[scan].score() < symmetric.scores[scan].score())) continue;
    symmetric.T_target_sensor[scan] = other.T_target_sensor[scan];
    symmetric.scores[scan] = other.scores[scan];
  }
}

std::uint32_t PoseSearch::end_symmetry_test() {
  symmetry_tested_ = true;
  next_ = 0;
  prune();
  stage_ = Stage::kRobustRefine;
  return kEndingWork;
}

}  // namespace lasso
