#include "fsw/pose/recognition/pose_search.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/symmetric6.hpp"
#include "fsw/pose/scan/path_pose.hpp"
#include "fsw/pose/scan/prepare.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

constexpr double kFirstShare = 0.8;             // of the work, for a scan that others may join: a later one takes some 0.6 million units
constexpr double kJoinShare = 0.85;             // beyond it a further scan is not worth adding
constexpr int kExploreSteps = 12;               // each way, even
constexpr int kExploreEnd = kExploreSteps + 4;  // with the places beside the best
constexpr std::size_t kLineHeadStart = 96;
constexpr double kExploreStep = 0.005;  // of the model's size, along the least certain direction

// The least certain direction of the information H: a step that moves the farthest part of the model by a metre. False where H has none.
bool find_weakest(const Mission& mission, const Mat6& H, Vec6& direction) {
  Mat6 covariance;
  if (invert6(H, covariance) != Status::kOk) return false;
  direction = axes_at_radius(covariance, mission.radius_m).vectors.col(5);
  direction.head<3>() /= mission.radius_m;
  return true;
}

}  // namespace

void Search::begin(const SearchLimits& limits) {
  limits_ = limits;
  stage_ = Stage::kIdle;
  scans_ = 0;
  tracks_.clear();
  line_ = Line();
  twins_ = working_ = suspects_ = false;
  adding_work_ = 0;
  result_ = SearchResult();
}

void Search::suspect(const Pose& T_sensor_target) {
  invariant(scans_ == 0, "before the first scan");
  suspects_ = true;
  suspect_ = inverse(T_sensor_target);
}

bool Search::joins() const {
  const bool room = scans_ < kMaxSearchScans && scans_ < limits_.scans_max;
  const bool undecided = result_.outcome == SearchOutcome::kAmbiguous && result_.work < kJoinShare * limits_.work_max;
  return room && (scans_ == 0 || result_.outcome == SearchOutcome::kAccepted || undecided);
}

Status Search::add_scan(const Mission& mission, const RangeImage& scan, Workspace& workspace) {
  if (busy()) return Status::kBusy;
  if (!joins()) return Status::kBadOrder;
  if (scans_ > 0 && scan.reference_time_us() <= evidence_[last()].t_us) return Status::kBadOrder;
  prepare_rays(mission, scan, StartPoint(), workspace);
  if (workspace.points.empty()) return Status::kNoData;
  carry_over();
  Evidence& evidence = evidence_[scans_++];
  evidence.clear();
  evidence.scan_id = scan.scan_id;
  evidence.t_us = scan.reference_time_us();
  maker_.begin(mission, workspace);
  adding_work_ = prepare_work(scan.samples.size());
  result_.work += adding_work_;
  unfinished_ = false;
  mirrored_ = false;
  stage_ = Stage::kEvidence;
  return Status::kOk;
}

bool Search::advance(const Mission& mission, Workspace& workspace, std::uint32_t budget) {
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
void Search::carry_over() {
  std::size_t carried = 0;
  for (Track& track : tracks_) {
    if (!unfinished_ && !is_near(ratio_of(track.total.score(), tracks_[0].total.score()), 0, limits_.ratio_min)) break;
    track.sketched = track.settled = track.swayed = false;
    track.cost = track.whole_cost = track.explained_cost = kAnyScore;
    ++carried;
  }
  tracks_.shrink(carried);
}

// Asked for what is worth working on, and only then.
bool Search::may_work() { return may_work_up_to(scans_ == 1 && limits_.scans_max > 1 ? kFirstShare : 1); }

bool Search::may_work_up_to(double share) {
  const bool may = result_.work < share * limits_.work_max;
  unfinished_ = unfinished_ || !may;
  return may;
}

std::uint32_t Search::step(const Mission& mission, Workspace& workspace) {
  switch (stage_) {
    case Stage::kEvidence:
      return gather_evidence(mission);
    case Stage::kCoarse:
      return look_coarsely(mission);
    case Stage::kPull:
      return pull_next(mission, workspace);
    case Stage::kDraw:
      return draw_next(mission, workspace);
    case Stage::kSketch:
      return sketch_next(mission, workspace);
    case Stage::kSettle:
      return settle_next(mission, workspace);
    case Stage::kExplore:
      return explore_next(mission);
    case Stage::kSway:
      return sway_next(mission, workspace);
    case Stage::kMirror:
      return mirror_next(mission, workspace);
    default:
      return conclude();
  }
}

std::uint32_t Search::gather_evidence(const Mission& mission) {
  std::uint32_t work = 0;
  if (maker_.step(mission, evidence_[last()], work)) return work;
  if (scans_ == 1) coarse_.begin(mission, evidence_[last()]);
  next_ = 0;
  stage_ = scans_ == 1 ? Stage::kCoarse : Stage::kSketch;
  return work;
}

std::uint32_t Search::look_coarsely(const Mission& mission) {
  const std::uint32_t work = coarse_.step(mission, evidence_[last()]);
  if (coarse_.done()) {
    drawn_.clear();
    next_ = 0;
    stage_ = Stage::kPull;
  }
  return work;
}

Pose Search::hypothesis(const Mission& mission, std::size_t i) const {
  const std::size_t found = coarse_.short_list().size();
  return i < found ? coarse_.short_list()[i].T_target_sensor : quarter_turned(suspect_, i - found, mission.center_m);
}

std::uint32_t Search::pull_next(const Mission& mission, Workspace& workspace) {
  put_points(evidence_[last()], kCoarsePoints, workspace);
  const Pulled pulled = pull_on_distances(mission, hypothesis(mission, next_), workspace);
  drawn_.add(pulled.T_target_sensor, pulled.distance);
  if (++next_ == hypotheses()) {
    drawn_.keep_best();
    next_ = 0;
    stage_ = Stage::kDraw;
  }
  return pull_work(workspace.points.size());
}

std::uint32_t Search::draw_next(const Mission& mission, Workspace& workspace) {
  const Evidence& evidence = evidence_[last()];
  put_points(evidence, kSketchPoints, workspace);
  Drawn& drawn = drawn_[next_];
  drawn.T_target_sensor = pull_on_rays(mission, drawn.T_target_sensor, workspace);
  drawn.fit = measure_fit(mission, drawn.T_target_sensor, evidence, hopeless_beyond(drawn_.best_score(next_)));
  drawn.score = drawn.fit.score();
  if (++next_ == drawn_.size()) choose_finalists();
  return draw_work(workspace.points.size()) + fit_work(drawn.fit);
}

// Is it as far as that from all finalists?
bool Search::is_apart(const Pose& T_target_sensor, double cos_half_angle) const {
  bool apart = true;
  for (const Track& track : tracks_) apart = apart && are_apart(T_target_sensor.q, track.T_target_sensor[0].q, cos_half_angle);
  return apart;
}

const Drawn* Search::best_drawn(double cos_half_angle) const {
  const Drawn* best = nullptr;
  for (std::size_t i = 0; i < drawn_.size(); ++i) {
    const bool better = best == nullptr || drawn_[i].score < best->score;
    if (better && is_apart(drawn_[i].T_target_sensor, cos_half_angle)) best = &drawn_[i];
  }
  return best;
}

// The best, at least 5 deg apart; and the last two at least 15 deg, so that there is a competitor to compare with.
void Search::choose_finalists() {
  for (std::size_t chosen = 0; chosen < kFinalists; ++chosen) {
    const Drawn* best = best_drawn(chosen + 2 < kFinalists ? kCosHalfSame : kCosHalfDistinct);
    if (best == nullptr) break;
    add_track(best->T_target_sensor, best->fit);
  }
  next_ = 0;
  stage_ = Stage::kSketch;
}

void Search::add_track(const Pose& T_target_sensor, const Fit& fit) {
  Track track;
  track.T_target_sensor[last()] = T_target_sensor;
  track.fits[last()] = fit;
  invariant(tracks_.push_back(track), "room for a track");
}

void Search::take(const Settled& settled, Track& track) const {
  track.T_target_sensor[last()] = settled.solution.T_target_sensor;
  track.fits[last()] = settled.fit;
  track.sketched = true;
  track.H = settled.solution.H;
  sum_up(track);
}

void Search::sum_up(Track& track) const {
  track.total = Fit();
  for (std::size_t i = 0; i < scans_; ++i) track.total = track.total + track.fits[i];
}

double Search::best_score() const {
  double best = kAnyScore;
  for (const Track& track : tracks_) {
    if (track.sketched) best = clamp(track.total.score(), 0, best);
  }
  return best;
}

bool Search::is_hopeless(const Track& track) const { return track.total.score() > hopeless_beyond(best_score()); }

// What fits worse than that is not worth measuring. Scores of several scans add up: whole ones.
double Search::sketch_limit() const { return scans_ == 1 ? hopeless_beyond(best_score()) : kAnyScore; }

// In the first scan the finalists from where they were drawn to, and the best one's twins; in a later one what is carried from where it
// should be.
std::uint32_t Search::sketch_near(const Mission& mission, Track& track, Workspace& workspace) {
  const bool drawn = scans_ == 1 && !twins_;
  std::uint32_t work = drawn ? 0 : draw_work(workspace.points.size());
  track.start = scans_ == 1 ? track.T_target_sensor[0] : carried(track);
  const Pose start = drawn ? track.start : pull_on_rays(mission, track.start, workspace);
  take(sketch(mission, evidence_[last()], {start, track.fits[last()]}, sketch_limit(), workspace, work), track);
  working_ = !drawn && (scans_ == 2 || is_hopeless(track));
  return work;
}

// Once more from there, pulled from farther, where that leads to nothing, or no rate was known.
std::uint32_t Search::sketch_afar(const Mission& mission, Track& track, Workspace& workspace) {
  std::uint32_t work = pull_work(workspace.points.size()) + draw_work(workspace.points.size());
  const Pose start = pull_in(mission, track.start, workspace);
  const Settled settled = sketch(mission, evidence_[last()], {start, track.fits[last()]}, sketch_limit(), workspace, work);
  if (settled.fit.score() < track.fits[last()].score()) take(settled, track);
  working_ = false;
  return work;
}

std::uint32_t Search::sketch_next(const Mission& mission, Workspace& workspace) {
  Track& track = tracks_[next_];
  put_points(evidence_[last()], kSketchPoints, workspace);
  const std::uint32_t work = working_ ? sketch_afar(mission, track, workspace) : sketch_near(mission, track, workspace);
  if (working_ || ++next_ < tracks_.size()) return work;
  prune();
  next_ = 0;
  stage_ = Stage::kSettle;
  return work;
}

std::uint32_t Search::settle_next(const Mission& mission, Workspace& workspace) {
  for (; next_ < tracks_.size(); ++next_) {
    Track& track = tracks_[next_];
    if (!working_ && (track.settled || is_hopeless(track) || !may_work())) continue;
    if (!working_) settler_.begin(track.T_target_sensor[last()], track.start);
    track.settled = true;
    std::uint32_t work = 0;
    working_ = settler_.step(mission, evidence_[last()], poor_beyond(best_score()), workspace, work) && may_work_up_to(1);
    if (!working_) take(settler_.best(), track);
    return work;
  }
  end_settling(mission);
  return kEndingWork;
}

void Search::end_settling(const Mission& mission) {
  prune();
  next_ = 0;
  stage_ = Stage::kExplore;
  if (!twins_ && scans_ == 1) add_twins(mission);
}

// Where a view says little about a direction, the registration may end anywhere along it, and hits that pass an edge decide: the best
// tracks move to the place along it that fits best. A step looks at one place.
std::uint32_t Search::explore_next(const Mission& mission) {
  const Evidence& evidence = evidence_[last()];
  std::uint32_t work = line_.begun ? 0 : begin_line(mission);
  if (line_.next <= kExploreEnd) work += look_along(mission, evidence);
  line_.next += 2;
  if (line_.next > kExploreEnd) end_line();
  return work;
}

// Without a direction, or hope, there is no place to look at.
std::uint32_t Search::begin_line(const Mission& mission) {
  const Track& track = tracks_[next_];
  line_.from = line_.best = track.T_target_sensor[last()];
  line_.fit = track.fits[last()];
  const bool worth = !is_hopeless(track) && may_work() && find_weakest(mission, track.H, line_.direction);
  line_.next = worth ? -kExploreSteps : kExploreEnd + 2;
  line_.begun = true;
  return kLineWork;
}

std::uint32_t Search::look_along(const Mission& mission, const Evidence& evidence) {
  const double step_m = kExploreStep * static_cast<double>(mission.search.size_m);
  // Every other place, then the two beside the best of them.
  const bool beside = line_.next > kExploreSteps;
  const int place = beside ? line_.middle + line_.next - kExploreEnd + 1 : line_.next;
  const Pose moved = step_pose(line_.from, place * step_m * line_.direction);
  const Fit fit = measure_fit(mission, moved, evidence, line_.fit.score(), kLineHeadStart);
  if (fit.score() < line_.fit.score()) {
    line_.fit = fit;
    line_.best = moved;
    if (!beside) line_.middle = place;
  }
  return fit_work(fit);
}

void Search::end_line() {
  Track& track = tracks_[next_];
  track.T_target_sensor[last()] = line_.best;
  track.fits[last()] = line_.fit;
  sum_up(track);
  line_ = Line();
  ++next_;
  if (explores_next()) return;
  next_ = 0;
  stage_ = Stage::kSway;
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

// From the poses of the scan and of the one before it; zero in the first.
Twist Search::rates_of(const Track& track, std::size_t scan) const {
  Twist rates;
  if (scan == 0) return rates;
  const double dt_s = to_seconds(evidence_[scan].t_us - evidence_[scan - 1].t_us);
  const Vec6 difference = pose_difference(inverse(track.T_target_sensor[scan]), inverse(track.T_target_sensor[scan - 1]));
  rates.omega_radps = difference.head<3>() / dt_s;
  rates.v_mps = difference.tail<3>() / dt_s;
  return rates;
}

// Where a pose of the scan before the last one should be in the last one.
Pose Search::carried(const Track& track) const {
  const std::size_t from = last() - 1;
  const double dt_s = to_seconds(evidence_[last()].t_us - evidence_[from].t_us);
  return inverse(propagate(inverse(track.T_target_sensor[from]), rates_of(track, from), dt_s));
}

}  // namespace lasso
