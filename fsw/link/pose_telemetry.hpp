// The navigation output of one frame, as plain values: what the packet `pose` says. The executive fills it, its rows (pose_rows.hpp) carry
// it to the ground and back. Units and frames as in docs/conventions.md: SI, T_sensor_target, quaternions x, y, z, w.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"
#include "fsw/core/time.hpp"
#include "fsw/link/housekeeping.hpp"
#include "fsw/link/packet.hpp"

namespace lasso {

constexpr std::size_t kPoseSigmas = 6;
constexpr std::size_t kPoseCovarianceTerms = 21;
constexpr std::size_t kPoseChanges = 4;
constexpr std::size_t kBearingValues = 6;
constexpr std::size_t kTelemetryCandidates = 4;

struct PoseTelemetry {
  std::uint32_t scan_id = 0;
  TimeUs t_measurement_us = 0;  // the scan's reference time, at which registration and filter are stated
  TimeUs t_publication_us = 0;
  std::uint32_t age_us = 0;  // publication - measurement

  std::uint8_t valid = 0;   // 1: the registration can be trusted
  std::uint8_t reason = 0;  // PoseReason
  std::uint8_t stop = 0;    // StopReason
  std::uint8_t mode = 0;    // TrackingMode after this scan

  double q_sensor_target[4] = {0, 0, 0, 1};  // registration of this scan alone; the prediction where it did not run
  double p_sensor_target_m[3] = {};
  // Upper triangle, row by row, of (rotation about the target's origin in sensor axes [rad], translation [m]).
  double covariance[kPoseCovarianceTerms] = {};  // in double: what a scan does not show has a variance 1e10 times that of what it shows

  double filter_q_sensor_target[4] = {0, 0, 0, 1};
  double filter_p_sensor_target_m[3] = {};
  double filter_omega_radps[3] = {};  // sensor axes
  double filter_v_mps[3] = {};
  float filter_sigma_pose[kPoseSigmas] = {};   // rotation [rad], translation [m]
  float filter_sigma_rates[kPoseSigmas] = {};  // angular [rad/s], linear [m/s]

  std::uint16_t rays = 0;
  std::uint16_t returns = 0;
  std::uint16_t inliers = 0;
  std::uint16_t labels = 0;
  std::uint16_t iterations = 0;
  std::uint16_t weak = 0;
  float rms_m = 0;
  float normalized_residual = 0;
  float inlier_share = 0;
  float agreement = 0;
  float weakest_sigma_m = 0;
  float weakest_direction[kPoseSigmas] = {};

  double plan_center[2] = {};  // tangent plane z = 1
  double plan_half_extents[2] = {};
  double plan_phase_turns = 0;
  std::uint16_t plan_points = 0;
  std::uint32_t plan_duration_us = 0;
  std::uint8_t plan_pattern = 0;  // PatternKind

  std::uint8_t held = 0;                         // 1: no mode ends because its frames are used up
  std::uint8_t changes = 0;                      // of the mode since the packet before: the first so many of these
  std::uint8_t change_from[kPoseChanges] = {};   // TrackingMode
  std::uint8_t change_event[kPoseChanges] = {};  // ModeEvent
  std::uint8_t change_to[kPoseChanges] = {};     // TrackingMode
  std::uint8_t start_source = 0;                 // InitialPoseSource of the present track
  std::uint8_t refused_source = 0;               // InitialPoseSource of the last pose to start from that was refused
  std::uint8_t refusal = 0;                      // StartRefusal: why
  std::uint32_t refused_starts = 0;
  std::uint32_t refused_commands = 0;

  std::uint8_t bearing_reason = 0;  // BearingReason
  std::uint16_t bearing_returns = 0;
  std::uint16_t bearing_used = 0;
  std::uint32_t bearing_scans = 0;      // that it rests on
  TimeUs t_bearing_us = 0;              // at which it is stated
  double bearing[kBearingValues] = {};  // azimuth, elevation [rad], range [m], their rates
  float bearing_sigma[kBearingValues] = {};

  std::uint8_t search_outcome = 0;  // SearchOutcome of the scans that the search has joined
  std::uint8_t search_reason = 0;   // SearchReason
  std::uint8_t search_scans = 0;
  std::uint8_t search_candidates = 0;  // the first so many of these
  float search_ratio = 0;
  float search_disagreement = 0;
  std::uint32_t search_work = 0;
  TimeUs t_search_us = 0;                                          // at which the candidates are stated
  float candidate_q_sensor_target[4 * kTelemetryCandidates] = {};  // as q_sensor_target, one after the other
  float candidate_p_sensor_target_m[3 * kTelemetryCandidates] = {};

  std::uint8_t part = 0;                 // that the scan looked at, from 1 in the image's order; 0: the target as a whole
  std::uint8_t parts_resting = 0;        // bit i: part i + 1 is left out for some scans
  std::uint8_t inconsistent_part = 0;    // that this scan showed to disagree with the others; 0: none
  float inconsistency_sigmas = 0;        // how far
  std::uint32_t inconsistent_parts = 0;  // so far

  std::uint8_t sensor = 0;           // that took the scan: 0 the mission's [sensor], then the further ones in the image's order
  std::uint8_t sensor_reason = 0;    // SensorReason: why it was chosen
  std::uint8_t sensors_failed = 0;   // bit i: sensor i loses its scans, and is left out for some frames
  std::uint32_t sensor_changes = 0;  // so far

  std::uint32_t image_crc = 0;
  std::uint32_t software_version = 0;  // major << 24 | minor << 16 | patch
  std::uint32_t software_build = 0;    // given by the build, 0: development

  std::uint32_t frames = 0;           // frames since the start of the component
  std::uint32_t invalid_frames = 0;   // reported without a valid pose
  std::uint32_t lost_scans = 0;       // not started, incomplete or refused by the sensor
  std::uint32_t overruns = 0;         // frames dropped because an estimate was not ready at its boundary
  std::uint32_t slot_slips = 0;       // slots that began later than their own length
  std::uint32_t dropped_packets = 0;  // did not fit into the telemetry queue
};

constexpr std::size_t kMaxPosePacketBytes = 896;

// Writes the whole packet (headers, structure id, rows, CRC) to `out`. `header` says counts and time; its service fields are set here.
// Returns the packet's size, 0 when `out` is too small.
std::size_t encode_pose(const PoseTelemetry& pose, PacketHeader header, Bytes out);

// kUnknown: not a pose packet. When it is refused, `header` and `pose` are untouched.
PacketFault decode_pose(ConstBytes packet, PacketHeader& header, PoseTelemetry& pose, std::uint16_t apid = kApid);

}  // namespace lasso
