// What holds for a stereo head where a mission says nothing. Inside of missiondb.
#pragma once

#include <string>

#include "mdat/missiondb/stereo_source.hpp"

namespace lasso::mdat {

// Of a flight parameter, or a field of a scenario; `preset` where stereo has none of its own. They are those of the preset head (1024
// pixels over 40 deg, 0.3 m): docs/experiments/2026-11-28-stereo.md.
double stereo_preset(const std::string& key, double preset);

// sensor.sigma_k_per_m of a head whose pixels lie over this half field of view: that of half a pixel of disparity, 0.5 / (f b).
double stereo_noise_per_m(const StereoSource& head, double fov_half_rad);

}  // namespace lasso::mdat
