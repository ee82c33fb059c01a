// Where a picture has something to match: light that is no noise, and texture that places a match.
#pragma once

#include <opencv2/core.hpp>

#include "mdat/missiondb/stereo_pair_file.hpp"

namespace lasso::mdat {

constexpr int kMaskWindow_px = 5;    // side of the square over which light and texture are summed
constexpr double kLightSigmas = 6;   // of the read noise, that the mean over it has to exceed
constexpr double kShadeShare = 0.1;  // of the brightest mean within kShadeReach_px, below which sky is that glare lights
constexpr int kShadeReach_px = 6, kShadeMargin_px = 2;
constexpr int kGlintMargin_px = 4;       // about a glint, whose flanks move with it
constexpr double kGlintShare = 0.8;      // of the full well, above which a mean is the sun's mirror image: it moves with the camera
constexpr int kSkyMargin_px = 4;         // about what is dark: a matcher spreads surfaces beyond their edges
constexpr double kWorstSigma_px = 0.35;  // of a disparity, as the texture predicts it

// Electrons in each pixel by its code, 32-bit.
cv::Mat electrons_of(const cv::Mat& codes, const PairCodes& kind);

// 255 where the mean light is above the noise, but for the margin, and not the dark side of a bright edge: there a lens spreads its glare,
// and a matcher the surfaces.
cv::Mat lit_mask(const cv::Mat& codes, const PairCodes& kind);

// 255 where the mean light is near the full well, and about it.
cv::Mat glint_mask(const cv::Mat& codes, const PairCodes& kind);

// Standard deviation of a disparity, pixels: sqrt(2) s / sqrt(sum of squared gradients along the row), s the noise of a code; the noise's
// own gradients are taken off (Cramér-Rao bound of a shift).
cv::Mat predicted_sigma_px(const cv::Mat& codes, const PairCodes& kind);

}  // namespace lasso::mdat
