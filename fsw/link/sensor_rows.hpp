// The rows of the packet `sensor`, in the order of the wire. For the ground: see row.hpp.
#pragma once

#include "fsw/link/choices.hpp"
#include "fsw/link/row.hpp"
#include "fsw/link/sensor_telemetry.hpp"

namespace lasso::sensor_report_rows {

using S = SensorTelemetry;

// clang-format off
inline constexpr TypedRow<S> kRows[] = {
  make_row<&S::sensor>(1, "sensor", "1", kAny, "sensor of which this is said, 0: the mission's [sensor], then the further ones"),
  make_row<&S::scans>(2, "scans", "1", kAny, "scans that it was asked for"),
  make_row<&S::lost>(3, "lost", "1", kAny, "of them, those that cannot be estimated from: the sum of the items lost_*"),
  make_row<&S::last_loss>(4, "last_loss", kScanLoss, "why the last of these was lost"),
  make_row<&S::lost_inhibited>(5, "lost_inhibited", "1", kAny, "scans lost because the sensor's light is inhibited"),
  make_row<&S::lost_no_room>(6, "lost_no_room", "1", kAny, "scans lost because the sensor takes no more commands"),
  make_row<&S::lost_silent>(7, "lost_silent", "1", kAny, "scans lost because the sensor does not answer"),
  make_row<&S::lost_busy>(8, "lost_busy", "1", kAny, "scans lost because an earlier one ran"),
  make_row<&S::lost_refused>(9, "lost_refused", "1", kAny, "scans lost because the plan was refused"),
  make_row<&S::lost_restarted>(10, "lost_restarted", "1", kAny, "scans lost because the sensor started anew"),
  make_row<&S::lost_foreign>(11, "lost_foreign", "1", kAny, "scans lost because the sensor is not the one that the calibration is for"),
  make_row<&S::lost_stopped>(12, "lost_stopped", "1", kAny, "scans lost because the sensor ended them early"),
  make_row<&S::lost_off_plan>(13, "lost_off_plan", "1", kAny, "scans lost because the sensor scanned something else"),
  make_row<&S::lost_other>(14, "lost_other", "1", kAny, "scans lost for another reason that the sensor gave"),
  make_row<&S::lost_unfinished>(15, "lost_unfinished", "1", kAny, "scans lost because too few samples were there at the frame's end"),
  make_row<&S::lost_thin>(16, "lost_thin", "1", kAny, "complete scans lost because too few samples were well formed"),
  make_row<&S::lost_stuck>(17, "lost_stuck", "1", kAny, "scans lost because the rays went nearly one way"),
  make_row<&S::frames>(18, "frames", "1", kAny, "frames of the line that came whole and right"),
  make_row<&S::damaged_frames>(19, "damaged_frames", "1", kAny, "frames of wrong length or checksum, and what resembles their beginning"),
  make_row<&S::missing_frames>(20, "missing_frames", "1", kAny, "gaps in the sequence of the frames"),
  make_row<&S::repeated_frames>(21, "repeated_frames", "1", kAny, "frames that came again"),
  make_row<&S::unknown_frames>(22, "unknown_frames", "1", kAny, "frames that are right, and say nothing that is defined"),
  make_row<&S::strayed>(23, "strayed", "1", kAny, "samples and answers that belong to no scan under way"),
  make_row<&S::samples_lost>(24, "samples_lost", "1", kAny, "samples that no frame brought"),
  make_row<&S::samples_refused>(25, "samples_refused", "1", kAny, "samples that make no statement: out of range, far outside the calibrated volume, saturated, not aimed"),
  make_row<&S::bad_times>(26, "bad_times", "1", kAny, "samples before their predecessor, or far from their planned time"),
  make_row<&S::off_plan>(27, "off_plan", "1", kAny, "frames whose rays are not those of the plan"),
  make_row<&S::clock_jumps>(28, "clock_jumps", "1", kAny, "jumps of the sensor's clock between scans"),
  make_row<&S::restarts>(29, "restarts", "1", kAny, "times that the sensor started anew"),
  make_row<&S::samples_outside>(30, "samples_outside", "1", kAny, "points from beside the calibrated volume or temperatures, which count for less"),
  make_row<&S::calibration>(31, "calibration", "1", kAny, "of those that the active image has for it, the one that its last scan went by, from 0; 255: none of them"),
  make_row<&S::lost_frozen>(32, "lost_frozen", "1", kAny, "scans lost because their samples were those of the scan before, which was planned otherwise"),
};
// clang-format on

}  // namespace lasso::sensor_report_rows
