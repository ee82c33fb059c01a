// A scan as clouds of points.
#pragma once

#include <vector>

#include "fsw/sense/range_image.hpp"
#include "hal_sim/ray_caster.hpp"
#include "mdat/recording/ros_messages.hpp"

namespace lasso::mdat {

// What the clouds say of a scan besides its samples.
struct ScanView {
  const std::vector<RangeSample>& samples;
  TimeUs t_us = 0;                         // reference time
  Pose T_sensor_target;                    // at that time
  Twist rates;                             // of it, sensor axes: rays look at the target where it is at their own time
  std::uint8_t part = 0;                   // of the target that the component sought in it; 0: the whole
  double sigma0_m = 0, sigma_k_per_m = 0;  // range noise that the component assumes: root of sigma0^2 + (k range^2)^2
};

// All rays, in order: x, y, z of a return (NaN of others), the sample itself, bit by bit (direction ux, uy, uz; range; sigma_factor;
// offset_us from t_us; state, see RayState), and its residual: range less that of `model`, metres; NaN where either has none. Of each
// return sigma, the noise of its range [m] (NaN of others); of all the part.
ros::PointCloud scan_cloud(const ScanView& scan, const sim::RayCaster& model);

// The residual of each ray, as above.
std::vector<float> residuals_of(const ScanView& scan, const sim::RayCaster& model);

// The rays that met nothing: the points at which they pass the target, at its origin's range.
ros::PointCloud missed_cloud(const ScanView& scan);

// The samples of a cloud of scan_cloud(). False: it is another one.
bool samples_of(const ros::PointCloud& cloud, TimeUs t_us, std::vector<RangeSample>& samples);

}  // namespace lasso::mdat
