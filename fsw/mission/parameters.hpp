// The mission's numbers as the flight component uses them: SI, radians. One row per parameter says everything about it; the mission
// compiler, the image loader, the reports and the parameter service read the same rows.
#pragma once

#include <cstdint>

#include "fsw/core/span.hpp"
#include "fsw/core/status.hpp"

namespace lasso {

// What the component knows of a sensor: [sensor], or a further one.
struct SensorParameters {
  // The noise that the estimator assumes: sigma_r^2 = sigma0^2 + (k z^2)^2 along the ray, z*sigma_angle across it.
  double sigma0_m, sigma_k_per_m, sigma_angle_rad, range_min_m, range_max_m, fov_half_x_rad, fov_half_y_rad, dropout_probability;
  double noise_tolerance;       // residuals larger than this times the stated noise refuse a pose
  double use_from_m, use_to_m;  // its turn: ranges of the target's origin
  // Errors that all rays of a scan have in common: along each ray sigma + k R^2, and a turn about each sensor axis.
  double common_sigma_m, common_sigma_k_per_m, common_sigma_rad, common_memory_s;
};
constexpr std::size_t kSensorValues = 15;

// [sensing] which of several sensors takes a scan
struct SensingParameters {
  double fault_scans;
};

// [scan]
struct ScanParameters {
  double pattern, points, duration_s, cycles_a, cycles_b, margin, phase_step_turns, aimed_share;
};

// [estimation]
struct EstimationParameters {
  double incidence_max_rad, kernel_width, gate_first_m, iterations_max, stop_translation_m, silhouettes, silhouette_sigma_m,
      silhouette_band_m, edge_gap_min_m, edge_depth_m, probe_step_m, deskew, noise_estimated, surface_sigma_m, wide_start;
};

// [filter]
struct FilterParameters {
  double period_s, acceleration_mps2, angular_acceleration_radps2, precession, initial_rate_mps, initial_angular_rate_radps;
};

// [bearing] the target's direction and range without its attitude
struct BearingParameters {
  double bearing_returns_min, bearing_rate_mps, bearing_memory_s;
};

// [tracking] validity and loss
struct TrackingParameters {
  double start_sigma_m, start_sigma_rad, inliers_min, inlier_share_min, agreement_min, sigma_position_max_m, sigma_attitude_max_rad,
      innovation_max, coast_frames, hysteresis, recover, reacquire_frames;
};

// [start] the sources of a pose to start from
struct StartParameters {
  double start_frames, start_inlier_share_min, start_check, start_age_max_s, start_first, start_second, start_third, start_fourth,
      start_fifth;
};

// [search] the first pose without any prior attitude
struct SearchParameters {
  double search_slice, search_frames;
};

// [short_range] a large target close by, scanned part by part
struct ShortRangeParameters {
  double short_range_enter_m, short_range_leave_m;
};

// [image] what an image that is loaded in flight has to show
struct ImageParameters {
  double image_trial_scans, image_trial_valid_min;
};

// [link]
struct LinkParameters {
  double link_silence_max_s;
};

// [tracking.initial] T_sensor_target and rates at the start
struct InitialPoseParameters {
  double initial_present, initial_qx, initial_qy, initial_qz, initial_qw, initial_x_m, initial_y_m, initial_z_m, initial_wx_radps,
      initial_wy_radps, initial_wz_radps, initial_vx_mps, initial_vy_mps, initial_vz_mps;
};

// The sections of a mission file, in its order. SensorParameters are those of the sensor whose scans these parameters are for.
// NOLINTNEXTLINE(misc-multiple-inheritance): plain values, of which each section has a name of its own
struct MissionParameters : SensorParameters,
                           SensingParameters,
                           ScanParameters,
                           EstimationParameters,
                           FilterParameters,
                           BearingParameters,
                           TrackingParameters,
                           StartParameters,
                           SearchParameters,
                           ShortRangeParameters,
                           ImageParameters,
                           LinkParameters,
                           InitialPoseParameters {};

enum class ParameterKind : std::uint8_t { kReal, kInteger, kBoolean, kChoice };

// A new row gets this id and raises it by one. The id of a row that goes joins those below, and is never used again.
constexpr std::uint16_t kNextParameterId = 102;
constexpr std::uint16_t kRetiredParameterIds[] = {16, 17, 31, 38, 66, 74, 75, 76, 77, 78, 83, 84};

struct ParameterRow {
  std::uint16_t id;    // names the parameter on the link, wherever its row stands
  ParameterKind kind;  // beside the id, where it takes no room in a flight image
  const char* key;     // TOML path, e.g. "sensor.fov_half_x_deg"
  const char* unit;    // unit of the TOML value: "m", "deg", "1", ...
  double MissionParameters::*member;
  double to_si;                     // member = value * to_si
  double minimum, maximum, preset;  // in the TOML unit, inclusive
  const char* choices;              // kChoice: names joined by '|', value = position; otherwise ""
  const char* meaning;              // one line
};

// In the order of the values of a mission image.
Span<const ParameterRow> parameter_rows();
// The first kSensorValues of them: those of a sensor.
Span<const ParameterRow> sensor_rows();
// The place of the row with this id; rows.size() where no row has it. Loop bound: the rows.
std::size_t index_of_id(Span<const ParameterRow> rows, std::uint16_t id);
double SensorParameters::*sensor_member(const ParameterRow& row);

MissionParameters preset_parameters();

// kNotFinite or kBadValue, with the row's index in `bad_row`, unless every value is within its row's range (and integers are whole).
Status validate(const MissionParameters& parameters, std::size_t& bad_row);
Status validate(const SensorParameters& sensor, std::size_t& bad_row);

}  // namespace lasso
