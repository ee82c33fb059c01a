#include "fsw/mode/searcher.hpp"

#include <type_traits>

#include "fsw/geometry/fixed_number.hpp"
#include "fsw/geometry/portable_math.hpp"

namespace lasso {
namespace {

constexpr double kOffset_rad = kRadPerDeg;
constexpr double kOffsetShare = 0.0075;       // of the model's size
constexpr double kTurn_rad = 5 * kRadPerDeg;  // since its only scan (1 sigma): more needs another scan
constexpr DurationUs kBetweenScans_us = 2'000'000;
constexpr double kFrameShare = std::is_same_v<FlightNumber, FixedNumber> ? 0.3 : 1;  // there a unit takes twice as long (docs/search.md)
constexpr std::uint32_t kCheckPart = 2;  // of frame_work half: the frame registers its scan, too
constexpr std::uint32_t kAimedFrom = 3;  // bearing scans: the next but one after the first is the first that is aimed by it

}  // namespace

std::uint32_t frame_work(const MissionParameters& p) { return static_cast<std::uint32_t>(kFrameShare * p.search_slice); }

StartOffer offer_of(const Mission& mission, const SearchResult& result) {
  const MissionParameters& p = mission.parameters;
  const double range2_m2 = result.T_sensor_target.p.squaredNorm();
  const double common_m = p.common_sigma_m + p.common_sigma_k_per_m * range2_m2;
  const double turn2 = p.common_sigma_rad * p.common_sigma_rad;
  const double offset_m = kOffsetShare * static_cast<double>(mission.search.size_m);
  StartOffer offer{result.t_us, result.T_sensor_target, result.rates, result.covariance};
  offer.covariance.diagonal().head<3>().array() += kOffset_rad * kOffset_rad + turn2;
  offer.covariance.diagonal().tail<3>().array() += offset_m * offset_m + common_m * common_m + turn2 * range2_m2;
  return offer;
}

void Searcher::begin(std::uint32_t number, bool checks) {
  number_ = number;
  checks_ = checks;
  waiting_ = false;
  SearchLimits limits = limits_;
  if (checks) limits.scans_max = 1;
  search_.begin(limits);
}

// A scan without returns is not taken; the next one may be.
void Searcher::take(const Mission& mission, const RangeImage& scan, Workspace& workspace) {
  if (!search_.joins()) begin(number_, false);
  static_cast<void>(search_.add_scan(mission, scan, workspace));
  taken_us_ = scan.reference_time_us();
  waiting_ = false;
}

// The farther a target turns between two scans, the less surely are the poses of one found again in the other.
void Searcher::keep(const RangeImage& scan) {
  if (waiting_ || scan.reference_time_us() - taken_us_ < kBetweenScans_us) return;
  next_ = scan;
  waiting_ = true;
}

void Searcher::receive(const Mission& mission, const RangeImage& scan, Workspace& workspace) {
  if (search_.busy()) return keep(scan);
  if (!found(mission.parameters, scan.reference_time_us())) take(mission, waiting_ ? next_ : scan, workspace);
}

// A single scan shows no rate.
bool Searcher::stale(const MissionParameters& p, TimeUs now_us) const {
  const double age_s = to_seconds(now_us - search_.result().t_us);
  return search_.result().scans < 2 && limits_.scans_max > 1 && age_s * p.initial_angular_rate_radps > kTurn_rad;
}

bool Searcher::offer(const Mission& mission, TrackStep& step) {
  TrackState& state = step.after;
  step.refusal = start_from(mission, offer_of(mission, search_.result()), step.registration.t_us, state.bearing, state.filter);
  if (step.refusal != StartRefusal::kNone) {
    begin(number_, false);
    return false;
  }
  state.source = InitialPoseSource::kSearch;
  return true;
}

void Searcher::work(const Mission& mission, const RangeImage* scan, Workspace& workspace, TrackStep& step) {
  const MissionParameters& p = mission.parameters;
  if (checks_ || number_ != step.after.searches) begin(step.after.searches, false);
  const TimeUs now_us = step.registration.t_us;
  if (scan != nullptr && step.after.bearing.scans >= kAimedFrom) receive(mission, *scan, workspace);
  static_cast<void>(search_.advance(mission, workspace, frame_work(p)));
  step.search = search_.result();
  step.registration.reason = scan != nullptr ? PoseReason::kSearching : step.registration.reason;
  const bool offered = found(p, now_us) && offer(mission, step);
  count_and_change(p, offered, step);
}

// False where it has no returns, or is another one: the check's own is gone.
bool Searcher::takes_check(const Mission& mission, const RangeImage* scan, Workspace& workspace, const TrackState& state) {
  begin(state.searches, true);
  if (scan == nullptr || scan->reference_time_us() != state.check.t_us) return false;
  taken_us_ = state.check.t_us;
  search_.suspect(state.check.T_sensor_target);
  return search_.add_scan(mission, *scan, workspace) == Status::kOk;
}

CheckOutcome Searcher::outcome_of(const Mission& mission, const Pose& T_sensor_target, Workspace& workspace) const {
  if (search_.contradicts(mission, T_sensor_target, workspace)) return CheckOutcome::kContradicted;
  return search_.agrees(T_sensor_target) ? CheckOutcome::kSure : CheckOutcome::kUndecided;
}

void Searcher::check(const Mission& mission, const RangeImage* scan, Workspace& workspace, TrackStep& step) {
  const MissionParameters& p = mission.parameters;
  const StartCheck& check = step.after.check;
  const bool at_work = checks_ && number_ == step.after.searches && taken_us_ == check.t_us;
  if (!at_work) {
    if (!takes_check(mission, scan, workspace, step.after)) confirm_anew(step);
    return;
  }
  if (!search_.advance(mission, workspace, frame_work(p) / kCheckPart)) return;
  step.search = search_.result();
  end_check(p, outcome_of(mission, check.T_sensor_target, workspace), step);
}

}  // namespace lasso
