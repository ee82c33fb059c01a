// Faults, reactions and causes of a reset, by their numbers in fsw/exec/faults.hpp and watchdog.hpp, which this room does not see:
// ut/exec/report_test.cpp compares the counts. For the ground: see row.hpp.
#pragma once

#include "fsw/link/row.hpp"

namespace lasso {

// clang-format off
inline constexpr Choice kFaultTexts[] = {
  {"sensor_silent", "no sample of a scan came, and no reason why", "look at the sensor's power and line"},
  {"sensor_late", "the sensor was still busy, or its scan did not end in time", "compare scan.duration_s with what the sensor needs"},
  {"sensor_corrupt", "what the sensor sent cannot be, is the scan before once more, or more than a twentieth of its samples were damaged", "look at the line, and at last_loss of the packet sensor"},
  {"sensor_stuck", "the rays fill less than a quarter of the plan's extents on an axis; the scan is not used", "look at the mirrors; reset the sensor"},
  {"sensor_saturated", "the sensor says of more than half of its samples that they mean nothing", "look for the sun or a mirror-like face in the field"},
  {"scan_incomplete", "samples came, too few for an estimate", "look at the sensor and its line"},
  {"estimate_overrun", "the estimate was not ready at its boundary, and was dropped whole", "a shorter scan or fewer iterations take less time"},
  {"slot_slip", "a slot began later than its own length", "look at the processor's load"},
  {"time_jump", "the clock is more than ten seconds away from the next slot's time; the slots go on from there", "look at who sets the clock"},
  {"implausible_pose", "the filter excludes a pose that explains its scan: a wrong minimum; it joins nothing", "none if it is rare"},
  {"filter_divergence", "the filter excludes what scan after scan says, or has numbers that are none", "none: the track starts anew near the prediction"},
  {"mode_corrupt", "a copy of the mode differed from two others, or from the step that led to it; repaired", "none if it is rare: a flipped bit"},
  {"mode_lost", "no two copies of the mode agreed", "command standby, then start again"},
  {"image_corrupt", "the mission image in memory differed from its checksum, or which one is active from its copies; repaired", "none if it is rare: a flipped bit"},
  {"image_lost", "the mission image in memory is corrupt and cannot be repaired", "load it again"},
  {"parameters_corrupt", "a copy of the parameters differed from its checksum; repaired from the other one", "none if it is rare: a flipped bit"},
  {"parameters_lost", "both copies of the parameters are corrupt; the mission image's hold", "set them again"},
  {"code_corrupt", "the code in memory differs from its checksum", "load the code anew from where the board boots; a reset alone takes its sums anew, and hides it"},
  {"link_silent", "no valid command came for longer than link.silence_max_s", "look at the link"},
  {"memory_high", "more than nine tenths of the telemetry queue were full at a boundary", "look at the link; raise its rate or ask for less"},
  {"watchdog_reset", "the component starts after its watchdog", "look at the events before the reset; then command standby"},
  {"self_test_failed", "a self-test at the start failed", "see failed_tests; do not trust its poses"},
  {"laser_corrupt", "a copy of the laser's permission differed from two others, and is repaired; where all differ the laser is inhibited", "none if it is rare: a flipped bit"},
};
inline constexpr Choice kFaultReactions[] = {
  {"report", "it is reported; what belongs to it was done where it was seen"},
  {"reacquire", "the prediction has lost its meaning: the target is looked for near it"},
  {"make_safe", "mode safe", "look at the faults in telemetry; then command standby"},
};
inline constexpr Choice kResetCauses[] = {
  {"power_on", "it was switched on"},
  {"commanded", "it was told to"},
  {"watchdog", "it did not feed its watchdog in time"},
  {"invariant", "it found a bug in itself"},
  {"exception", "the processor met an instruction or an address that it could not"},
};

inline constexpr Enumeration kFault{"fault", Span<const Choice>(kFaultTexts)};
inline constexpr Enumeration kFaultReaction{"fault_reaction", Span<const Choice>(kFaultReactions)};
inline constexpr Enumeration kResetCause{"reset_cause", Span<const Choice>(kResetCauses)};
// clang-format on

}  // namespace lasso
