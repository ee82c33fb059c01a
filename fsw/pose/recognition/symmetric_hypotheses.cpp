// The poses that a search's best one is most easily confused with: its near-symmetries.
#include "fsw/pose/recognition/pose_search.hpp"
#include "fsw/pose/recognition/acceptance.hpp"

namespace lasso {

using N = FlightNumber;

namespace {

Pose twin_of(const NearSymmetry<N>& symmetry, const Pose& T_target_sensor) {
  Pose motion;
  motion.q =
      normalized(Quat(N::to_double(symmetry.q[3]), N::to_double(symmetry.q[0]), N::to_double(symmetry.q[1]), N::to_double(symmetry.q[2])));
  motion.p = Vec3(N::to_double(symmetry.p[0]), N::to_double(symmetry.p[1]), N::to_double(symmetry.p[2]));
  return motion * T_target_sensor;
}

}  // namespace

// Of the pose that was settled first: they are sketched and settled, too.
void Search::add_twins(const Mission& mission) {
  if (mission.search.symmetries.empty()) return;
  next_ = tracks_.size();
  stage_ = Stage::kSketch;
  const Pose best = tracks_[0].T_target_sensor[last()];
  for (const NearSymmetry<N>& symmetry : mission.search.symmetries) add_track(twin_of(symmetry, best), Fit());
  twins_ = true;
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
// are; one that is a rival there, and better than what was found near it, is carried on with: swayed if among the best.
std::uint32_t Search::mirror_next(const Mission& mission, Workspace& workspace) {
  if (next_ == mission.search.symmetries.size() || !may_work_up_to(1)) return end_mirroring();
  const Track& best = tracks_[0];
  const NearSymmetry<N>& symmetry = mission.search.symmetries[next_++];
  const Pose T_target_sensor = twin_of(symmetry, best.T_target_sensor[last()]);
  const Fit fit = measure_fit(mission, T_target_sensor, evidence_[last()], hopeless_beyond(best.fits[last()].score()));
  const bool near = is_near(ratio_of(fit.score(), best.fits[last()].score()), best.cost, limits_.ratio_min);
  if (!near || !is_new(T_target_sensor, fit)) return fit_work(fit);
  Track twin;
  put_points(evidence_[last()], kEvidenceHits, workspace);
  take({weigh_hits(mission, T_target_sensor, workspace), fit}, twin);
  const std::uint32_t work = fit_work(fit) + weigh_work(workspace.points.size()) + mirror_before(mission, symmetry, twin);
  invariant(tracks_.push_back(twin), "room for a twin");
  return work;
}

// In the scans before, too: as it is there, or as what stands near it was settled, whichever fits better.
std::uint32_t Search::mirror_before(const Mission& mission, const NearSymmetry<N>& symmetry, Track& twin) const {
  std::uint32_t work = 0;
  for (std::size_t scan = 0; scan < last(); ++scan) {
    twin.T_target_sensor[scan] = twin_of(symmetry, tracks_[0].T_target_sensor[scan]);
    twin.fits[scan] = measure_fit(mission, twin.T_target_sensor[scan], evidence_[scan], kAnyScore);
    work += fit_work(twin.fits[scan]);
  }
  for (const Track& track : tracks_) {
    if (!are_apart(track.T_target_sensor[last()].q, twin.T_target_sensor[last()].q, kCosHalfSame)) inherit(track, twin);
  }
  sum_up(twin);
  return work;
}

void Search::inherit(const Track& other, Track& twin) const {
  for (std::size_t scan = 0; scan < last(); ++scan) {
    if (!(other.fits[scan].score() < twin.fits[scan].score())) continue;
    twin.T_target_sensor[scan] = other.T_target_sensor[scan];
    twin.fits[scan] = other.fits[scan];
  }
}

std::uint32_t Search::end_mirroring() {
  mirrored_ = true;
  next_ = 0;
  prune();
  stage_ = Stage::kSway;
  return kEndingWork;
}

}  // namespace lasso
