// The rows of the pose packet, in the order of the wire. For the ground: see row.hpp.
#pragma once

#include "fsw/link/choices.hpp"
#include "fsw/link/pose_telemetry.hpp"
#include "fsw/link/row.hpp"

namespace lasso {
namespace pose_rows {

using P = PoseTelemetry;

// clang-format off
inline constexpr TypedRow<P> kRows[] = {
  make_row<&P::scan_id>(1, "scan_id", "1", kAny, "number of the scan: frames since the start of the component"),
  make_row<&P::t_measurement_us>(2, "t_measurement_us", "us", kAny, "middle between first and last sample, at which the poses are stated"),
  make_row<&P::t_publication_us>(3, "t_publication_us", "us", kAny, "when this packet was made"),
  make_row<&P::age_us>(4, "age_us", "us", kAtLeastZero, "publication minus measurement"),
  make_row<&P::valid>(5, "valid", kYesNo, "the registration can be trusted"),
  make_row<&P::reason>(6, "reason", kPoseReason, "why the registration can be trusted or not"),
  make_row<&P::stop>(7, "stop", kStopReason, "why the iterations ended"),
  make_row<&P::mode>(8, "mode", kTrackingMode, "tracking mode after this scan"),
  make_row<&P::q_sensor_target>(9, "q_sensor_target", "1", kUnitVector, "registration: Hamilton quaternion x, y, z, w, target to sensor"),
  make_row<&P::p_sensor_target_m>(10, "p_sensor_target_m", "m", kAny, "registration: target's origin in the sensor frame"),
  make_row<&P::covariance>(11, "covariance", "rad,m", kAny, "upper triangle by rows: rotation about target origin, translation; sensor axes"),
  make_row<&P::filter_q_sensor_target>(12, "filter_q_sensor_target", "1", kUnitVector, "filtered attitude, as q_sensor_target"),
  make_row<&P::filter_p_sensor_target_m>(13, "filter_p_sensor_target_m", "m", kAny, "filtered position"),
  make_row<&P::filter_omega_radps>(14, "filter_omega_radps", "rad/s", kAny, "filtered angular rate, sensor axes"),
  make_row<&P::filter_v_mps>(15, "filter_v_mps", "m/s", kAny, "filtered velocity of the target's origin, sensor axes"),
  make_row<&P::filter_sigma_pose>(16, "filter_sigma_pose", "rad,m", kAtLeastZero, "filter's sigmas: rotation, translation"),
  make_row<&P::filter_sigma_rates>(17, "filter_sigma_rates", "rad/s,m/s", kAtLeastZero, "filter's sigmas: angular rate, velocity"),
  make_row<&P::rays>(18, "rays", "1", kAny, "rays that say something: hits and misses"),
  make_row<&P::returns>(19, "returns", "1", kAny, "rays that hit"),
  make_row<&P::inliers>(20, "inliers", "1", kAny, "returns with weight in the last iteration"),
  make_row<&P::labels>(21, "labels", "1", kAny, "silhouette measurements used"),
  make_row<&P::iterations>(22, "iterations", "1", kAny, "iterations of the registration"),
  make_row<&P::weak>(23, "weak", "1", Range{0, 6}, "directions (of 6) that are less certain than the mission asks"),
  make_row<&P::rms_m>(24, "rms_m", "m", kAtLeastZero, "unweighted range residual of the inliers"),
  make_row<&P::normalized_residual>(25, "normalized_residual", "1", kAtLeastZero, "root of chi squared per degree of freedom"),
  make_row<&P::inlier_share>(26, "inlier_share", "1", kShare, "share of the returns that the pose explains"),
  make_row<&P::agreement>(27, "agreement", "1", kShare, "1 less the share of rays that contradict the pose, but for two"),
  make_row<&P::weakest_sigma_m>(28, "weakest_sigma_m", "m", kAtLeastZero, "largest sigma of any direction, rotation times model radius"),
  make_row<&P::weakest_direction>(29, "weakest_direction", "1", kAny, "that direction: rotation times radius, translation; sensor axes"),
  make_row<&P::plan_center>(30, "plan_center", "1", kAny, "middle of the scan on the tangent plane z = 1"),
  make_row<&P::plan_half_extents>(31, "plan_half_extents", "1", kAtLeastZero, "half extents of the scan on the tangent plane"),
  make_row<&P::plan_phase_turns>(32, "plan_phase_turns", "1", kShare, "phase of the pattern"),
  make_row<&P::plan_points>(33, "plan_points", "1", kAny, "rays of the scan"),
  make_row<&P::plan_duration_us>(34, "plan_duration_us", "us", kAny, "first to last sample of the scan"),
  make_row<&P::plan_pattern>(35, "plan_pattern", kPattern, "pattern of the scan"),
  make_row<&P::image_crc>(36, "image_crc", "1", kAny, "CRC-32C of the mission image"),
  make_row<&P::software_version>(37, "software_version", "1", kAny, "major (8 bits), minor (8), patch (16)"),
  make_row<&P::software_build>(38, "software_build", "1", kAny, "identifier given by the build, 0: development"),
  make_row<&P::frames>(39, "frames", "1", kAny, "boundaries passed since the start of the component"),
  make_row<&P::invalid_frames>(40, "invalid_frames", "1", kAny, "frames reported without a valid pose"),
  make_row<&P::lost_scans>(41, "lost_scans", "1", kAny, "scans not started, incomplete or failed"),
  make_row<&P::overruns>(42, "overruns", "1", kAny, "frames dropped because an estimate was late"),
  make_row<&P::slot_slips>(43, "slot_slips", "1", kAny, "slots that began later than their own length"),
  make_row<&P::dropped_packets>(44, "dropped_packets", "1", kAny, "packets that did not fit into the queue"),
  make_row<&P::held>(45, "held", kYesNo, "no mode ends because its frames are used up"),
  make_row<&P::changes>(46, "changes", "1", Range{0, kPoseChanges}, "changes of the mode since the packet before, which follow"),
  make_row<&P::change_from>(47, "change_from", kTrackingMode, "mode before"),
  make_row<&P::change_event>(48, "change_event", kModeEvent, "why it changed"),
  make_row<&P::change_to>(49, "change_to", kTrackingMode, "mode after"),
  make_row<&P::start_source>(50, "start_source", kStartSource, "source of the present track's start"),
  make_row<&P::refused_source>(51, "refused_source", kStartSource, "source of the last pose to start from that was refused"),
  make_row<&P::refusal>(52, "refusal", kStartRefusal, "why it was refused"),
  make_row<&P::refused_starts>(53, "refused_starts", "1", kAny, "poses to start from that were refused"),
  make_row<&P::refused_commands>(54, "refused_commands", "1", kAny, "commanded modes that were refused"),
  make_row<&P::bearing_reason>(55, "bearing_reason", kBearingReason, "why the bearing can be trusted or not; no_scan unless in mode bearing or searching"),
  make_row<&P::bearing_returns>(56, "bearing_returns", "1", kAny, "rays of the full-field scan that hit"),
  make_row<&P::bearing_used>(57, "bearing_used", "1", kAny, "of these, the target's"),
  make_row<&P::bearing_scans>(58, "bearing_scans", "1", kAny, "scans that the bearing rests on"),
  make_row<&P::t_bearing_us>(59, "t_bearing_us", "us", kAny, "time at which the bearing is stated"),
  make_row<&P::bearing>(60, "bearing", "rad,m", kAny, "azimuth (right), elevation (up), range of the centroid; their rates per second"),
  make_row<&P::bearing_sigma>(61, "bearing_sigma", "rad,m", kAtLeastZero, "their sigmas"),
  make_row<&P::search_outcome>(62, "search_outcome", kSearchOutcome, "what the search says of the scans that it has joined; none unless in mode searching, or where a check of a start ends"),
  make_row<&P::search_reason>(63, "search_reason", kSearchReason, "why"),
  make_row<&P::search_scans>(64, "search_scans", "1", kAny, "scans that the search has joined"),
  make_row<&P::search_candidates>(65, "search_candidates", "1", Range{0, kTelemetryCandidates}, "poses that explain them, best first, which follow (at most 4)"),
  make_row<&P::search_ratio>(66, "search_ratio", "1", kAtLeastZero, "score of the best competitor over that of the best pose; 0: no competitor"),
  make_row<&P::search_disagreement>(67, "search_disagreement", "1", kShare, "share of what was looked at that the best pose does not explain"),
  make_row<&P::search_work>(68, "search_work", "1", kAny, "work of the search so far, some 75 instructions of a 603e each"),
  make_row<&P::t_search_us>(69, "t_search_us", "us", kAny, "time at which the candidates are stated"),
  make_row<&P::candidate_q_sensor_target>(70, "candidate_q_sensor_target", "1", kUnitVector, "candidates: quaternions x, y, z, w, one after the other"),
  make_row<&P::candidate_p_sensor_target_m>(71, "candidate_p_sensor_target_m", "m", kAny, "candidates: target's origin in the sensor frame"),
  make_row<&P::part>(72, "part", "1", kAny, "part of the target that the scan looked at, 0: the whole"),
  make_row<&P::parts_resting>(73, "parts_resting", "1", kAny, "bit i: part i + 1 is left out for some scans"),
  make_row<&P::inconsistent_part>(74, "inconsistent_part", "1", kAny, "part that this scan showed to disagree with the others, 0: none"),
  make_row<&P::inconsistency_sigmas>(75, "inconsistency_sigmas", "1", kAtLeastZero, "how far it is from the one it is farthest from"),
  make_row<&P::inconsistent_parts>(76, "inconsistent_parts", "1", kAny, "such disagreements so far"),
  make_row<&P::sensor>(77, "sensor", "1", kAny, "sensor that took the scan, 0: the mission's [sensor], then the further ones"),
  make_row<&P::sensor_reason>(78, "sensor_reason", kSensorReason, "why it was chosen"),
  make_row<&P::sensors_failed>(79, "sensors_failed", "1", kAny, "bit i: sensor i loses its scans, and is left out for some frames"),
  make_row<&P::sensor_changes>(80, "sensor_changes", "1", kAny, "changes of the sensor so far"),
};
// clang-format on

}  // namespace pose_rows
}  // namespace lasso
