#include "fsw/link/pose_telemetry.hpp"

namespace lasso {
namespace {

using P = PoseTelemetry;
constexpr char kYesNo[] = "0=no|1=yes";
constexpr char kReasons[] =
    "0=valid|1=no_scan|2=too_few_returns|3=too_few_inliers|4=low_inlier_share|5=low_agreement|6=high_residual|7=not_converged|"
    "8=singular|9=no_track|10=overrun|11=implausible|12=only_bearing|13=far_from_start|14=searching|15=part_disagrees";
constexpr char kStops[] = "0=converged|1=iteration_limit|2=too_few_points|3=singular|4=not_run";
constexpr char kModes[] = "0=standby|1=starting|2=tracking|3=coasting|4=lost|5=bearing|6=reacquiring|7=searching|8=short_range";
constexpr char kEvents[] =
    "0=start|1=stop|2=pose_valid|3=pose_invalid|4=exhausted|5=recover|6=seek|7=reacquire|8=bearing_known|9=bearing_unknown|10=search|"
    "11=near|12=far";
constexpr char kWays[] = "0=none|1=handover|2=navigation|3=apriori|4=uplink|5=search";
constexpr char kRefusals[] =
    "0=none|1=not_begun|2=no_such_way|3=not_finite|4=not_unit|5=bad_covariance|6=from_future|7=too_old|8=too_fast|9=out_of_reach|"
    "10=not_at_bearing|11=not_confirmed";
constexpr char kBearingReasons[] =
    "0=valid|1=no_scan|2=out_of_order|3=same_scan|4=nothing_seen|5=not_finite|6=outside_field|7=outside_range|8=too_few_returns|"
    "9=one_direction|10=only_background|11=jump";
constexpr char kSearchOutcomes[] = "0=none|1=accepted|2=ambiguous|3=rejected";
constexpr char kSearchReasons[] = "0=not_done|1=distinct|2=competitor|3=too_few_returns|4=unexplained|5=not_registered";
constexpr char kPatterns[] = "0=rosette|1=lissajous|2=raster";

// clang-format off
constexpr TelemetryRow<P> kRows[] = {
  make_row<&P::scan_id>(1, "scan_id", "1", "", "number of the scan: frames since the start of the component"),
  make_row<&P::t_measurement_us>(2, "t_measurement_us", "us", "", "middle between first and last sample, at which the poses are stated"),
  make_row<&P::t_publication_us>(3, "t_publication_us", "us", "", "when this packet was made"),
  make_row<&P::age_us>(4, "age_us", "us", "", "publication minus measurement"),
  make_row<&P::valid>(5, "valid", "1", kYesNo, "the registration can be trusted"),
  make_row<&P::reason>(6, "reason", "1", kReasons, "why the registration can be trusted or not"),
  make_row<&P::stop>(7, "stop", "1", kStops, "why the iterations ended"),
  make_row<&P::mode>(8, "mode", "1", kModes, "tracking mode after this scan"),
  make_row<&P::q_sensor_target>(9, "q_sensor_target", "1", "", "registration: Hamilton quaternion x, y, z, w, target to sensor"),
  make_row<&P::p_sensor_target_m>(10, "p_sensor_target_m", "m", "", "registration: target's origin in the sensor frame"),
  make_row<&P::covariance>(11, "covariance", "rad,m", "", "upper triangle by rows: rotation about target origin, translation; sensor axes"),
  make_row<&P::filter_q_sensor_target>(12, "filter_q_sensor_target", "1", "", "filtered attitude, as q_sensor_target"),
  make_row<&P::filter_p_sensor_target_m>(13, "filter_p_sensor_target_m", "m", "", "filtered position"),
  make_row<&P::filter_omega_radps>(14, "filter_omega_radps", "rad/s", "", "filtered angular rate, sensor axes"),
  make_row<&P::filter_v_mps>(15, "filter_v_mps", "m/s", "", "filtered velocity of the target's origin, sensor axes"),
  make_row<&P::filter_sigma_pose>(16, "filter_sigma_pose", "rad,m", "", "filter's sigmas: rotation, translation"),
  make_row<&P::filter_sigma_rates>(17, "filter_sigma_rates", "rad/s,m/s", "", "filter's sigmas: angular rate, velocity"),
  make_row<&P::rays>(18, "rays", "1", "", "rays that say something: hits and misses"),
  make_row<&P::returns>(19, "returns", "1", "", "rays that hit"),
  make_row<&P::inliers>(20, "inliers", "1", "", "returns with weight in the last iteration"),
  make_row<&P::labels>(21, "labels", "1", "", "silhouette measurements used"),
  make_row<&P::iterations>(22, "iterations", "1", "", "iterations of the registration"),
  make_row<&P::weak>(23, "weak", "1", "", "directions (of 6) that are less certain than the mission asks"),
  make_row<&P::rms_m>(24, "rms_m", "m", "", "unweighted range residual of the inliers"),
  make_row<&P::normalized_residual>(25, "normalized_residual", "1", "", "root of chi squared per degree of freedom"),
  make_row<&P::inlier_share>(26, "inlier_share", "1", "", "share of the returns that the pose explains"),
  make_row<&P::agreement>(27, "agreement", "1", "", "share of rays whose hit or miss is as predicted"),
  make_row<&P::weakest_sigma_m>(28, "weakest_sigma_m", "m", "", "largest sigma of any direction, rotation times model radius"),
  make_row<&P::weakest_direction>(29, "weakest_direction", "1", "", "that direction: rotation times radius, translation; sensor axes"),
  make_row<&P::plan_center>(30, "plan_center", "1", "", "middle of the scan on the tangent plane z = 1"),
  make_row<&P::plan_half_extents>(31, "plan_half_extents", "1", "", "half extents of the scan on the tangent plane"),
  make_row<&P::plan_phase_turns>(32, "plan_phase_turns", "1", "", "phase of the pattern"),
  make_row<&P::plan_points>(33, "plan_points", "1", "", "rays of the scan"),
  make_row<&P::plan_duration_us>(34, "plan_duration_us", "us", "", "first to last sample of the scan"),
  make_row<&P::plan_pattern>(35, "plan_pattern", "1", kPatterns, "pattern of the scan"),
  make_row<&P::image_crc>(36, "image_crc", "1", "", "CRC-32C of the mission image"),
  make_row<&P::software_version>(37, "software_version", "1", "", "major (8 bits), minor (8), patch (16)"),
  make_row<&P::software_build>(38, "software_build", "1", "", "identifier given by the build, 0: development"),
  make_row<&P::frames>(39, "frames", "1", "", "boundaries passed since the start of the component"),
  make_row<&P::invalid_frames>(40, "invalid_frames", "1", "", "frames reported without a valid pose"),
  make_row<&P::lost_scans>(41, "lost_scans", "1", "", "scans not started, incomplete or failed"),
  make_row<&P::overruns>(42, "overruns", "1", "", "frames dropped because an estimate was late"),
  make_row<&P::slot_slips>(43, "slot_slips", "1", "", "slots that began later than their own length"),
  make_row<&P::dropped_packets>(44, "dropped_packets", "1", "", "packets that did not fit into the queue"),
  make_row<&P::held>(45, "held", "1", kYesNo, "no mode ends because its frames are used up"),
  make_row<&P::changes>(46, "changes", "1", "", "changes of the mode since the packet before, which follow"),
  make_row<&P::change_from>(47, "change_from", "1", kModes, "mode before"),
  make_row<&P::change_event>(48, "change_event", "1", kEvents, "why it changed"),
  make_row<&P::change_to>(49, "change_to", "1", kModes, "mode after"),
  make_row<&P::start_way>(50, "start_way", "1", kWays, "way by which the present track was started"),
  make_row<&P::refused_way>(51, "refused_way", "1", kWays, "way of the last pose to start from that was refused"),
  make_row<&P::refusal>(52, "refusal", "1", kRefusals, "why it was refused"),
  make_row<&P::refused_starts>(53, "refused_starts", "1", "", "poses to start from that were refused"),
  make_row<&P::refused_commands>(54, "refused_commands", "1", "", "commanded modes that were refused"),
  make_row<&P::bearing_reason>(55, "bearing_reason", "1", kBearingReasons, "why the bearing can be trusted or not; no_scan unless in mode bearing or searching"),
  make_row<&P::bearing_returns>(56, "bearing_returns", "1", "", "rays of the full-field scan that hit"),
  make_row<&P::bearing_used>(57, "bearing_used", "1", "", "of these, the target's"),
  make_row<&P::bearing_scans>(58, "bearing_scans", "1", "", "scans that the bearing rests on"),
  make_row<&P::t_bearing_us>(59, "t_bearing_us", "us", "", "time at which the bearing is stated"),
  make_row<&P::bearing>(60, "bearing", "rad,m", "", "azimuth (right), elevation (up), range of the centroid; their rates per second"),
  make_row<&P::bearing_sigma>(61, "bearing_sigma", "rad,m", "", "their sigmas"),
  make_row<&P::search_outcome>(62, "search_outcome", "1", kSearchOutcomes, "what the search says of the scans that it has joined; none unless in mode searching"),
  make_row<&P::search_reason>(63, "search_reason", "1", kSearchReasons, "why"),
  make_row<&P::search_scans>(64, "search_scans", "1", "", "scans that the search has joined"),
  make_row<&P::search_candidates>(65, "search_candidates", "1", "", "poses that explain them, best first, which follow (at most 4)"),
  make_row<&P::search_ratio>(66, "search_ratio", "1", "", "score of the best competitor over that of the best pose; 0: no competitor"),
  make_row<&P::search_disagreement>(67, "search_disagreement", "1", "", "share of what was looked at that the best pose does not explain"),
  make_row<&P::search_work>(68, "search_work", "1", "", "look-ups of the search so far"),
  make_row<&P::t_search_us>(69, "t_search_us", "us", "", "time at which the candidates are stated"),
  make_row<&P::candidate_q>(70, "candidate_q", "1", "", "candidates: quaternions x, y, z, w, one after the other"),
  make_row<&P::candidate_p_m>(71, "candidate_p_m", "m", "", "candidates: target's origin in the sensor frame"),
  make_row<&P::part>(72, "part", "1", "", "part of the target that the scan looked at, 0: the whole"),
  make_row<&P::parts_resting>(73, "parts_resting", "1", "", "bit i: part i + 1 is left out for some scans"),
  make_row<&P::odd_part>(74, "odd_part", "1", "", "part that this scan showed to disagree with the others, 0: none"),
  make_row<&P::odd_sigmas>(75, "odd_sigmas", "1", "", "how far it is from the one it is farthest from"),
  make_row<&P::odd_parts>(76, "odd_parts", "1", "", "such disagreements so far"),
};
// clang-format on

constexpr std::size_t kStructureIdBytes = 2;

bool is_pose_report(const PacketHeader& header) {
  return header.service == kServiceHousekeeping && header.subservice == kSubserviceHousekeepingReport;
}

}  // namespace

Span<const TelemetryRow<PoseTelemetry>> pose_rows() { return Span<const TelemetryRow<P>>(kRows); }

std::size_t encode_pose(const PoseTelemetry& pose, PacketHeader header, Bytes out) {
  header.service = kServiceHousekeeping;
  header.subservice = kSubserviceHousekeepingReport;
  ByteWriter writer(out);
  begin_packet(header, writer);
  writer.u16(kPoseStructureId);
  for (const TelemetryRow<P>& row : kRows) row.write(pose, writer);
  return finish_packet(writer, out);
}

PacketFault decode_pose(ConstBytes packet, PacketHeader& header, PoseTelemetry& pose) {
  PacketHeader parsed;
  ConstBytes data;
  const PacketFault fault = parse_packet(packet, parsed, data);
  if (fault != PacketFault::kNone) return fault;
  ByteReader in(data);
  if (!is_pose_report(parsed) || in.u16() != kPoseStructureId) return PacketFault::kUnknown;
  if (in.remaining() != rows_size(pose_rows(), pose_rows().size())) return PacketFault::kBadLength;
  for (const TelemetryRow<P>& row : kRows) row.read(in, pose);
  header = parsed;
  return PacketFault::kNone;
}

std::size_t pose_row_offset(std::size_t row) { return kPacketHeaderBytes + kStructureIdBytes + rows_size(pose_rows(), row); }

}  // namespace lasso
