// The modes of tracking as a table, executed as written: which mode, on which event, leads where. Later modes are more rows.
#pragma once

#include <cstdint>

#include "fsw/core/span.hpp"

namespace lasso {

enum class TrackingMode : std::uint8_t {
  kStandby = 0,   // no scans, no poses
  kStarting = 1,  // an initial pose was given, no scan has confirmed it yet
  kTracking = 2,  // the last scan gave a valid pose
  kCoasting = 3,  // the last scan gave none: the filter predicts
  kLost = 4,      // too long without a valid pose: no scans, every frame says so
};

enum class ModeEvent : std::uint8_t {
  kStart = 0,        // a pose to start from is given
  kStop = 1,         // commanded to standby
  kPoseValid = 2,    // a scan gave a valid pose
  kPoseInvalid = 3,  // a scan gave none, and coasting goes on
  kExhausted = 4,    // a scan gave none, and tracking.coast_frames are used up
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
  bool scans;       // a scan is planned and started in each frame; each scan is reported
  bool says_lost;   // frames without a scan are reported too
  bool wide_start;  // registration starts wide (where estimation.wide_start is set)
  const char* name;
};

Span<const ModeTransition> mode_transitions();
Span<const ModeProperties> mode_properties();

// The mode after `event`; `from` where the table has no row. Loop bound: the rows.
TrackingMode next_mode(TrackingMode from, ModeEvent event);
const ModeProperties& properties(TrackingMode mode);
const char* to_string(TrackingMode mode);  // never null

}  // namespace lasso
