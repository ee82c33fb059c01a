// The steps of a registration (registration_steps.hpp), of a frame of a recording.
#pragma once

#include <optional>
#include <vector>

#include "mdat/recording/registration_steps.hpp"
#include "mdat/serve/recording.hpp"

namespace lasso::mdat::serve {

// The recorded scan of frame n as the component takes it; none: there is none, or another program's.
std::optional<RangeImage> recorded_scan(const Recording& recording, std::size_t n);

// Empty where nothing can be repeated: as registration_steps, or no frame is before, or no image is there.
std::vector<RegistrationStep> iterations_of(const Recording& recording, std::size_t n);

// Range less that of the target's surface for each sample, at this pose, moved by the rates to the sample's own time [m]; NaN where either
// has none. Empty: the recording holds no surface.
std::vector<float> residuals_at(const Recording& recording, const RangeImage& scan, const Pose& T_sensor_target, const Twist& rates);

}  // namespace lasso::mdat::serve
