#include "fsw/mode/modes.hpp"

namespace lasso {
namespace {

using M = TrackingMode;
using E = ModeEvent;

// clang-format off
constexpr ModeTransition kTransitions[] = {
  {M::kStandby,     E::kStart,          M::kStarting,    "a pose to start from"},
  {M::kStandby,     E::kSeek,           M::kBearing,     "commanded, or the mission's own start is refused"},
  {M::kStandby,     E::kSearch,         M::kSearching,   "commanded"},
  {M::kStandby,     E::kMakeSafe,      M::kSafe,        "commanded, or the answer to a fault"},
  {M::kStarting,    E::kStart,          M::kStarting,    "another pose to start from"},
  {M::kStarting,    E::kStop,           M::kStandby,     "commanded, or the image that takes over cannot go on with the track"},
  {M::kStarting,    E::kSeek,           M::kBearing,     "commanded"},
  {M::kStarting,    E::kSearch,         M::kSearching,   "commanded"},
  {M::kStarting,    E::kPoseValid,      M::kTracking,    "a scan confirms the start"},
  {M::kStarting,    E::kCheck,          M::kVerifying,   "a scan confirms the start, and is searched for a better pose"},
  {M::kStarting,    E::kPoseInvalid,    M::kStarting,    "the next scan tries again"},
  {M::kStarting,    E::kExhausted,      M::kLost,        "no scan confirmed the start"},
  {M::kStarting,    E::kRecover,        M::kBearing,     "no scan confirmed the start: its direction at least, then a search if it is the next source"},
  {M::kStarting,    E::kFallBack,       M::kReacquiring, "no scan confirmed the start: the track that it interrupted is looked for again"},
  {M::kStarting,    E::kMakeSafe,      M::kSafe,        "commanded, or the answer to a fault"},
  {M::kVerifying,   E::kStart,          M::kStarting,    "another pose to start from"},
  {M::kVerifying,   E::kStop,           M::kStandby,     "commanded, or the image that takes over cannot go on with the track"},
  {M::kVerifying,   E::kSeek,           M::kBearing,     "commanded"},
  {M::kVerifying,   E::kSearch,         M::kSearching,   "commanded"},
  {M::kVerifying,   E::kPoseValid,      M::kTracking,    "no search found a better pose"},
  {M::kVerifying,   E::kPoseInvalid,    M::kVerifying,   "the search is at work, another scan is to be searched, or the scan gave no pose"},
  {M::kVerifying,   E::kConfirmAnew,    M::kStarting,    "the check ends without an answer: a scan has to confirm the start again"},
  {M::kVerifying,   E::kExhausted,      M::kLost,        "a search found a better pose, or too many scans gave no pose"},
  {M::kVerifying,   E::kRecover,        M::kBearing,     "a search found a better pose, or too many scans gave no pose: its direction at least, then a search if it is the next source"},
  {M::kVerifying,   E::kFallBack,       M::kReacquiring, "a search found a better pose, or too many scans gave no pose: the track that the start interrupted is looked for again"},
  {M::kVerifying,   E::kMakeSafe,       M::kSafe,        "commanded, or the answer to a fault"},
  {M::kTracking,    E::kStart,          M::kStarting,    "another pose to start from"},
  {M::kTracking,    E::kStop,           M::kStandby,     "commanded, or the image that takes over cannot go on with the track"},
  {M::kTracking,    E::kSeek,           M::kBearing,     "commanded, or a fault that leaves no prediction"},
  {M::kTracking,    E::kReacquire,      M::kReacquiring, "commanded, or the answer to a fault"},
  {M::kTracking,    E::kSearch,         M::kSearching,   "commanded"},
  {M::kTracking,    E::kPoseValid,      M::kTracking,    "the track holds"},
  {M::kTracking,    E::kNear,           M::kShortRange,  "close by: its parts in turn; or commanded"},
  {M::kTracking,    E::kPoseInvalid,    M::kCoasting,    "the filter bridges a scan without a pose"},
  {M::kTracking,    E::kExhausted,      M::kLost,        "no coasting is allowed"},
  {M::kTracking,    E::kRecover,        M::kReacquiring, "no coasting is allowed: look near the prediction"},
  {M::kTracking,    E::kMakeSafe,      M::kSafe,        "commanded, or the answer to a fault"},
  {M::kCoasting,    E::kStart,          M::kStarting,    "another pose to start from"},
  {M::kCoasting,    E::kStop,           M::kStandby,     "commanded, or the image that takes over cannot go on with the track"},
  {M::kCoasting,    E::kSeek,           M::kBearing,     "commanded, or a fault that leaves no prediction"},
  {M::kCoasting,    E::kReacquire,      M::kReacquiring, "commanded, or the answer to a fault"},
  {M::kCoasting,    E::kSearch,         M::kSearching,   "commanded"},
  {M::kCoasting,    E::kPoseValid,      M::kTracking,    "the track is taken up again"},
  {M::kCoasting,    E::kPoseInvalid,    M::kCoasting,    "the filter bridges another scan"},
  {M::kCoasting,    E::kExhausted,      M::kLost,        "too many scans without a pose"},
  {M::kCoasting,    E::kRecover,        M::kReacquiring, "too many scans without a pose: look near the prediction"},
  {M::kCoasting,    E::kMakeSafe,      M::kSafe,        "commanded, or the answer to a fault"},
  {M::kLost,        E::kStart,          M::kStarting,    "a pose to start from"},
  {M::kLost,        E::kStop,           M::kStandby,     "commanded, or the image that takes over cannot go on with the track"},
  {M::kLost,        E::kSeek,           M::kBearing,     "commanded, or a start is refused and a search is left to be tried"},
  {M::kLost,        E::kReacquire,      M::kReacquiring, "commanded, or an image that lost the track is taken back"},
  {M::kLost,        E::kSearch,         M::kSearching,   "commanded"},
  {M::kLost,        E::kMakeSafe,      M::kSafe,        "commanded, or the answer to a fault"},
  {M::kBearing,     E::kStart,          M::kStarting,    "a pose to start from"},
  {M::kBearing,     E::kStop,           M::kStandby,     "commanded, or the image that takes over cannot go on with the track"},
  {M::kBearing,     E::kSearch,         M::kSearching,   "commanded, or the turn of search as a source"},
  {M::kBearing,     E::kBearingKnown,   M::kBearing,     "direction and range are known; a pose is awaited"},
  {M::kBearing,     E::kBearingUnknown, M::kBearing,     "the next scan looks again"},
  {M::kBearing,     E::kMakeSafe,      M::kSafe,        "commanded, or the answer to a fault"},
  {M::kReacquiring, E::kStart,          M::kStarting,    "a pose to start from"},
  {M::kReacquiring, E::kStop,           M::kStandby,     "commanded, or the image that takes over cannot go on with the track"},
  {M::kReacquiring, E::kSeek,           M::kBearing,     "commanded"},
  {M::kReacquiring, E::kSearch,         M::kSearching,   "commanded"},
  {M::kReacquiring, E::kPoseValid,      M::kTracking,    "found near the prediction"},
  {M::kReacquiring, E::kPoseInvalid,    M::kReacquiring, "the next scan tries again"},
  {M::kReacquiring, E::kExhausted,      M::kLost,        "not found near the prediction"},
  {M::kReacquiring, E::kRecover,        M::kBearing,     "not found near the prediction: its direction at least"},
  {M::kReacquiring, E::kMakeSafe,      M::kSafe,        "commanded, or the answer to a fault"},
  {M::kSearching,   E::kStart,          M::kStarting,    "a pose to start from"},
  {M::kSearching,   E::kStop,           M::kStandby,     "commanded, or another image takes over"},
  {M::kSearching,   E::kSeek,           M::kBearing,     "commanded"},
  {M::kSearching,   E::kPoseValid,      M::kStarting,    "a pose is recognised: a scan has to confirm it"},
  {M::kSearching,   E::kPoseInvalid,    M::kSearching,   "still at work, or another scan is needed"},
  {M::kSearching,   E::kExhausted,      M::kLost,        "no pose was recognised"},
  {M::kSearching,   E::kRecover,        M::kBearing,     "no pose was recognised: the other sources of a start, and again"},
  {M::kSearching,   E::kMakeSafe,      M::kSafe,        "commanded, or the answer to a fault"},
  {M::kShortRange,  E::kStart,          M::kStarting,    "another pose to start from"},
  {M::kShortRange,  E::kStop,           M::kStandby,     "commanded, or the image that takes over cannot go on with the track"},
  {M::kShortRange,  E::kSeek,           M::kBearing,     "commanded, or a fault that leaves no prediction"},
  {M::kShortRange,  E::kReacquire,      M::kReacquiring, "commanded, or the answer to a fault"},
  {M::kShortRange,  E::kSearch,         M::kSearching,   "commanded"},
  {M::kShortRange,  E::kPoseValid,      M::kShortRange,  "the track holds"},
  {M::kShortRange,  E::kPoseInvalid,    M::kShortRange,  "the filter bridges a part without a pose"},
  {M::kShortRange,  E::kFar,            M::kTracking,    "far enough to be scanned as a whole; or commanded"},
  {M::kShortRange,  E::kExhausted,      M::kLost,        "too many scans without a pose"},
  {M::kShortRange,  E::kRecover,        M::kReacquiring, "too many scans without a pose: look near the prediction"},
  {M::kShortRange,  E::kMakeSafe,      M::kSafe,        "commanded, or the answer to a fault"},
  {M::kSafe,        E::kStop,          M::kStandby,     "commanded"},
};

constexpr ModeProperties kProperties[] = {
  //                scans full   search lost   wide   conf.  take   parts  await  tries
  {M::kStandby,     false, false, false, false, false, false, false, false, false, false, "standby", "no scans, no poses"},
  {M::kStarting,    true,  false, false, false, true,  true,  true,  false, false, true,  "starting", "a pose was given; a scan has to confirm it"},
  {M::kTracking,    true,  false, false, false, false, false, false, false, false, false, "tracking", "the last scan gave a valid pose"},
  {M::kCoasting,    true,  false, false, false, false, false, true,  false, false, false, "coasting", "the last scan gave none: the filter predicts"},
  {M::kLost,        false, false, false, true,  false, false, false, false, true,  false, "lost", "no scans; every frame says so"},
  {M::kBearing,     true,  true,  false, false, false, false, false, false, true,  false, "bearing", "full-field scans for direction and range"},
  {M::kReacquiring, true,  false, false, false, true,  true,  true,  false, false, false, "reacquiring", "wide starts near the prediction"},
  {M::kSearching,   true,  false, true,  false, false, false, false, false, false, false, "searching", "the pose is looked for at any attitude"},
  {M::kShortRange,  true,  false, false, false, false, false, false, true,  false, false, "short_range", "close by: parts of the target in turn"},
  {M::kSafe,        false, false, false, true,  false, false, false, false, false, false, "safe", "no scans, the laser inhibited; left by command alone"},
  {M::kVerifying,   true,  false, false, false, false, false, true,  false, false, true,  "verifying", "a scan confirmed the start, and is searched for a better pose"},
};

constexpr ModeEventProperties kEvents[] = {
  {E::kStart, true, "start"},
  {E::kStop, true, "stop"},
  {E::kPoseValid, false, "pose_valid"},
  {E::kPoseInvalid, false, "pose_invalid"},
  {E::kExhausted, false, "exhausted"},
  {E::kRecover, false, "recover"},
  {E::kSeek, true, "seek"},
  {E::kReacquire, true, "reacquire"},
  {E::kBearingKnown, false, "bearing_known"},
  {E::kBearingUnknown, false, "bearing_unknown"},
  {E::kSearch, true, "search"},
  {E::kNear, true, "near"},
  {E::kFar, true, "far"},
  {E::kMakeSafe, true, "make_safe"},
  {E::kFallBack, false, "fall_back"},
  {E::kCheck, false, "check"},
  {E::kConfirmAnew, false, "confirm_anew"},
};
// clang-format on

const ModeTransition* find_row(TrackingMode from, ModeEvent event) {
  for (const ModeTransition& row : kTransitions) {
    if (row.from == from && row.event == event) return &row;
  }
  return nullptr;
}

}  // namespace

Span<const ModeTransition> mode_transitions() { return Span<const ModeTransition>(kTransitions); }

Span<const ModeProperties> mode_properties() { return Span<const ModeProperties>(kProperties); }

Span<const ModeEventProperties> mode_events() { return Span<const ModeEventProperties>(kEvents); }

TrackingMode next_mode(TrackingMode from, ModeEvent event) {
  const ModeTransition* row = find_row(from, event);
  return row != nullptr ? row->to : from;
}

bool has_transition(TrackingMode from, ModeEvent event) { return find_row(from, event) != nullptr; }

const ModeProperties& properties(TrackingMode mode) { return mode_properties()[static_cast<std::size_t>(mode)]; }

bool command_event(TrackingMode mode, ModeEvent& event) {
  constexpr struct {
    TrackingMode mode;
    ModeEvent event;
  } kCommands[] = {{M::kStandby, E::kStop}, {M::kBearing, E::kSeek},    {M::kReacquiring, E::kReacquire}, {M::kSearching, E::kSearch},
                   {M::kTracking, E::kFar}, {M::kShortRange, E::kNear}, {M::kSafe, E::kMakeSafe}};
  for (const auto& command : kCommands) {
    if (command.mode != mode) continue;
    event = command.event;
    return true;
  }
  return false;
}

const char* to_string(ModeRefusal refusal) {
  static constexpr const char* kNames[] = {"none", "not_begun", "not_by_command", "not_from_here", "no_prediction"};
  const auto index = static_cast<std::size_t>(refusal);
  return index < sizeof(kNames) / sizeof(kNames[0]) ? kNames[index] : "unknown";
}

const char* to_string(TrackingMode mode) { return properties(mode).name; }

const char* to_string(ModeEvent event) { return mode_events()[static_cast<std::size_t>(event)].name; }

}  // namespace lasso
