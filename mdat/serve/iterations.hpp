// How a registration came to its pose: its steps, computed again on the ground from the recorded scan, the flight image and the filter of
// the frame before, by the component's own registration.
//
// What is not repeated: a second look, a wide start, and what the outline and silhouettes move the pose by after the last step.
#pragma once

#include <optional>
#include <vector>

#include "fsw/sense/range_image.hpp"
#include "mdat/serve/recording.hpp"

namespace lasso::mdat::serve {

// The pose after a step; the first of them is where the registration began.
struct Iteration {
  Pose T_sensor_target;
  double step_m = 0, step_rad = 0;  // to it from the one before
  double rms_m = 0;                 // of the inliers' range residuals at this pose
  std::uint32_t inliers = 0;        // of this pose
};

// The recorded scan of frame n as the component takes it; none: there is none, or another program's.
std::optional<RangeImage> recorded_scan(const Recording& recording, std::size_t n);

// Empty where nothing can be repeated: no registration ran, it was of a part, no frame before tells where it began, or no image is there.
std::vector<Iteration> iterations_of(const Recording& recording, std::size_t n);

// Range less that of the target's surface for each sample, at this pose, moved by the rates to the sample's own time [m]; NaN where either
// has none. Empty: the recording holds no surface.
std::vector<float> residuals_at(const Recording& recording, const RangeImage& scan, const Pose& T_sensor_target, const Twist& rates);

// The flight parameters that held for scans of this sensor.
MissionParameters parameters_of(const LoadedImage& image, std::uint8_t sensor);

}  // namespace lasso::mdat::serve
