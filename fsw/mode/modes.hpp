// The modes as a table, executed as written: which mode, on which event, leads where. `mdat modes` prints it (docs/modes.md).
#pragma once

#include <cstdint>

#include "fsw/core/span.hpp"

namespace lasso {

enum class TrackingMode : std::uint8_t {
  kStandby = 0,      // no scans, no poses
  kStarting = 1,     // an initial pose was given, no scan has confirmed it yet
  kTracking = 2,     // the last scan gave a valid pose
  kCoasting = 3,     // the last scan gave none: the filter predicts
  kLost = 4,         // too long without a valid pose: no scans, every frame says so
  kBearing = 5,      // full-field scans for direction and range; a pose to start from is awaited
  kReacquiring = 6,  // the target is looked for near the prediction, from wide starts
  kSearching = 7,    // its pose is looked for without any prior attitude
  kShortRange = 8,   // close by: the last scan gave a valid pose, and the next ones look at parts of the target in turn
  kSafe = 9,         // after a fault, or commanded: no scans, no start is taken; every frame says what was known last
  kVerifying = 10,   // a scan has confirmed the start, and is searched for a better pose before the start is believed
};

enum class ModeEvent : std::uint8_t {
  kStart = 0,           // a pose to start from is given, or the next source's turn has come
  kStop = 1,            // commanded to standby, or an image takes over that cannot go on with the track
  kPoseValid = 2,       // a scan gave a valid pose
  kPoseInvalid = 3,     // a scan gave none, and the mode's frames are not used up
  kExhausted = 4,       // they are used up, and the mission asks for no recovery
  kRecover = 5,         // they are used up, and the mission asks for recovery, or a start leaves a search to be tried
  kSeek = 6,            // commanded to look for the target in the whole field; or a start is refused, or a fault leaves no prediction
  kReacquire = 7,       // commanded to look near the prediction, or the answer to a fault, or to an image that lost the track
  kBearingKnown = 8,    // a full-field scan gave a bearing
  kBearingUnknown = 9,  // a full-field scan gave none
  kSearch = 10,         // commanded to look for the pose at any attitude, or the turn of search as a source
  kNear = 11,           // a scan gave a valid pose, within short_range.enter_m; or commanded to look at parts
  kFar = 12,            // a scan gave a valid pose, beyond short_range.leave_m; or commanded to leave the parts
  kMakeSafe = 13,       // commanded, or the answer to a fault
  kFallBack = 14,       // a start that interrupted a track is given up
  kCheck = 15,          // a scan confirms a start that is to be checked (start.check)
  kConfirmAnew = 16,    // the check of a start ends without an answer: a scan has to confirm the start again
};

struct ModeTransition {
  TrackingMode from;
  ModeEvent event;
  TrackingMode to;
  const char* meaning;
};

// What the component does while in a mode.
struct ModeProperties {
  TrackingMode mode;
  bool scans;         // a scan is planned and started in each frame; each scan is reported
  bool full_field;    // scans of the whole field, for a bearing; otherwise aimed by the prediction, for a pose
  bool searches;      // aimed at the bearing, for the target at any attitude
  bool says_lost;     // frames without a scan are reported too
  bool wide_start;    // registration starts wide (where estimation.wide_start is set)
  bool confirms;      // a valid pose has to agree with the prediction, and starts the filter anew
  bool takes_up;      // a valid pose has to pass by tracking.hysteresis
  bool by_parts;      // scans look at a part of the target each, where there is one to look at
  bool awaits_start;  // a pose to start from is taken from the next source by itself, in the mission's order
  bool tries_start;   // a start is not yet believed, and is given up once its frames are used up
  const char* name;
  const char* meaning;
};

struct ModeEventProperties {
  ModeEvent event;
  bool commanded;  // it can be; the component may cause it, too
  const char* name;
};

// One step along the table, for telemetry.
struct ModeChange {
  TrackingMode from = TrackingMode::kStandby;
  ModeEvent event = ModeEvent::kStart;
  TrackingMode to = TrackingMode::kStandby;
};

// Why a mode cannot be commanded.
enum class ModeRefusal : std::uint8_t {
  kNone = 0,
  kNotBegun = 1,      // the component has not begun
  kNotByCommand = 2,  // scans lead there: coasting, lost, verifying; starting needs a pose (offer_start)
  kNotFromHere = 3,   // the table has no such way out of the present mode
  kNoPrediction = 4,  // nothing was tracked, so there is no place to look near
};
const char* to_string(ModeRefusal refusal);  // never null

// The event by which a mode is commanded; false where it cannot be.
bool command_event(TrackingMode mode, ModeEvent& event);

Span<const ModeTransition> mode_transitions();
Span<const ModeProperties> mode_properties();
Span<const ModeEventProperties> mode_events();

// The mode after `event`; `from` where the table has no row. Loop bound: the rows.
TrackingMode next_mode(TrackingMode from, ModeEvent event);
// Has the table a row for it?
bool has_transition(TrackingMode from, ModeEvent event);
const ModeProperties& properties(TrackingMode mode);
const char* to_string(TrackingMode mode);  // never null
const char* to_string(ModeEvent event);    // never null

}  // namespace lasso
