// From radiance to a picture: exposure and sRGB.
#pragma once

#include <vector>

#include "mdat/render/picture.hpp"
#include "mdat/render/render.hpp"

namespace lasso::mdat {

constexpr double kExposedShare = 0.85;  // of the lit pixels of the target are darker than ...
constexpr double kExposedLevel = 0.5;   // ... this share of white

// The radiance that is white, W/m2/sr, so that the picture is exposed as said above; 0: nothing of the target is lit.
double automatic_white(const std::vector<Rgb>& radiance, const std::vector<SeenPoint>& seen);

// The sRGB code (IEC 61966-2-1) of a linear value, nearest; 0 and 255 beyond [0, 1].
std::uint8_t srgb_code(double linear);

// Values above `white` are clipped, each channel by itself.
Picture photo(const std::vector<Rgb>& radiance, const Camera& camera, double white);

}  // namespace lasso::mdat
