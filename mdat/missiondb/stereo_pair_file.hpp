// The calibration of a stereo pair as a file (TOML): two cameras, and where the right one stands.
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "fsw/geometry/se3.hpp"

namespace lasso::mdat {

// A pinhole camera with Brown's distortion. The middle of a pixel has whole coordinates, the first one 0.
struct PairCamera {
  int width = 0, height = 0;
  double focal_x_px = 0, focal_y_px = 0, center_x_px = 0, center_y_px = 0;
  std::array<double, 5> distortion{};  // k1, k2, p1, p2, k3, in the order of OpenCV
};

// How the codes of both pictures came about: what is noise is decided by it.
struct PairCodes {
  bool square_root = true;  // code = 255 sqrt(e / full well), as of most pictures that people look at; or 255 e / full well
  double full_well_e = 20000, read_noise_e = 8;
};

struct StereoPair {
  PairCamera left, right;
  Pose T_left_right;  // x right, y down, z ahead
  PairCodes codes;
};

// Throws MissionError with all problems: a key that is missing or unknown, a value out of its range, a quaternion that is not of unit
// length within 1e-3, a right camera that is not to the right of the left one (nearer to its x axis than to y and z).
StereoPair load_stereo_pair(const std::filesystem::path& file);

// The file's text; numbers read back to the same bits.
std::string stereo_pair_text(const StereoPair& pair);

}  // namespace lasso::mdat
