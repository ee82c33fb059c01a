#include "fsw/pose/search.hpp"

#include "fsw/geometry/symmetric6.hpp"
#include "fsw/pose/path_pose.hpp"
#include "fsw/pose/prepare.hpp"
#include "fsw/pose/register.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

constexpr std::size_t kPullPoints = 128;
constexpr double kCosHalfSame = 0.99904822158185780;      // 5 deg
constexpr double kCosHalfDistinct = 0.99144486137381038;  // 15 deg
constexpr double kRatioFloor = 0.01;
constexpr double kSettled = 0.02;             // disagreement below which nothing better is looked for
constexpr int kExploreSteps = 12;             // each way
constexpr double kExploreStep = 0.005;        // of the model's size, along the least certain direction
constexpr std::uint32_t kExploredAtOnce = 5;  // of these in a step of the work
// Look-ups of one point, by what its instructions are worth on a 603e.
constexpr std::size_t kFitCost = 18;
constexpr std::size_t kWalkCost = 12;
constexpr std::size_t kPullCost = 40 + 4 * kWalkCost;  // 8 distances, then walks

std::uint32_t to_work(std::size_t lookups) { return static_cast<std::uint32_t>(lookups); }

std::uint32_t fit_work(const Evidence& evidence) { return to_work(kFitCost * (evidence.hits.size() + evidence.misses.size())); }

// The registration works on the workspace's points: the first `count` of the evidence.
void put_points(const Evidence& evidence, std::size_t count, Workspace& workspace) {
  workspace.points.clear();
  for (std::size_t i = 0; i < evidence.hits.size() && i < count; ++i) {
    invariant(workspace.points.push_back(evidence.hits[i]), "as many points as rays");
  }
}

Pose moved_by(const NearSymmetry<N>& symmetry) {
  Pose pose;
  pose.q =
      normalized(Quat(N::to_double(symmetry.q[3]), N::to_double(symmetry.q[0]), N::to_double(symmetry.q[1]), N::to_double(symmetry.q[2])));
  pose.p = Vec3(N::to_double(symmetry.p[0]), N::to_double(symmetry.p[1]), N::to_double(symmetry.p[2]));
  return pose;
}

// The least certain direction of the information H: a step that moves the farthest part of the model by a metre. False where H has none.
bool find_weakest(const Mission& mission, const Mat6& H, Vec6& direction) {
  Mat6 covariance;
  if (invert6(H, covariance) != Status::kOk) return false;
  Vec6 scale;
  scale << mission.radius_m, mission.radius_m, mission.radius_m, 1, 1, 1;
  direction = eigen6(scale.asDiagonal() * covariance * scale.asDiagonal()).vectors.col(5);
  direction.head<3>() /= mission.radius_m;
  return true;
}

double ratio_of(double score, double best) { return (score + kRatioFloor) / (best + kRatioFloor); }

}  // namespace

const char* to_string(SearchOutcome outcome) {
  switch (outcome) {
    case SearchOutcome::kNone:
      return "none";
    case SearchOutcome::kAccepted:
      return "accepted";
    case SearchOutcome::kAmbiguous:
      return "ambiguous";
    case SearchOutcome::kRejected:
      return "rejected";
  }
  return "unknown";
}

const char* to_string(SearchReason reason) {
  switch (reason) {
    case SearchReason::kNotDone:
      return "not_done";
    case SearchReason::kDistinct:
      return "distinct";
    case SearchReason::kCompetitor:
      return "competitor";
    case SearchReason::kTooFewReturns:
      return "too_few_returns";
    case SearchReason::kUnexplained:
      return "unexplained";
    case SearchReason::kNotRegistered:
      return "not_registered";
  }
  return "unknown";
}

void Search::begin(const SearchLimits& limits) {
  limits_ = limits;
  stage_ = Stage::kIdle;
  scans_ = 0;
  tracks_.clear();
  line_ = Line();
  result_ = SearchResult();
}

Status Search::add_scan(const Mission& mission, const RangeImage& scan, Workspace& workspace) {
  if (busy()) return Status::kBusy;
  if (scans_ == kMaxSearchScans || scans_ >= limits_.scans_max) return Status::kBadOrder;
  if (scans_ > 0 && scan.reference_time_us() <= evidence_[last()].t_us) return Status::kBadOrder;
  prepare_rays(mission, scan, StartPoint(), workspace);
  if (workspace.points.empty()) return Status::kNoData;
  Evidence& evidence = evidence_[scans_++];
  evidence.clear();
  evidence.scan_id = scan.scan_id;
  evidence.t_us = scan.reference_time_us();
  maker_.begin(mission, workspace);
  stage_ = Stage::kEvidence;
  return Status::kOk;
}

bool Search::advance(const Mission& mission, Workspace& workspace, std::uint32_t budget) {
  std::uint32_t used = 0;
  while (busy() && used < budget) used += step(mission, workspace);
  result_.work += used;
  return !busy();
}

std::uint32_t Search::step(const Mission& mission, Workspace& workspace) {
  Evidence& evidence = evidence_[last()];
  switch (stage_) {
    case Stage::kEvidence:
      if (!maker_.step(mission, evidence)) {
        coarse_.begin(evidence);
        stage_ = Stage::kCoarse;
      }
      return kPoolRays / 4;
    case Stage::kCoarse:
      if (!coarse_.step(mission, evidence)) {
        pulled_.clear();
        next_ = 0;
        stage_ = Stage::kPull;
      }
      return kRolls * kCoarsePoints;
    case Stage::kPull:
      return pull(mission, workspace);
    case Stage::kSettle:
    case Stage::kTwins:
      return settle_next(mission, workspace);
    case Stage::kExplore:
      return explore_next(mission);
    case Stage::kRecall:
      return recall_next(mission, workspace);
    default:
      return conclude();
  }
}

std::uint32_t Search::pull(const Mission& mission, Workspace& workspace) {
  const Evidence& evidence = evidence_[last()];
  put_points(evidence, kPullPoints, workspace);
  Pulled pulled;
  pulled.T_target_sensor = pull_in(mission, coarse_.short_list()[next_].T_target_sensor, workspace);
  pulled.score = measure_fit(mission, pulled.T_target_sensor, evidence).score();
  invariant(pulled_.push_back(pulled), "as many as the short list");
  if (++next_ == coarse_.short_list().size()) {
    choose_finalists();
    next_ = 0;
    stage_ = Stage::kSettle;
  }
  return to_work(kPullCost * workspace.points.size()) + fit_work(evidence);
}

// Is it as far as that from all of the scan's own finalists?
bool Search::is_apart(const Pose& T_target_sensor, double cos_half_angle) const {
  bool apart = true;
  for (std::size_t i = first_; i < tracks_.size(); ++i) {
    apart = apart && are_apart(T_target_sensor.q, tracks_[i].T_target_sensor[last()].q, cos_half_angle);
  }
  return apart;
}

const Search::Pulled* Search::best_pulled(double cos_half_angle) const {
  const Pulled* best = nullptr;
  for (const Pulled& pulled : pulled_) {
    const bool better = best == nullptr || pulled.score < best->score;
    if (better && is_apart(pulled.T_target_sensor, cos_half_angle)) best = &pulled;
  }
  return best;
}

// The best, at least 5 deg apart; and the last two at least 15 deg, so that there is a competitor to compare with.
void Search::choose_finalists() {
  first_ = tracks_.size();
  for (std::size_t chosen = 0; chosen < kFinalists; ++chosen) {
    const Pulled* best = best_pulled(chosen + 2 < kFinalists ? kCosHalfSame : kCosHalfDistinct);
    if (best == nullptr) break;
    add_track(best->T_target_sensor);
  }
}

// The poses that the best one is most easily confused with: its near-symmetries.
void Search::add_twins(const Mission& mission) {
  first_ = tracks_.size();
  const Pose best = tracks_[0].T_target_sensor[last()];
  for (const NearSymmetry<N>& symmetry : mission.search.symmetries) add_track(moved_by(symmetry) * best);
}

void Search::add_track(const Pose& T_target_sensor) {
  Track track;
  track.T_target_sensor[last()] = T_target_sensor;
  invariant(tracks_.push_back(track), "room for a track");
}

// Registers the scan's evidence from the start and measures the fit.
std::uint32_t Search::settle(const Mission& mission, std::size_t scan, const Pose& start, Track& track, Workspace& workspace) const {
  const Evidence& evidence = evidence_[scan];
  put_points(evidence, kEvidenceHits, workspace);
  HitSolution solution = register_hits(mission, pull_on_rays(mission, start, workspace), workspace);
  Fit fit = measure_fit(mission, solution.T_target_sensor, evidence);
  std::uint32_t work = to_work(kWalkCost * (4 + solution.iterations) * evidence.hits.size()) + fit_work(evidence);
  if (fit.disagreement() > kSettled) {
    put_points(evidence, kEvidenceHits, workspace);
    const HitSolution other = register_hits(mission, pull_in(mission, start, workspace), workspace);
    const Fit other_fit = measure_fit(mission, other.T_target_sensor, evidence);
    work += to_work((kPullCost + kWalkCost * other.iterations) * evidence.hits.size()) + fit_work(evidence);
    if (other_fit.score() < fit.score()) {
      fit = other_fit;
      solution = other;
    }
  }
  track.T_target_sensor[scan] = solution.T_target_sensor;
  track.fits[scan] = fit;
  track.known[scan] = true;
  track.total = track.total + track.fits[scan];
  if (scan == last()) track.H = solution.H;
  return work;
}

// All tracks in the last scan: its own finalists from where they were found, the others from where they should be now.
std::uint32_t Search::settle_next(const Mission& mission, Workspace& workspace) {
  Track& track = tracks_[next_];
  const bool own = next_ >= first_;
  const Pose start = own ? track.T_target_sensor[last()] : carry(track, last() - 1, last(), rates_of(track, last() - 1));
  const std::uint32_t work = settle(mission, last(), start, track, workspace);
  if (++next_ < tracks_.size()) return work;
  prune();
  if (stage_ == Stage::kSettle) add_twins(mission);
  stage_ = stage_ == Stage::kSettle && first_ < tracks_.size() ? Stage::kTwins : Stage::kExplore;
  next_ = stage_ == Stage::kTwins ? first_ : 0;
  return work;
}

// Where a view says little about a direction, the registration may end anywhere along it, and hits that pass an edge decide: the best
// tracks move to the place along it that fits best. A step looks at a few places of one track.
std::uint32_t Search::explore_next(const Mission& mission) {
  const Evidence& evidence = evidence_[last()];
  if (!line_.begun) begin_line(mission);
  std::uint32_t fits = 0;
  for (; line_.next <= kExploreSteps && fits < kExploredAtOnce; ++line_.next) {
    look_along(mission, evidence);
    ++fits;
  }
  if (line_.next > kExploreSteps) end_line();
  return fits * fit_work(evidence) + 1;
}

// Without a direction there is no place to look at.
void Search::begin_line(const Mission& mission) {
  const Track& track = tracks_[next_];
  line_.from = line_.best = track.T_target_sensor[last()];
  line_.fit = track.fits[last()];
  line_.next = find_weakest(mission, track.H, line_.direction) ? -kExploreSteps : kExploreSteps + 1;
  line_.begun = true;
}

void Search::look_along(const Mission& mission, const Evidence& evidence) {
  const double step_m = kExploreStep * N::to_double(mission.search.size);
  const Pose moved = step_pose(line_.from, line_.next * step_m * line_.direction);
  const Fit fit = measure_fit(mission, moved, evidence);
  if (!(fit.score() < line_.fit.score())) return;
  line_.fit = fit;
  line_.best = moved;
}

void Search::end_line() {
  Track& track = tracks_[next_];
  track.T_target_sensor[last()] = line_.best;
  track.fits[last()] = line_.fit;
  track.total = Fit();
  for (std::size_t i = 0; i < scans_; ++i) track.total = track.total + track.fits[i];
  line_ = Line();
  ++next_;
  if (next_ < tracks_.size() && next_ < kExplored) return;
  next_ = 0;
  stage_ = Stage::kRecall;
}

// The last scan's finalists in the scans before, so that scores of as many scans are compared. A step settles one track in one scan.
std::uint32_t Search::recall_next(const Mission& mission, Workspace& workspace) {
  for (; next_ < tracks_.size(); ++next_) {
    for (std::size_t scan = last(); scan-- > 0;) {
      Track& track = tracks_[next_];
      if (track.known[scan]) continue;
      return settle(mission, scan, carry(track, scan + 1, scan, rates_of(track, scan + 2)), track, workspace);
    }
  }
  stage_ = Stage::kVerdict;
  return 1;
}

// Keeps the best few that are at least 5 deg apart, best first.
void Search::prune() {
  FixedVector<Track, kTracks>& t = tracks_;
  for (std::size_t i = 1; i < t.size(); ++i) {
    const Track track = t[i];
    std::size_t k = i;
    for (; k > 0 && track.total.score() < t[k - 1].total.score(); --k) t[k] = t[k - 1];
    t[k] = track;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < t.size() && kept < kCarried; ++i) {
    bool apart = true;
    for (std::size_t k = 0; k < kept; ++k) {
      apart = apart && are_apart(t[i].T_target_sensor[last()].q, t[k].T_target_sensor[last()].q, kCosHalfSame);
    }
    if (apart) t[kept++] = t[i];
  }
  t.shrink(kept);
}

// From the poses of `scan` and the one before it, which are known; zero where there are none.
Twist Search::rates_of(const Track& track, std::size_t scan) const {
  Twist rates;
  if (scan == 0 || scan > last()) return rates;
  const double dt_s = to_seconds(evidence_[scan].t_us - evidence_[scan - 1].t_us);
  const Vec6 difference = pose_difference(inverse(track.T_target_sensor[scan]), inverse(track.T_target_sensor[scan - 1]));
  rates.omega_radps = difference.head<3>() / dt_s;
  rates.v_mps = difference.tail<3>() / dt_s;
  return rates;
}

Pose Search::carry(const Track& track, std::size_t from, std::size_t to, const Twist& rates) const {
  const double dt_s = to_seconds(evidence_[to].t_us - evidence_[from].t_us);
  return inverse(propagate(inverse(track.T_target_sensor[from]), rates, dt_s));
}

std::uint32_t Search::conclude() {
  prune();
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
  return 1;
}

// A step x of T_target_sensor in target axes is a step -R x of T_sensor_target in sensor axes. False where the pose has no covariance.
bool Search::describe_covariance(const Track& best) {
  Mat6 covariance;
  if (invert6(best.H, covariance) != Status::kOk) return false;
  const Mat3 R = to_matrix(best.T_target_sensor[last()].q).transpose();
  Mat6 J = Mat6::Zero();
  J.topLeftCorner<3, 3>() = R;
  J.bottomRightCorner<3, 3>() = R;
  result_.covariance = J * covariance * J.transpose();
  return true;
}

void Search::describe_candidates() {
  const double best = tracks_[0].total.score();
  result_.ratio = 0;
  result_.candidates.clear();
  for (const Track& track : tracks_) {
    const double ratio = ratio_of(track.total.score(), best);
    const bool distinct = are_apart(track.T_target_sensor[last()].q, tracks_[0].T_target_sensor[last()].q, kCosHalfDistinct);
    if (distinct && !(result_.ratio > 0)) result_.ratio = ratio;
    if (ratio < limits_.ratio_min) {
      (void)result_.candidates.push_back({inverse(track.T_target_sensor[last()]), track.total.disagreement(), track.total.score()});
    }
  }
}

void Search::judge(bool registered) {
  result_.outcome = SearchOutcome::kRejected;
  if (!registered) {
    result_.reason = SearchReason::kNotRegistered;
  } else if (result_.returns < limits_.hits_min) {
    result_.reason = SearchReason::kTooFewReturns;
  } else if (result_.disagreement > limits_.disagreement_max) {
    result_.reason = SearchReason::kUnexplained;
  } else if (result_.ratio < limits_.ratio_min) {
    result_.outcome = SearchOutcome::kAmbiguous;
    result_.reason = SearchReason::kCompetitor;
  } else {
    result_.outcome = SearchOutcome::kAccepted;
    result_.reason = SearchReason::kDistinct;
  }
}

}  // namespace lasso
