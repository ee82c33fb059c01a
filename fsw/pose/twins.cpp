// The poses that a search's best one is most easily confused with: its near-symmetries.
#include "fsw/pose/near_symmetry.hpp"
#include "fsw/pose/search.hpp"
#include "fsw/pose/verdict.hpp"

namespace lasso {

using N = FlightNumber;

// Of the pose that was settled first: they are sketched and settled, too.
void Search::add_twins(const Mission& mission) {
  first_ = tracks_.size();
  const Pose best = tracks_[0].T_target_sensor[last()];
  for (const NearSymmetry<N>& symmetry : mission.search.symmetries) add_track(twin_of(symmetry, best), Fit());
  twins_ = true;
  next_ = first_;
}

// Does it fit better than all that stand where it does?
bool Search::is_new(const Pose& T_target_sensor, const Fit& fit) const {
  bool better = true;
  for (const Track& track : tracks_) {
    const bool apart = are_apart(T_target_sensor.q, track.T_target_sensor[last()].q, kCosHalfSame);
    better = better && (apart || fit.score() < track.fits[last()].score());
  }
  return better;
}

// Of the best pose as it stands: it was explored and swayed since, and its twins may have ended elsewhere. They are measured where they
// are; one that is a rival there, and better than what was found near it, is carried on with: recalled, and swayed if among the best.
std::uint32_t Search::mirror_next(const Mission& mission, Workspace& workspace) {
  if (next_ == mission.search.symmetries.size()) return end_mirroring();
  const Track& best = tracks_[0];
  Track twin;
  twin.T_target_sensor[last()] = twin_of(mission.search.symmetries[next_++], best.T_target_sensor[last()]);
  const Fit fit = measure_fit(mission, twin.T_target_sensor[last()], evidence_[last()], hopeless_beyond(best.fits[last()].score()));
  const bool near = is_near(ratio_of(fit.score(), best.fits[last()].score()), best.cost, limits_.ratio_min);
  if (!near || !is_new(twin.T_target_sensor[last()], fit)) return fit_work(fit);
  put_points(evidence_[last()], kEvidenceHits, workspace);
  const Settled settled{weigh_hits(mission, twin.T_target_sensor[last()], workspace), fit};
  take(settled, last(), twin);
  for (const Track& track : tracks_) {
    if (!are_apart(track.T_target_sensor[last()].q, twin.T_target_sensor[last()].q, kCosHalfSame)) inherit(track, twin);
  }
  invariant(tracks_.push_back(twin), "room for a twin");
  return fit_work(fit) + weigh_work(workspace.points.size());
}

std::uint32_t Search::end_mirroring() {
  mirrored_ = true;
  next_ = 0;
  prune();
  stage_ = Stage::kRecall;
  return kEndingWork;
}

}  // namespace lasso
