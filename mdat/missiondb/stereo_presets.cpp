#include "mdat/missiondb/stereo_presets.hpp"

#include <map>

#include "fsw/geometry/portable_math.hpp"

namespace lasso::mdat {
namespace {

constexpr double kPixelM =
    1406.7 * 0.3;  // focal length, pixels, times baseline: a depth z is off by z^2 / kPixelM for each pixel of disparity
// Larger than what a disparity spreads, 0.2 to 0.25: errors of neighbours go together, and a picture is worth far fewer independent ranges
// than a scan has rays.
constexpr double kNoise_px = 0.5, kCommon_px = 0.13;

}  // namespace

double stereo_preset(const std::string& key, double preset) {
  static const std::map<std::string, double> presets = {
      {"sensor.sigma_k_per_m", kNoise_px / kPixelM},
      {"sensor.fov_half_x_deg", 20},
      {"sensor.fov_half_y_deg", 20},
      {"sensor.range_min_m", 0.9},  // three baselines
      {"sensor.common_sigma_k_per_m", kCommon_px / kPixelM},
      {"sensor.common_sigma_deg", 0.04},
      {"estimation.kernel_width", 4},     // wrong matches are many, and near
      {"estimation.noise_estimated", 0},  // residuals do not show what neighbours have in common
      {"tracking.agreement_min", 0.9},    // surfaces are spread beyond their edges
      {"start.inlier_share_min", 0.7},
      {"estimation.silhouettes", 0},  // there are no misses
      {"estimation.deskew", 0},       // all of a picture is taken at once
  };
  const auto found = presets.find(key);
  return found == presets.end() ? preset : found->second;
}

double stereo_noise_per_m(const StereoSource& head, double fov_half_rad) {
  const double focal_px = 0.5 * head.pixels / tangent(fov_half_rad);
  return kNoise_px / (focal_px * head.baseline_m);
}

}  // namespace lasso::mdat
