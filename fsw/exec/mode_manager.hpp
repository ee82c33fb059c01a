// The track and its mode, from boundary to boundary: which poses it may start from, what commands and faults ask of it, and what the last
// scan led to. The transitions themselves are a table (fsw/mode/modes.hpp). Used by the acquisition thread.
#pragma once

#include <cstdint>

#include "fsw/core/fixed_vector.hpp"
#include "fsw/core/time.hpp"
#include "fsw/core/voted.hpp"
#include "fsw/exec/component_context.hpp"
#include "fsw/link/pose_telemetry.hpp"
#include "fsw/mode/tracker.hpp"

namespace lasso {

class ModeManager {
 public:
  // They outlive it.
  explicit ModeManager(const ComponentContext& context) : context_(context) {}

  // See the functions of the same name of Component.
  StartRefusal offer_start(InitialPoseSource source, const StartOffer& offer);
  ModeRefusal command_mode(TrackingMode mode);
  void hold_mode(bool held) { held_ = held; }
  // The component begins: starts from the mission's pose, if it has one.
  void begin(TimeUs boundary_0_us);
  // Safe is commanded for the next boundary.
  bool safe_requested() const { return request_.kind == Request::Kind::kCommand && request_.event == ModeEvent::kMakeSafe; }

  // A boundary, in this order. Before anybody uses the mode: its copies are compared. Where no two agree, nobody knows it: safe, as often
  // as that happens.
  void check_mode();
  // What the scan's estimate led to becomes the track.
  void follow(TrackStep& step);
  // A fault was confirmed.
  void answer(FaultReaction reaction);
  // What was requested is carried out; then the sources of the mission's order have their turn.
  void apply_request();
  // The boundary's end: the mode is kept in its copies.
  void keep_mode() { mode_.set(track_.mode); }

  // The scan that is handed to the estimate is this sensor's. Errors that track, and interrupted track, have in common with the scans of
  // another one are then errors of their own.
  void use_sensor(SensorNumber sensor);
  // The clock has jumped by `moved_us`: states keep their age. Offers of another time are forgotten, a search begins anew, a start that is
  // checked has to be confirmed anew, and one that waits for the boundary is refused as kTooOld.
  void follow_jump(DurationUs moved_us);

  // Another image becomes active. One that keeps the target takes over the track, which is remembered while the image is `on_trial`, and of
  // which a checked start has to be confirmed anew; another one starts from nothing, and a start that waits for the boundary, which is of
  // the target before, is refused as kTooOld.
  void take_over_track(bool kept, bool on_trial);
  // The image before becomes active again: the track goes on from what was remembered (remembers_track()), but not from mode bearing. What
  // was commanded since has made it forgotten.
  void restore_track();
  bool remembers_track() const { return before_trial_.filter.initialised; }

  const TrackState& track() const { return track_; }
  TrackingMode mode() const { return track_.mode; }
  // Changes of the mode wait for the next pose packet; so many that one has to be sent, whatever is on its way.
  bool changes_wait() const { return !changes_.empty(); }
  bool changes_overdue() const { return changes_.size() >= kPoseChanges; }
  // What no packet reports of a change, its event has reported.
  void drop_changes() { changes_.clear(); }
  // Moves changes of the mode into the packet, and states counters and the last refusal.
  void report(PoseTelemetry& report);

 private:
  // For the next boundary. The last one counts.
  struct Request {
    enum class Kind : std::uint8_t { kNone, kStart, kCommand };
    Kind kind = Kind::kNone;
    InitialPoseSource source = InitialPoseSource::kNone;  // kStart
    ModeEvent event = ModeEvent::kStop;                   // kCommand
  };
  struct Counters {
    std::uint32_t refused_starts = 0, refused_commands = 0, inconsistent_parts = 0;
    InitialPoseSource refused_source = InitialPoseSource::kNone;  // the last one
    StartRefusal refusal = StartRefusal::kNone;
  };
  const Mission& mission() const { return context_.images.view(0).mission; }
  ModeRefusal refusal_of(TrackingMode mode, ModeEvent& event) const;
  void request_start(InitialPoseSource source);
  void drop_request();
  void take(ModeEvent event);
  void follow_table(ModeEvent event);
  void confirm_anew();
  void try_start(InitialPoseSource source);
  void try_sources();
  InitialPoseSource next_source() const;
  void take_source(InitialPoseSource source);
  void refuse_start(InitialPoseSource source, StartRefusal refusal);
  void refuse_in(const TrackStep& step);
  void resume_former(TrackStep& step);
  void watch_filter(const TrackStep& step);
  void note_change(const ModeChange& change);
  void doubt_track();
  void leave_target();
  void forget_before_trial();
  void forget_offers();
  void move_changes(PoseTelemetry& report);

  const ComponentContext& context_;
  TrackState track_;         // as of the last boundary
  FilterState former_;       // of the track that the present start interrupted, where it did
  TrackState before_trial_;  // the track that the active image took over
  InitialPoseSources sources_;
  Request request_;
  bool held_ = false;
  Voted<TrackingMode> mode_{TrackingMode::kStandby};  // as of the end of the last boundary
  Counters counters_;
  FixedVector<ModeChange, 2 * kPoseChanges> changes_;  // that no packet has reported yet
};

}  // namespace lasso
