// The calibration of depth images as a file (TOML): fx, fy, cx, cy in pixels, scale_m in metres a unit; values = "depth" (along z, the
// preset) or "range" (along the ray).
#pragma once

#include <filesystem>

#include "hal_sim/depth_image.hpp"

namespace lasso::mdat {

// Throws MissionError with all problems: a key that is missing or unknown, a value out of its range.
sim::DepthCamera load_depth_camera(const std::filesystem::path& file);

}  // namespace lasso::mdat
