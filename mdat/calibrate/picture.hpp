// What a calibration leaves over its volume, as a picture.
#pragma once

#include <string>

#include "mdat/calibrate/fit.hpp"
#include "mdat/report/plotter.hpp"

namespace lasso::mdat {

// The bytes of a PNG file: rms and mean of the residual over the noise, against depth and mirror x. Throws PictureError.
std::string residual_picture(Plotter& plotter, const CalibrationReport& before, const CalibrationReport& after);

}  // namespace lasso::mdat
