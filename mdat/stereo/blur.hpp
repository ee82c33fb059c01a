// Blur of grey images. Beyond their edges they are black.
#pragma once

#include "mdat/stereo/imager.hpp"

namespace lasso::mdat {

// By a Gaussian of this standard deviation, cut at 4 of them and scaled to sum 1; 0: none.
GreyImage gaussian_blur(const GreyImage& image, double sigma_px);

// Means of blocks of `block` x `block` pixels; what of the last ones is missing counts as black.
GreyImage reduced(const GreyImage& image, int block);

// An image whose pixels are the middles of such blocks, at `width` x `height` pixels: linear between middles, level beyond the outer ones.
GreyImage enlarged(const GreyImage& image, int block, int width, int height);

}  // namespace lasso::mdat
