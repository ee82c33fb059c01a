// The enumerations of commands and telemetry: what the numbers mean. The numbers are those of the enumerators of the rooms that decide them
// (fsw/pose, fsw/mode, fsw/sense), which this room does not see: ut/exec/report_test.cpp compares the names. For the ground: see row.hpp.
#pragma once

#include "fsw/link/row.hpp"

namespace lasso {

// clang-format off
inline constexpr Choice kNoYes[] = {
  {"no", "no"},
  {"yes", "yes"},
};
inline constexpr Choice kPoseReasons[] = {
  {"valid", "the registration can be trusted"},
  {"no_scan", "the scan was lost or incomplete", "look at lost_scans and at the sensor"},
  {"too_few_returns", "too few rays came back", "look for the target (mode bearing); compare its range with what the sensor measures"},
  {"too_few_inliers", "too few returns lie on the model", "start anew from a better pose; check that the mission image is the target's"},
  {"low_inlier_share", "the pose explains too small a share of the returns", "look for background, an object in between, or a wrong start"},
  {"model_mismatch", "rays contradict the model at this pose: the target is not as modelled, or the pose is wrong", "check that the mission image is of the target as it is now; start anew from a better pose"},
  {"high_residual", "residuals are too large for their noise", "compare [sensor] of the mission with the sensor's real noise"},
  {"not_converged", "the iterations reached their limit", "none if it is rare; otherwise raise estimation.iterations_max"},
  {"singular", "the normal equations had no solution: the returns leave a direction open", "wait for another aspect, or widen the scan"},
  {"no_track", "there is nothing to start from", "send a pose to start from, or command a search"},
  {"overrun", "the estimate was not ready at its boundary, and was dropped whole", "look at overruns; a shorter scan or fewer iterations take less time"},
  {"implausible", "the filter's prediction excludes this pose: one of both is wrong", "none if it is rare; otherwise command reacquiring"},
  {"only_bearing", "a full-field scan: no attitude is looked for", "none: this is what mode bearing does"},
  {"far_from_start", "farther from the prediction that it was to confirm than 25 squared sigmas", "send a better pose to start from"},
  {"searching", "no attitude is known: it is looked for", "none: this is what mode searching does"},
  {"part_disagrees", "of a part that is elsewhere than the others say", "look at inconsistent_part: it may have moved, or have a wrong model"},
  {"too_fast", "the target is predicted to turn or move too far within the scan for its points to be brought to one time, or faster than 60 rad/s or 500 m/s", "start anew with the right rates; shorten scan.duration_s for a target that is so fast"},
  {"unchecked", "of a start: this scan would confirm it; a search of a scan that did is still to contradict it or not (start.check)", "none: wait for its end, some seconds"},
  {"contradicted", "of a start: a search of the scan that would confirm it found a pose that explains it better", "let the search find it, or start anew from a better pose"},
};
inline constexpr Choice kStopReasons[] = {
  {"converged", "the last step was below estimation.stop_translation_m and 0.01 deg, or within 1 sigma of the pose (2.9 after many passes)"},
  {"iteration_limit", "estimation.iterations_max was reached"},
  {"too_few_points", "too few returns lay on the model"},
  {"singular", "the normal equations had no solution"},
  {"not_run", "there was nothing to register"},
};
inline constexpr Choice kTrackingModes[] = {
  {"standby", "no scans, no poses"},
  {"starting", "a pose was given; a scan has to confirm it"},
  {"tracking", "the last scan gave a valid pose"},
  {"coasting", "the last scan gave none: the filter predicts"},
  {"lost", "no scans; every frame says so", "send a pose to start from, or command bearing, searching or reacquiring"},
  {"bearing", "full-field scans for direction and range"},
  {"reacquiring", "wide starts near the prediction"},
  {"searching", "the pose is looked for at any attitude"},
  {"short_range", "close by: parts of the target in turn"},
  {"safe", "no scans, the laser inhibited; left by command alone", "look at the faults in telemetry; then command standby"},
  {"verifying", "a scan confirmed the start, and is searched for a better pose"},
};
inline constexpr Choice kModeEvents[] = {
  {"start", "a pose to start from is given, or the next source's turn has come"},
  {"stop", "commanded to standby, or an image takes over that cannot go on with the track"},
  {"pose_valid", "a scan gave a valid pose"},
  {"pose_invalid", "a scan gave none, and the mode's frames are not used up"},
  {"exhausted", "the mode's frames are used up, and the mission asks for no recovery", "see mode lost; tracking.recover asks for recovery"},
  {"recover", "the mode's frames are used up, and the mission asks for recovery, or a start that no scan confirmed leaves a search to be tried"},
  {"seek", "commanded to look for the target in the whole field; or a start is refused, or a fault leaves no prediction"},
  {"reacquire", "commanded to look near the prediction, or the answer to a fault, or to an image that lost the track"},
  {"bearing_known", "a full-field scan gave a bearing"},
  {"bearing_unknown", "a full-field scan gave none"},
  {"search", "commanded to look for the pose at any attitude, or the turn of search as a source"},
  {"near", "a scan gave a valid pose, within short_range.enter_m, or commanded to look at parts"},
  {"far", "a scan gave a valid pose, beyond short_range.leave_m, or commanded to leave the parts"},
  {"make_safe", "commanded, or the answer to a fault", "look at the faults in telemetry"},
  {"fall_back", "a start that interrupted a track is given up: the track is looked for again", "see start_refused"},
  {"check", "a scan confirms a start that is to be checked (start.check)"},
  {"confirm_anew", "the check of a start ends without an answer: a scan has to confirm the start again"},
};
inline constexpr Choice kStartSources[] = {
  {"none", "no source"},
  {"handover", "handed over by a long-range system"},
  {"navigation", "from a navigation system's stream"},
  {"apriori", "known a priori, from the mission image"},
  {"uplink", "sent by the ground"},
  {"search", "recognised"},
};
inline constexpr Choice kStartRefusals[] = {
  {"none", "it was not refused"},
  {"not_begun", "the component has not begun", "begin, then send it again"},
  {"no_such_source", "the number names no source from which poses are offered", "see start_source"},
  {"not_finite", "a value is not a number", "correct it"},
  {"not_unit", "the quaternion is not of unit length", "normalise it"},
  {"bad_covariance", "not symmetric, or not of variances and correlations", "correct it"},
  {"from_future", "stated later than the frame in which it would start", "compare the clocks"},
  {"too_old", "stated longer ago than start.age_max_s; or before the clock jumped, or before another target's image became active", "send a fresh one"},
  {"too_fast", "its rates since then have no meaning, move the target too far within a scan, or are above 60 rad/s or 500 m/s", "send a fresh one, or correct its rates"},
  {"out_of_reach", "not in front of the sensor, or wholly outside the ranges that it measures", "compare frames and units with T_sensor_target in metres"},
  {"not_at_bearing", "not where the bearing sees the target", "compare it with the item bearing"},
  {"not_confirmed", "no scan confirmed it within start.frames", "send a better one, or command a search"},
  {"not_from_here", "the present mode takes no start: safe", "command standby first"},
  {"contradicted", "a search of the scan that would confirm it found a pose that explains it better (start.check)", "let the search find it, or send a better one"},
};
inline constexpr Choice kBearingReasons[] = {
  {"valid", "the bearing can be trusted"},
  {"no_scan", "no samples: the scan was lost", "look at lost_scans and at the sensor"},
  {"out_of_order", "samples, or the scan after its predecessor, go back in time", "look at the sensor's clock"},
  {"same_scan", "this scan has been looked at already"},
  {"nothing_seen", "no ray returned", "point the sensor at the target, or wait for it to come into its range"},
  {"not_finite", "no return can be believed; the first is not a number", "look at the sensor"},
  {"outside_field", "no return can be believed; the first is not from the field of view", "look at the sensor and its calibration"},
  {"outside_range", "no return can be believed; the first is nearer or farther than the sensor measures", "compare sensor.range_min_m and _max_m with the target's range"},
  {"too_few_returns", "fewer than bearing.returns_min, with or without background and strays", "wait for a nearer target, or lower bearing.returns_min"},
  {"one_direction", "all returns along one ray: the mirrors stand still", "look at the sensor"},
  {"only_background", "no group of the target's size stands alone", "point the sensor at the target"},
  {"jump", "far from where the scans before say that it is", "none: it starts anew after bearing.memory_s"},
};
inline constexpr Choice kSearchOutcomes[] = {
  {"none", "no search, or still at work"},
  {"accepted", "a pose is recognised, and offered as a start"},
  {"ambiguous", "more than one pose explains the scans", "choose among the candidates, and send the one that is right"},
  {"rejected", "no pose explains them", "see search_reason"},
};
inline constexpr Choice kSearchReasons[] = {
  {"not_done", "idle, or still at work"},
  {"distinct", "the best pose explains the scans, and no other does"},
  {"competitor", "another pose explains them nearly as well", "wait for another aspect, or choose among the candidates"},
  {"too_few_returns", "fewer returns than a search needs: 80, of all its scans", "wait for a nearer target; a mission with more scan.points sees more of it"},
  {"unexplained", "the best pose leaves too much unexplained", "check that the mission image is the target's; look for background"},
  {"not_registered", "the registration of the best pose failed", "wait for another aspect"},
  {"unfinished", "the search had done all its work before every other pose was excluded", "wait for another aspect, or send a pose to start from"},
};
inline constexpr Choice kSensorReasons[] = {
  {"in_band", "the target's range is within the sensor's band (use_from_m, use_to_m)"},
  {"range_unknown", "nobody knows the range: the sensors that work look in turn"},
  {"outside_bands", "the range is within nobody's band; this sensor measures it", "let the bands of the mission's sensors overlap"},
  {"substitute", "the sensor whose band it is has failed; this one measures the range", "look at the one that has failed (sensors_failed)"},
  {"out_of_range", "no sensor that works measures the range", "look at sensors_failed, or wait for the target to come into range"},
  {"all_failed", "all sensors lose their scans; the one in use goes on", "look at the sensors"},
  {"busy", "a search is at work on the sensor's scans: it stays"},
};
inline constexpr Choice kLossReasons[] = {
  {"none", "no scan was lost"},
  {"inhibited", "the sensor's light is inhibited", "permit it"},
  {"no_room", "the sensor takes no more commands: they do not leave", "look at the line"},
  {"silent", "the sensor does not answer, or has nothing to give", "look at its power and at the line"},
  {"busy", "an earlier scan ran", "none, unless it repeats: reset the sensor"},
  {"refused", "the plan is outside the sensor's limits", "compare the mission's field of view with the sensor's"},
  {"restarted", "the sensor started anew", "none, unless it repeats: look at its power"},
  {"foreign", "another sensor than the calibration's, of another protocol, or it has not said which", "load its calibration"},
  {"stopped", "the sensor ended the scan early", "look at its faults"},
  {"off_plan", "the sensor scanned something else", "look at its mirrors"},
  {"other", "the sensor gave another reason", "look at the sensor"},
  {"unfinished", "too few samples were there at the frame's end", "look at the line; compare its rate with the scan's duration"},
  {"thin", "complete, but too few samples were well formed", "look at damaged_frames and samples_lost: a noisy line"},
  {"stuck", "the rays went nearly one way: the mirrors stand still", "look at the mirrors; reset the sensor"},
  {"frozen", "its samples are those of the scan before, bit for bit, though other rays were planned", "reset the sensor"},
};
inline constexpr Choice kPacketFaults[] = {
  {"none", "it is accepted"},
  {"truncated", "fewer bytes than its headers need, or than its length field says", "look at the link"},
  {"bad_length", "more bytes than its length field says, or not as many as its items need", "compare the sender's dictionary with this one"},
  {"bad_crc", "the checksum does not match", "look at the link"},
  {"bad_version", "the packet version number is not 0", "look at the sender"},
  {"bad_type", "a command where telemetry is expected, or the reverse", "look at the routing"},
  {"no_secondary_header", "the flag of the secondary header is 0", "look at the sender"},
  {"other_apid", "for somebody else", "look at the routing"},
  {"segmented", "the sequence flags are not 3", "send each packet whole"},
  {"bad_pus_version", "the secondary header is not of PUS-C", "look at the sender"},
  {"unknown", "nothing has this service, subservice and number", "compare the sender's dictionary with this one"},
  {"bad_argument", "a value is outside of its item's range", "correct it"},
  {"repeated", "the sequence count is not after the one of the last accepted command", "count on, and send it again"},
  {"not_authentic", "its authentication trailer is missing, not right, or was used before", "send it with the key that the board has"},
};
inline constexpr Choice kModeRefusals[] = {
  {"none", "it was not refused"},
  {"not_begun", "the component has not begun", "begin, then send it again"},
  {"not_by_command", "scans lead there; starting needs a pose", "send a pose to start from"},
  {"not_from_here", "the present mode has no such way out", "command standby first; see the table of modes"},
  {"no_prediction", "nothing was tracked, so there is no place to look near", "send a pose to start from, or command a search"},
};
inline constexpr Choice kServiceRefusals[] = {
  {"none", "it was not refused"},
  {"no_such_event", "no event has this number", "compare the sender's dictionary with this one"},
  {"not_armed", "a hazardous command that the last arm did not name, or too long ago", "arm it, then send it again"},
  {"not_hazardous", "arm names no hazardous command", "see which commands are hazardous"},
  {"no_such_structure", "no structure has this number", "compare the sender's dictionary with this one"},
  {"no_such_parameter", "no parameter has this id", "compare the sender's dictionary with this one"},
  {"fixed_parameter", "it is the mission image's alone", "upload an image that has it"},
  {"out_of_limits", "the value is outside of the parameter's limits, or not whole", "see the parameter's limits"},
  {"inconsistent", "the value contradicts another parameter", "change the other one first (short_range.leave_m stays above enter_m)"},
  {"no_image_buffer", "the board has no second image buffer", "load the image at a start"},
  {"too_long", "longer than the image buffer, than a dump (128 bytes) or a check (16384 bytes) may be; or no image at all", "send less"},
  {"not_open", "no image is being loaded", "send begin_image"},
  {"outside", "it ends behind its area, or the area is empty", "correct offset and length"},
  {"not_whole", "a part that does not begin, or end, where a block of 128 bytes does", "send whole blocks"},
  {"incomplete", "parts of the image are missing", "send those that the packet image names"},
  {"image_busy", "the other image is being checked or converted, or may still be wanted back", "wait for the event image_ready, or image_confirmed"},
  {"image_not_ready", "the other buffer has no image that could be active", "load one, and send check_image"},
  {"other_image", "the image is not the one that is named", "compare the checksums"},
  {"does_not_fit", "its filter.period_s is not that of the active image", "load it at a start"},
  {"not_allowed", "the area is not written to", "load into other_image"},
  {"mode_safe", "the laser stays dark in mode safe", "command standby first"},
  {"no_store", "the board has no non-volatile store", ""},
  {"store_failed", "the store does not take it", "look at the board's store; try again"},
  {"nothing_stored", "the store has no such record that is right", "save it first; ask for an event that was reported"},
  {"other_table", "it was saved by software with other parameters", "set the parameters again, and save them"},
  {"no_calibration", "the active image has no such calibration", "name a sensor and a calibration of the mission; see its calibration lists"},
  {"no_such_key", "the board has no key of this number, or no keys; numbers grow, and are used up at 4294967295",
   "name the number after that of the key in use; where they are used up, start with a new master key"},
  {"key_on_trial", "another key is on trial", "confirm it, or wait until it is given up"},
  {"no_key_on_trial", "no key of this number is on trial", "send change_key"},
  {"not_by_new_key", "the command is not signed with the key that it confirms", "sign it with the new key"},
  {"not_kept", "the board cannot store that this key is in use: a restart would lose it", "look at the board's store; confirm it again before the trial ends"},
};
inline constexpr Choice kStructureNames[] = {
  {"none", "no structure"},
  {"pose", "the navigation output"},
  {"link", "counters of the link"},
  {"sensor", "counters of a sensor, a packet each"},
  {"health", "faults and what led to them"},
  {"image", "the two mission images, and the scrub of memory"},
  {"filter", "the covariance of the tracking filter; sent when it is asked for, or enabled"},
  {"named_pose", "pose, rates and covariances between frames that the mission names"},
};
inline constexpr Choice kMemoryAreas[] = {
  {"other_image", "the image that is not active: the one that is loaded"},
  {"active_image", "the active image as it lies in memory"},
  {"code", "the code of the component, where the board names it"},
};
inline constexpr Choice kImageStates[] = {
  {"empty", "there is none"},
  {"loading", "parts are awaited"},
  {"checking", "it has come, and is being checked"},
  {"refused", "it is wrong, or has decayed"},
  {"storing", "it is right, and is being written to the store"},
  {"converting", "its numbers become those of the processor"},
  {"sealing", "checksums are taken of it as it lies in memory"},
  {"ready", "it can be made active"},
};
inline constexpr Choice kScrubbedAreas[] = {
  {"image_0", "the image in buffer 0"},
  {"views_0", "what was made of it: its parameters, and where its tables are"},
  {"image_1", "the image in buffer 1"},
  {"views_1", "what was made of it"},
  {"code", "the code of the component"},
};
inline constexpr Choice kStatuses[] = {
  {"ok", "nothing"},
  {"truncated", "fewer bytes than the format needs"},
  {"bad_magic", "not this format at all"},
  {"bad_version", "this format, another version"},
  {"bad_length", "a length contradicts the data"},
  {"bad_crc", "a checksum does not match"},
  {"bad_index", "an index points outside its table"},
  {"bad_value", "a value is outside its range, or does not fit this board"},
  {"not_finite", "a value is not a number"},
  {"over_capacity", "more than the component has room for"},
  {"missing", "a required part is not there"},
  {"bad_order", "out of order"},
  {"busy", "an earlier request still runs"},
  {"timeout", "no answer in time"},
  {"no_data", "nothing to work on"},
  {"singular", "a division has no meaning"},
  {"off_plan", "a device does something else than it was told"},
  {"not_signed", "it has no signature, and the board takes signed images alone", "sign it: mdat mission sign"},
  {"not_authentic", "its signature is not right: another key, or other bytes than those that were signed", "sign it with the key that the board has; load it again"},
};
inline constexpr Choice kPatterns[] = {
  {"rosette", "two circles of coprime frequencies"},
  {"lissajous", "a Lissajous figure"},
  {"raster", "lines"},
};

inline constexpr Enumeration kYesNo{"yes_no", Span<const Choice>(kNoYes)};
inline constexpr Enumeration kPoseReason{"pose_reason", Span<const Choice>(kPoseReasons)};
inline constexpr Enumeration kStopReason{"stop_reason", Span<const Choice>(kStopReasons)};
inline constexpr Enumeration kTrackingMode{"mode", Span<const Choice>(kTrackingModes)};
inline constexpr Enumeration kModeEvent{"mode_event", Span<const Choice>(kModeEvents)};
inline constexpr Enumeration kStartSource{"start_source", Span<const Choice>(kStartSources)};
inline constexpr Enumeration kStartRefusal{"start_refusal", Span<const Choice>(kStartRefusals)};
inline constexpr Enumeration kBearingReason{"bearing_reason", Span<const Choice>(kBearingReasons)};
inline constexpr Enumeration kSearchOutcome{"search_outcome", Span<const Choice>(kSearchOutcomes)};
inline constexpr Enumeration kSearchReason{"search_reason", Span<const Choice>(kSearchReasons)};
inline constexpr Enumeration kSensorReason{"sensor_reason", Span<const Choice>(kSensorReasons)};
inline constexpr Enumeration kScanLoss{"scan_loss", Span<const Choice>(kLossReasons)};
inline constexpr Enumeration kPacketFault{"packet_fault", Span<const Choice>(kPacketFaults)};
inline constexpr Enumeration kModeRefusal{"mode_refusal", Span<const Choice>(kModeRefusals)};
inline constexpr Enumeration kServiceRefusal{"service_refusal", Span<const Choice>(kServiceRefusals)};
inline constexpr Enumeration kStructure{"structure", Span<const Choice>(kStructureNames)};
inline constexpr Enumeration kMemoryArea{"memory_area", Span<const Choice>(kMemoryAreas)};
inline constexpr Enumeration kImageState{"image_state", Span<const Choice>(kImageStates)};
inline constexpr Enumeration kScrubArea{"scrub_area", Span<const Choice>(kScrubbedAreas)};
inline constexpr Enumeration kStatus{"status", Span<const Choice>(kStatuses)};
inline constexpr Enumeration kPattern{"pattern", Span<const Choice>(kPatterns)};
// clang-format on

}  // namespace lasso
