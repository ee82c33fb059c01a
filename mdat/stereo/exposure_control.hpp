// The exposure of the next frame, as a camera chooses it by what it has read out.
#pragma once

#include "mdat/stereo/imager.hpp"

namespace lasso::mdat {

constexpr double kMeteredShare = 0.9;  // of the lit pixels are darker than ...
constexpr double kMeteredLevel = 0.6;  // ... this share of the full well
constexpr double kExposureJump = 16;   // where a frame says no more than too bright, or too dark
constexpr double kShortest_s = 2e-5, kLongest_s = 0.1;

// A pixel is lit that is above 0.5 % of the full well, which glare seldom reaches, and above 6 sigma of the read noise. Scaled from the
// exposure of the frame that was measured, not from the present one: so a delay between measurement and effect makes no oscillation.
double next_exposure_s(const RawFrame& frame, const Imager& imager);

// Share of the pixels that are at the greatest number.
double saturated_share(const RawFrame& frame, const Imager& imager);

// The exposure at which the control comes to rest before a scene that stands still: it begins at 1 ms.
double settled_exposure_s(const GreyImage& focused, const Imager& imager, const ImagerSeeds& seeds);

}  // namespace lasso::mdat
