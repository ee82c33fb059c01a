#include "fsw/pose/recognition/pose_search.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/symmetric6.hpp"
#include "fsw/pose/scan/path_pose.hpp"
#include "fsw/pose/scan/prepare.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

constexpr double kFirstShare = 0.8;       // of the work, for a scan that others may join: a later one takes some 0.6 million units
constexpr double kJoinShare = 0.85;       // beyond it a further scan is not worth adding
constexpr int kLineSteps = 12;            // each way, even
constexpr int kLineEnd = kLineSteps + 4;  // with the places beside the best
constexpr std::size_t kLineHeadStart = 96;
constexpr double kLineStep = 0.005;  // of the model's size, along the least certain direction

// The least certain direction of the information H: a step that moves the farthest part of the model by a metre. False where H has none.
bool find_weakest(const Mission& mission, const Mat6& H, Vec6& direction) {
  Mat6 covariance;
  if (invert6(H, covariance) != Status::kOk) return false;
  direction = axes_at_radius(covariance, mission.radius_m).vectors.col(5);
  direction.head<3>() /= mission.radius_m;
  return true;
}

}  // namespace

void PoseSearch::begin(const SearchLimits& limits) {
  limits_ = limits;
  stage_ = Stage::kIdle;
  scans_ = 0;
  tracks_.clear();
  line_ = Line();
  symmetries_ = working_ = suspects_ = false;
  adding_work_ = 0;
  result_ = SearchResult();
}

void PoseSearch::suspect(const Pose& T_sensor_target) {
  invariant(scans_ == 0, "before the first scan");
  suspects_ = true;
  suspect_ = inverse(T_sensor_target);
}

bool PoseSearch::joins() const {
  const bool room = scans_ < kMaxSearchScans && scans_ < limits_.scans_max;
  const bool undecided = result_.outcome == SearchOutcome::kAmbiguous && result_.work < kJoinShare * limits_.work_max;
  return room && (scans_ == 0 || result_.outcome == SearchOutcome::kAccepted || undecided);
}

Status PoseSearch::add_scan(const Mission& mission, const RangeImage& scan, Workspace& workspace) {
  if (busy()) return Status::kBusy;
  if (!joins()) return Status::kBadOrder;
  if (scans_ > 0 && scan.reference_time_us() <= subsets_[last()].t_us) return Status::kBadOrder;
  prepare_rays(mission, scan, StartPoint(), workspace);
  if (workspace.points.empty()) return Status::kNoData;
  carry_over();
  ScanSubset& subset = subsets_[scans_++];
  subset.clear();
  subset.scan_id = scan.scan_id;
  subset.t_us = scan.reference_time_us();
  maker_.begin(mission, workspace);
  adding_work_ = prepare_work(scan.samples.size());
  result_.work += adding_work_;
  unfinished_ = false;
  symmetry_tested_ = false;
  stage_ = Stage::kSubset;
  return Status::kOk;
}

bool PoseSearch::advance(const Mission& mission, Workspace& workspace, std::uint32_t budget) {
  std::uint32_t used = adding_work_;
  adding_work_ = 0;
  while (busy() && used < budget) {
    const std::uint32_t work = step(mission, workspace);
    used += work;
    result_.work += work;
  }
  return !busy();
}

// To the next scan: the best pose and what it does not leave behind by its score alone, all where not all was worked on; as if nothing
// were known of them there.
void PoseSearch::carry_over() {
  std::size_t carried = 0;
  for (Track& track : tracks_) {
    if (!unfinished_ && !is_near(ratio_of(track.total.score(), tracks_[0].total.score()), 0, limits_.ratio_min)) break;
    track.fast_refined = track.refined = track.robustly_refined = false;
    track.cost = track.whole_cost = track.explained_cost = kAnyScore;
    ++carried;
  }
  tracks_.shrink(carried);
}

// Asked for what is worth working on, and only then.
bool PoseSearch::may_work() { return may_work_up_to(scans_ == 1 && limits_.scans_max > 1 ? kFirstShare : 1); }

bool PoseSearch::may_work_up_to(double share) {
  const bool may = result_.work < share * limits_.work_max;
  unfinished_ = unfinished_ || !may;
  return may;
}

std::uint32_t PoseSearch::step(const Mission& mission, Workspace& workspace) {
  switch (stage_) {
    case Stage::kSubset:
      return gather_subset(mission);
    case Stage::kViewMatching:
      return match_views(mission);
    case Stage::kAlignOnDistances:
      return align_on_distances_next(mission, workspace);
    case Stage::kAlignOnRays:
      return align_on_rays_next(mission, workspace);
    case Stage::kFastRefine:
      return refine_fast_next(mission, workspace);
    case Stage::kRefine:
      return refine_next(mission, workspace);
    case Stage::kLineSearch:
      return search_line_next(mission);
    case Stage::kRobustRefine:
      return refine_robustly_next(mission, workspace);
    case Stage::kSymmetryTest:
      return test_symmetry_next(mission, workspace);
    default:
      return conclude();
  }
}

std::uint32_t PoseSearch::gather_subset(const Mission& mission) {
  std::uint32_t work = 0;
  if (maker_.step(mission, subsets_[last()], work)) return work;
  if (scans_ == 1) coarse_.begin(mission, subsets_[last()]);
  next_ = 0;
  stage_ = scans_ == 1 ? Stage::kViewMatching : Stage::kFastRefine;
  return work;
}

std::uint32_t PoseSearch::match_views(const Mission& mission) {
  const std::uint32_t work = coarse_.step(mission, subsets_[last()]);
  if (coarse_.done()) {
    aligned_.clear();
    next_ = 0;
    stage_ = Stage::kAlignOnDistances;
  }
  return work;
}

Pose PoseSearch::hypothesis(const Mission& mission, std::size_t i) const {
  const std::size_t found = coarse_.short_list().size();
  return i < found ? coarse_.short_list()[i].T_target_sensor : quarter_turned(suspect_, i - found, mission.center_m);
}

std::uint32_t PoseSearch::align_on_distances_next(const Mission& mission, Workspace& workspace) {
  put_points(subsets_[last()], kCoarsePoints, workspace);
  const DistanceAlignment alignment = align_on_distances(mission, hypothesis(mission, next_), workspace);
  aligned_.add(alignment.T_target_sensor, alignment.distance);
  if (++next_ == hypotheses()) {
    aligned_.keep_best();
    next_ = 0;
    stage_ = Stage::kAlignOnRays;
  }
  return distance_alignment_work(workspace.points.size());
}

std::uint32_t PoseSearch::align_on_rays_next(const Mission& mission, Workspace& workspace) {
  const ScanSubset& subset = subsets_[last()];
  put_points(subset, kFastRefinePoints, workspace);
  AlignedHypothesis& aligned = aligned_[next_];
  aligned.T_target_sensor = align_on_rays(mission, aligned.T_target_sensor, workspace);
  aligned.fit = measure_score(mission, aligned.T_target_sensor, subset, hopeless_beyond(aligned_.best_score(next_)));
  aligned.score = aligned.fit.score();
  if (++next_ == aligned_.size()) choose_finalists();
  return ray_alignment_work(workspace.points.size()) + score_work(aligned.fit);
}

// Is it as far as that from all finalists?
bool PoseSearch::is_apart(const Pose& T_target_sensor, double cos_half_angle) const {
  bool apart = true;
  for (const Track& track : tracks_) apart = apart && are_apart(T_target_sensor.q, track.T_target_sensor[0].q, cos_half_angle);
  return apart;
}

const AlignedHypothesis* PoseSearch::best_aligned(double cos_half_angle) const {
  const AlignedHypothesis* best = nullptr;
  for (std::size_t i = 0; i < aligned_.size(); ++i) {
    const bool better = best == nullptr || aligned_[i].score < best->score;
    if (better && is_apart(aligned_[i].T_target_sensor, cos_half_angle)) best = &aligned_[i];
  }
  return best;
}

// The best, at least 5 deg apart; and the last two at least 15 deg, so that there is a competitor to compare with.
void PoseSearch::choose_finalists() {
  for (std::size_t chosen = 0; chosen < kFinalists; ++chosen) {
    const AlignedHypothesis* best = best_aligned(chosen + 2 < kFinalists ? kCosHalfSame : kCosHalfDistinct);
    if (best == nullptr) break;
    add_track(best->T_target_sensor, best->fit);
  }
  next_ = 0;
  stage_ = Stage::kFastRefine;
}

void PoseSearch::add_track(const Pose& T_target_sensor, const HypothesisScore& fit) {
  Track track;
  track.T_target_sensor[last()] = T_target_sensor;
  track.scores[last()] = fit;
  invariant(tracks_.push_back(track), "room for a track");
}

void PoseSearch::take(const RefinedHypothesis& refined, Track& track) const {
  track.T_target_sensor[last()] = refined.solution.T_target_sensor;
  track.scores[last()] = refined.fit;
  track.fast_refined = true;
  track.H = refined.solution.H;
  sum_up(track);
}

void PoseSearch::sum_up(Track& track) const {
  track.total = HypothesisScore();
  for (std::size_t i = 0; i < scans_; ++i) track.total = track.total + track.scores[i];
}

double PoseSearch::best_score() const {
  double best = kAnyScore;
  for (const Track& track : tracks_) {
    if (track.fast_refined) best = clamp(track.total.score(), 0, best);
  }
  return best;
}

bool PoseSearch::is_hopeless(const Track& track) const { return track.total.score() > hopeless_beyond(best_score()); }

// What fits worse than that is not worth measuring. Scores of several scans add up: whole ones.
double PoseSearch::fast_refine_limit() const { return scans_ == 1 ? hopeless_beyond(best_score()) : kAnyScore; }

// In the first scan the finalists from where they were aligned, and the best one's symmetric images; in a later one what is carried from
// where it should be.
std::uint32_t PoseSearch::refine_fast_near(const Mission& mission, Track& track, Workspace& workspace) {
  const bool aligned = scans_ == 1 && !symmetries_;
  std::uint32_t work = aligned ? 0 : ray_alignment_work(workspace.points.size());
  track.start = scans_ == 1 ? track.T_target_sensor[0] : carried(track);
  const Pose start = aligned ? track.start : align_on_rays(mission, track.start, workspace);
  take(refine_fast(mission, subsets_[last()], {start, track.scores[last()]}, fast_refine_limit(), workspace, work), track);
  working_ = !aligned && (scans_ == 2 || is_hopeless(track));
  return work;
}

// Once more from there, aligned from farther away, where that leads to nothing, or no rate was known.
std::uint32_t PoseSearch::refine_fast_afar(const Mission& mission, Track& track, Workspace& workspace) {
  std::uint32_t work = distance_alignment_work(workspace.points.size()) + ray_alignment_work(workspace.points.size());
  const Pose start = align_on_both(mission, track.start, workspace);
  const RefinedHypothesis refined =
      refine_fast(mission, subsets_[last()], {start, track.scores[last()]}, fast_refine_limit(), workspace, work);
  if (refined.fit.score() < track.scores[last()].score()) take(refined, track);
  working_ = false;
  return work;
}

std::uint32_t PoseSearch::refine_fast_next(const Mission& mission, Workspace& workspace) {
  Track& track = tracks_[next_];
  put_points(subsets_[last()], kFastRefinePoints, workspace);
  const std::uint32_t work = working_ ? refine_fast_afar(mission, track, workspace) : refine_fast_near(mission, track, workspace);
  if (working_ || ++next_ < tracks_.size()) return work;
  prune();
  next_ = 0;
  stage_ = Stage::kRefine;
  return work;
}

std::uint32_t PoseSearch::refine_next(const Mission& mission, Workspace& workspace) {
  for (; next_ < tracks_.size(); ++next_) {
    Track& track = tracks_[next_];
    if (!working_ && (track.refined || is_hopeless(track) || !may_work())) continue;
    if (!working_) refiner_.begin(track.T_target_sensor[last()], track.start);
    track.refined = true;
    std::uint32_t work = 0;
    working_ = refiner_.step(mission, subsets_[last()], poor_beyond(best_score()), workspace, work) && may_work_up_to(1);
    if (!working_) take(refiner_.best(), track);
    return work;
  }
  end_refining(mission);
  return kEndingWork;
}

void PoseSearch::end_refining(const Mission& mission) {
  prune();
  next_ = 0;
  stage_ = Stage::kLineSearch;
  if (!symmetries_ && scans_ == 1) add_symmetric_hypotheses(mission);
}

// Where a view says little about a direction, the registration may end anywhere along it, and hits that pass an edge decide: the best
// tracks move to the place along it that fits best. A step looks at one place.
std::uint32_t PoseSearch::search_line_next(const Mission& mission) {
  const ScanSubset& subset = subsets_[last()];
  std::uint32_t work = line_.begun ? 0 : begin_line(mission);
  if (line_.next <= kLineEnd) work += look_along(mission, subset);
  line_.next += 2;
  if (line_.next > kLineEnd) end_line();
  return work;
}

// Without a direction, or hope, there is no place to look at.
std::uint32_t PoseSearch::begin_line(const Mission& mission) {
  const Track& track = tracks_[next_];
  line_.from = line_.best = track.T_target_sensor[last()];
  line_.fit = track.scores[last()];
  const bool worth = !is_hopeless(track) && may_work() && find_weakest(mission, track.H, line_.direction);
  line_.next = worth ? -kLineSteps : kLineEnd + 2;
  line_.begun = true;
  return kLineWork;
}

std::uint32_t PoseSearch::look_along(const Mission& mission, const ScanSubset& subset) {
  const double step_m = kLineStep * static_cast<double>(mission.search.size_m);
  // Every other place, then the two beside the best of them.
  const bool beside = line_.next > kLineSteps;
  const int place = beside ? line_.middle + line_.next - kLineEnd + 1 : line_.next;
  const Pose moved = step_pose(line_.from, place * step_m * line_.direction);
  const HypothesisScore fit = measure_score(mission, moved, subset, line_.fit.score(), kLineHeadStart);
  if (fit.score() < line_.fit.score()) {
    line_.fit = fit;
    line_.best = moved;
    if (!beside) line_.middle = place;
  }
  return score_work(fit);
}

void PoseSearch::end_line() {
  Track& track = tracks_[next_];
  track.T_target_sensor[last()] = line_.best;
  track.scores[last()] = line_.fit;
  sum_up(track);
  line_ = Line();
  ++next_;
  if (is_next_searched()) return;
  next_ = 0;
  stage_ = Stage::kRobustRefine;
}

// Keeps the best few that are at least 5 deg apart, best first.
void PoseSearch::prune() {
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

// From the poses of the scan and of the one before it; zero in the first.
Twist PoseSearch::rates_of(const Track& track, std::size_t scan) const {
  Twist rates;
  if (scan == 0) return rates;
  const double dt_s = to_seconds(subsets_[scan].t_us - subsets_[scan - 1].t_us);
  const Vec6 difference = pose_difference(inverse(track.T_target_sensor[scan]), inverse(track.T_target_sensor[scan - 1]));
  rates.omega_radps = difference.head<3>() / dt_s;
  rates.v_mps = difference.tail<3>() / dt_s;
  return rates;
}

// Where a pose of the scan before the last one should be in the last one.
Pose PoseSearch::carried(const Track& track) const {
  const std::size_t from = last() - 1;
  const double dt_s = to_seconds(subsets_[last()].t_us - subsets_[from].t_us);
  return inverse(propagate(inverse(track.T_target_sensor[from]), rates_of(track, from), dt_s));
}

}  // namespace lasso
