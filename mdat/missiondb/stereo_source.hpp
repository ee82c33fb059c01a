// Stereo cameras as a mission says them, [stereo]: the head that sensors of the kind `stereo` are, and the light on the target.
#pragma once

#include <vector>

namespace lasso::mdat {

constexpr const char* kStereoModelNames[] = {"rendered", "fitted"};  // as a mission writes them

struct StereoSource {
  double model = 0;  // position in kStereoModelNames: pairs are rendered and matched, or ranges have errors that were fitted to such pairs
  double baseline_m = 0.3;
  double pixels = 1024;  // along the longer side of the field of view
  double f_number = 8, pixel_m = 5.5e-6, full_well_e = 20000, read_noise_e = 8;
  double exposure_s = 0;  // 0: by the light (mdat/stereo/exposure_control.hpp)
  double samples = 3;     // rays of a pixel are its square
  double plain = 0;       // 1: surfaces without relief and shades
  double lamp_Wpsr = 0;   // of a lamp at the left camera; 0: none
  double earthshine = 1;  // 0: Earth's light is left out
  // Directions in the sensor frame where the mission has no orbit; of length 0: none.
  std::vector<double> sun = {0.5, -0.5, -0.7}, earth = {0, 1, 0};
  // By how much the right camera stands otherwise than its calibration says: rotation vector in its axes, and the baseline's relative
  // error.
  std::vector<double> turn_error_rad = {0, 0, 0};
  double baseline_error = 0;

  bool is_fitted() const { return model == 1; }
};

}  // namespace lasso::mdat
