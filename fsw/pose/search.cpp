#include "fsw/pose/search.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/geometry/symmetric6.hpp"
#include "fsw/pose/path_pose.hpp"
#include "fsw/pose/prepare.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

constexpr std::size_t kPullPoints = 128;
constexpr int kExploreSteps = 12;               // each way, even
constexpr int kExploreEnd = kExploreSteps + 4;  // with the places beside the best
constexpr double kExploreStep = 0.005;          // of the model's size, along the least certain direction

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

}  // namespace

void Search::begin(const SearchLimits& limits) {
  limits_ = limits;
  stage_ = Stage::kIdle;
  scans_ = 0;
  tracks_.clear();
  line_ = Line();
  working_ = false;
  adding_work_ = 0;
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
  scan_work_ = 0;
  adding_work_ = prepare_work(scan.samples.size());
  count(adding_work_);
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
    count(work);
  }
  return !busy();
}

void Search::count(std::uint32_t work) {
  scan_work_ += work;
  result_.work += work;
}

// Asked for what is worth working on, and only then.
bool Search::may_work() {
  const bool may = scan_work_ < limits_.work_max;
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
    case Stage::kRecall:
      return recall_next(mission, workspace);
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
  if (!maker_.step(mission, evidence_[last()], work)) {
    coarse_.begin(mission, evidence_[last()]);
    stage_ = Stage::kCoarse;
  }
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

std::uint32_t Search::pull_next(const Mission& mission, Workspace& workspace) {
  put_points(evidence_[last()], kPullPoints, workspace);
  const Pulled pulled = pull_on_distances(mission, coarse_.short_list()[next_].T_target_sensor, workspace);
  drawn_.add(pulled.T_target_sensor, pulled.distance);
  if (++next_ == coarse_.short_list().size()) {
    drawn_.keep_best();
    next_ = 0;
    stage_ = Stage::kDraw;
  }
  return pull_work(workspace.points.size());
}

std::uint32_t Search::draw_next(const Mission& mission, Workspace& workspace) {
  const Evidence& evidence = evidence_[last()];
  put_points(evidence, kPullPoints, workspace);
  Drawn& drawn = drawn_[next_];
  drawn.T_target_sensor = pull_on_rays(mission, drawn.T_target_sensor, workspace);
  drawn.fit = measure_fit(mission, drawn.T_target_sensor, evidence, hopeless_beyond(drawn_.best_score(next_)));
  drawn.score = drawn.fit.score();
  if (++next_ == drawn_.size()) choose_finalists();
  return draw_work(workspace.points.size()) + fit_work(drawn.fit);
}

// Is it as far as that from all of the scan's own finalists?
bool Search::is_apart(const Pose& T_target_sensor, double cos_half_angle) const {
  bool apart = true;
  for (std::size_t i = first_; i < tracks_.size(); ++i) {
    apart = apart && are_apart(T_target_sensor.q, tracks_[i].T_target_sensor[last()].q, cos_half_angle);
  }
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
  first_ = tracks_.size();
  for (std::size_t chosen = 0; chosen < kFinalists; ++chosen) {
    const Drawn* best = best_drawn(chosen + 2 < kFinalists ? kCosHalfSame : kCosHalfDistinct);
    if (best == nullptr) break;
    add_track(best->T_target_sensor, best->fit);
  }
  twins_ = false;
  next_ = 0;
  stage_ = Stage::kSketch;
}

void Search::add_track(const Pose& T_target_sensor, const Fit& fit) {
  Track track;
  track.T_target_sensor[last()] = T_target_sensor;
  track.fits[last()] = fit;
  invariant(tracks_.push_back(track), "room for a track");
}

void Search::take(const Settled& settled, std::size_t scan, Track& track) const {
  track.T_target_sensor[scan] = settled.solution.T_target_sensor;
  track.fits[scan] = settled.fit;
  track.known[scan] = true;
  if (scan == last()) track.H = settled.solution.H;
  sum_up(track);
}

void Search::sum_up(Track& track) const {
  track.total = Fit();
  for (std::size_t i = 0; i < scans_; ++i) track.total = track.total + track.fits[i];
}

double Search::best_score() const {
  double best = kAnyScore;
  for (const Track& track : tracks_) {
    if (track.known[last()]) best = clamp(track.total.score(), 0, best);
  }
  return best;
}

bool Search::is_hopeless(const Track& track) const { return track.total.score() > hopeless_beyond(best_score()); }

// All tracks in the last scan: its own finalists from where they were drawn to, the others from where they should be; and once more from
// there, pulled from farther, where that leads to nothing.
std::uint32_t Search::sketch_next(const Mission& mission, Workspace& workspace) {
  const Evidence& evidence = evidence_[last()];
  Track& track = tracks_[next_];
  const bool own = next_ >= first_;
  const bool drawn = own && !twins_;
  const double limit = hopeless_beyond(best_score());
  std::uint32_t work = 0;
  put_points(evidence, kPullPoints, workspace);
  if (working_) {
    const Pose start = pull_in(mission, track.start, workspace);
    const Settled settled = sketch(mission, evidence, {start, track.fits[last()]}, limit, workspace, work);
    if (settled.fit.score() < track.fits[last()].score()) take(settled, last(), track);
    work += pull_work(workspace.points.size()) + draw_work(workspace.points.size());
    working_ = false;
  } else {
    track.start = own ? track.T_target_sensor[last()] : carry(track, last() - 1, last(), rates_of(track, last() - 1));
    track.settled = track.swayed = false;
    track.cost = track.whole_cost = track.explained_cost = kAnyScore;
    const Pose start = drawn ? track.start : pull_on_rays(mission, track.start, workspace);
    take(sketch(mission, evidence, {start, track.fits[last()]}, limit, workspace, work), last(), track);
    work += drawn ? 0 : draw_work(workspace.points.size());
    working_ = !drawn && is_hopeless(track);
  }
  if (working_ || ++next_ < tracks_.size()) return work;
  prune();
  next_ = 0;
  stage_ = Stage::kSettle;
  return work;
}

// One attempt at a track in a scan.
std::uint32_t Search::settle(const Mission& mission, std::size_t scan, Track& track, Workspace& workspace) {
  std::uint32_t work = 0;
  const double limit = scan == last() ? poor_beyond(best_score()) : kAnyScore;
  working_ = settler_.step(mission, evidence_[scan], limit, workspace, work);
  if (!working_) take(settler_.best(), scan, track);
  return work;
}

std::uint32_t Search::settle_next(const Mission& mission, Workspace& workspace) {
  for (; next_ < tracks_.size(); ++next_) {
    Track& track = tracks_[next_];
    if (!working_ && (track.settled || is_hopeless(track) || !may_work())) continue;
    if (!working_) settler_.begin(track.T_target_sensor[last()], track.start);
    track.settled = true;
    return settle(mission, last(), track, workspace);
  }
  end_settling(mission);
  return kEndingWork;
}

void Search::end_settling(const Mission& mission) {
  prune();
  next_ = 0;
  if (!twins_ && scans_ == 1) {
    add_twins(mission);
    stage_ = Stage::kSketch;
    if (first_ < tracks_.size()) return;
  }
  next_ = 0;
  stage_ = Stage::kExplore;
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
  const Fit fit = measure_fit(mission, moved, evidence, line_.fit.score());
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
  stage_ = Stage::kRecall;
}

// The last scan's finalists in the scans before, so that scores of as many scans are compared. A step is one attempt.
std::uint32_t Search::recall_next(const Mission& mission, Workspace& workspace) {
  for (; next_ < tracks_.size(); ++next_) {
    for (std::size_t scan = last(); scan-- > 0;) {
      Track& track = tracks_[next_];
      if (track.known[scan] || (is_hopeless(track) && !is_rival(track))) continue;
      if (!working_ && !may_work()) continue;
      const Pose start = carry(track, scan + 1, scan, rates_of(track, scan + 2));
      if (!working_) settler_.begin(start, start);
      return settle(mission, scan, track, workspace);
    }
  }
  prune();
  next_ = 0;
  stage_ = Stage::kSway;
  return kEndingWork;
}

// What comes to the same attitude in the last scan was the same in those before it.
void Search::inherit(const Track& other, Track& track) const {
  for (std::size_t scan = 0; scan < last(); ++scan) {
    if (track.known[scan] || (is_hopeless(track) && !is_rival(track))) continue;
    track.T_target_sensor[scan] = other.T_target_sensor[scan];
    track.fits[scan] = other.fits[scan];
    track.known[scan] = other.known[scan];
  }
  sum_up(track);
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
      const bool same = !are_apart(t[i].T_target_sensor[last()].q, t[k].T_target_sensor[last()].q, kCosHalfSame);
      if (same) inherit(t[i], t[k]);
      apart = apart && !same;
    }
    if (apart) t[kept++] = t[i];
  }
  t.shrink(kept);
}

// From the poses of `scan`, which is known, and the one before it; zero where that is not.
Twist Search::rates_of(const Track& track, std::size_t scan) const {
  Twist rates;
  if (scan == 0 || scan > last() || !track.known[scan - 1]) return rates;
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

}  // namespace lasso
