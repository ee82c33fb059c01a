#include "fsw/mission/parameters.hpp"

#include "fsw/geometry/portable_math.hpp"

namespace lasso {
namespace {

using P = MissionParameters;
constexpr ParameterKind kReal = ParameterKind::kReal;
constexpr ParameterKind kInteger = ParameterKind::kInteger;
constexpr ParameterKind kBoolean = ParameterKind::kBoolean;
constexpr ParameterKind kChoice = ParameterKind::kChoice;
constexpr double kDeg = kRadPerDeg;

// clang-format off
const ParameterRow kRows[] = {
  {"sensor.sigma0_m", "m", kReal, &P::sigma0_m, 1, 1e-6, 1, 1e-4, "", "range noise, constant part (1 sigma)"},
  {"sensor.sigma_k_per_m", "1/m", kReal, &P::sigma_k_per_m, 1, 0, 0.01, 1.0 / 9000, "", "range noise that grows with the square of the range"},
  {"sensor.sigma_angle_rad", "rad", kReal, &P::sigma_angle_rad, 1, 0, 0.01, 0, "", "pointing noise of a ray (1 sigma, each axis)"},
  {"sensor.range_min_m", "m", kReal, &P::range_min_m, 1, 0, 1000, 0.5, "", "nearest range that the sensor measures"},
  {"sensor.range_max_m", "m", kReal, &P::range_max_m, 1, 0.01, 10000, 20, "", "farthest range that the sensor measures"},
  {"sensor.fov_half_x_deg", "deg", kReal, &P::fov_half_x_rad, kDeg, 0.1, 60, 15, "", "half field of view, right and left"},
  {"sensor.fov_half_y_deg", "deg", kReal, &P::fov_half_y_rad, kDeg, 0.1, 60, 15, "", "half field of view, up and down"},
  {"sensor.dropout_probability", "1", kReal, &P::dropout_probability, 1, 0, 0.9, 0, "", "share of rays on the target that do not return"},
  {"sensor.noise_tolerance", "1", kReal, &P::noise_tolerance, 1, 1, 1000, 1.5, "", "residuals that show more than this times the noise stated above, and the surface's, make a pose not valid"},
  {"sensor.use_from_m", "m", kReal, &P::use_from_m, 1, 0, 10000, 0, "", "of several sensors, this one is used for a target's origin from here ..."},
  {"sensor.use_to_m", "m", kReal, &P::use_to_m, 1, 0, 10000, 10000, "", "... to here; where two sensors' bands overlap the one in use stays"},
  {"sensor.common_sigma_m", "m", kReal, &P::common_sigma_m, 1, 0, 1, 0, "", "range error that all rays of a scan have in common (1 sigma): calibration, surface, model"},
  {"sensor.common_sigma_k_per_m", "1/m", kReal, &P::common_sigma_k_per_m, 1, 0, 0.01, 0, "", "added to it, times the square of the range"},
  {"sensor.common_sigma_deg", "deg", kReal, &P::common_sigma_rad, kDeg, 0, 10, 0, "", "turn that all rays of a scan have in common (1 sigma, each axis of the sensor)"},
  {"sensor.common_memory_s", "s", kReal, &P::common_memory_s, 1, 0, 1e6, 0, "", "time in which the correlation of common errors falls to 1/e; 0: new in each scan"},
  {"sensing.fault_scans", "1", kInteger, &P::fault_scans, 1, 1, 1000, 3, "", "a sensor that loses so many scans in a row has failed: another one that measures the target's range takes its place"},
  {"sensing.rest_frames", "1", kInteger, &P::sensor_rest_frames, 1, 0, 10000, 50, "", "frames after which it is tried again"},
  {"sensing.look_scans", "1", kInteger, &P::look_scans, 1, 1, 10000, 10, "", "scans for which a sensor looks for a target of unknown range before the next one does"},
  {"scan.pattern", "1", kChoice, &P::pattern, 1, 0, 2, 0, "rosette|lissajous|raster", "scan pattern"},
  {"scan.points", "1", kInteger, &P::points, 1, 64, 4096, 1024, "", "rays of one scan"},
  {"scan.duration_s", "s", kReal, &P::duration_s, 1, 0.001, 10, 0.18, "", "first to last sample of a scan"},
  {"scan.cycles_a", "1", kInteger, &P::cycles_a, 1, 1, 500, 19, "", "rosette, Lissajous: first cycle count; raster: lines"},
  {"scan.cycles_b", "1", kInteger, &P::cycles_b, 1, 1, 500, 12, "", "rosette, Lissajous: second cycle count, coprime to the first"},
  {"scan.margin", "1", kReal, &P::margin, 1, 0.5, 3, 1, "", "scan extents over the target's predicted extents"},
  {"scan.phase_step_turns", "1", kReal, &P::phase_step_turns, 1, 0, 1, 0.3819660112501051, "", "turn of the pattern from scan to scan"},
  {"scan.aimed_share", "1", kReal, &P::aimed_share, 1, 0, 0.5, 0, "", "most of the rays that leave the pattern for predicted contours (with estimation.silhouettes); 0.3 is a good share"},
  {"estimation.incidence_max_deg", "deg", kReal, &P::incidence_max_rad, kDeg, 45, 89, 86, "", "rays that graze the surface more than this do not count"},
  {"estimation.kernel_width", "1", kReal, &P::kernel_width, 1, 2, 50, 10, "", "Tukey kernel's width in sigmas (tight is dishonest, see docs)"},
  {"estimation.gate_first_m", "m", kReal, &P::gate_first_m, 1, 0, 10, 0.010, "", "added to the kernel's width in the first iteration"},
  {"estimation.iterations_max", "1", kInteger, &P::iterations_max, 1, 2, 50, 12, "", "bound of the ray iterations"},
  {"estimation.stop_translation_m", "m", kReal, &P::stop_translation_m, 1, 1e-7, 0.1, 1e-4, "", "converged when a step is smaller than this"},
  {"estimation.stop_rotation_deg", "deg", kReal, &P::stop_rotation_rad, kDeg, 1e-6, 1, 0.01, "", "and smaller than this"},
  {"estimation.silhouettes", "1", kBoolean, &P::silhouettes, 1, 0, 1, 1, "", "use rays that missed and occlusion edges as measurements"},
  {"estimation.silhouette_sigma_m", "m", kReal, &P::silhouette_sigma_m, 1, 1e-6, 0.1, 1e-4, "", "uncertainty of a contour's place across the ray"},
  {"estimation.silhouette_band_m", "m", kReal, &P::silhouette_band_m, 1, 1e-5, 1, 3e-3, "", "rays this near a contour are labels"},
  {"estimation.edge_gap_min_m", "m", kReal, &P::edge_gap_min_m, 1, 1e-5, 10, 0.010, "", "an inner contour needs a step in range of at least this"},
  {"estimation.edge_depth_m", "m", kReal, &P::edge_depth_m, 1, 1e-5, 10, 0.012, "", "the near side of a contour is found within this of the edge"},
  {"estimation.probe_step_m", "m", kReal, &P::probe_step_m, 1, 1e-6, 0.1, 1.5e-4, "", "contours are confirmed this far on either side of the edge"},
  {"estimation.label_error", "1", kReal, &P::label_error, 1, 1e-6, 0.4, 1e-3, "", "probability that a hit or miss label is wrong, without dropouts"},
  {"estimation.deskew", "1", kBoolean, &P::deskew, 1, 0, 1, 1, "", "move each point to the scan's reference time by the predicted rates"},
  {"estimation.noise_estimated", "1", kBoolean, &P::noise_estimated, 1, 0, 1, 1, "", "scale the covariance by the residuals instead of trusting sensor.sigma"},
  {"estimation.surface_sigma_m", "m", kReal, &P::surface_sigma_m, 1, 0, 0.08, 1e-5, "", "how well the model's surface is known"},
  {"estimation.wide_start", "1", kBoolean, &P::wide_start, 1, 0, 1, 1, "", "the first scan starts from centroid, far field and slides"},
  {"filter.period_s", "s", kReal, &P::period_s, 1, 0.01, 100, 0.2, "", "frame period"},
  {"filter.acceleration_mps2", "m/s2", kReal, &P::acceleration_mps2, 1, 1e-9, 100, 0.01, "", "unmodelled acceleration of the target (1 sigma)"},
  {"filter.angular_acceleration_degps2", "deg/s2", kReal, &P::angular_acceleration_radps2, kDeg, 1e-9, 1000, 0.1, "", "unmodelled angular acceleration (1 sigma) of a target at rest"},
  {"filter.precession", "1", kReal, &P::precession, 1, 0, 10, 0.25, "", "and as much as this times the square of its angular rate: a free body's own is at most 0.5 of it"},
  {"filter.initial_rate_mps", "m/s", kReal, &P::initial_rate_mps, 1, 1e-9, 100, 0.05, "", "uncertainty of the velocity at the start (1 sigma)"},
  {"filter.initial_angular_rate_degps", "deg/s", kReal, &P::initial_angular_rate_radps, kDeg, 1e-9, 100, 10, "", "uncertainty of the angular rate at the start (1 sigma)"},
  {"bearing.returns_min", "1", kInteger, &P::bearing_returns_min, 1, 4, 4096, 12, "", "fewer returns of one target: no bearing"},
  {"bearing.rate_mps", "m/s", kReal, &P::bearing_rate_mps, 1, 1e-6, 100, 1, "", "how fast the target may move at first sight, each axis (1 sigma)"},
  {"bearing.memory_s", "s", kReal, &P::bearing_memory_s, 1, 0.01, 1000, 5, "", "a bearing that no scan has renewed for longer starts anew"},
  {"tracking.start_sigma_m", "m", kReal, &P::start_sigma_m, 1, 1e-6, 100, 0.3, "", "how far off a track's first pose may be, each axis (1 sigma); the first scans reach that much farther"},
  {"tracking.start_sigma_deg", "deg", kReal, &P::start_sigma_rad, kDeg, 1e-4, 180, 20, "", "how far a track's first attitude may be off, each axis (1 sigma)"},
  {"tracking.inliers_min", "1", kInteger, &P::inliers_min, 1, 12, 4096, 60, "", "fewer inliers: the pose is not valid"},
  {"tracking.inlier_share_min", "1", kReal, &P::inlier_share_min, 1, 0, 1, 0.5, "", "least share of the returns that the pose explains"},
  {"tracking.agreement_min", "1", kReal, &P::agreement_min, 1, 0, 1, 0.99, "", "least agreement of a scan's rays: 1 less the share of those that contradict the pose, but for two; less for a sensor with outliers, or a model without small parts"},
  {"tracking.sigma_position_max_m", "m", kReal, &P::sigma_position_max_m, 1, 1e-6, 100, 0.05, "", "a direction less certain than this is weak"},
  {"tracking.sigma_attitude_max_deg", "deg", kReal, &P::sigma_attitude_max_rad, kDeg, 1e-6, 180, 2, "", "an axis less certain than this is weak"},
  {"tracking.innovation_max", "1", kReal, &P::innovation_max, 1, 3, 1000, 5, "", "a pose this many sigmas off the filter's prediction is implausible"},
  {"tracking.coast_frames", "1", kInteger, &P::coast_frames, 1, 0, 1000, 10, "", "frames without a valid pose before the track is lost"},
  {"tracking.hysteresis", "1", kReal, &P::hysteresis, 1, 0, 0.5, 0.02, "", "a track begins, or is taken up again, with this much more than the least share of explained returns and agreement"},
  {"tracking.recover", "1", kBoolean, &P::recover, 1, 0, 1, 0, "", "look for a target that is lost: near the prediction, then its bearing"},
  {"tracking.reacquire_frames", "1", kInteger, &P::reacquire_frames, 1, 0, 10000, 25, "", "frames for which it is looked for near the prediction"},
  {"start.frames", "1", kInteger, &P::start_frames, 1, 0, 10000, 10, "", "frames in which a scan has to confirm a pose to start from"},
  {"start.inlier_share_min", "1", kReal, &P::start_inlier_share_min, 1, 0, 1, 0.9, "", "least share of that scan's returns that its pose explains; less for a sensor with outliers: half a turn off, a pose explains most"},
  {"start.gate", "1", kReal, &P::start_gate, 1, 1, 1000, 25, "", "most normalised square of its difference from that scan's pose (6 degrees of freedom)"},
  {"start.check", "1", kBoolean, &P::start_check, 1, 0, 1, 1, "", "a scan that confirms a start known no better than to 3 deg is searched for a pose that explains it better, before one is valid: some seconds"},
  {"start.age_max_s", "s", kReal, &P::start_age_max_s, 1, 0, 1000, 100, "", "an older pose to start from is refused"},
  {"start.first", "1", kChoice, &P::start_first, 1, 0, 5, 4, "none|handover|navigation|apriori|uplink|search", "the way to a pose to start from that is tried first"},
  {"start.second", "1", kChoice, &P::start_second, 1, 0, 5, 1, "none|handover|navigation|apriori|uplink|search", "the way that is tried next"},
  {"start.third", "1", kChoice, &P::start_third, 1, 0, 5, 2, "none|handover|navigation|apriori|uplink|search", "the way that is tried next"},
  {"start.fourth", "1", kChoice, &P::start_fourth, 1, 0, 5, 3, "none|handover|navigation|apriori|uplink|search", "the way that is tried next"},
  {"start.fifth", "1", kChoice, &P::start_fifth, 1, 0, 5, 0, "none|handover|navigation|apriori|uplink|search", "the way that is tried last"},
  {"search.hits_min", "1", kInteger, &P::search_hits_min, 1, 12, 672, 80, "", "fewer returns looked at, of all scans: no pose is accepted"},
  {"search.disagreement_max", "1", kReal, &P::search_disagreement_max, 1, 0, 1, 0.20, "", "largest share of what was looked at that an accepted pose does not explain"},
  {"search.ratio_min", "1", kReal, &P::search_ratio_min, 1, 1, 100, 1.3, "", "least score of the best competitor over that of an accepted pose; less is ambiguous"},
  {"search.scans_max", "1", kInteger, &P::search_scans_max, 1, 1, 3, 3, "", "scans that one search joins before it begins anew"},
  {"search.work_max", "1", kInteger, &P::search_work_max, 1, 1500000, 100000000, 2500000, "", "work of a search on all its scans, in units of some 75 instructions of a 603e; most searches take 1.2 million; what they leave open is ambiguous"},
  {"search.slice", "1", kInteger, &P::search_slice, 1, 1000, 10000000, 160000, "", "work of one frame, in units of some 75 instructions of a 603e; with its last step at most 17 million of these; in fixed point a share of it"},
  {"search.frames", "1", kInteger, &P::search_frames, 1, 1, 10000, 200, "", "frames in which a pose has to be recognised"},
  {"short_range.enter_m", "m", kReal, &P::short_range_enter_m, 1, 0, 10000, 0, "", "a tracked target whose origin is this near is scanned part by part; 0: never"},
  {"short_range.leave_m", "m", kReal, &P::short_range_leave_m, 1, 0, 10000, 0, "", "one this far away is scanned as a whole again"},
  {"short_range.disagreement_max", "1", kReal, &P::disagreement_max, 1, 3, 1000, 6, "", "parts whose poses are this many sigmas apart disagree"},
  {"short_range.rest_frames", "1", kInteger, &P::rest_frames, 1, 0, 10000, 25, "", "frames for which a part that disagrees, or gives no pose, is left out"},
  {"image.trial_scans", "1", kInteger, &P::image_trial_scans, 1, 0, 1000, 10, "", "scans in which an image that takes this one's place has to give valid poses, or is taken back; 0: it is trusted"},
  {"image.trial_valid_min", "1", kInteger, &P::image_trial_valid_min, 1, 1, 1000, 3, "", "valid poses that it has to give in them"},
  {"link.silence_max_s", "s", kReal, &P::link_silence_max_s, 1, 0, 1e6, 0, "", "without a valid command for longer, the fault link_silent is told; 0: it is not watched for"},
  {"tracking.initial.present", "1", kBoolean, &P::initial_present, 1, 0, 1, 0, "", "tracking starts from the pose below"},
  {"tracking.initial.qx", "1", kReal, &P::initial_qx, 1, -1, 1, 0, "", "quaternion of T_sensor_target"},
  {"tracking.initial.qy", "1", kReal, &P::initial_qy, 1, -1, 1, 0, "", "quaternion of T_sensor_target"},
  {"tracking.initial.qz", "1", kReal, &P::initial_qz, 1, -1, 1, 0, "", "quaternion of T_sensor_target"},
  {"tracking.initial.qw", "1", kReal, &P::initial_qw, 1, -1, 1, 1, "", "quaternion of T_sensor_target, scalar part"},
  {"tracking.initial.x_m", "m", kReal, &P::initial_x_m, 1, -1e4, 1e4, 0, "", "target's origin in the sensor frame, right"},
  {"tracking.initial.y_m", "m", kReal, &P::initial_y_m, 1, -1e4, 1e4, 0, "", "target's origin in the sensor frame, down"},
  {"tracking.initial.z_m", "m", kReal, &P::initial_z_m, 1, -1e4, 1e4, 1, "", "target's origin in the sensor frame, along the boresight"},
  {"tracking.initial.wx_degps", "deg/s", kReal, &P::initial_wx_radps, kDeg, -360, 360, 0, "", "angular rate about the sensor's x"},
  {"tracking.initial.wy_degps", "deg/s", kReal, &P::initial_wy_radps, kDeg, -360, 360, 0, "", "angular rate about the sensor's y"},
  {"tracking.initial.wz_degps", "deg/s", kReal, &P::initial_wz_radps, kDeg, -360, 360, 0, "", "angular rate about the sensor's z"},
  {"tracking.initial.vx_mps", "m/s", kReal, &P::initial_vx_mps, 1, -100, 100, 0, "", "velocity along the sensor's x"},
  {"tracking.initial.vy_mps", "m/s", kReal, &P::initial_vy_mps, 1, -100, 100, 0, "", "velocity along the sensor's y"},
  {"tracking.initial.vz_mps", "m/s", kReal, &P::initial_vz_mps, 1, -100, 100, 0, "", "velocity along the sensor's z"},
};
// clang-format on

bool in_range(const ParameterRow& row, double si) {
  const double slack = 1e-12 * (row.maximum - row.minimum);
  const double value = si / row.to_si;
  return value >= row.minimum - slack && value <= row.maximum + slack;
}

static_assert(sizeof(SensorParameters) == kSensorValues * sizeof(double), "a row for each value of a sensor");

bool is_whole(double value) { return static_cast<double>(static_cast<std::int64_t>(value)) == value; }

Status validate(const ParameterRow& row, double value) {
  if (!is_finite(value)) return Status::kNotFinite;
  if (!in_range(row, value)) return Status::kBadValue;
  return row.kind != ParameterKind::kReal && !is_whole(value) ? Status::kBadValue : Status::kOk;
}

}  // namespace

Span<const ParameterRow> parameter_rows() { return Span<const ParameterRow>(kRows); }

Span<const ParameterRow> sensor_rows() { return parameter_rows().first(kSensorValues); }

double SensorParameters::*sensor_member(const ParameterRow& row) { return static_cast<double SensorParameters::*>(row.member); }

MissionParameters preset_parameters() {
  MissionParameters parameters{};
  for (const ParameterRow& row : kRows) parameters.*row.member = row.preset * row.to_si;
  return parameters;
}

Status validate(const MissionParameters& parameters, std::size_t& bad_row) {
  for (bad_row = 0; bad_row < parameter_rows().size(); ++bad_row) {
    const Status status = validate(kRows[bad_row], parameters.*kRows[bad_row].member);
    if (status != Status::kOk) return status;
  }
  return Status::kOk;
}

Status validate(const SensorParameters& sensor, std::size_t& bad_row) {
  for (bad_row = 0; bad_row < kSensorValues; ++bad_row) {
    const Status status = validate(kRows[bad_row], sensor.*sensor_member(kRows[bad_row]));
    if (status != Status::kOk) return status;
  }
  return Status::kOk;
}

}  // namespace lasso
