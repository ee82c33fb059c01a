// Red, green and blue of a radiance, an irradiance or a reflectance; linear.
#pragma once

#include <Eigen/Core>

namespace lasso::mdat {

using Rgb = Eigen::Array3d;

// Share of each channel in what the eye calls bright (ITU-R BT.709).
inline double luminance(const Rgb& colour) { return 0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2]; }

}  // namespace lasso::mdat
