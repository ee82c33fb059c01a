// How a registration came to its pose: its steps, computed again on the ground from the scan, the flight image and the filter of the frame
// before, by the component's own registration.
//
// What is not repeated: a second look, a wide start, and what the outline and silhouettes move the pose by after the last step.
#pragma once

#include <cstdint>
#include <vector>

#include "fsw/link/pose_telemetry.hpp"
#include "fsw/sense/range_image.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/recording/ros_messages.hpp"
#include "mdat/recording/scan_cloud.hpp"

namespace lasso::mdat {

// The pose after a step; the first of them is where the registration began.
struct RegistrationStep {
  Pose T_sensor_target;
  double step_m = 0, step_rad = 0;  // to it from the one before
  double rms_m = 0;                 // of the inliers' range residuals at this pose
  std::uint32_t inliers = 0;        // of this pose
};

// The flight parameters that hold for scans of this sensor.
MissionParameters parameters_of(const LoadedImage& image, std::uint8_t sensor);

// The samples as the component takes them; false: they are more than it does.
bool to_range_image(const std::vector<RangeSample>& samples, RangeImage& scan);

// `before`: of the frame before, whose filter tells where the registration began, and how it moved the rays. Empty where nothing can be
// repeated: no registration ran, it was of a part, or that frame tells no place.
std::vector<RegistrationStep> registration_steps(const LoadedImage& image, const PoseTelemetry& before, const PoseTelemetry& told,
                                                 const RangeImage& scan);

// The scan's returns with their residuals at each step: x, y, z, residual_0, residual_1, and so on up to `columns`, NaN behind the last
// step. `scan`'s own pose is not asked for; its rates are those with which the rays were moved.
ros::PointCloud steps_cloud(const ScanView& scan, const std::vector<RegistrationStep>& steps, std::size_t columns,
                            const sim::RayCaster& model);

}  // namespace lasso::mdat
