#include <algorithm>
#include <cmath>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/missiondb/rule.hpp"
#include "mdat/missiondb/sections.hpp"
#include "mdat/missiondb/stereo_presets.hpp"
#include "mdat/missiondb/value_row.hpp"

namespace lasso::mdat {
namespace {

constexpr double kStereoNoise = 1.5;       // factor that is still alike
constexpr double kLidarGrowth = 20;        // over that of the LIDAR whose values are the presets
constexpr double kFinestClock_m = 5e-4;    // 3 ps
constexpr double kNarrowBeams = 0.1;       // of the beam's growth, which says how uncertain the place of a contour is
constexpr double kPlaceInPixel = 0.2;      // of a pixel's width
constexpr double kFarNoise = 0.25;         // of the range
constexpr double kAcrossShare = 0.03;      // the same across the ray
constexpr double kLinearCommon = 3;        // of the noise: NEES of 7 to 13 of 6 there, 11 to 26 at ten times
constexpr double kNoiseShare = 1.0 / 12;   // of half of the target's length: the tenth-scale Hubble has wrong poses from there on
constexpr double kFieldShare = 0.25;       // of the target that the field shows: below 0.1 most poses are wrong
constexpr double kLeastFieldShare = 0.05;  // where nothing of the target's shape is left

double farthest_m(const Subject& s) { return *std::max_element(s.sensor->ranges_m.begin(), s.sensor->ranges_m.end()); }

std::string band_fault(double from_m, double to_m, const std::string& to_key) {
  return from_m < to_m ? "" : "expected less than " + to_key + ", which is " + number_text(to_m) + " m";
}

std::string measured_fault(const Subject& s) {
  return band_fault(s.sensor->p.range_min_m, s.sensor->p.range_max_m, s.sensor->prefix + "range_max_m");
}

std::string used_fault(const Subject& s) { return band_fault(s.sensor->p.use_from_m, s.sensor->p.use_to_m, s.sensor->prefix + "use_to_m"); }

std::string span_text(double from_m, double to_m) { return figure(from_m) + " m to " + figure(to_m) + " m"; }

std::string blind_band_fault(const Subject& s) {
  const SensorParameters& p = s.sensor->p;
  if (p.use_from_m < p.range_max_m && p.use_to_m > p.range_min_m) return "";
  return "the sensor is used from " + span_text(p.use_from_m, p.use_to_m) + ", and measures from " +
         span_text(p.range_min_m, p.range_max_m) + ": never both";
}

// Of all scenarios, as a sensor may serve in one of them.
std::string unused_fault(const Subject& s) {
  const SensorParameters& p = s.sensor->p;
  double low_m = 1e9, high_m = 0;
  bool serves = s.scenario != nullptr || s.source.scenarios.empty() || !(p.use_from_m < p.use_to_m);
  for (const auto& [name, scenario] : s.source.scenarios) {
    const auto [low, high] = std::minmax_element(scenario.ranges_m.begin(), scenario.ranges_m.end());
    low_m = std::min(low_m, *low);
    high_m = std::max(high_m, *high);
    const auto within = [&](double range_m) { return range_m >= p.use_from_m && range_m <= p.use_to_m; };
    serves = serves || std::any_of(scenario.ranges_m.begin(), scenario.ranges_m.end(), within);
    serves = serves || (scenario.has_profile() && *low <= p.use_to_m && *high >= p.use_from_m);
  }
  if (serves) return "";
  return "the sensor is used from " + span_text(p.use_from_m, p.use_to_m) + ", where no scenario has the target: they have it from " +
         span_text(low_m, high_m);
}

std::string lidar_growth_fault(const Subject& s) {
  const SensorParameters& p = s.sensor->p;
  const double preset = preset_of(SensorKind::kTimeOfFlight, "sensor.sigma_k_per_m", 0);
  if (s.sensor->kind != SensorKind::kTimeOfFlight || p.sigma_k_per_m <= kLidarGrowth * preset) return "";
  return "grows to " + figure(range_sigma_m(p, p.range_max_m)) + " m at " + figure(p.range_max_m) +
         " m, as that of a laser camera, which triangulates; the preset of a LIDAR is " + figure(preset);
}

std::string lidar_clock_fault(const Subject& s) {
  const double sigma_m = s.sensor->p.sigma0_m;
  if (s.sensor->kind != SensorKind::kTimeOfFlight || sigma_m >= kFinestClock_m) return "";
  return figure(1e3 * sigma_m) + " mm are " + figure(sigma_m / 149.9e-6) +
         " ps of a pulse's time, as of a laser camera; the preset of a LIDAR is " +
         figure(preset_of(SensorKind::kTimeOfFlight, "sensor.sigma0_m", 0)) + " m";
}

std::string camera_fault(const Subject& s) {
  const SensorParameters& p = s.sensor->p;
  if (s.sensor->kind != SensorKind::kLaserCamera || p.sigma_k_per_m > 0 || p.range_max_m <= 10 * p.range_min_m) return "";
  return "the noise of a laser camera, which triangulates, grows with the square of the range, and this one is the same from " +
         span_text(p.range_min_m, p.range_max_m) + "; of a LIDAR say kind = \"time_of_flight\"";
}

std::string far_noise_fault(const Subject& s) {
  const SensorParameters& p = s.sensor->p;
  const double sigma_m = range_sigma_m(p, p.range_max_m);
  if (sigma_m <= kFarNoise * p.range_max_m) return "";
  return "there one sigma of a range is " + figure(sigma_m) + " m; in millimetres? " + figure(p.range_max_m) + " mm are " +
         figure(1e-3 * p.range_max_m) + " m";
}

// Of the head that the mission states.
std::string stereo_noise_fault(const Subject& s) {
  const SensorParameters& p = s.sensor->p;
  if (s.sensor->kind != SensorKind::kStereo) return "";
  const double expected = stereo_noise_per_m(s.source.stereo, std::max(p.fov_half_x_rad, p.fov_half_y_rad));
  if (p.sigma_k_per_m < kStereoNoise * expected && expected < kStereoNoise * p.sigma_k_per_m) return "";
  return "two cameras with " + number_text(s.source.stereo.pixels) + " pixels over " +
         degrees_text(2 * std::max(p.fov_half_x_rad, p.fov_half_y_rad)) + ", " + figure(s.source.stereo.baseline_m) +
         " m apart, make 0.5 pixels of disparity " + figure(expected) +
         ": expected about that, and sensor.common_sigma_k_per_m in proportion";
}

// The fields of both cameras, each as wide as the other, beside each other.
std::string overlap_fault(const Subject& s) {
  if (s.sensor->kind != SensorKind::kStereo || s.sensor->ranges_m.empty()) return "";
  const double width_m = 2 * farthest_m(s) * std::tan(s.sensor->p.fov_half_x_rad);
  if (width_m > s.source.stereo.baseline_m) return "";
  return "the cameras see nothing in common: at " + figure(farthest_m(s)) + " m the field of each is " + figure(width_m) +
         " m wide, and they stand " + figure(s.source.stereo.baseline_m) + " m apart";
}

// A simulated camera ends with the counts of its detector (docs/icd/lcs.md).
std::string fine_camera_fault(const Subject& s) {
  if (s.sensor->kind != SensorKind::kLaserCamera || s.sensor->ranges_m.empty() || s.scenario->noise == 0) return "";
  const double range_m = farthest_m(s), counts_m = kCameraCounts_per_m * range_m * range_m;
  if (range_sigma_m(s.sensor->p, range_m) >= counts_m) return "";
  return "one sigma of a range is " + figure(1e3 * range_sigma_m(s.sensor->p, range_m)) + " mm at " + figure(range_m) +
         " m, less than the counts of a laser camera tell apart, about " + figure(1e3 * counts_m) +
         " mm: its returns would count as outliers";
}

std::string beam_fault(const Subject& s) {
  const double growth_rad = preset_of(SensorKind::kTimeOfFlight, "beam_divergence_rad", 0);
  const double angle_rad = s.sensor->p.sigma_angle_rad;
  if (s.sensor->kind != SensorKind::kTimeOfFlight || s.p.silhouettes < 0.5 || angle_rad >= kNarrowBeams * growth_rad) return "";
  return "the beam of a LIDAR widens by " + figure(growth_rad) + " rad, " + figure(growth_rad * s.sensor->p.range_max_m) + " m at " +
         figure(s.sensor->p.range_max_m) + " m, and on which side of a contour a ray passed is as uncertain: expected about " +
         figure(0.4 * growth_rad) + ", or covariances are too small";
}

// A place within a pixel, one sigma: 0.29 of the pixel.
std::string pixel_fault(const Subject& s) {
  if (s.sensor->kind != SensorKind::kFlashLidar || s.p.silhouettes < 0.5) return "";
  const double pixel_rad = 2 * std::tan(s.sensor->p.fov_half_x_rad) / s.sensor->flash.columns;
  if (s.sensor->p.sigma_angle_rad >= kPlaceInPixel * pixel_rad) return "";
  return "a pixel is " + figure(pixel_rad) + " rad wide, and on which side of a contour it looked is as uncertain: expected about " +
         figure(0.29 * pixel_rad) + ", or covariances are too small";
}

std::string photons_fault(const Subject& s) {
  if (s.sensor->kind != SensorKind::kFlashLidar || s.sensor->ranges_m.empty() || s.scenario->noise == 0) return "";
  const double photons = s.sensor->flash.photons_at_10m * 100 / (farthest_m(s) * farthest_m(s));
  if (photons >= 2 * s.sensor->flash.threshold) return "";
  return "a surface seen straight on returns " + figure(photons) + " counts from " + figure(farthest_m(s)) + " m, and " +
         std::to_string(s.sensor->flash.threshold) + " make a return: many pixels on the target see nothing";
}

std::string aimed_flash_fault(const Subject& s) {
  if (s.sensor->kind != SensorKind::kFlashLidar || s.p.aimed_share == 0) return "";
  return "has no effect in scans of a flash LIDAR, which cannot aim";
}

double noise_share(const Subject& s) {
  return s.sensor->ranges_m.empty() ? 0 : range_sigma_m(s.sensor->p, farthest_m(s)) / s.target->half_m();
}

std::string noise_text(const Subject& s, const std::string& so) {
  const double sigma_m = range_sigma_m(s.sensor->p, farthest_m(s));
  const bool constant = s.sensor->p.sigma0_m >= 0.5 * sigma_m;
  return "one sigma of a range is " + figure(sigma_m) + " m at " + figure(farthest_m(s)) + " m, " +
         percent_text(sigma_m / s.target->longest_m()) + " of the target's length of " + figure(s.target->longest_m()) + " m: " + so +
         (constant ? "; in millimetres? " + figure(s.sensor->p.sigma0_m) + " mm are " + figure(1e-3 * s.sensor->p.sigma0_m) + " m"
                   : "; most of it is by sigma_k_per_m, " + figure(s.sensor->p.sigma_k_per_m));
}

std::string drowned_fault(const Subject& s) { return noise_share(s) > 1 ? noise_text(s, "no shape is left") : ""; }

std::string noise_fault(const Subject& s) {
  return noise_share(s) > kNoiseShare && noise_share(s) <= 1 ? noise_text(s, "poses can be wrong") : "";
}

std::string across_fault(const Subject& s) {
  const double across_m = s.sensor->ranges_m.empty() ? 0 : s.sensor->p.sigma_angle_rad * farthest_m(s);
  if (across_m <= kAcrossShare * s.target->half_m()) return "";
  return "one sigma of a ray's place is " + figure(1e3 * across_m) + " mm at " + figure(farthest_m(s)) + " m, on a target of " +
         figure(s.target->longest_m()) + " m: poses are refused, or wrong; in degrees? " + figure(s.sensor->p.sigma_angle_rad) +
         " deg are " + figure(s.sensor->p.sigma_angle_rad * kRadPerDeg) + " rad";
}

double field_share(const Subject& s, double half_rad) {
  return s.sensor->ranges_m.empty() ? 1 : farthest_m(s) * std::tan(half_rad) / s.target->half_m();
}

std::string field_text(const Subject& s, double half_rad, const std::string& so) {
  const double in_degrees = half_rad / kRadPerDeg;
  const bool radians = in_degrees <= 1 && in_degrees >= 0.02;
  return "the field is " + figure(2 * farthest_m(s) * std::tan(half_rad)) + " m wide at " + figure(farthest_m(s)) + " m, " +
         percent_text(field_share(s, half_rad)) + " of the target's length of " + figure(s.target->longest_m()) + " m: " + so +
         (radians ? "; in radians? " + figure(in_degrees) + " rad are " + degrees_text(in_degrees) : "");
}

template <double SensorParameters::*kHalf>
std::string blind_field_fault(const Subject& s) {
  const double half_rad = s.sensor->p.*kHalf;
  if (field_share(s, half_rad) >= kLeastFieldShare) return "";
  return field_text(s, half_rad, "nothing of its shape is seen");
}

template <double SensorParameters::*kHalf>
std::string field_fault(const Subject& s) {
  const double half_rad = s.sensor->p.*kHalf, share = field_share(s, half_rad);
  if (share < kLeastFieldShare || share >= kFieldShare) return "";
  return field_text(s, half_rad, "poses from so small a part of it can be wrong");
}

double common_error_m(const SensorParameters& p, double range_m) { return p.common_sigma_m + p.common_sigma_k_per_m * range_m * range_m; }

std::string common_memory_fault(const Subject& s) {
  const SensorParameters& p = s.sensor->p;
  if (p.common_memory_s == 0) return "";
  if (common_error_m(p, 1) == 0 && p.common_sigma_rad == 0) return "no common error is stated that it could be the memory of";
  if (p.common_memory_s >= s.p.duration_s) return "";
  return "is shorter than a scan of " + figure(s.p.duration_s) + " s, whose rays then have no errors in common: expected 0, or more";
}

std::string common_size_fault(const Subject& s) {
  const SensorParameters& p = s.sensor->p;
  const double error_m = s.sensor->ranges_m.empty() ? 0 : common_error_m(p, farthest_m(s)) + p.common_sigma_rad * farthest_m(s);
  if (error_m <= s.p.sigma_position_max_m) return "";
  return "common errors make " + figure(1e3 * error_m) + " mm at " + figure(farthest_m(s)) +
         " m, and no pose is more certain: above tracking.sigma_position_max_m, which is " + figure(1e3 * s.p.sigma_position_max_m) +
         " mm, every pose is weak";
}

std::string common_linear_fault(const Subject& s) {
  const SensorParameters& p = s.sensor->p;
  for (const double range_m : s.sensor->ranges_m) {
    const double share = common_error_m(p, range_m) / range_sigma_m(p, range_m);
    if (share <= kLinearCommon) continue;
    return "the range error that rays have in common is " + figure(share) + " times their noise at " + figure(range_m) +
           " m: gates and labels are not linear so far, and poses can be wrong or refused";
  }
  return "";
}

// Half of the target's half on either side of its middle.
std::string cut_fault(const Subject& s) {
  const SensorParameters& p = s.sensor->p;
  for (const double range_m : s.sensor->ranges_m) {
    const double near_m = range_m - 0.5 * s.target->half_m(), far_m = range_m + 0.5 * s.target->half_m();
    if (near_m >= p.range_min_m && far_m <= p.range_max_m) continue;
    return "at " + figure(range_m) + " m the target of " + figure(s.target->longest_m()) +
           " m reaches well beyond the ranges that the sensor measures, " + span_text(p.range_min_m, p.range_max_m) +
           ": much of it is not seen";
  }
  return "";
}

}  // namespace

const Rules& sensor_rules() {
  using enum Severity;
  using enum Scope;
  using enum Needs;
  using P = SensorParameters;
  // clang-format off
  static const Rules rules = {
    {kError, kSensor, kValues, {"sensor.range_min_m", "sensor.range_max_m"}, measured_fault},
    {kError, kSensor, kValues, {"sensor.use_from_m", "sensor.use_to_m"}, used_fault},
    {kError, kSensor, kValues, {"sensor.use_to_m", "sensor.use_from_m", "sensor.range_min_m", "sensor.range_max_m"}, blind_band_fault},
    {kWarning, kSensor, kValues, {"sensor.use_to_m", "sensor.use_from_m"}, unused_fault},
    {kWarning, kSensor, kValues, {"sensor.sigma_k_per_m", "sensor.kind"}, lidar_growth_fault},
    {kWarning, kSensor, kValues, {"sensor.sigma0_m", "sensor.kind"}, lidar_clock_fault},
    {kWarning, kSensor, kValues, {"sensor.sigma_k_per_m", "sensor.kind"}, camera_fault},
    {kWarning, kSensor, kValues, {"sensor.sigma_angle_rad", "sensor.kind"}, beam_fault},
    {kWarning, kSensor, kValues, {"sensor.sigma_angle_rad", "sensor.flash_columns", "sensor.fov_half_x_deg"}, pixel_fault},
    {kWarning, kSensor, kValues, {"sensor.flash_photons_at_10m", "sensor.flash_threshold", "ranges_m"}, photons_fault},
    {kWarning, kSensor, kValues, {"scan.aimed_share", "sensor.kind"}, aimed_flash_fault},
    {kWarning, kSensor, kValues, {"sensor.sigma_k_per_m", "sensor.sigma0_m"}, fine_camera_fault},
    {kWarning, kSensor, kValues, {"sensor.sigma_k_per_m", "sensor.kind"}, stereo_noise_fault},
    {kError, kSensor, kValues, {"stereo.baseline_m", "sensor.fov_half_x_deg"}, overlap_fault},
    {kWarning, kSensor, kValues, {"sensor.range_max_m", "sensor.sigma_k_per_m"}, far_noise_fault},
    {kError, kSensor, kValues, {"sensor.common_memory_s", "scan.duration_s"}, common_memory_fault},
    {kWarning, kSensor, kValues, {"sensor.common_sigma_m", "sensor.common_sigma_k_per_m", "sensor.common_sigma_deg", "tracking.sigma_position_max_m"}, common_size_fault},
    {kWarning, kSensor, kValues, {"sensor.common_sigma_m", "sensor.common_sigma_k_per_m", "sensor.sigma0_m", "sensor.sigma_k_per_m"}, common_linear_fault},
    {kWarning, kSensor, kTarget, {"sensor.sigma_angle_rad"}, across_fault},
    {kError, kSensor, kTarget, {"sensor.sigma0_m", "sensor.sigma_k_per_m"}, drowned_fault},
    {kWarning, kSensor, kTarget, {"sensor.sigma0_m", "sensor.sigma_k_per_m"}, noise_fault},
    {kError, kSensor, kTarget, {"sensor.fov_half_x_deg"}, blind_field_fault<&P::fov_half_x_rad>},
    {kError, kSensor, kTarget, {"sensor.fov_half_y_deg"}, blind_field_fault<&P::fov_half_y_rad>},
    {kWarning, kSensor, kTarget, {"sensor.fov_half_x_deg"}, field_fault<&P::fov_half_x_rad>},
    {kWarning, kSensor, kTarget, {"sensor.fov_half_y_deg"}, field_fault<&P::fov_half_y_rad>},
    {kWarning, kSensor, kTarget, {"ranges_m", "sensor.range_min_m", "sensor.range_max_m"}, cut_fault},
  };
  // clang-format on
  return rules;
}

}  // namespace lasso::mdat
