// Smooth random fields over a picture: what errors of neighbouring pixels have in common.
#pragma once

#include <cstdint>

namespace lasso::mdat {

// A standard normal number at a place of a picture that belongs to `seed`: white noise on a lattice of `blur_px`, blurred by a Gaussian of
// that width. Mean 0, variance 1; the correlation of two places r apart is exp(-r^2 / (4 blur^2)) within 0.02. Bound: 49 lattice points.
double error_field(std::uint64_t seed, double column, double row, double blur_px);

// Share of a standard normal distribution below x; error below 1e-6 (Abramowitz and Stegun, 26.2.17).
double normal_share(double x);

}  // namespace lasso::mdat
