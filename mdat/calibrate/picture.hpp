// What a calibration leaves over its volume, as a picture.
#pragma once

#include <string>

#include "mdat/calibrate/fit.hpp"

namespace lasso::mdat {

// The bytes of a PNG file: rms and mean of the residual over the noise, against depth and mirror x. Throws RunError (no gnuplot).
std::string residual_picture(const CalibrationReport& before, const CalibrationReport& after);

}  // namespace lasso::mdat
