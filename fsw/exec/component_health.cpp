// What the component watches, and how it answers: the table of faults (faults.hpp), the mode in its copies, the watchdog.
#include "fsw/exec/component.hpp"

namespace lasso {
namespace {

constexpr std::size_t kQueueHighBytes = kTelemetryQueueBytes / 10 * 9;

}  // namespace

void Component::feed_watchdog() {
  const bool alive = check_in_.boundary(estimation_.idle());
  if (!alive) ++health_.unfed_frames;
  if (watchdog_ != nullptr && alive) watchdog_->feed();
}

// Before anybody uses the mode. Where no two copies agree, nobody knows it: safe, as often as that happens.
void Component::check_mode() {
  TrackingMode voted = TrackingMode::kSafe;
  const bool known = mode_.get(voted);
  const bool agreed = mode_.agreed() && voted == track_.mode;
  if (!agreed) ++health_.mode_repairs;
  seen_.add(Fault::kModeLost, !known);
  seen_.add(Fault::kModeCorrupt, !agreed);
  if (!known) note_change({TrackingMode::kStandby, ModeEvent::kMakeSafe, TrackingMode::kSafe});
  if (!known) inhibit_laser();
  track_.mode = voted;
  mode_.set(voted);
}

// Before anybody asks for it. Where no two copies agree the laser goes out.
void Component::check_laser() {
  if (laser_.agreed()) return;
  seen_.add(Fault::kLaserCorrupt);
  link_changed_ = true;
  if (laser_enabled()) return laser_.set(1);
  inhibit_laser();
}

// The clock was set, or nobody ran the slots for long: states keep their age, and what is on its way is of another time.
void Component::follow_jump(TimeUs now_us) {
  const DurationUs moved_us = executive_.follow_jump(now_us);
  track_.filter.t_us += moved_us;
  track_.check = StartCheck{};  // its scan is of another time
  former_.t_us += moved_us;
  track_.bearing.t_us += moved_us;
  before_trial_ = TrackState{};
  sources_ = InitialPoseSources{};
  downlink_.forget_time();
  leave_track();
  estimated_.active = false;
  seen_.add(Fault::kTimeJump);
  ++health_.clock_jumps;
}

// A filter that excludes what scan after scan says, or has no numbers any more, is the one that is wrong.
void Component::watch_filter(const TrackStep& step) {
  const bool implausible = step.registration.reason == PoseReason::kImplausible;
  seen_.add(Fault::kImplausiblePose, implausible);
  seen_.add(Fault::kFilterDivergence, implausible || !is_sound(step.after.filter));
}

void Component::see_faults() {
  seen_.add(Fault::kSlotSlip, executive_.slips() != watched_.slot_slips);
  seen_.add(Fault::kMemoryHigh, downlink_.queue().size() > kQueueHighBytes);
  const MissionParameters& p = mission().parameters;
  seen_.add(Fault::kLinkSilent, p.link_silence_max_s > 0 && silent_frames_ * p.period_s > p.link_silence_max_s);
  ++silent_frames_;
  seen_.add(Fault::kWatchdogReset, health_.reset_cause > static_cast<std::uint8_t>(ResetCause::kCommanded));
  seen_.add(Fault::kSelfTestFailed, health_.failed_tests != 0);
}

void Component::answer_faults(TimeUs now_us) {
  see_faults();
  const FaultChanges changes = faults_.step(seen_);
  seen_ = FaultSet{};
  tell_faults(changes, now_us);
  if (changes.reaction == FaultReaction::kReacquire) doubt_track();
  if (changes.reaction != FaultReaction::kMakeSafe) return;
  drop_request();
  take(ModeEvent::kMakeSafe);
}

// The prediction is as good as a start that somebody guesses; where it has no numbers, nobody knows even that.
void Component::doubt_track() {
  if (!properties(track_.mode).scans || !has_transition(track_.mode, ModeEvent::kReacquire)) return;
  const MissionParameters& p = mission().parameters;
  FilterState& filter = track_.filter;
  const StartOffer guess = rough_offer(p, filter.T_sensor_target, filter.rates, filter.t_us);
  const bool known = start_filter(filter, filter_start(p, guess)) == Status::kOk;
  take(known ? ModeEvent::kReacquire : ModeEvent::kSeek);
}

void Component::tell_faults(const FaultChanges& changes, TimeUs now_us) {
  for (const FaultRow& row : fault_table()) {
    if (changes.confirmed.has(row.fault)) events_.raise<EventId::kFaultConfirmed>(row.fault, row.reaction);
    if (changes.cleared.has(row.fault)) events_.raise<EventId::kFaultCleared>(row.fault);
  }
  const bool news = !changes.confirmed.empty() || !changes.cleared.empty() || executive_.frame() == 0;
  if (!housekeeping_.due(kHealthStructureId, news)) return;
  health_.active_faults = faults_.active().bits();
  health_.past_faults = faults_.ever().bits();
  health_.confirmations = faults_.confirmations();
  health_.worst_lateness_us = executive_.worst_lateness_us();
  std::uint8_t packet[kMaxHealthBytes];
  downlink_.send({packet, encode_health(health_, downlink_.next_header(kHousekeepingReport, now_us), Bytes(packet))});
}

}  // namespace lasso
