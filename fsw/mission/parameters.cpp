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
  {0, kReal, "sensor.sigma0_m", "m", &P::sigma0_m, 1, 1e-6, 1, 1e-4, "", "range noise, constant part (1 sigma)"},
  {1, kReal, "sensor.sigma_k_per_m", "1/m", &P::sigma_k_per_m, 1, 0, 0.01, 1.0 / 9000, "", "range noise that grows with the square of the range"},
  {2, kReal, "sensor.sigma_angle_rad", "rad", &P::sigma_angle_rad, 1, 0, 0.01, 0, "", "pointing noise of a ray (1 sigma, each axis)"},
  {3, kReal, "sensor.range_min_m", "m", &P::range_min_m, 1, 0, 1000, 0.5, "", "nearest range that the sensor measures"},
  {4, kReal, "sensor.range_max_m", "m", &P::range_max_m, 1, 0.01, 10000, 20, "", "farthest range that the sensor measures"},
  {5, kReal, "sensor.fov_half_x_deg", "deg", &P::fov_half_x_rad, kDeg, 0.1, 60, 15, "", "half field of view, right and left"},
  {6, kReal, "sensor.fov_half_y_deg", "deg", &P::fov_half_y_rad, kDeg, 0.1, 60, 15, "", "half field of view, up and down"},
  {7, kReal, "sensor.dropout_probability", "1", &P::dropout_probability, 1, 0, 0.9, 0, "", "share of rays on the target that do not return"},
  {8, kReal, "sensor.noise_tolerance", "1", &P::noise_tolerance, 1, 1, 1000, 1.5, "", "residuals that show more than this times the noise stated above, and the surface's, make a pose not valid"},
  {9, kReal, "sensor.use_from_m", "m", &P::use_from_m, 1, 0, 10000, 0, "", "of several sensors, this one is used for a target's origin from here ..."},
  {10, kReal, "sensor.use_to_m", "m", &P::use_to_m, 1, 0, 10000, 10000, "", "... to here; where two sensors' bands overlap the one in use stays"},
  {11, kReal, "sensor.common_sigma_m", "m", &P::common_sigma_m, 1, 0, 1, 0, "", "range error that all rays of a scan have in common (1 sigma): calibration, surface, model"},
  {12, kReal, "sensor.common_sigma_k_per_m", "1/m", &P::common_sigma_k_per_m, 1, 0, 0.01, 0, "", "added to it, times the square of the range"},
  {13, kReal, "sensor.common_sigma_deg", "deg", &P::common_sigma_rad, kDeg, 0, 10, 0, "", "turn that all rays of a scan have in common (1 sigma, each axis of the sensor)"},
  {14, kReal, "sensor.common_memory_s", "s", &P::common_memory_s, 1, 0, 1e6, 0, "", "time in which the correlation of common errors falls to 1/e; 0: new in each scan"},
  {15, kInteger, "sensing.fault_scans", "1", &P::fault_scans, 1, 1, 1000, 3, "", "a sensor that loses so many scans in a row has failed: another one that measures the target's range takes its place"},
  {18, kChoice, "scan.pattern", "1", &P::pattern, 1, 0, 2, 0, "rosette|lissajous|raster", "scan pattern"},
  {19, kInteger, "scan.points", "1", &P::points, 1, 64, 4096, 1024, "", "rays of one scan"},
  {20, kReal, "scan.duration_s", "s", &P::duration_s, 1, 0.001, 10, 0.18, "", "first to last sample of a scan"},
  {21, kInteger, "scan.cycles_a", "1", &P::cycles_a, 1, 1, 500, 19, "", "rosette, Lissajous: first cycle count; raster: lines"},
  {22, kInteger, "scan.cycles_b", "1", &P::cycles_b, 1, 1, 500, 12, "", "rosette, Lissajous: second cycle count, coprime to the first"},
  {23, kReal, "scan.margin", "1", &P::margin, 1, 0.5, 3, 1, "", "scan extents over the target's predicted extents"},
  {24, kReal, "scan.phase_step_turns", "1", &P::phase_step_turns, 1, 0, 1, 0.3819660112501051, "", "turn of the pattern from scan to scan"},
  {25, kReal, "scan.aimed_share", "1", &P::aimed_share, 1, 0, 0.5, 0, "", "most of the rays that leave the pattern for predicted contours (with estimation.silhouettes); 0.3 is a good share"},
  {26, kReal, "estimation.incidence_max_deg", "deg", &P::incidence_max_rad, kDeg, 45, 89, 86, "", "rays that graze the surface more than this do not count"},
  {27, kReal, "estimation.kernel_width", "1", &P::kernel_width, 1, 2, 50, 10, "", "Tukey kernel's width in sigmas (a narrow one gives too small a covariance)"},
  {28, kReal, "estimation.gate_first_m", "m", &P::gate_first_m, 1, 0, 10, 0.010, "", "added to the kernel's width in the first iteration"},
  {29, kInteger, "estimation.iterations_max", "1", &P::iterations_max, 1, 2, 50, 12, "", "bound of the ray iterations"},
  {30, kReal, "estimation.stop_translation_m", "m", &P::stop_translation_m, 1, 1e-7, 0.1, 1e-4, "", "converged when a step is smaller than this, and than 0.01 deg"},
  {32, kBoolean, "estimation.silhouettes", "1", &P::silhouettes, 1, 0, 1, 1, "", "use rays that missed and occlusion edges as measurements"},
  {33, kReal, "estimation.silhouette_sigma_m", "m", &P::silhouette_sigma_m, 1, 1e-6, 0.1, 1e-4, "", "uncertainty of a contour's place across the ray"},
  {34, kReal, "estimation.silhouette_band_m", "m", &P::silhouette_band_m, 1, 1e-5, 1, 3e-3, "", "rays this near a contour are labels"},
  {35, kReal, "estimation.edge_gap_min_m", "m", &P::edge_gap_min_m, 1, 1e-5, 10, 0.010, "", "an inner contour needs a step in range of at least this"},
  {36, kReal, "estimation.edge_depth_m", "m", &P::edge_depth_m, 1, 1e-5, 10, 0.012, "", "the near side of a contour is found within this of the edge"},
  {37, kReal, "estimation.probe_step_m", "m", &P::probe_step_m, 1, 1e-6, 0.1, 1.5e-4, "", "contours are confirmed this far on either side of the edge"},
  {39, kBoolean, "estimation.deskew", "1", &P::deskew, 1, 0, 1, 1, "", "move each point to the scan's reference time by the predicted rates"},
  {40, kBoolean, "estimation.noise_estimated", "1", &P::noise_estimated, 1, 0, 1, 1, "", "scale the covariance by the residuals instead of trusting sensor.sigma"},
  {41, kReal, "estimation.surface_sigma_m", "m", &P::surface_sigma_m, 1, 0, 0.08, 1e-5, "", "how well the model's surface is known"},
  {42, kBoolean, "estimation.wide_start", "1", &P::wide_start, 1, 0, 1, 1, "", "the first scan starts from centroid, far field and slides"},
  {43, kReal, "filter.period_s", "s", &P::period_s, 1, 0.01, 100, 0.2, "", "frame period"},
  {44, kReal, "filter.acceleration_mps2", "m/s2", &P::acceleration_mps2, 1, 1e-9, 100, 0.01, "", "unmodelled acceleration of the target (1 sigma)"},
  {45, kReal, "filter.angular_acceleration_degps2", "deg/s2", &P::angular_acceleration_radps2, kDeg, 1e-9, 1000, 0.1, "", "unmodelled angular acceleration (1 sigma) of a target at rest"},
  {46, kReal, "filter.precession", "1", &P::precession, 1, 0, 10, 0.25, "", "and as much as this times the square of its angular rate: a free body's own is at most 0.5 of it"},
  {47, kReal, "filter.initial_rate_mps", "m/s", &P::initial_rate_mps, 1, 1e-9, 100, 0.05, "", "uncertainty of the velocity at the start (1 sigma)"},
  {48, kReal, "filter.initial_angular_rate_degps", "deg/s", &P::initial_angular_rate_radps, kDeg, 1e-9, 100, 10, "", "uncertainty of the angular rate at the start (1 sigma)"},
  {49, kInteger, "bearing.returns_min", "1", &P::bearing_returns_min, 1, 4, 4096, 12, "", "fewer returns of one target: no bearing"},
  {50, kReal, "bearing.rate_mps", "m/s", &P::bearing_rate_mps, 1, 1e-6, 100, 1, "", "how fast the target may move at first sight, each axis (1 sigma)"},
  {51, kReal, "bearing.memory_s", "s", &P::bearing_memory_s, 1, 0.01, 1000, 5, "", "a bearing that no scan has renewed for longer starts anew"},
  {52, kReal, "tracking.start_sigma_m", "m", &P::start_sigma_m, 1, 1e-6, 100, 0.3, "", "how far off a track's first pose may be, each axis (1 sigma); the first scans reach that much farther"},
  {53, kReal, "tracking.start_sigma_deg", "deg", &P::start_sigma_rad, kDeg, 1e-4, 180, 20, "", "how far a track's first attitude may be off, each axis (1 sigma)"},
  {54, kInteger, "tracking.inliers_min", "1", &P::inliers_min, 1, 12, 4096, 60, "", "fewer inliers: the pose is not valid"},
  {55, kReal, "tracking.inlier_share_min", "1", &P::inlier_share_min, 1, 0, 1, 0.5, "", "least share of the returns that the pose explains"},
  {56, kReal, "tracking.agreement_min", "1", &P::agreement_min, 1, 0, 1, 0.99, "", "least agreement of a scan's rays: 1 less the share of those that contradict the pose, but for two; less for a sensor with outliers, or a model without small parts"},
  {57, kReal, "tracking.sigma_position_max_m", "m", &P::sigma_position_max_m, 1, 1e-6, 100, 0.05, "", "a direction less certain than this is weak"},
  {58, kReal, "tracking.sigma_attitude_max_deg", "deg", &P::sigma_attitude_max_rad, kDeg, 1e-6, 180, 2, "", "an axis less certain than this is weak"},
  {59, kReal, "tracking.innovation_max", "1", &P::innovation_max, 1, 3, 1000, 5, "", "a pose this many sigmas off the filter's prediction is implausible"},
  {60, kInteger, "tracking.coast_frames", "1", &P::coast_frames, 1, 0, 1000, 10, "", "frames without a valid pose before the track is lost"},
  {61, kReal, "tracking.hysteresis", "1", &P::hysteresis, 1, 0, 0.5, 0.02, "", "a track begins, or is taken up again, with this much more than the least share of explained returns and agreement"},
  {62, kBoolean, "tracking.recover", "1", &P::recover, 1, 0, 1, 0, "", "look for a target that is lost: near the prediction, then its bearing"},
  {63, kInteger, "tracking.reacquire_frames", "1", &P::reacquire_frames, 1, 0, 10000, 25, "", "frames for which it is looked for near the prediction"},
  {64, kInteger, "start.frames", "1", &P::start_frames, 1, 0, 10000, 10, "", "frames in which a scan has to confirm a pose to start from"},
  {65, kReal, "start.inlier_share_min", "1", &P::start_inlier_share_min, 1, 0, 1, 0.9, "", "least share of that scan's returns that its pose explains; less for a sensor with outliers: half a turn off, a pose explains most"},
  {67, kBoolean, "start.check", "1", &P::start_check, 1, 0, 1, 1, "", "a scan that confirms a start known no better than to 3 deg is searched for a pose that explains it better, before one is valid: some seconds"},
  {68, kReal, "start.age_max_s", "s", &P::start_age_max_s, 1, 0, 1000, 100, "", "an older pose to start from is refused"},
  {69, kChoice, "start.first", "1", &P::start_first, 1, 0, 5, 4, "none|handover|navigation|apriori|uplink|search", "the source of a pose to start from that is tried first"},
  {70, kChoice, "start.second", "1", &P::start_second, 1, 0, 5, 1, "none|handover|navigation|apriori|uplink|search", "the source that is tried next"},
  {71, kChoice, "start.third", "1", &P::start_third, 1, 0, 5, 2, "none|handover|navigation|apriori|uplink|search", "the source that is tried next"},
  {72, kChoice, "start.fourth", "1", &P::start_fourth, 1, 0, 5, 3, "none|handover|navigation|apriori|uplink|search", "the source that is tried next"},
  {73, kChoice, "start.fifth", "1", &P::start_fifth, 1, 0, 5, 0, "none|handover|navigation|apriori|uplink|search", "the source that is tried last"},
  {79, kInteger, "search.slice", "1", &P::search_slice, 1, 1000, 10000000, 160000, "", "work of one frame, in units of some 75 instructions of a 603e; with its last step at most 17 million of these; in fixed point a share of it"},
  {80, kInteger, "search.frames", "1", &P::search_frames, 1, 1, 10000, 200, "", "frames in which a pose has to be recognised"},
  {81, kReal, "short_range.enter_m", "m", &P::short_range_enter_m, 1, 0, 10000, 0, "", "a tracked target whose origin is this near is scanned part by part; 0: never"},
  {82, kReal, "short_range.leave_m", "m", &P::short_range_leave_m, 1, 0, 10000, 0, "", "one this far away is scanned as a whole again"},
  {85, kInteger, "image.trial_scans", "1", &P::image_trial_scans, 1, 0, 1000, 10, "", "scans in which an image that takes this one's place has to give valid poses, or is taken back; 0: it is trusted"},
  {86, kInteger, "image.trial_valid_min", "1", &P::image_trial_valid_min, 1, 1, 1000, 3, "", "valid poses that it has to give in them"},
  {87, kReal, "link.silence_max_s", "s", &P::link_silence_max_s, 1, 0, 1e6, 0, "", "without a valid command for longer, the fault link_silent is reported; 0: it is not watched for"},
  {88, kBoolean, "tracking.initial.present", "1", &P::initial_present, 1, 0, 1, 0, "", "tracking starts from the pose below"},
  {89, kReal, "tracking.initial.qx", "1", &P::initial_qx, 1, -1, 1, 0, "", "quaternion of T_sensor_target"},
  {90, kReal, "tracking.initial.qy", "1", &P::initial_qy, 1, -1, 1, 0, "", "quaternion of T_sensor_target"},
  {91, kReal, "tracking.initial.qz", "1", &P::initial_qz, 1, -1, 1, 0, "", "quaternion of T_sensor_target"},
  {92, kReal, "tracking.initial.qw", "1", &P::initial_qw, 1, -1, 1, 1, "", "quaternion of T_sensor_target, scalar part"},
  {93, kReal, "tracking.initial.x_m", "m", &P::initial_x_m, 1, -1e4, 1e4, 0, "", "target's origin in the sensor frame, right"},
  {94, kReal, "tracking.initial.y_m", "m", &P::initial_y_m, 1, -1e4, 1e4, 0, "", "target's origin in the sensor frame, down"},
  {95, kReal, "tracking.initial.z_m", "m", &P::initial_z_m, 1, -1e4, 1e4, 1, "", "target's origin in the sensor frame, along the boresight"},
  {96, kReal, "tracking.initial.wx_degps", "deg/s", &P::initial_wx_radps, kDeg, -360, 360, 0, "", "angular rate about the sensor's x"},
  {97, kReal, "tracking.initial.wy_degps", "deg/s", &P::initial_wy_radps, kDeg, -360, 360, 0, "", "angular rate about the sensor's y"},
  {98, kReal, "tracking.initial.wz_degps", "deg/s", &P::initial_wz_radps, kDeg, -360, 360, 0, "", "angular rate about the sensor's z"},
  {99, kReal, "tracking.initial.vx_mps", "m/s", &P::initial_vx_mps, 1, -100, 100, 0, "", "velocity along the sensor's x"},
  {100, kReal, "tracking.initial.vy_mps", "m/s", &P::initial_vy_mps, 1, -100, 100, 0, "", "velocity along the sensor's y"},
  {101, kReal, "tracking.initial.vz_mps", "m/s", &P::initial_vz_mps, 1, -100, 100, 0, "", "velocity along the sensor's z"},
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

std::size_t index_of_id(Span<const ParameterRow> rows, std::uint16_t id) {
  std::size_t index = 0;
  while (index < rows.size() && rows[index].id != id) ++index;
  return index;
}

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
